"""`faultspace check`: certificates through the checker, which decides alone; here they are only opened, and the answers shown.
--rocq       besides, what Rocq's kernel makes of the certificates that the checker has verified
"""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console
from rich.text import Text

from .. import packaged_examples
from ..base.errors import InvalidInput, in_file, quote_path
from ..base.messages import say
from ..base.progress import working
from ..base.regular_files import standard_input
from ..proofs.checking import CheckedFile, ask_rocq, check_file
from ..proofs.rocq.build import believed, told
from ..proofs.trust import checker
from .consoles import answers, paragraph, print_json
from .failures import NOT_AS_EXPECTED

STYLES = dict.fromkeys(("verified", "accepted"), "green") | dict.fromkeys(("rejected", "malformed"), "red")
STYLES |= dict.fromkeys(("verified under an assumption", "not covered", "undecided", "not asked"), "yellow")


def run(names: Sequence[str], *, systems: Sequence[str], rocq: bool = False, as_json: bool) -> int:
    """Check one file after the other; the exit code of the worst. As JSON: an array with one object a file, as the checker writes it.

    What does not parse is told on standard error alone, and in the JSON. With `rocq`, exit 1 also where Rocq accepts not all of them, and
    InvalidInput where there is no Rocq.
    """
    insisted = [_system(name) for name in systems]
    console = answers()
    files: list[CheckedFile] = []
    for name in names:
        with working(f"checking {quote_path(name)}"):
            files.append(check_file(name, insisted))
        if not rocq:
            _show(console, files[-1], as_json=as_json)
    if rocq:
        files = _with_rocq(files)
        for file in files:
            _show(console, file, as_json=as_json)
    if as_json:
        print_json([file.to_json() for file in files])
    code = checker.worst(file.result for file in files)
    doubted = any(file.rocq is not None and file.rocq["result"] != "accepted" for file in files)
    return NOT_AS_EXPECTED if doubted and code != checker.CODES["malformed"] else code


def _with_rocq(files: Sequence[CheckedFile]) -> list[CheckedFile]:
    try:
        with working("asking Rocq") as tell:
            asked = ask_rocq(files, tell)
        say(f"Rocq: {told(believed())}")
        return asked
    except InvalidInput as error:
        raise InvalidInput(f"--{error}") from None


def _show(console: Console, file: CheckedFile, *, as_json: bool) -> None:
    answer, name = file.answer, quote_path(file.answer["file"])
    if file.result == "malformed":
        reason = answer["reason"]
        reason = reason[:1].lower() + reason[1:] if reason[1:2].islower() else reason
        say(f"{name}: {reason}; certificates are what `faultspace verify --out DIR` writes")
    elif not as_json:
        heading = Text.assemble((file.result, STYLES[file.result]), f"  {name}")
        if "sha256" in answer:
            heading.append(f"  {answer['kind']}, SHA-256 {answer['sha256'][:12]}")
        paragraph(console, heading)
        paragraph(console, answer.get("statement") or answer["reason"], "    ")
        for assumption in answer.get("assumes", []):
            paragraph(console, assumption, "    assumed, not verified: ")
        if file.rocq is not None:
            verdict = file.rocq["result"]
            paragraph(console, Text.assemble((verdict, STYLES[verdict]), f", {file.rocq['reason']}"), "    Rocq: ")


def _system(name: str) -> checker.System:
    """The SYSTEM or EXPERIMENT in a file, an example or standard input, under the limits of the checker."""
    with in_file(name):
        try:
            if name.startswith(packaged_examples.PREFIX):
                data = packaged_examples.content(name)
            elif name == "-":
                data = standard_input().read(checker.MAX_BYTES + 1)
            else:
                data = checker.content(name)
        except checker.Malformed as error:
            reason = str(error)
            raise InvalidInput(f"cannot be read ({reason[:1].lower()}{reason[1:]}), expected a JSON file") from None
        try:
            return checker.subject(checker.parse(data.removeprefix(b"\xef\xbb\xbf")))
        except (checker.Malformed, checker.Rejected) as error:
            raise InvalidInput(f"got no system: {error}") from None
