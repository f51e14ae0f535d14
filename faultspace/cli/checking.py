"""`faultspace check`: certificates through the checker, which decides alone; here they are only opened and told about.

run          the command's body
--rocq       besides, what Rocq's kernel makes of the certificates that the checker has verified
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

from rich.console import Console
from rich.text import Text

from .. import packaged_examples
from ..base.errors import InvalidInput, in_file, quote_path
from ..proofs.trust import checker
from .consoles import answers, print_json
from .failures import NOT_AS_EXPECTED, say
from .progress import working

STYLES = dict.fromkeys(("verified", "accepted"), "green") | dict.fromkeys(("rejected", "malformed"), "red")
STYLES |= dict.fromkeys(("verified under an assumption", "not covered", "undecided", "not asked"), "yellow")


def run(names: Sequence[str], *, systems: Sequence[str], rocq: bool = False, as_json: bool) -> int:
    """Checks one file after the other; the exit code of the worst. As JSON: an array with one object a file, as the checker writes it.

    What does not parse is told on standard error alone, and in the JSON. With `rocq`, exit 1 also where Rocq accepts not all of them, and
    InvalidInput where there is no Rocq.
    """
    insisted = [_system(name) for name in systems]
    console = answers()
    results: list[dict[str, Any]] = []
    for name in names:
        with working(f"checking {quote_path(name)}"):
            result = checker.result_of(name, insisted)
        results.append(result)
        if not rocq:
            _tell(console, result, as_json=as_json)
    if rocq:
        _add_rocq(results)
        for result in results:
            _tell(console, result, as_json=as_json)
    if as_json:
        print_json(results)
    code = checker.worst(result["result"] for result in results)
    doubted = any(result["rocq"]["result"] != "accepted" for result in results if "rocq" in result)
    return NOT_AS_EXPECTED if doubted and code != checker.CODES["malformed"] else code


def _tell(console: Console, result: dict[str, Any], *, as_json: bool) -> None:
    name = quote_path(result["file"])
    if result["result"] == "malformed":
        say(f"{name}: {result['reason']}")
    elif not as_json:
        heading = Text.assemble((result["result"], STYLES[result["result"]]), f"  {name}")
        if "sha256" in result:
            heading.append(f"  {result['kind']}, SHA-256 {result['sha256'][:12]}")
        console.print(heading, soft_wrap=True)
        console.print(Text("    " + (result.get("statement") or result["reason"])), soft_wrap=True)
        for assumption in result.get("assumes", []):
            console.print(Text(f"    assumed, not verified: {assumption}"), soft_wrap=True)
        if "rocq" in result:
            verdict = result["rocq"]["result"]
            console.print(Text.assemble("    Rocq: ", (verdict, STYLES[verdict]), f", {result['rocq']['reason']}"), soft_wrap=True)


def _add_rocq(results: list[dict[str, Any]]) -> None:
    """What Rocq says of each certificate that parses, under the key "rocq"; it is asked about verified ones alone."""
    from ..proofs.rocq.build import BrokenTheory, NoRocq
    from ..proofs.rocq.recompute import recomputed

    certificates, asked = [], []
    for result in results:
        if result["result"] == "rejected":
            result["rocq"] = {"result": "not asked", "reason": "only what the checker has verified is handed to Rocq"}
        elif result["result"] != "malformed":
            certificate = _again(result)
            if certificate is not None:
                certificates.append(certificate)
                asked.append(result)
    try:
        with working("asking Rocq") as tell:
            said = recomputed(certificates, tell)
    except NoRocq as error:
        raise InvalidInput(f"--rocq: {error}") from None
    except BrokenTheory as error:
        raise InvalidInput(f"--rocq: this version of Rocq does not compile the theory ({error})") from None
    for result, one in zip(asked, said, strict=True):
        result["rocq"] = {"result": one.result, "reason": one.reason}


def _again(result: dict[str, Any]) -> Any:
    """The certificate, which is not kept meanwhile; None, and "not asked", where the file holds another one now."""
    try:
        certificate = checker.load(result["file"])
        if checker.sha256(certificate) == result["sha256"]:
            return certificate
    except (checker.Malformed, ValueError, TypeError, MemoryError):
        pass
    result["rocq"] = {"result": "not asked", "reason": "the file has changed since the checker has read it"}
    return None


def _system(name: str) -> checker.System:
    """The SYSTEM or EXPERIMENT in a file, an example or standard input, under the limits of the checker."""
    with in_file(name):
        try:
            if name.startswith(packaged_examples.PREFIX):
                data = packaged_examples.content(name)
            elif name == "-":
                data = sys.stdin.buffer.read(checker.MAX_BYTES + 1)
            else:
                data = checker.content(name)
        except checker.Malformed as error:
            reason = str(error)
            raise InvalidInput(f"cannot be read ({reason[:1].lower()}{reason[1:]}), expected a JSON file") from None
        try:
            return checker.subject(checker.parse(data.removeprefix(b"\xef\xbb\xbf")))
        except (checker.Malformed, checker.Rejected) as error:
            raise InvalidInput(f"got no system: {error}") from None
