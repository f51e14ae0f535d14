"""`faultspace conjecture`: bounds on a quantity by others; and `faultspace claim --sharpen`: bounds in the place of a claim's.

run             the body of `conjecture`
run_sharpen     that of `claim --sharpen`
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.text import Text

from ..base.errors import InvalidInput, in_file, quote_path, shorten
from ..base.messages import say
from ..base.progress import evenly, working
from ..base.sheets import NAME_WIDTH, Shown, counted, line
from ..proofs.brought.claims import Claim
from ..proofs.brought.conjectures import Sharpened
from ..proofs.brought.conjecturing import MOST, conjecture, sharpen
from ..proofs.trust.structure_certificates import Certificate, sha256
from .consoles import answers, paragraph, print_json
from .failures import ANSWERED
from .reading_files import prepare_folder, write_json


def run(
    target: str,
    *,
    under: Sequence[str],
    by: Sequence[str],
    about: str,
    field: str,
    sizes: Sequence[str],
    numbers: dict[str, int | None],
    most: int | None,
    jobs: int,
    out: Path | None,
    as_json: bool,
) -> int:
    """Seek bounds on the target and show them. `numbers` are those of the grammar; None leaves one as it is."""
    box = _box(sizes)
    if out is not None:
        prepare_folder(out)
    given: dict[str, Any] = {name: value for name, value in numbers.items() if value is not None}
    with working(f"seeking bounds on {shorten(target)}") as tell:
        found = conjecture(
            target,
            hypotheses=list(under),
            by=list(by) or None,
            about=about,
            field=field,
            box=box or None,
            most=MOST if most is None else most,
            jobs=jobs,
            on_progress=evenly(tell),
            **given,
        )
    if as_json:
        print_json(found.to_json())
    else:
        _print([found])
    if out is not None:
        write_certificates(out, found.certificates)
    return ANSWERED


def run_sharpen(name: str, claims: Sequence[Claim], *, most: int | None, jobs: int, out: Path | None, as_json: bool) -> int:
    """Seek bounds in the place of those of the claims of the file `name`, and show them."""
    if out is not None:
        prepare_folder(out)
    with in_file(name), working(f"sharpening {quote_path(name)}") as tell:
        told = evenly(tell)
        found: list[Sharpened] = [
            answer for one in claims for answer in sharpen(one, most=MOST if most is None else most, jobs=jobs, progress=told)
        ]
    if as_json:
        print_json({"sharpened": [one.to_json() for one in found]})
    else:
        _print(found)
    if out is not None:
        write_certificates(out, [certificate for one in found for certificate in one.certificates])
    return ANSWERED


def _print(found: Sequence[Shown]) -> None:
    console = answers()
    for one in found:
        print_shown(console, one, "bold")


def print_shown(console: Console, one: Shown, style: str) -> None:
    """Print the title of a record, a line for each pair of its sheet, and an empty line."""
    paragraph(console, Text(one.title, style=style))
    for label, value in one.sheet():
        paragraph(console, value, line(label, " ")[:-1] + " " * (len(label) >= NAME_WIDTH))
    console.print()


def write_certificates(out: Path, certificates: Iterable[Certificate]) -> None:
    """Write them into the folder, each named by its kind and SHA-256, and say how many there are."""
    names = {f"{one['kind']}-{sha256(one)[:12]}.json": one for one in certificates}
    for file, certificate in names.items():
        write_json(out / file, certificate)
    say(f"{quote_path(str(out))} has {counted(len(names), 'certificate')}; check each with: faultspace check FILE")


def _box(sizes: Sequence[str]) -> dict[str, Any]:
    """Return the box of texts such as n=1:3, total=5 and entries=-1,0,1; what the values may be is said where they are read."""
    found: dict[str, Any] = {}
    for one in sizes:
        key, equals, value = (part.strip() for part in one.partition("="))
        if not equals or key in found:
            raise InvalidInput(f"--box: got {shorten(one)}, expected such as n=1:3, total=5 or entries=-1,0,1, each key once")
        if key == "entries":
            found[key] = [part.strip() for part in value.split(",")]
        elif key == "total":
            found[key] = _whole(one, value)
        else:
            first, colon, last = value.partition(":")
            found[key] = [_whole(one, first), _whole(one, last if colon else first)]
    return found


def _whole(text: str, part: str) -> int:
    try:
        return int(part)
    except ValueError:
        raise InvalidInput(f"--box: got {shorten(text)}, expected whole numbers such as n=1:3 or total=5") from None
