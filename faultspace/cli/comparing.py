"""`faultspace compare`: whether two systems make the same outputs, and a word that separates them where they do not.

run          the command's body
word_json    the separating word as JSON, for `--word --json`
"""

from __future__ import annotations

from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..base.errors import in_file, quote_path
from ..exact.algebra.matrices import Matrix
from ..exact.structure.behavior import Comparison, Separation, compare
from ..exact.structure.kernel_rows import kernel_representation
from ..exact.structure.signals import simulate
from ..exact.system.systems import ResidualSystem
from .consoles import answers, print_json, print_table
from .failures import ANSWERED, NOT_AS_EXPECTED, say
from .notation import entry, polynomial
from .progress import working
from .reading_files import read_system

MOST_SAMPLES = 24


def run(names: tuple[str, str], *, as_json: bool, expected: str | None, word: bool, floats_exactly: bool) -> int:
    """Compares the systems in two files; `expected` is "equivalent", "different" or None."""
    systems = [read_system(name, floats_exactly=floats_exactly).residual for name in names]
    both = " and ".join(map(quote_path, names))
    with in_file(both), working(f"comparing {both}"):
        found = compare(*(kernel_representation(system) for system in systems))
    if as_json:
        document: dict[str, object] = {"equivalent": found.equivalent, "first_difference": found.first_difference}
        print_json(document | {"word": word_json(found)} if word else document)
    else:
        _print(answers(), names, found, whole_word=word)
    verdict = "equivalent" if found.equivalent else "different"
    if expected not in (None, verdict):
        say(f"{both}: got {verdict}, expected {expected}")
        return NOT_AS_EXPECTED
    return ANSWERED


def word_json(found: Comparison) -> dict[str, Any] | None:
    """The shortest word of one system that the other cannot make, with its output and the kernel row it violates; null if there is none.

    "of" says whose word it is: "first" or "second". v and r hold one row a sample; row holds [c_0, ..., c_mu].
    """
    shortest = _shortest(found)
    if shortest is None:
        return None
    maker, system, word = shortest
    return {
        "of": maker,
        "x0": [row[0] for row in word.x0.to_json()],
        "v": word.v.to_json(),
        "r": _outputs(system, word).to_json(),
        "row": word.row.coefficients.to_json(),
    }


def _shortest(found: Comparison) -> tuple[str, ResidualSystem, Separation] | None:
    candidates = [
        ("first", found.first.system, found.first_not_in_second),
        ("second", found.second.system, found.second_not_in_first),
    ]
    words = [(maker, system, word) for maker, system, word in candidates if word is not None]
    return min(words, key=lambda candidate: candidate[2].window, default=None)


def _outputs(system: ResidualSystem, word: Separation) -> Matrix:
    return simulate(system, word.x0, word.v).residuals


def _print(console: Console, names: tuple[str, str], found: Comparison, *, whole_word: bool) -> None:
    shortest = _shortest(found)
    if shortest is None:
        console.print(Text("equivalent: both make the same outputs, on every window", style="green"), soft_wrap=True)
        return
    maker, system, word = shortest
    own, other = names if maker == "first" else names[::-1]
    samples = _samples(word.window)
    console.print(Text(f"different: first on {samples}, the same on fewer", style="yellow"), soft_wrap=True)
    console.print(f"{quote_path(own)} makes this word of {samples}, which {quote_path(other)} cannot:", soft_wrap=True)
    field = system.field

    def row_of(matrix: Matrix, i: int) -> str:
        return ", ".join(entry(matrix[i, j], field) for j in range(matrix.ncols))

    state = ", ".join(entry(word.x0[i, 0], field) for i in range(system.n))
    console.print(f"  x(0) = ({state})", soft_wrap=True)
    table = Table("k", "v(k)", "r(k)", box=None, padding=(0, 2))
    outputs = _outputs(system, word)
    shown = word.window if whole_word else min(word.window, MOST_SAMPLES)
    for k in range(shown):
        table.add_row(str(k), row_of(word.v, k), row_of(outputs, k))
    print_table(console, table)
    if shown < word.window:
        console.print(f"  ... and {word.window - shown} samples more; --word prints them all")
    row = word.row.coefficients
    polynomials = [polynomial([row[k, j] for k in range(row.nrows)], field) for j in range(row.ncols)]
    console.print(f"every word r of {quote_path(other)} satisfies N(q) r = 0 with N(q) = [ {',  '.join(polynomials)} ]", soft_wrap=True)


def _samples(count: int) -> str:
    return "1 sample" if count == 1 else f"{count} samples"
