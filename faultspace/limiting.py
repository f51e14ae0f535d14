"""`faultspace limit`: what subspace identification converges to for an experiment, exactly.

run          the command's body
sheet        what a person reads of PopulationLimits
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from rich.text import Text

from .consoles import answers, print_json, working
from .exact.experiments import Experiment
from .exact.fields import QQ
from .exact.input_limits import InputLimit
from .exact.input_rules import InvalidInput
from .exact.limits import Limit
from .exact.matrices import Matrix
from .exact.population_limits import PopulationLimits, population_limits
from .exact.stability import characteristic_polynomial
from .failures import ANSWERED, BAD_INPUT, placed, printable, say
from .notation import matrix_lines, polynomial
from .reading_files import read_experiment

NAME_WIDTH = 36
LONGEST_ENTRY = 24


def run(names: Sequence[str], *, as_json: bool, floats_exactly: bool) -> int:
    """Answers one file after the other; a bad one is told and the rest is still done. The largest exit code.

    As JSON one file gives an object, several an array of objects that also say which "file" they are about.
    """
    code = ANSWERED
    console = answers()
    documents = []
    for name in names:
        try:
            experiment = read_experiment(name, floats_exactly=floats_exactly)
            with placed(name), working(f"taking {printable(name)} to the limit"):
                found = population_limits(experiment)
                if as_json:
                    documents.append({"file": name, **found.to_json()})
        except InvalidInput as error:
            say(str(error))
            code = BAD_INPUT
            continue
        if not as_json:
            console.print(Text.assemble((printable(name), "bold"), f"   {_sizes(experiment)}"), soft_wrap=True)
            for label, value in sheet(found):
                line = Text(f"    {label:<{NAME_WIDTH}}{value}") if value else Text(f"  {label}", style="bold cyan")
                console.print(line, soft_wrap=True)
            console.print()
    if as_json and len(names) > 1:
        print_json(documents)
    elif as_json and documents:
        print_json({key: value for key, value in documents[0].items() if key != "file"})
    return code


def sheet(found: PopulationLimits) -> Iterator[tuple[str, str]]:
    """(name, value) pairs; a pair without a value is a heading, one without a name goes on with the value above it."""
    system = found.experiment.system.residual
    yield "past inputs as instruments (PI-MOESP)", ""
    yield from _of_limit(found.past_inputs, system.n)
    yield "past inputs and outputs as instruments (PO-MOESP)", ""
    yield from _of_limit(found.past_outputs, system.n)
    yield "the system itself", ""
    yield "characteristic polynomial of A", _polynomial(characteristic_polynomial(system.A))
    for title, regression in (("with the true A and C, by output error", found.true_AC), ("by MOESP's regression", found.moesp)):
        yield f"B and D {title}", ""
        if regression is None:
            yield "B, D", "not unique"
            continue
        bias = found.bias(regression)
        yield from _of_regression(regression, bias)


def _of_limit(limit: Limit, n: int) -> Iterator[tuple[str, str]]:
    yield "rank of the limit", f"{limit.rank}; of O_s {limit.observability_rank}, of both together {limit.joint_rank}"
    yield "column space", _columns(limit, n)
    if limit.state is not None:
        yield "characteristic polynomial of its A", _polynomial(limit.state.characteristic_polynomial)


def _columns(limit: Limit, n: int) -> str:
    if limit.equals_observability_range:
        if limit.rank < n:
            return "that of O_s, which is not of rank n: (A, C) is not observable on s samples"
        return "that of O_s: A and C are consistent" if limit.state else "that of O_s, but s is too small to tell A"
    if limit.within_observability_range:
        return "inside that of O_s, and smaller: states are missing"
    if limit.contains_observability_range:
        return f"that of O_s and {limit.rank - limit.observability_rank} more: A and C of order {n} are inconsistent"
    return "neither inside that of O_s nor around it: A and C are inconsistent"


def _of_regression(found: InputLimit, bias: InputLimit) -> Iterator[tuple[str, str]]:
    for name, matrix, error in (("B", found.B, bias.B), ("D", found.D, bias.D)):
        yield from _lines(f"limit of {name}", matrix)
        if error.is_zero():
            yield f"its bias for {name}", "none"
        else:
            yield from _lines(f"its bias for {name}", error)


def _lines(name: str, matrix: Matrix) -> Iterator[tuple[str, str]]:
    """The matrix in full, or, where an entry is too long to be read, about it in decimals: --json has the fractions."""
    lines = matrix_lines(matrix) or [f"empty, {matrix.nrows} x {matrix.ncols}"]
    entries = [entry for row in matrix.elements() for entry in row]
    if any(len(str(entry)) > LONGEST_ENTRY for entry in entries):
        about = [[f"{float(Fraction(int(x.p), int(x.q))):.9g}" for x in row] for row in matrix.elements()]
        width = max(len(text) for row in about for text in row)
        lines = ["[ " + "  ".join(text.rjust(width) for text in row) + " ] about" for row in about]
    yield from ((name if i == 0 else "", line) for i, line in enumerate(lines))


def _polynomial(coefficients: Sequence[object]) -> str:
    return polynomial([QQ.element(c) for c in coefficients], QQ)


def _sizes(experiment: Experiment) -> str:
    residual = experiment.system.residual
    parts = [(residual.n, "state"), (residual.m, "fault"), (residual.p, "output"), (experiment.system.nu, "input")]
    sizes = ", ".join(f"{count} {word}{'' if count == 1 else 's'}" for count, word in parts)
    return f"{sizes}; s = {experiment.s}, past = {experiment.past}"
