"""The headline certificates made anew: `python -m tests.house.certificates` runs `faultspace verify`, locks their names and writes anew
those that the tree has.

HEADLINES   where they are
NAMES       the file there that names all certificates of a run; a name ends with the first digits of its certificate's SHA-256
PATTERN     their names: a kind and the beginning of a digest; verdicts.json, which the command writes beside them, is none
replaced    the names locked, and of the certificates of the tree those written that are made still: the names that came, those that went
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from .import_graph import ROOT

HEADLINES = ROOT / "proofs" / "certificates"
NAMES = "names.txt"
PATTERN = "*-*.json"


def replaced(made: Path, kept: Path) -> tuple[set[str], set[str]]:
    """Return the names that came and those that went. Raises ValueError where nothing was made: a run that failed removes nothing."""
    new = {path.stem: path.read_bytes() for path in made.glob(PATTERN)}
    if not new:
        raise ValueError(f"no certificate {PATTERN} was made")
    old = set((kept / NAMES).read_text("utf-8").split())
    (kept / NAMES).write_text("".join(f"{name}\n" for name in sorted(new)), "utf-8")
    for path in kept.glob(PATTERN):
        if path.stem in new:
            path.write_bytes(new[path.stem])
        else:
            path.unlink()
    return new.keys() - old, old - new.keys()


def main() -> int:
    """Run the command on all claims; replace nothing, and return its code, where a claim is not as expected."""
    with tempfile.TemporaryDirectory() as scratch:
        code = subprocess.run(
            [sys.executable, "-m", "faultspace", "verify", "--effort", "quick", "--jobs", "2", "--out", scratch]
        ).returncode
        if code:
            print("proofs/certificates stays as it is: not every claim is as expected", file=sys.stderr)
            return code
        came, went = replaced(Path(scratch), HEADLINES)
    print(f"proofs/certificates: {len(came)} came, {len(went)} went")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
