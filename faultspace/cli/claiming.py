"""`faultspace claim`: claims of your own, decided; or, with --explain, what each part of them is on a system, or a pair."""

from __future__ import annotations

from pathlib import Path

from rich.text import Text

from ..base.errors import InvalidInput, in_file, quote_path
from ..base.messages import say
from ..base.progress import evenly, working
from ..proofs.brought.case_files import is_choice, is_pair, is_record, read_case
from ..proofs.brought.claim_files import read_claims
from ..proofs.brought.claiming import MOST, decide_claims, explain
from ..proofs.brought.claims import Answered, Claim, nearest
from ..proofs.quantities.cases import case_json
from .conjecturing import print_shown, run_sharpen, write_certificates
from .consoles import answers, paragraph, print_json
from .failures import ANSWERED, NOT_AS_EXPECTED
from .reading_files import prepare_folder, read_json, read_text, system_in

STYLES = {Answered.REFUTED: "red", Answered.NOT_REFUTED: "green", Answered.PROVED: "green", Answered.VACUOUS: "yellow"}


def run(
    name: str,
    *,
    only: list[str],
    ablation: bool,
    most: int | None,
    jobs: int,
    on: str | None,
    out: Path | None,
    as_json: bool,
    cluster: str | None = None,
    resume: Path | None = None,
) -> int:
    """Decide the claims of a file, or explain them on what is in `on`. The exit code is 1 where a verdict is not the expected one."""
    if cluster is not None and jobs > 1:
        raise InvalidInput("--scheduler: got --jobs, too, expected one of the two: the cluster decides how many work")
    with in_file(name):
        claims = _chosen(read_claims(read_text(name)), only, "--claim")
    if on is not None:
        return _explain(claims, on, as_json=as_json)
    if out is not None:
        prepare_folder(out)
    with in_file(name), working(f"deciding {quote_path(name)}") as tell:
        found = decide_claims(
            claims,
            ablation=ablation,
            most=MOST if most is None else most,
            jobs=jobs,
            on_progress=evenly(tell),
            cluster=cluster,
            resume=resume,
        )
    if as_json:
        print_json(found.to_json())
    else:
        console = answers()
        for one in sorted(found.answers, key=lambda answer: answer.as_expected):  # stable: what is not as expected is seen first
            print_shown(console, one, f"bold {STYLES[one.verdict]}")
    if out is not None:
        write_certificates(out, found.certificates)
    for one in found.answers:
        if not one.as_expected:
            say(f"{one.id} over {one.field}: got {one.verdict}, expected {one.expected}")
    return ANSWERED if found.as_expected else NOT_AS_EXPECTED


def sharpen(name: str, ids: list[str], *, most: int | None, jobs: int, out: Path | None, as_json: bool) -> int:
    """Seek bounds in the place of those that these claims of a file state."""
    with in_file(name):
        claims = _chosen(read_claims(read_text(name)), ids, "--sharpen")
    return run_sharpen(name, claims, most=most, jobs=jobs, out=out, as_json=as_json)


def _chosen(claims: list[Claim], only: list[str], option: str) -> list[Claim]:
    names = tuple(one.id for one in claims)
    for id in only:
        if id not in names:
            raise InvalidInput(f"{option}: got {id}, which is no claim of the file; {nearest(id, names)}")
    return [one for one in claims if not only or one.id in only]


def _explain(claims: list[Claim], on: str, *, as_json: bool) -> int:
    document = read_json(on)
    told = {}
    with in_file(on):
        case = read_case(document) if any(one(document) for one in (is_pair, is_choice, is_record)) else system_in(document).residual
        for one in claims:
            told[one.id] = list(explain(one, case))
    if as_json:
        rows = {id: [{"level": level, "text": text, "value": value} for level, text, value in parts] for id, parts in told.items()}
        print_json(case_json(case) | {"explained": rows})
        return ANSWERED
    console = answers()
    for id, parts in told.items():
        paragraph(console, Text.assemble((id, "bold"), f"  on {case}"))
        for level, text, value in parts:
            paragraph(console, value, f"{'  ' * (level + 1)}{text} = ")
        console.print()
    return ANSWERED
