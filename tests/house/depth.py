"""How deep the house is: `python -m tests.house.depth` runs four errands and counts the functions of ours between question and answer.

Errand      what is run, after what has to be there
Journey     of one errand: the distinct functions of ours that were called, and the longest chain of them that called each other
travelled   the Journey of a call, in the main thread of this process
ERRANDS     a system inspected, a record identified, a claim decided, a check of the audit

A function of ours is one whose code lies in the tree and has a name: comprehensions, generator expressions and lambdas are not counted, nor
is what runs while a module is imported. A chain goes on through code of others. `--chain` prints the longest one.
"""

from __future__ import annotations

import argparse
import contextlib
import importlib
import io
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
ROOMS = tuple(str(ROOT / name) + "/" for name in ("faultspace", "exact", "numeric", "proofs"))
Body = Callable[[], object]


@dataclass(frozen=True)
class Journey:
    """`functions` counts distinct ones; `chain` names the longest, as file and function, the outermost first."""

    functions: int
    chain: tuple[str, ...]

    @property
    def depth(self) -> int:
        """This says how many functions of ours stand on top of each other at most."""
        return len(self.chain)


@dataclass(frozen=True)
class Errand:
    """`prepared` makes in a folder what is needed, and gives what is then measured."""

    name: str
    prepared: Callable[[Path], Body]


def travelled(body: Body) -> Journey:
    """This runs the body and watches it."""
    seen: set[CodeType] = set()
    ours: dict[CodeType, bool] = {}
    stack: list[CodeType] = []
    deepest: list[CodeType] = []
    importing = 0

    def is_ours(code: CodeType) -> bool:
        if code not in ours:
            ours[code] = code.co_filename.startswith(ROOMS) and not code.co_name.startswith("<")
        return ours[code]

    def watch(frame: FrameType, event: str, _: Any) -> None:
        nonlocal importing, deepest
        code = frame.f_code
        if code.co_name == "<module>" and event in ("call", "return"):
            importing += 1 if event == "call" else -1
        elif importing or event not in ("call", "return") or not is_ours(code):
            return
        elif event == "call":
            seen.add(code)
            stack.append(code)
            if len(stack) > len(deepest):
                deepest = stack.copy()
        elif stack:
            stack.pop()

    sys.setprofile(watch)
    try:
        body()
    finally:
        sys.setprofile(None)
    return Journey(len(seen), tuple(f"{Path(code.co_filename).relative_to(ROOT)}: {code.co_qualname}" for code in deepest))


def _command(*arguments: str) -> Body:
    """Run the command line in this process; what it prints is dropped."""
    main = importlib.import_module("faultspace.__main__").main

    def run() -> None:
        with contextlib.redirect_stdout(io.StringIO()):
            code = main(list(arguments))
        if code != 0:
            raise RuntimeError(f"faultspace {' '.join(arguments)}: exit code {code}")

    return run


def _identify(folder: Path) -> Body:
    with contextlib.redirect_stderr(io.StringIO()):
        _command("examples", str(folder))()
    record = str(folder / "faulty-data.csv")
    return _command("identify", record, "--inputs", "valve,pump", "--outputs", "level1,level2,flow", "--out", str(folder / "RESULT"))


def _audit(_: Path) -> Body:
    """Return the audit of an object, since the command has its checks done in another process."""
    running = importlib.import_module("faultspace.numeric.audit.running")
    reference = importlib.import_module("faultspace.numeric.audit.reference")
    return lambda: running.audit(reference, only=["fault-dimension[one-fault]"])


ERRANDS = (
    Errand("inspect example:paper", lambda folder: _command("inspect", "example:paper")),
    Errand("identify faulty-data.csv", _identify),
    Errand("verify --claim example-v", lambda folder: _command("verify", "--claim", "example-v", "--jobs", "1")),
    Errand("audit, fault-dimension[one-fault]", _audit),
)


def main(arguments: list[str] | None = None) -> int:
    """Prints a row for each errand, in Markdown."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--chain", action="store_true", help="print the longest chain of each")
    parser.add_argument("--errand", action="append", metavar="WORD", help="only those whose name has this word; may be repeated")
    options = parser.parse_args(arguments)
    print("| errand | functions of ours | greatest depth |\n|---|---|---|", flush=True)
    for errand in ERRANDS:
        if options.errand and not any(word in errand.name for word in options.errand):
            continue
        with tempfile.TemporaryDirectory() as name:
            found = travelled(errand.prepared(Path(name)))
        print(f"| `{errand.name}` | {found.functions} | {found.depth} |", flush=True)
        if options.chain:
            print("\n".join(f"{'  ' * level}{step}" for level, step in enumerate(found.chain)), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
