"""`faultspace inspect`: everything the exact branch knows about a system.

run          the command's body
sheet        what a person reads of a Structure
FLOATS       what must be known of answers about floats
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..base.errors import in_file, quote_path
from ..exact.algebra.fields import QQ, NumberField
from ..exact.structure.record import Structure, structure
from ..exact.system.systems import FaultySystem, ResidualSystem
from .failures import say
from .file_by_file import Answer, answer_each
from .notation import matrix_lines, polynomial, several
from .progress import working
from .reading_files import read_system

FLOATS = (
    "--floats-exactly takes every float for the dyadic rational that it is; floats that were measured or estimated have, exactly, no zeros "
    "and indices as equal as they can be: that this is found here confirms nothing about the plant"
)


def run(names: Sequence[str], *, as_json: bool, floats_exactly: bool) -> int:
    """Inspects one file after the other. The largest exit code."""

    def answer(name: str) -> Answer:
        system = read_system(name, floats_exactly=floats_exactly)
        with in_file(name), working(f"inspecting {quote_path(name)}"):
            found = structure(system.residual)
        if floats_exactly:
            say(FLOATS)
        return Answer(_sizes(system), sheet(system, found), found)

    return answer_each(names, answer, as_json=as_json)


def sheet(system: ResidualSystem | FaultySystem, found: Structure) -> Iterator[tuple[str, str]]:
    """(name, value) pairs; a pair without a value is a heading, one without a name goes on with the value above it."""
    kernel, n = found.kernel, found.system.n
    yield "pencil P(q) = [[qI - A, -F], [C, G]]", ""
    yield "normal rank r", f"{kernel.normal_rank} of at most {min(found.system.m, found.system.p)}"
    yield "left minimal indices", several(kernel.left_minimal_indices)
    yield "lag", str(kernel.lag)
    yield "right minimal indices", several(found.right_minimal_indices)
    yield "invariant zero polynomial", polynomial(found.invariant_zero_polynomial, found.system.field)
    yield "infinite zero orders", several(found.infinite_zero_orders)
    yield "zeros, finite + infinite = zeta", f"{found.finite_zeros} + {sum(found.infinite_zero_orders)} = {found.zeta}"
    yield "states and faults", ""
    yield "(A, C) observable", _yes(found.observable)
    yield "(A, F) controllable", _yes(found.controllable)
    yield "left-invertible (r = m)", _yes(found.left_invertible)
    yield "inversion delay, x(0) known", _delay(found.delay_known_state)
    yield "inversion delay, x(0) unknown", _delay(found.delay_unknown_state)
    document = found.to_json()
    yield f"windows of s = 1, ..., {n + 3} samples", ""
    yield "rank [O_s T_s]", several(document["window_ranks"])
    yield "dimension of problem (11)", several(document["fault_space_dimensions"])
    space = found.fault_space
    yield f"fault space: n_z = {space.dimension}, reached from s = {space.exact_from} on", ""
    for name, matrix in (("Fhat", space.F), ("Ghat", space.G)):
        lines = matrix_lines(matrix) or [f"empty, {matrix.nrows} x {matrix.ncols}"]
        yield from ((name if i == 0 else "", line) for i, line in enumerate(lines))


def _sizes(system: ResidualSystem | FaultySystem) -> str:
    parts = [(system.residual.n, "state"), (system.residual.m, "fault"), (system.residual.p, "output")]
    if isinstance(system, FaultySystem):
        parts.append((system.nu, "input"))
    sizes = ", ".join(f"{count} {word}{'' if count == 1 else 's'}" for count, word in parts)
    return f"{sizes}, over {_field(system)}"


def _field(system: ResidualSystem | FaultySystem) -> str:
    field = system.field
    if isinstance(field, NumberField):
        return f"Q(a), a a root of {polynomial([QQ.element(c) for c in field.minimal_polynomial], QQ, 'a')}"
    return str(field)


def _yes(value: bool) -> str:
    return "yes" if value else "no"


def _delay(value: int | None) -> str:
    return "none" if value is None else str(value)
