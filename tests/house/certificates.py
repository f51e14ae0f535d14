"""The headline certificates made anew: `python -m tests.house.certificates` runs `faultspace verify` and puts what it wrote in their place.

HEADLINES   where they are
PATTERN     their names: a kind and the beginning of a digest; verdicts.json, which the command writes beside them, is none
replaced    the old certificates removed, the new ones put there: the names that came, and those that went
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from .import_graph import ROOT

HEADLINES = ROOT / "proofs" / "certificates"
PATTERN = "*-*.json"


def replaced(made: Path, kept: Path) -> tuple[set[str], set[str]]:
    """Names that came and names that went. Raises ValueError where nothing was made: a run that failed removes nothing."""
    new = {path.name: path.read_bytes() for path in made.glob(PATTERN)}
    if not new:
        raise ValueError(f"no certificate {PATTERN} was made")
    old = {path.name for path in kept.glob(PATTERN)}
    for name in old - new.keys():
        (kept / name).unlink()
    for name, content in new.items():
        (kept / name).write_bytes(content)
    return new.keys() - old, old - new.keys()


def main() -> int:
    """Runs the command on all claims; replaces nothing, and returns its code, where a claim is not as expected."""
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
