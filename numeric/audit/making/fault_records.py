"""How the vectors of faults are computed: data, ranks and spaces by the exact branch, singular values enclosed, bounds from conditioning.

fault_vectors        zeros at infinity and outside the unit circle, uncontrollable (A, F), the longest lag, bad units, nearly equal
                     faults, G = 0; each in all views
unexciting_vectors   a constant, a sine, two faults in proportion
noisy_vectors        white noise far below the least singular value
singular_values      certified
enclosed_values      the same from the square of the matrix
conditions_gap       (below the least nonzero singular value of the conditions, above the norm of the response), certified
conditions_clear     whether it stands CLEAR above what rounding makes of it, as those of the windows do

Rows N, orthonormal, vanish on the windows of s block rows of r. A column [f; g] explains r where N, shifted by each number of samples
within the window, vanishes on its response [0 I; C 0; C A 0; ..] [f; g]: these are the conditions, and the space is their null space. Who
solves them decides a rank twice, that of the windows, which gives N, and that of the conditions. Rounding of the samples turns N by its
norm over the least singular value of the windows at most, and so moves a condition by that times the norm of the response.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import ceil, sqrt
from random import Random

import numpy as np
from flint import arb, arb_mat, ctx, fmpq

from faultspace.exact.algebra.matrices import Matrix, beside, left_null_space, rank, solve_left, stacked
from faultspace.exact.structure.record import analyze
from faultspace.exact.structure.signals import excitation_matrix, hankel, simulate
from faultspace.exact.system.systems import ResidualSystem
from faultspace.exact.system.windows import observability_matrix, window_matrix

from ...method.model.compression import EPS
from ...method.model.models import StateSpaceModel, lower_toeplitz
from ...method.model.residuals import residual
from ...method.signal.reconstruction import reconstruct_fault
from ...method.space.by_ranks import noise_free_fault_space
from ...study.conditioning import SMALL
from ...study.residual_conditioning import fault_signal_error, fitted_state_error
from ..vectors.fault_vectors import (
    AS_GIVEN,
    CLEAR,
    HALF,
    LONG_WINDOW,
    VIEWS,
    FaultVector,
    FaultView,
    UnexcitingVector,
    channel_units,
    in_channel_units,
    unexciting_inputs,
    with_input,
)
from ..vectors.rationals import floats, fractions, matrix, scaled
from ..vectors.recipe_vectors import NoisyVector
from .planting import TELLING, digits, stable, upward

ABOVE = 10.0  # how far above the noise's norm the least singular value must be, both certified


def fault_systems() -> list[tuple[str, ResidualSystem]]:
    """Return left-invertible systems with m < p, all stable."""
    rng = Random("faults")

    def plain(n: int, m: int, p: int) -> ResidualSystem:
        return ResidualSystem(stable(rng, n), digits(rng, n, m, 3), digits(rng, p, n, 5), digits(rng, p, m, 7))

    two = plain(3, 2, 3)
    three = plain(3, 1, 3)
    without = three.with_faults(three.F, Matrix.zero(three.field, 3, 1))
    units = matrix([[1, 0, 0], [0, Fraction(1, 10**4), 0], [0, 0, 10**3]], 3)
    worse = matrix([[1, 0, 0], [0, Fraction(1, 10**8), 0], [0, 0, 10**8]], 3)
    return [
        ("one-fault", three),
        ("two-faults", two),
        ("delayed", without),
        ("bad-units", ResidualSystem(two.A, two.F, units @ two.C, units @ two.G)),
        ("longest-lag", plain(4, 1, 2)),
        ("worst-units", ResidualSystem(three.A, three.F, worse @ three.C, worse @ three.G)),
        ("nearly-one-fault", three.with_faults(*_nearly_twice(three))),
        (
            "zero-outside",  # r = [1; 2] times the output of a single channel with the zero 3/2, beside one that sees the second state
            ResidualSystem.of(
                [["1/2", "1", "0"], ["0", "1/3", "0"], ["0", "0", "1/4"]],
                [["1"], ["-7/6"], ["0"]],
                [["1", "0", "1"], ["2", "0", "0"]],
                [["0"], ["0"]],
            ),
        ),
        (
            "uncontrollable",  # the third state moves by itself
            ResidualSystem.of(
                [["1/2", "1/5", "1/3"], ["-1/4", "1/3", "1/7"], ["0", "0", "9/10"]],
                [["1"], ["2/3"], ["0"]],
                [["1", "2/5", "1/3"], ["-1/3", "1", "1"]],
                [["1/7"], ["1"]],
            ),
        ),
    ]


def _nearly_twice(system: ResidualSystem) -> tuple[Matrix, Matrix]:
    """Return F and G with a second column a millionth away from the first."""
    rng = Random("nearly")
    F, G = (matrix([[row[0], row[0] + Fraction(rng.randint(1, 9), 10**7)] for row in fractions(one)], 2) for one in (system.F, system.G))
    return F, G


def fault_vectors() -> list[FaultVector]:
    """The module says what these vectors are."""
    return [_faults(slug, system) for slug, system in fault_systems()]


def _faults(slug: str, system: ResidualSystem) -> FaultVector:
    rng = Random(slug)
    x0, v = digits(rng, system.n, 1, 1), digits(rng, 2 * HALF, system.m, 3)
    whole = _seen(slug, AS_GIVEN, system, x0, v, None)
    views = {view.slug: _seen(slug, view, view.system(system), *view.record(system, x0, v), whole) for view in VIEWS}
    return FaultVector(**{name: getattr(whole, name) for name in FaultVector.__dataclass_fields__ if name != "views"}, views=views)


def _seen(slug: str, view: FaultView, system: ResidualSystem, x0: Matrix, v: Matrix, whole: FaultVector | None) -> FaultVector:
    """Return the vector in that view; ranks and singular values are those of `whole` where all samples are there."""
    n, windows = system.n, system.n + 2
    known = analyze(system)
    lag, delay = known.kernel.lag, known.delay_known_state
    trajectory = simulate(system, x0, v)
    longest = max(windows, LONG_WINDOW)
    if rank(excitation_matrix(trajectory, longest)) < n + system.m * longest:
        raise ArithmeticError(f"{slug}, {view.slug}: the record does not excite the system")
    if delay is None:
        raise ArithmeticError(f"{slug}: not left-invertible")
    r = trajectory.residuals
    if whole is not None and v.nrows == whole.v.nrows:
        same = in_channel_units(whole.r).columns(view.outputs(system.p))
        if in_channel_units(r) != same:
            raise ArithmeticError(f"{slug}, {view.slug}: not the same record in other units")
        ranks, gaps = whole.ranks, whole.gaps
    else:
        ranks = tuple(rank(hankel(r, s)) for s in range(1, windows + 1))
        gaps = tuple(singular_values(hankel(in_channel_units(r), s)) for s in range(1, windows + 1))
    basis = known.fault_space.basis.transposed()
    bounds = {"residual": residual_bound(r, system, view.scale), "signal": signal_bound(r, system, x0)}
    space = {s: space_bound(r, system, s) for s in {lag + 1, n + 1, LONG_WINDOW}}
    return FaultVector(slug, view, system, x0, v, ranks, gaps, system.m, basis, lag, v.nrows - delay, bounds, space)


def space_bound(r: Matrix, system: ResidualSystem, block_rows: int) -> float:
    found = noise_free_fault_space(floats(r), floats(system.A), floats(system.C), n_v=system.m, block_rows=block_rows)
    if not found.meaningful or found.error_bound is None:
        raise ArithmeticError(f"no bound for the fault space from {block_rows} block rows: {found.reason}")
    return upward(found.error_bound)


def residual_bound(r: Matrix, system: ResidualSystem, size: Fraction) -> float:
    """Return the bound for y = r + the response from rest to u = size, -size, ... with B = F, D = G (see `with_input`), in
    channel units: what is computed for an output has its unit as a factor, whoever computes it.
    """
    units = channel_units(r)
    y, u = with_input(r, system, size)
    y = scaled(y, [1 / unit for unit in units])
    C, G = (scaled(M.transposed(), [1 / unit for unit in units]).transposed() for M in (system.C, system.G))
    model = StateSpaceModel(*(floats(M) for M in (system.A, system.F, C, G)))
    return upward(fitted_state_error(floats(y), floats(u), model, residual(floats(y), floats(u), model).r))


def signal_bound(r: Matrix, system: ResidualSystem, x0: Matrix) -> float | None:
    """Return None where a zero on or outside the unit circle lets errors of the last samples grow backwards into the record, and where
    rounding may make so much of the signal that nothing is asked.
    """
    A, F, C, G = (floats(M) for M in (system.A, system.F, system.C, system.G))
    start = floats(x0).ravel()
    found = reconstruct_fault(floats(r), A, F, C, G, x0=start)
    if found.zeros.size and float(np.max(np.abs(found.zeros))) >= 1:
        return None
    bound = fault_signal_error(floats(r), A, F, C, G, found, x0=start)
    return upward(bound) if bound < TELLING * float(np.linalg.norm(found.v)) else None


def leading_signal_bound(r: Matrix, system: ResidualSystem, x0: Matrix, trusted: int, outside: Sequence[float]) -> float | None:
    """Return the bound on the first `trusted` samples of v where the zeros outside the unit circle have the moduli `outside`; None where
    it asks for nothing.

    v solves T v = r - O x(0), T block Toeplitz. Rounding moves r - O x(0) - T v by SMALL N eps (|r| + |O x(0)| + |T| |v|) at most, and so
    v(k) by that times the norm of its rows of the pseudo-inverse; who goes forward from sample to sample multiplies by the largest zero
    each time. Both take T as it is; who takes the direction that hardly shows for rounding adds a multiple of it, which grows to the end as
    the powers of the least of them, and is there no larger than the signal.
    """
    A, F, C, G = (floats(M) for M in (system.A, system.F, system.C, system.G))
    data, N, m = floats(r), r.nrows, system.m
    model = StateSpaceModel(A, F, C, G)
    matrix_of = lower_toeplitz(model.markov(N))
    free = np.asarray(model.simulate(np.zeros((N, m)), floats(x0).ravel()))
    inverse = np.linalg.pinv(matrix_of, rcond=EPS)
    v = (inverse @ (data - free).ravel()).reshape(N, m)
    moved = SMALL * N * EPS * (np.linalg.norm(data) + np.linalg.norm(free) + np.linalg.norm(matrix_of) * np.linalg.norm(v))
    rows = np.linalg.norm(inverse.reshape(N, m, -1), axis=(1, 2))
    forward = rows[0] * max(outside) ** np.arange(trusted)
    kept = np.linalg.norm(v) * min(outside) ** (np.arange(trusted) - float(N))
    bound = float(np.linalg.norm(moved * np.maximum(rows[:trusted], forward) + kept))
    return upward(bound) if bound < TELLING * float(np.linalg.norm(v[:trusted])) else None


def singular_values(H: Matrix) -> tuple[float, float]:
    """Return (below the least nonzero, above the largest) singular value of H, certified: root enclosures of the exact polynomial of H
    H'.
    """
    return enclosed_values(H @ H.transposed())


def enclosed_values(square: Matrix) -> tuple[float, float]:
    """Return the same of any H with this square H H' or H' H."""
    polynomial = square.flint.charpoly()
    enclosures = [root.real for root, _ in polynomial.numer().complex_roots() if not root.contains(0)]
    lowest, highest = min(float(one.lower()) for one in enclosures), max(float(one.upper()) for one in enclosures)
    # One rounding of the root and of writing three digits: a thousandth away on the safe side.
    return float(f"{sqrt(lowest) * 0.999:.4e}"), float(f"{sqrt(highest) * 1.001:.4e}")


# -- what does not excite ---------------------------------------------------------------------------------------------------------------


def unexciting_vectors() -> list[UnexcitingVector]:
    """The module says what these vectors are."""
    systems = dict(fault_systems())
    rng = Random("unexciting")
    one, two, N = systems["one-fault"], systems["two-faults"], 2 * HALF
    signals = unexciting_inputs(N)
    single = fractions(digits(rng, N, 1, 3))
    together = matrix([[x, 2 * x] for (x,) in single], 2)
    cases = [
        ("constant-fault", one, signals["constant"], 0),
        ("sine-fault", one, signals["sine"], 0),
        ("faults-in-proportion", two, together, 1),
    ]
    return [_unexciting(*case) for case in cases]


def _unexciting(slug: str, system: ResidualSystem, v: Matrix, visible: int) -> UnexcitingVector:
    windows = system.n + 5
    x0 = digits(Random(slug), system.n, 1, 1)
    r = simulate(system, x0, v).residuals
    ranks = tuple(rank(hankel(r, s)) for s in range(1, windows + 1))
    if {ranks[-1] - ranks[-2], ranks[-2] - ranks[-3]} != {visible}:
        raise ArithmeticError(f"{slug}: the ranks {ranks} do not show {visible}")
    gaps = tuple(singular_values(hankel(in_channel_units(r), s)) for s in range(1, windows + 1))
    return UnexcitingVector(slug, system, x0, v, ranks, gaps, visible)


# -- noise ------------------------------------------------------------------------------------------------------------------------------


def noisy_vectors() -> list[NoisyVector]:
    """Return faults a thousand times the noise, whose deviation is one."""
    systems = dict(fault_systems())
    return [_noisy(f"{slug}-in-noise", systems[slug]) for slug in ("one-fault", "delayed", "longest-lag", "two-faults")]


def _noisy(slug: str, small: ResidualSystem) -> NoisyVector:
    system = small.with_faults(*(matrix([[x * 10**4 for x in row] for row in fractions(M)], small.m) for M in (small.F, small.G)))
    windows = system.n + 2
    blank = NoisyVector(slug, system, Fraction(1), 1200, 20250521, (), ())
    known = analyze(system).kernel
    ranks = tuple(known.rank(s) for s in range(1, windows + 1))
    gaps = tuple((low, _noise_norm(blank, s)) for s, low in enumerate(_enclosed_from_below(blank, ranks), start=1))
    if min(low / high for low, high in gaps) < ABOVE:
        raise ArithmeticError(f"{slug}: {gaps} leave the noise too near")
    return NoisyVector(slug, system, blank.noise, blank.samples, blank.seed, ranks, gaps)


def _noise_norm(vector: NoisyVector, s: int) -> float:
    """Return the Frobenius norm of the noise's Hankel matrix, every entry of which is +-noise: it is above the spectral norm."""
    entries = vector.system.p * s * (vector.samples - s + 1)
    return ceil(float(vector.noise) * sqrt(entries) * 1.001 * 1e3) / 1e3


