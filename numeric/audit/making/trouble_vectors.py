"""How a kind of trouble becomes vectors: systems and signals from a seed, truth by the exact branch, bounds from conditioning.

troubles         all kinds of trouble for a seed: the default set as it comes with the package, any other drawn and computed now
made             the vectors of a kind for a seed: of the system, of a record without fault, of a residual
structure_vector of a system alone
unbounded        the same before there are bounds: all of it exact, so that every machine makes the same
Unsuitable       the draw does not meet the conditions of the question, and the next one is tried
zero_bounds      how far rounding may carry each zero, repeated ones as well
eigenvalue_bounds    the same for the poles of a model whose A is wrong by so much
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from random import Random

import numpy as np

from faultspace.exact.algebra.matrices import rank, stacked
from faultspace.exact.structure.record import Structure, analyze
from faultspace.exact.structure.signals import excitation_matrix, hankel, simulate
from faultspace.exact.system.systems import ResidualSystem

from ....base.arrays import Array
from ....base.threads import one_thread
from ...method.model.compression import EPS
from ...study.conditioning import SMALL
from ..vectors.exact_comparison import roots
from ..vectors.fault_vectors import AS_GIVEN, HALF, FaultVector, in_channel_units, samples_that_settle
from ..vectors.rationals import floats
from ..vectors.shipped_vectors import IdentificationVector, StructureVector
from ..vectors.trouble import SEED, Trouble, default_troubles
from .fault_records import conditions_clear, leading_signal_bound, residual_bound, signal_bound, singular_values, space_bound
from .kinds_of_trouble import COUNT, KINDS, MODEL, RANKS, RESIDUAL, SIGNAL, SPACE, STRUCTURE, Kind
from .model_bounds import model_bounds, telling
from .planting import digits, upward

ATTEMPTS = 100
APART, LEADING = 1.25, 3  # zeros so far outside let the end of a record disturb its first third by nothing that counts
MORE = 15  # samples beyond those that windows need
ANGLES = 24  # of a circle about a zero
COARSE, FINE = 8.0, 1.25  # between the radii of two circles


class Unsuitable(ArithmeticError):
    """The draw does not meet the conditions of the question."""


@one_thread()
def made(kind: Kind, seed: int) -> Trouble:
    """Return the vectors of the kind with their bounds. Raises ArithmeticError where no draw of ATTEMPTS meets the conditions."""
    return _first(kind, seed, lambda found: _bounded(kind, found))


def unbounded(kind: Kind, seed: int) -> Trouble:
    """Return the vectors of the kind without bounds. Raises ArithmeticError as `made` does."""
    return _first(kind, seed, lambda found: found)


def _first(kind: Kind, seed: int, finished: Callable[[Trouble], Trouble]) -> Trouble:
    reasons = []
    for attempt in range(ATTEMPTS):
        rng = Random(f"{kind.slug} {seed} {attempt}")
        try:
            return finished(_vectors(kind, kind.drawn(rng), rng))
        except Unsuitable as reason:
            reasons.append(str(reason))
    raise ArithmeticError(f"{kind.slug}, seed {seed}: none of {ATTEMPTS} draws will do: {'; '.join(dict.fromkeys(reasons))}")


def _bounded(kind: Kind, found: Trouble) -> Trouble:
    return replace(
        found,
        structure=found.structure and _bounded_structure(found.structure),
        model=found.model and _bounded_model(found.model),
        faults=found.faults and _bounded_faults(found.faults, kind),
    )


def _vectors(kind: Kind, system: ResidualSystem, rng: Random) -> Trouble:
    known = analyze(system)
    asked = set(kind.asks)
    return Trouble(
        kind.slug,
        kind.what,
        tuple(kind.asks),
        _structure(kind.slug, system, known) if STRUCTURE in asked else None,
        _model(kind, system, known, rng) if MODEL in asked else None,
        _faults(kind, system, known, rng) if asked & {RESIDUAL, RANKS, COUNT, SPACE, SIGNAL} else None,
    )


# -- zeros ------------------------------------------------------------------------------------------------------------------------------


def _structure(slug: str, system: ResidualSystem, known: Structure) -> StructureVector:
    zeros = roots(known.invariant_zero_polynomial) if known.finite_zeros else ()
    return StructureVector(slug, system, known.kernel.normal_rank, zeros, (), known.infinite_zero_orders)


def structure_vector(slug: str, system: ResidualSystem) -> StructureVector:
    """Return the questions of structure of a system, with their bounds."""
    return _bounded_structure(_structure(slug, system, analyze(system)))


def _bounded_structure(vector: StructureVector) -> StructureVector:
    return replace(vector, zero_bounds=tuple(upward(one) for one in zero_bounds(vector.system, vector.zeros, vector.normal_rank)))


def zero_bounds(system: ResidualSystem, zeros: Sequence[complex], normal_rank: int) -> list[float]:
    """Return for each zero z0 the radius within which z can be a zero of a pencil that rounding does not tell from this one.

    Such a pencil is off by d = SMALL (rows + columns) eps |P(z)| and has the same normal rank; z is a zero of one where the last singular
    value of P(z) that this rank leaves different from zero is at most d. The radius is the least of those tried, on whose circle none is:
    for a simple zero that is d over its condition number, for one in a chain of length k it goes with the kth root of d.
    """
    A, F, C, G = (floats(M) for M in (system.A, system.F, system.C, system.G))
    n, m, p = system.n, system.m, system.p
    fixed, slope = np.block([[-A, -F], [C, G]]), np.zeros((n + p, n + m))
    slope[:n, :n] = np.eye(n)

    def apart(points: Array) -> bool:
        pencils = fixed + points[:, np.newaxis, np.newaxis] * slope
        least = np.linalg.svd(pencils, compute_uv=False)[:, n + normal_rank - 1]
        return bool(np.all(least > SMALL * (2 * n + m + p) * EPS * np.linalg.norm(pencils, axis=(1, 2))))

    return _radii(apart, zeros)


def eigenvalue_bounds(A: Array, moved: float, exact: Sequence[complex]) -> list[float]:
    """Return for each eigenvalue the radius within which A + dA, |dA| <= moved, can have one; what `zero_bounds` is for a pencil."""
    unit = np.eye(len(A))

    def apart(points: Array) -> bool:
        least = np.linalg.svd(points[:, np.newaxis, np.newaxis] * unit - A, compute_uv=False)[:, -1]
        return bool(np.all(least > moved + SMALL * len(A) * EPS * float(np.linalg.norm(A))))

    return _radii(apart, exact)


def _radii(apart: Callable[[Array], bool], centres: Sequence[complex]) -> list[float]:
    """Return for each centre the least radius tried, in coarse steps and then in fine ones, on whose circle all points are `apart`."""
    turns = np.exp(2j * np.pi * (np.arange(ANGLES) + 0.5) / ANGLES)
    found = {}
    for centre in set(centres):
        size = max(1.0, abs(centre))
        radius = EPS * size
        while not apart(centre + COARSE * radius * turns):
            radius *= COARSE
            if radius > size / EPS:
                raise Unsuitable("rounding may put a zero anywhere")
        while not apart(centre + radius * turns):
            radius *= FINE
        found[centre] = radius
    return [found[centre] for centre in centres]


# -- models -----------------------------------------------------------------------------------------------------------------------------


def _model(kind: Kind, system: ResidualSystem, known: Structure, rng: Random) -> IdentificationVector:
    """B and D are F and G. The window is one longer than it must be."""
    if not known.observable:
        raise Unsuitable("not observable")
    n, m, p = system.n, system.m, system.p
    s = max(_observability_index(system) + 2, 2, -(-n // m) + 1)
    samples = 2 * (m + p + 1) * s + 20
    x0, u = digits(rng, n, 1), kind.moves(rng, samples, m)
    driven = simulate(system, x0, u)
    if rank(excitation_matrix(driven, 2 * s)) < n + 2 * s * m:
        raise Unsuitable("the input does not excite")
    return IdentificationVector(kind.slug, system.A, system.F, system.C, system.G, x0, u, s, {})


def _bounded_model(vector: IdentificationVector) -> IdentificationVector:
    whole = replace(vector, bounds=model_bounds(vector, floats(vector.y), floats(vector.u), eigenvalue_bounds))
    return replace(whole, bounds=telling(whole))


def _observability_index(system: ResidualSystem) -> int:
    rows, blocks = system.C, 1
    while rank(rows) < system.n:
        rows, blocks = stacked(system.C, rows @ system.A), blocks + 1
    return blocks


# -- residuals --------------------------------------------------------------------------------------------------------------------------


def _faults(kind: Kind, system: ResidualSystem, known: Structure, rng: Random) -> FaultVector:
    n, m, p, lag = system.n, system.m, system.p, known.kernel.lag
    windows = lag + 2
    if not known.left_invertible and {COUNT, SPACE, SIGNAL} & set(kind.asks):
        raise Unsuitable("not left-invertible")  # fewer faults show than there are
    if RESIDUAL in kind.asks and not known.observable:
        raise Unsuitable("not observable")  # a free response that no output shows is determined by nothing
    samples = max(HALF, (p + 1) * (max(windows, n + 1) + 1), samples_that_settle(p, lag)) + MORE
    x0, v = digits(rng, n, 1), kind.moves(rng, samples, m)
    trajectory = simulate(system, x0, v)
    longest = max(windows, n + 1)
    if known.left_invertible and rank(excitation_matrix(trajectory, longest)) < n + m * longest:
        raise Unsuitable("the fault does not excite")
    r = trajectory.residuals
    ranks = tuple(rank(hankel(r, s)) for s in range(1, windows + 1))
    gaps = tuple(singular_values(hankel(in_channel_units(r), s)) for s in range(1, windows + 1))
    delay = known.delay_known_state
    basis = known.fault_space.basis.transposed()
    trusted = v.nrows - delay if delay is not None else 0
    if _outside(known):
        trusted //= LEADING
    blank = FaultVector(kind.slug, AS_GIVEN, system, x0, v, ranks, gaps, m, basis, lag, trusted, {}, {})
    if not blank.clear:
        raise Unsuitable("rounding hides a rank")
    if SPACE in kind.asks and not all(conditions_clear(r, system, s) for s in _space_windows(lag, n)):
        raise Unsuitable("rounding hides a condition of the fault space")
    return blank


def _space_windows(lag: int, n: int) -> list[int]:
    return sorted({lag + 1, n + 1})


def _bounded_faults(vector: FaultVector, kind: Kind) -> FaultVector:
    r, system, asked = vector.r, vector.system, set(kind.asks)
    bounds = {
        "residual": residual_bound(r, system, Fraction(1)) if RESIDUAL in asked else None,
        "signal": _signal_bound(vector) if SIGNAL in asked else None,
    }
    windows = _space_windows(vector.lag, system.n) if SPACE in asked else []
    return replace(vector, bounds=bounds, space_bounds={s: space_bound(r, system, s) for s in windows})


def _signal_bound(vector: FaultVector) -> float | None:
    known = analyze(vector.system)
    outside = _outside(known)
    if outside:
        return leading_signal_bound(vector.r, vector.system, vector.x0, vector.trusted, outside)
    return None if _grows(known) else signal_bound(vector.r, vector.system, vector.x0)


def _outside(known: Structure) -> list[float]:
    """Return the moduli of the zeros that are not inside the unit circle; none where one of them is nearer to it than APART."""
    moduli = [abs(zero) for zero in _finite(known) if abs(zero) > 1 - 1e-9]
    return moduli if min(moduli, default=0.0) >= APART else []


def _grows(known: Structure) -> bool:
    """Say whether a zero on or outside the unit circle lets errors grow. Their enclosures have fifty bits and more."""
    return any(abs(zero) > 1 - 1e-9 for zero in _finite(known))


def _finite(known: Structure) -> Sequence[complex]:
    return roots(known.invariant_zero_polynomial) if known.finite_zeros else ()


@cache
def troubles(seed: int) -> tuple[Trouble, ...]:
    """Return the vectors of every kind. Another seed than the default takes five seconds of computing."""
    return default_troubles() if seed == SEED else drawn_troubles(seed)


def drawn_troubles(seed: int) -> tuple[Trouble, ...]:
    """Return the vectors computed now, whatever the seed."""
    return tuple(made(kind, seed) for kind in KINDS)
