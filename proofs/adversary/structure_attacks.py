"""Attacks on what is said of single systems: each statement is decided on the zero sets where ranks drop, not only at random points.

    structure_attacks    all of them
    on_strata            one statement, one family, several quantities
    unlike               a test on the certified quantities of a system, as an exact decision

A statement about ranks that fails somewhere fails, as a rule, where some other rank drops: a zero comes to a pole, a state disappears
from the outputs, an order at infinity rises. So a point is led to the zero set of a determinant by its change of sign, put on it exactly
(the determinants are affine in every entry of C, F and G), and the statement is decided there with certificates.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from random import Random

from flint import fmpq, fmpq_poly

from ...exact.algebra.matrices import Matrix, left_null_space, rank, stacked
from ...exact.pairs.bad_variety import bad_equations
from ...exact.pairs.polynomial import Exceptional, polynomial_at
from ...exact.structure.fault_columns import fault_space
from ...exact.structure.kernel_rows import kernel_representation
from ...exact.system.systems import ResidualSystem
from ..claims.common import delays, ranks_and_inversion, spaces, zeros
from ..claims.windows import first_column_conditions, reachable_part
from ..evidence.alternatives import comparison_certificate
from ..evidence.attacks import Aim, Attack, Family, Point, Witness
from ..evidence.corpus import Evidence, examine
from ..evidence.pairs_by_polynomial import examine_by_polynomial, pencil_of
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate
from .structure_families import (
    Square,
    exact_value,
    feedthrough,
    free_family,
    hadamard,
    hidden_family,
    idle_family,
    pencil,
    product,
    rank_deficient_family,
    reached,
    seen,
    system_of,
)
from .witnesses import Found, confirmed

Fails = Callable[[Evidence], bool]
Show = Callable[[ResidualSystem], Iterable[Certificate]]
Decide = Callable[[ResidualSystem], Found | None]

at_zero = pencil(0)

WORDS = {
    at_zero: "det of a square part of P(0)",
    feedthrough: "det G",
    product: "det CF",
    seen: "det of the first n rows of O_n",
    reached: "det of the first n columns of [F AF ...]",
}


def structure_attacks() -> Iterator[Attack]:
    """Yield first attacks on what is false, then attacks on rows of the hypothesis table."""
    yield from _refuted()
    for dropped, family, first in (
        ("controllable", idle_family(2, 2, 2), at_zero),
        ("A stable", free_family(2, 2, 2), at_zero),
        ("left-invertible", rank_deficient_family(), reached),
        ("r >= 2", free_family(2, 2, 1, feedthrough=False), at_zero),
    ):
        yield from on_strata(f"without codimension: {dropped}", "lines", family, [first, seen], _thick_seen)
    dependent = free_family(2, 2, 2, feedthrough=False)
    yield from on_strata("without range-of-F: left-invertible", "G = 0", dependent, [product, at_zero], unlike(_range_lost, zeros))


def on_strata(target: str, name: str, family: Family, quantities: Sequence[Square], decide: Decide) -> Iterator[Attack]:
    """Yield an attack for each quantity."""
    for square in quantities:
        words = WORDS[square]
        yield Attack(
            target=target,
            name=f"{name}: {words}",
            aim=Aim.STRATUM,
            measured=f"{words}, against Hadamard's bound",
            family=family,
            quantity=hadamard(family, square),
            decide=_at_points(family, decide),
            exact=exact_value(family, square),
            starts=10,
        )


def unlike(fails: Fails, show: Show) -> Decide:
    """Return a decision that finds a system whose certified quantities fail the statement."""

    def decide(system: ResidualSystem) -> Found | None:
        return (str(system), list(show(system))) if fails(examine("adversary", system)) else None

    return decide


def _at_points(family: Family, decide: Decide) -> Callable[[Point], Witness | None]:
    def at(point: Point) -> Witness | None:
        found = decide(system_of(family.at(point)))
        if found is None:
            return None
        return confirmed(found[0], point, found[1])

    return at


def _refuted() -> Iterator[Attack]:
    tall, flat, scalar, no_gain = free_family(2, 2, 1), free_family(1, 2, 1), free_family(1, 1, 1), free_family(2, 1, 1, feedthrough=False)
    known, unknown = (unlike(partial(_early_gap, known=known), delays) for known in (True, False))
    early_space = unlike(_early_space, spaces(lambda s: s.n))
    for target, name, family, square, decide in (
        ("theorem-2.finite-zeros-only", "one state", scalar, feedthrough, unlike(_finite_only, zeros)),
        ("theorem-2.transfer-function-zeros", "an idle state", idle_family(2, 1, 1), at_zero, _transfer_zeros),
        ("theorem-2.every-window", "one fault", tall, feedthrough, unlike(_every_window, zeros)),
        ("assumption-4.n-minus-1-known", "one fault", tall, at_zero, known),
        ("assumption-4.n-minus-1-unknown", "one fault", tall, at_zero, unknown),
        ("proposition-3.n-minus-1", "one fault", tall, at_zero, known),
        ("settle-2.n-minus-1", "one fault", tall, at_zero, known),
        ("proposition-3.without-left-invertibility", "two faults", free_family(1, 1, 2), seen, unlike(_gap_not_m, ranks_and_inversion)),
        ("problem-11.window-n", "one fault", flat, feedthrough, early_space),
        ("zero-feedthrough.fault-matrices", "G = 0", no_gain, product, unlike(_other_matrices, zeros)),
        ("trajectory-recovered.state-unknown", "one fault", free_family(2, 1, 1), at_zero, unlike(_state_needed, delays)),
        ("zeros-of-pairs.split", "two faults", free_family(1, 2, 2), feedthrough, _other_split),
        ("objection-3.controllability-needed", "an idle state", idle_family(2, 2, 1), at_zero, unlike(_right_anyway, zeros)),
        ("problem-11.first-block-column", "one fault", flat, feedthrough, _first_column),
        ("bad-set.codimension-unobservable", "a hidden state", hidden_family(1, 1, 1), feedthrough, _bad_on_a_line),
        ("zero-assignment.without-observability", "a hidden state", hidden_family(2, 2, 2), at_zero, _no_free_zeros),
    ):
        yield from on_strata(target, name, family, [square], decide)


# -- what is false ---------------------------------------------------------------------------------------------------------


def _minimal(d: Evidence) -> bool:
    return d.left_invertible and d.observable and d.controllable


def _finite_only(d: Evidence) -> bool:
    return _minimal(d) and any(
        d.kernel.rank(s) != d.system.n + s * d.system.m - d.finite_zeros for s in range(max(d.system.n, 1), d.system.n + 3)
    )


def _every_window(d: Evidence) -> bool:
    return _minimal(d) and any(d.kernel.rank(s) != d.system.n + s * d.system.m - d.zeta for s in range(1, d.system.n + 3))


def _early_gap(d: Evidence, known: bool) -> bool:
    delay = d.delay_known_state if known else d.delay_unknown_state
    if not (d.observable and d.left_invertible and delay is not None):
        return False
    return any(d.kernel.gap(s) != d.system.m for s in range(max(delay, d.system.n - 1, 1), d.system.n + 2))


def _gap_not_m(d: Evidence) -> bool:
    return d.observable and any(d.kernel.gap(s) != d.system.m for s in range(max(d.system.n, 1), d.system.n + 3))


def _early_space(d: Evidence) -> bool:
    if not (d.observable and d.left_invertible and d.delay_known_state is not None and d.system.n):
        return False
    return d.space_dimensions[max(d.system.n, d.delay_known_state) - 1] != d.fault_space.dimension


def _right_anyway(d: Evidence) -> bool:
    """Return whether the gap is m from n on, without controllability."""
    return (
        not d.controllable
        and d.observable
        and d.left_invertible
        and all(d.kernel.gap(s) == d.system.m for s in range(max(d.system.n, 1), d.system.n + 3))
    )


def _first_column(system: ResidualSystem) -> Found | None:
    """Find a z that the rows annihilate on the first block column of T_s(z) at s = lag + 1, and not on all of them."""
    kernel = kernel_representation(system)
    d = examine("adversary", system)
    if not (d.observable and d.left_invertible):
        return None
    window = kernel.lag + 1
    conditions = first_column_conditions(kernel, window)
    found = left_null_space(stacked(*conditions).transposed()) if conditions else Matrix.zero(system.field, 0, 0)
    space = fault_space(kernel, window).basis
    for i in range(found.nrows):
        if rank(stacked(space, found.rows([i]))) > space.nrows:
            z = found.rows([i]).transposed()
            words = f"{system}, z = {[str(x) for x in z.transposed().elements()[0]]}, s = {window}"
            return words, [make.first_column_only(kernel, window, z), make.window_ranks(kernel)]
    return None


def _other_matrices(d: Evidence) -> bool:
    return d.observable and d.left_invertible and d.system.G.is_zero() and d.without_feedthrough != rank(d.system.F)


def _state_needed(d: Evidence) -> bool:
    return d.observable and d.left_invertible and d.delay_unknown_state is None


def _transfer_zeros(system: ResidualSystem) -> Found | None:
    """Find a system for which the zeros of its reachable part, which is minimal where the system is observable, give another rank."""
    d = examine("adversary", system)
    if not (d.observable and d.left_invertible and not d.controllable):
        return None
    part = reachable_part(system)
    certificates = [*zeros(system), make.finite_zeros(part), make.infinite_zeros(part)]
    zeta = len(certificates[-2]["statement"]["invariant_zero_polynomial"]) - 1 + sum(certificates[-1]["statement"]["infinite_zero_orders"])
    fails = any(d.kernel.rank(s) != d.system.n + s * d.system.m - zeta for s in range(max(d.system.n, 1), d.system.n + 3))
    return (f"{system}, whose transfer function is that of its reachable part", certificates) if fails else None


def _other_split(system: ResidualSystem) -> Found | None:
    """Find two good P of one system whose pairs have different numbers of finite zeros: unit columns, and their sums."""
    pencil_ = pencil_of(system)
    if not pencil_.columns or pencil_.zeta < 1:
        return None
    rows, cols = pencil_.n_z, pencil_.columns
    found: dict[int, ResidualSystem] = {}
    for shift in range(rows):
        for tilt in (0, 1):
            P = Matrix.of(
                [[int((i + shift) % rows == j) + tilt * int(i == j) for j in range(cols)] for i in range(rows)], shape=(rows, cols)
            )
            pair = examine_by_polynomial("adversary", "unit", system, P, None, 1)
            if pair.equal:
                found[len(pair.zero_polynomial)] = pair.pair
    if len(found) < 2:
        return None
    pairs = list(found.values())[:2]
    kernels = [kernel_representation(one) for one in (system, *pairs)]
    certificates = [comparison_certificate(kernels[0], other) for other in kernels[1:]] + [make.finite_zeros(one) for one in pairs]
    return f"{system} with the pairs {pairs[0].F}, {pairs[0].G} and {pairs[1].F}, {pairs[1].G}", certificates


def _no_free_zeros(system: ResidualSystem) -> Found | None:
    pencil_ = pencil_of(system)
    if pencil_.observable or not pencil_.columns or not pencil_.zeta:
        return None
    certificates = [make.matrix_rank("observability", system), make.fault_space(pencil_.kernel, pencil_.space)]
    return f"{system}: the zeros {list(map(str, pencil_.fixed))} (ascending) belong to every pair", certificates


def _bad_on_a_line(system: ResidualSystem) -> Found | None:
    pencil_ = pencil_of(system)
    return _thick(system) if pencil_.zeta >= 1 and pencil_.columns else None


# -- what stands -----------------------------------------------------------------------------------------------------------


def _thick_seen(system: ResidualSystem) -> Found | None:
    """Find a bad set that is a hypersurface, of an observable system, whatever r is."""
    pencil_ = pencil_of(system)
    return _thick(system) if pencil_.observable and pencil_.columns and pencil_.zeta >= 1 else None


def _range_lost(d: Evidence) -> bool:
    """Return whether G = 0, rank CF = m, there are no finite zeros, and yet members of Z without feedthrough lie outside im F."""
    system = d.system
    return (
        system.G.is_zero() and rank(system.C @ system.F) == d.system.m and d.finite_zeros == 0 and d.without_feedthrough != rank(system.F)
    )


def _thick(system: ResidualSystem) -> Found | None:
    """Find a bad set that is a hypersurface: the coefficients of D(q; P) share a polynomial in P, which they do not where some line misses
    the set."""
    pencil_ = pencil_of(system)
    rows, cols = pencil_.n_z, pencil_.columns
    random = Random(str(system))
    P, Q = (Matrix.of([[random.randint(-999, 999) for _ in range(cols)] for _ in range(rows)], shape=(rows, cols)) for _ in range(2))
    if _common(pencil_, P, Q).degree() < 1:
        return None
    import sympy  # here, where it is needed

    shared = sympy.gcd_list(list(bad_equations(pencil_).equations))
    if not shared.free_symbols:
        return None
    certificates = [
        make.fault_space(pencil_.kernel, pencil_.space),
        make.matrix_rank("observability", system),
        make.window_ranks(pencil_.kernel),
    ]
    return f"{system}: every coefficient of D(q; P) is a multiple of {shared}", certificates


def _common(pencil_: Exceptional, P: Matrix, Q: Matrix) -> fmpq_poly:
    """Return the greatest common divisor in t of the coefficients of D(q; P + t Q), of degree r in t at most."""
    degree = P.ncols
    values = []
    for t in range(degree + 1):
        values.append([fmpq(x) for x in polynomial_at(pencil_, P + Matrix(P.field, *Q.shape, Q.flint * t))])
    width = max(len(v) for v in values)
    common = fmpq_poly([0])
    for k in range(width):
        common = common.gcd(_through([v[k] if k < len(v) else fmpq(0) for v in values]))
    return common


def _through(values: Sequence[fmpq]) -> fmpq_poly:
    """Return the polynomial with these values at 0, 1, 2, ..."""
    result, basis = fmpq_poly([0]), fmpq_poly([1])
    for t, y in enumerate(values):
        result += basis * ((y - result(fmpq(t))) / basis(fmpq(t)))
        basis *= fmpq_poly([-t, 1])
    return result
