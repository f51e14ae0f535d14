"""Declare the command `faultspace conjecture`, whose work is in `conjecturing`, imported when asked for.

conjecture   its arguments and options, as `command_line` declares the other commands
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .option_types import Json, jobs_number, number


def conjecture(
    target: Annotated[str, typer.Argument(metavar="TARGET", show_default=False, help="A quantity, such as lag, or a sum of some.")],
    under: Annotated[
        list[str] | None, typer.Option(metavar="H", help="A hypothesis, such as left_invertible; may be repeated.", show_default=False)
    ] = None,
    by: Annotated[
        list[str] | None, typer.Option(metavar="Q", help="Seek bounds by this quantity alone, and others so named.", show_default="all")
    ] = None,
    about: Annotated[
        str, typer.Option(metavar="KIND", help="What is bounded: system, pair, 'pair with the same (A, C)', choice or record.")
    ] = "system",
    field: Annotated[str, typer.Option(metavar="FIELD", help="Q, or GF(q).")] = "Q",
    box: Annotated[
        list[str] | None,
        typer.Option(metavar="KEY=VALUE", help="As n=1:3, total=5, entries=-1,0,1, or k, nu, N; may be repeated.", show_default=False),
    ] = None,
    terms: Annotated[
        int | None, typer.Option(metavar="K", parser=number(int, 1, 2), help="Quantities in a bound.", show_default="3, or 2")
    ] = None,
    largest: Annotated[
        int | None, typer.Option(metavar="K", parser=number(int, 1, 1), help="Largest coefficient.", show_default="2")
    ] = None,
    constant: Annotated[int | None, typer.Option(metavar="K", parser=number(int, 0, 1), help="Largest constant.", show_default="2")] = None,
    most: Annotated[
        int | None,
        typer.Option(metavar="K", parser=number(int, 1, 10**9), help="Go through no more of the box.", show_default="10^9"),
    ] = None,
    jobs: Annotated[int, typer.Option(metavar="K", parser=jobs_number, help="Processes at a time, for large boxes.")] = 1,
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="Write the certificates there.", show_default=False)] = None,
    json: Json = False,
) -> int:
    """Seek bounds that nothing refutes.

    What is answered is refuted by nothing that was tried and attained by a system (a pair, a choice, a record), none is implied
    by the others, and the next sharper ones come with the smallest one that refutes them. It is no proof; docs/your-claims.md
    tells the language.
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
