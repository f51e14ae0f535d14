"""Declare the commands about claims: verify, check, claim, conjecture and report. Each one's work is in a module of its own, imported when
asked for; `command_line.py` makes commands of these functions."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

from ..base.errors import InvalidInput, shorten
from .option_types import BoxJobs, Certificates, Effort, Jobs, Json, Scheduler, Verbose, number


def verify(
    stray: Annotated[list[str] | None, typer.Argument(hidden=True)] = None,
    *,
    effort: Annotated[Effort, typer.Option(help="Samples of systems; or every small one, for the background.")] = Effort.quick,
    claim: Annotated[list[str] | None, typer.Option("--claim", metavar="ID", help="Only this claim, its card; may be repeated.")] = None,
    jobs: Jobs = None,
    scheduler: Scheduler = None,
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="Write the headline certificates and verdicts.json there.")] = None,
    rocq: Annotated[bool, typer.Option("--rocq", help="Have Rocq check the theorems; the first time, compile them: minutes.")] = False,
    recheck: Annotated[
        bool, typer.Option("--recheck", help="First compile the Rocq theory anew, whatever is cached, and let coqchk read it.")
    ] = False,
    resume: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Keep what is decided there, and go on with what an earlier run has kept.")
    ] = None,
    verbose: Verbose = False,
    json: Json = False,
) -> int:
    """Decide the claims of the paper.

    A claim gets a sentence, with --claim a card; -v prints all readings. Exit 0 if every verdict is the expected one, else 1.
    """
    from . import verifying

    if stray:
        near = verifying.nearest(stray[0])
        raise InvalidInput(f"verify: got {shorten(stray[0])}, expected options; try: faultspace verify --claim {near}")
    workers = jobs or (os.cpu_count() or 1 if scheduler is None else -1)
    return verifying.run(
        claim or [],
        effort=effort.value,
        jobs=workers,
        scheduler=scheduler,
        out=out,
        rocq=rocq,
        recheck=recheck,
        verbose=verbose,
        as_json=json,
        resume=resume,
    )


def check(
    certificate: Annotated[list[str], typer.Argument(metavar="CERTIFICATE...", help="Certificate files.")],
    system: Annotated[
        list[str] | None, typer.Option("--system", metavar="FILE", help="Accept only what is about this system; may be repeated.")
    ] = None,
    rocq: Annotated[bool, typer.Option("--rocq", help="Have Rocq's kernel recompute them, too; needs coqc with MathComp.")] = False,
    json: Json = False,
) -> int:
    """Run the checker on certificates.

    Exit 0: all verified; 3: all verified, one or more under an assumption that is printed; 1: one is
    rejected, or not accepted by Rocq; 2: one does not parse.
    """
    from . import checking

    return checking.run(certificate, systems=system or [], rocq=rocq, as_json=json)


def claim(
    file: Annotated[str, typer.Argument(metavar="FILE", help="Claims in TOML, - or example:claims.")],
    only: Annotated[list[str] | None, typer.Option("--claim", metavar="ID", help="Only this claim of the file; may be repeated.")] = None,
    ablation: Annotated[bool, typer.Option("--ablation/--no-ablation", help="Try each claim without each of its hypotheses, too.")] = True,
    most: Annotated[
        int | None,
        typer.Option(metavar="K", parser=number(int, 1, 10**9), help="Go through no more systems of a box.", show_default="10^9"),
    ] = None,
    jobs: BoxJobs = 1,
    explain: Annotated[
        str | None, typer.Option(metavar="SYSTEM", help="Tell what each part of the claims is on this system, instead.")
    ] = None,
    sharpen: Annotated[
        list[str] | None, typer.Option(metavar="ID", help="Seek sharper bounds in the place of this claim's, instead; may be repeated.")
    ] = None,
    out: Certificates = None,
    resume: Annotated[Path | None, typer.Option(metavar="FILE", help="Keep there what was gone through, and go on from it.")] = None,
    scheduler: Scheduler = None,
    json: Json = False,
) -> int:
    """Decide claims of your own about systems.

    Each is refuted by a counterexample, the smallest of its box where that has one, proved, not refuted, or vacuous. The page
    docs/your-claims.md tells the language. Exit 1 where a claim names the verdict that it expects and gets another one.

    Example: faultspace claim example:claims
    """
    from . import claiming

    if sharpen:
        if only or explain is not None:
            raise InvalidInput("--sharpen: got --claim or --explain, too, expected --sharpen ID alone")
        return claiming.sharpen(file, sharpen, most=most, jobs=jobs, out=out, as_json=json)
    return claiming.run(
        file, only=only or [], ablation=ablation, most=most, jobs=jobs, on=explain, out=out, as_json=json, cluster=scheduler, resume=resume
    )


def conjecture(
    target: Annotated[str, typer.Argument(metavar="TARGET", help="A quantity, such as lag, or a sum of some.")],
    under: Annotated[list[str] | None, typer.Option(metavar="H", help="A hypothesis, such as left_invertible; may be repeated.")] = None,
    by: Annotated[
        list[str] | None, typer.Option(metavar="Q", help="Seek bounds by this quantity alone, and others so named.", show_default="all")
    ] = None,
    about: Annotated[
        str, typer.Option(metavar="KIND", help="What is bounded: system, pair, 'pair with the same (A, C)', choice or record.")
    ] = "system",
    field: Annotated[str, typer.Option(metavar="FIELD", help="Q, GF(q), or as 'Q(a) with a^2 - 2 = 0'.")] = "Q",
    box: Annotated[
        list[str] | None, typer.Option(metavar="KEY=VALUE", help="As n=1:3, total=5, entries=-1,0,1, or k, nu, N; may be repeated.")
    ] = None,
    terms: Annotated[
        int | None, typer.Option(metavar="K", parser=number(int, 1, 2), help="Quantities in a bound.", show_default="3, or 2")
    ] = None,
    largest: Annotated[
        int | None, typer.Option(metavar="K", parser=number(int, 1, 1), help="Largest coefficient.", show_default="2")
    ] = None,
    constant: Annotated[int | None, typer.Option(metavar="K", parser=number(int, 0, 1), help="Largest constant.", show_default="2")] = None,
    most: Annotated[
        int | None, typer.Option(metavar="K", parser=number(int, 1, 10**9), help="Go through no more of the box.", show_default="10^9")
    ] = None,
    jobs: BoxJobs = 1,
    out: Certificates = None,
    json: Json = False,
) -> int:
    """Seek bounds that nothing refutes.

    What is answered is refuted by nothing that was tried and attained by a system (a pair, a choice, a record), none is implied
    by the others, and the next sharper ones come with the smallest one that refutes them. It is no proof; docs/your-claims.md
    tells the language.

    Example: faultspace conjecture lag --by n
    """
    from . import conjecturing

    numbers = {"terms": terms, "largest": largest, "constant": constant}
    return conjecturing.run(
        target,
        under=under or [],
        by=by or [],
        about=about,
        field=field,
        sizes=box or [],
        numbers=numbers,
        most=most,
        jobs=jobs,
        out=out,
        as_json=json,
    )


def report(
    run: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="A folder that `faultspace verify --out` has written.", show_default="decide the claims now"),
    ] = None,
    out: Annotated[Path, typer.Option(metavar="DIR", help="Write the page there.")] = Path("faultspace-report"),
    effort: Annotated[Effort, typer.Option(help="Of the run, where the claims are decided now.")] = Effort.quick,
    jobs: Jobs = None,
    pdf: Annotated[bool, typer.Option("--pdf", help="Print the page into report.pdf, too; needs a Chromium.")] = False,
    serve: Annotated[bool, typer.Option("--serve", help="Show the page at a local address until you interrupt it.")] = False,
    json: Json = False,
) -> int:
    """Make the page that a reviewer reads.

    One file with everything: the claims as stated and as checked, counterexamples, limits, a small study, what must be believed, what was
    wrong. It fetches nothing. Without --run the claims and the statements of the literature are decided first, which takes minutes. Exit 0
    if everything is as expected, else 1: then the page begins with what is not. Needs the extra: pip install 'faultspace[report]'.
    """
    from . import reporting

    return reporting.run(run, out, effort=effort.value, jobs=jobs, pdf=pdf, serve=serve, as_json=json)