def _enclosed_from_below(vector: NoisyVector, ranks: Sequence[int]) -> list[float]:
    """Return bounds from below on the least nonzero singular value of the exact R_s, s = 1, 2, ..., in balls.

    The eigenvalues of P = R_s R_s' + t N' N, the rows of N the left null space of [O_s T_s], are those of R_s R_s' that are not zero and
    those of t N N': the least of them all is below, |P^-8|^(-1/8) below that, and that P has an inverse shows the rank of R_s.
    """
    with ctx.workprec(400):
        r = _simulated(vector)
        result = []
        for s, due in enumerate(ranks, start=1):
            columns = vector.samples - s + 1
            H = arb_mat([[r[k + i][j] for k in range(columns)] for i in range(s) for j in range(vector.system.p)])
            product = H * H.transpose()
            null = left_null_space(window_matrix(vector.system, s))
            if null.nrows != vector.system.p * s - due:
                raise ArithmeticError(f"{vector.slug}: [O_{s} T_{s}] has another rank than {due}")
            if null.nrows:
                rows = _enclosed(null)
                product += rows.transpose() * rows * product.trace()
            squares = (arb(x) ** 2 for row in (product.inv() ** 8).tolist() for x in row)
            highest = float(sum(squares, arb(0)).root(16).upper())  # ZeroDivisionError where the inverse is not seen to exist
            result.append(float(f"{0.999 / sqrt(highest):.4e}"))
    return result


