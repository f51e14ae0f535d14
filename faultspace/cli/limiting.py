"""`faultspace limit`: what subspace identification converges to for an experiment, exactly.

run          the command's body
sheet        what a person reads of PopulationLimits
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from ..base.errors import in_file, quote_path
from ..exact.algebra.fields import QQ
from ..exact.algebra.matrices import Matrix
from ..exact.algebra.stability import characteristic_polynomial
from ..exact.limits.column_space import Limit
from ..exact.limits.experiments import Experiment
from ..exact.limits.inputs import InputLimit
from ..exact.limits.moesp import PopulationLimits, population_limits
from .file_by_file import Answer, answer_each
from .notation import matrix_lines, polynomial
from .progress import working
from .reading_files import read_experiment

LONGEST_ENTRY = 24


def run(names: Sequence[str], *, as_json: bool, floats_exactly: bool) -> int:
    """Answers one file after the other. The largest exit code."""

    def answer(name: str) -> Answer:
        experiment = read_experiment(name, floats_exactly=floats_exactly)
        with in_file(name), working(f"taking {quote_path(name)} to the limit"):
            found = population_limits(experiment)
        return Answer(_sizes(experiment), sheet(found), found)

    return answer_each(names, answer, as_json=as_json)


def sheet(found: PopulationLimits) -> Iterator[tuple[str, str]]:
    """(name, value) pairs; a pair without a value is a heading, one without a name goes on with the value above it."""
    system = found.experiment.system.residual
    yield "past inputs as instruments (PI-MOESP)", ""
    yield from _of_limit(found, found.past_inputs)
    yield "past inputs and outputs as instruments (PO-MOESP)", ""
    yield from _of_limit(found, found.past_outputs)
    yield "the system itself", ""
    yield "characteristic polynomial of A", _polynomial(characteristic_polynomial(system.A))
    for title, regression in (("with the true A and C, by output error", found.true_AC), ("by MOESP's regression", found.moesp)):
        yield f"B and D {title}", ""
        if regression is None:
            yield "B, D", "not unique"
            continue
        bias = found.bias(regression)
        yield from _of_regression(regression, bias)


def _of_limit(found: PopulationLimits, limit: Limit) -> Iterator[tuple[str, str]]:
    yield "rank of the limit", f"{limit.rank}; of O_s {limit.observability_rank}, of both together {limit.joint_rank}"
    yield "column space", _columns(limit, found.experiment.system.residual.n)
    if limit.contains_observability_range and not limit.equals_observability_range:
        yield "", _leading(limit.observability_rank, found.leading_vectors_right(limit))
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
        return f"that of O_s and {limit.rank - limit.observability_rank} more: the rank does not tell the order {n}"
    return "neither inside that of O_s nor around it: nothing in it spans that of O_s"


def _leading(count: int, right: bool) -> str:
    """What becomes of O_s where the limit has more columns than it, and the largest singular values choose among them."""
    vectors = "its leading left singular vector" if count == 1 else f"its {count} leading left singular vectors"
    if right:
        return f"{vectors} {'spans' if count == 1 else 'span'} that of O_s all the same, with the outputs as they are scaled here"
    return f"{vectors} {'does' if count == 1 else 'do'} not span that of O_s, with the outputs as they are scaled here"


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
