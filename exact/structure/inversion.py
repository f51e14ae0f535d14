"""Left inversion: from how many samples r(0..l) is v(0) determined, with the initial state known or not.

    delay_known_state     least l such that r(0..l) determines v(0) when x(0) = 0; None unless left-invertible
    delay_unknown_state   least l in 0..n such that r(0..l) determines v(0) whatever x(0) is; None where there is none
    left_inverse          M with M [O_(l+1) T_(l+1)] = [0 | I 0 ... 0] (known state: M T_(l+1) = [I 0 ... 0])
    ambiguous_word        (x0, v) with v(0) != 0 and zero output on all of its samples: why fewer samples do not do
    largest_output_nulling V*, the states from which zero output can be kept for ever

Source: [SM69] (known state), [HP98], [MZ10] (unknown state); [TSH01] for V*. The delay of [K11] is another one: that of state and fault
together, which by its abstract is the delay with a known state.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ..algebra.matrices import Matrix, beside, column_basis, rank, right_null_space, solve_left, stacked
from ..algebra.validation import natural
from ..system.systems import ResidualSystem, System, residual_of
from ..system.windows import toeplitz_matrix, window_matrix
from .kernel_rows import KernelRepresentation, kernel_of


@dataclass(frozen=True)
class AmbiguousWord:
    """The word has x0 (n x 1) and v (samples x m) with v(0) != 0, and its output is zero throughout."""

    x0: Matrix
    v: Matrix


def delay_known_state(kernel: KernelRepresentation | System) -> int | None:
    """Return the least l with which r(0), ..., r(l) determine v(0) when x(0) is known, a number of samples; None where none do.

    It is the least l with rank T_(l+1) - rank T_l = m, and exists iff the system is left-invertible. Source: [SM69].

    Parameters
    ----------
    kernel : KernelRepresentation or System

    Returns
    -------
    int or None
        0 where there is no fault.

    Raises
    ------
    InvalidInput
        For what is neither.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, delay_known_state, kernel_representation
    >>> late = ResidualSystem.of([[0, 1], [0, 0]], [[0], [1]], [[1, 0]], [[0]])
    >>> delay_known_state(kernel_representation(late))
    2
    """
    kernel = kernel_of(kernel)
    system = kernel.system
    if kernel.normal_rank < system.m:
        return None
    delay, previous = 0, 0
    while True:
        current = rank(toeplitz_matrix(system, delay + 1))
        if current - previous == system.m:
            return delay
        delay, previous = delay + 1, current


def delay_unknown_state(kernel: KernelRepresentation | System) -> int | None:
    """Return the least number l with which r(0), ..., r(l) determine v(0) whatever x(0) is; None where none do.

    A recursion modulo a prime finds it and shows that fewer samples do not do; that l samples do is decided exactly. Source: [HP98],
    [MZ10]; not that of [K11], which asks for state and fault together.

    Parameters
    ----------
    kernel : KernelRepresentation or System

    Returns
    -------
    int or None
        A number of samples, at most n, and 0 where there is no fault.

    Raises
    ------
    InvalidInput
        For what is neither.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, delay_unknown_state, kernel_representation
    >>> zero_at_2 = ResidualSystem.of([["1/2"]], [["-3/2"]], [[1]], [[1]])
    >>> no_zero = ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]])
    >>> [delay_unknown_state(kernel_representation(system)) for system in (zero_at_2, no_zero)]
    [None, 1]
    """
    kernel = kernel_of(kernel)
    system = kernel.system
    for delay in range(_first_determined(kernel.image.system), system.n + 1):
        keep = [j for j in range(system.n + system.m * (delay + 1)) if not system.n <= j < system.n + system.m]
        if rank(window_matrix(system, delay + 1).columns(keep)) == kernel.rank(delay + 1) - system.m:
            return delay
    return None


def largest_output_nulling(system: ResidualSystem) -> Matrix:
    """Return V* as a column basis (n x dim): the limit of the chain V_0 = K^n, V_(j+1) = {x : some v has C x + G v = 0, A x + F v in
    V_j}.
    """
    *_, last = _output_nulling(system)
    return column_basis(last.rows(range(system.n)))


def left_inverse(system: System, delay: int, *, known_state: bool) -> Matrix | None:
    """Return a matrix of shape m x p(delay + 1) that takes r(0), ..., r(delay) to v(0), or None where there is none.

    Source: [SM69] for a known state, [HP98] for an unknown one.

    Parameters
    ----------
    system : System
    delay : int
        A number of samples >= 0.
    known_state : bool
        Whether the outputs are those from x(0) = 0; else they come from any initial state.

    Returns
    -------
    Matrix or None

    Raises
    ------
    InvalidInput
        For what is no system, for a delay that is no integer >= 0, and for a window of more than 2^27 entries.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, left_inverse
    >>> system = ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]])
    >>> left_inverse(system, 1, known_state=False), left_inverse(system, 0, known_state=False)  # v(0) = r(1) - r(0) / 2
    ([[-1/2, 1]], None)
    """
    system = residual_of(system)
    natural(delay, "delay")
    built = toeplitz_matrix(system, delay + 1) if known_state else window_matrix(system, delay + 1)
    skipped = Matrix.zero(system.field, system.m, 0 if known_state else system.n)
    wanted = beside(skipped, Matrix.identity(system.field, system.m), Matrix.zero(system.field, system.m, system.m * delay))
    return solve_left(built, wanted)


def ambiguous_word(system: ResidualSystem, samples: int, *, known_state: bool) -> AmbiguousWord | None:
    """Return a word of that many samples with v(0) != 0 and zero output, from x0 = 0 when the state is known; None where there is
    none.
    """
    if samples == 0:
        return None
    built = toeplitz_matrix(system, samples) if known_state else window_matrix(system, samples)
    offset = 0 if known_state else system.n
    null = right_null_space(built)
    for j in range(null.ncols):
        column = null.columns([j])
        if not column.rows(range(offset, offset + system.m)).is_zero():
            x0 = Matrix.zero(system.field, system.n, 1) if known_state else column.rows(range(system.n))
            faults = [column.rows(range(offset + k * system.m, offset + (k + 1) * system.m)).transposed() for k in range(samples)]
            return AmbiguousWord(x0, stacked(Matrix.zero(system.field, 0, system.m), *faults))
    return None


def _output_nulling(system: ResidualSystem) -> Iterator[Matrix]:
    """Yield the columns [x; v] with output zero that lead into V_j, for j = 0, 1, ... up to the first V_j that is V_(j+1)."""
    subspace = Matrix.identity(system.field, system.n)
    while True:
        pairs = _zero_output_pairs(system, subspace)
        yield pairs
        successor = column_basis(pairs.rows(range(system.n)))
        if successor.ncols == subspace.ncols:
            return
        subspace = successor


def _zero_output_pairs(system: ResidualSystem, target: Matrix) -> Matrix:
    """Return the columns [x; v] of the result span {C x + G v = 0, A x + F v in the column space of `target`}."""
    moves = beside(system.A, system.F, -target)
    outputs = beside(system.C, system.G, Matrix.zero(system.field, system.p, target.ncols))
    return right_null_space(stacked(moves, outputs)).rows(range(system.n + system.m))


def _first_determined(system: ResidualSystem) -> int:
    """Return the least l such that v(0) is determined by r(0..l), or n + 1; by the recursion V_j, meant for prime fields."""
    for delay, pairs in enumerate(_output_nulling(system)):
        if pairs.rows(range(system.n, system.n + system.m)).is_zero():
            return delay
    return system.n + 1