def _simulated(vector: NoisyVector) -> list[list[arb]]:
    """Return r without noise, enclosed. The states are exact: balls would grow with |A|, however stable A is."""
    v = matrix([[int(one) for one in row] for row in vector.drawn()[0]], vector.system.m)
    exact = simulate(vector.system, Matrix.zero(vector.system.field, vector.system.n, 1), v).residuals
    return [[arb(x) for x in row] for row in exact.elements()]


def _enclosed(given: Matrix) -> arb_mat:
    return arb_mat([[arb(fmpq(x.numerator, x.denominator)) for x in row] for row in fractions(given)])


# -- how clearly the samples show the fault space ----------------------------------------------------------------------------------------


def conditions_gap(r: Matrix, system: ResidualSystem, block_rows: int) -> tuple[float, float]:
    """Return (below the least nonzero singular value of the conditions, above the norm of the response).

    Channels are in their units, states in the one that makes the largest entry of C one. Where no row vanishes on the windows there are no
    conditions, and the first is infinite.
    """
    p, s = system.p, block_rows
    response = _response(system, [1 / unit for unit in channel_units(r)], s)
    size = enclosed_values(response.transposed() @ response)[1]
    rows = left_null_space(hankel(in_channel_units(r), s))
    if not rows.nrows:
        return float("inf"), size
    gram = rows @ rows.transposed()
    total = Matrix.zero(rows.field, system.n + p, system.n + p)
    for shift in range(s):
        condition = rows.columns(range(shift * p, s * p)) @ response.rows(range((s - shift) * p))
        divided = solve_left(gram, condition.transposed())
        assert divided is not None  # the rows are independent
        total = total + divided @ condition
    return enclosed_values(total)[0], size


def conditions_clear(r: Matrix, system: ResidualSystem, block_rows: int) -> bool:
    """Say whether rounding of the samples leaves no doubt of the dimension of the fault space from windows of so many block rows."""
    least, size = conditions_gap(r, system, block_rows)
    low, high = singular_values(hankel(in_channel_units(r), block_rows))
    return least > CLEAR * sqrt(system.p * block_rows) * high / low * size


def _response(system: ResidualSystem, factors: list[Fraction], block_rows: int) -> Matrix:
    """Return [0 I; C 0; C A 0; ..], block_rows blocks of rows, in the units of `conditions_gap`."""
    n, p = system.n, system.p
    C = scaled(system.C.transposed(), factors).transposed()
    largest = max((abs(x) for row in fractions(C) for x in row), default=Fraction(0)) or Fraction(1)
    unit = scaled(C, [1 / largest] * n)
    later = observability_matrix(ResidualSystem(system.A, system.F, unit, system.G), block_rows - 1)
    first = beside(Matrix.zero(system.field, p, n), Matrix.identity(system.field, p))
    return stacked(first, beside(later, Matrix.zero(system.field, later.nrows, p)))
