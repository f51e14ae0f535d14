"""How the vectors are computed: systems drawn from fixed seeds, data and answers by the exact branch, bounds from conditioning.

    MAKERS                  kind -> function that makes its vectors
    identification_vectors  n_u, p = 1, 2, 3, with and without D and initial state; smooth inputs
    fault_vectors           zeros at infinity and outside the unit circle, uncontrollable (A, F), the longest lag, bad units, G = 0
    structure_vectors       the same questions for the system itself; not left-invertible, without zeros
    consistency_vectors     a coloured fault

The bounds are those of the problem, not of one program. A model: the largest over two ways to compress (QR, Gram) and two regressions for B
and D, each a worst case to first order. A fault space: the kernel rows' conditioning. A zero: its condition number as an eigenvalue of the
pencil times the rounding of a backward stable algorithm [GVL13].
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import sqrt
from random import Random
from typing import Any

import numpy as np

from faultspace.exact.experiments import Experiment
from faultspace.exact.filters import Filter
from faultspace.exact.matrices import Matrix, rank
from faultspace.exact.population_limits import population_limits
from faultspace.exact.signals import excitation_matrix, hankel, simulate
from faultspace.exact.structure import structure
from faultspace.exact.systems import FaultySystem, ResidualSystem

from ..compression import EPS, compress
from ..conditioning import SMALL, ModelError, by_gram, by_qr, moesp_error, noise_free_range, output_error_error, setting
from ..fault_space import noise_free_fault_space
from ..models import StateSpaceModel
from ..pi_moesp import pi_moesp, pi_moesp_from_compression
from ..reconstruction import reconstruct_fault
from ..residual_conditioning import fault_signal_error, fitted_state_error
from ..residuals import residual
from .exact_comparison import matched, poles, roots
from .vectors import POINTS, ConsistencyVector, FaultVector, IdentificationVector, StructureVector, floats, matrix


def drawn(rng: Random, height: int, width: int, denominator: int) -> Matrix:
    """Digits over a denominator, none of them zero."""
    digits = [d for d in range(-9, 10) if d]
    return matrix([[Fraction(rng.choice(digits), denominator) for _ in range(width)] for _ in range(height)], width)


def stable(rng: Random, n: int) -> Matrix:
    """Entries over 16 or a multiple of it, spectral radius below 0.9."""
    entries = [[rng.randint(-12, 12) for _ in range(n)] for _ in range(n)]
    radius = float(np.max(np.abs(np.linalg.eigvals(np.array(entries, dtype=float)))))
    denominator = 16 * max(1, int(np.ceil(radius / 14.4)))
    return matrix([[Fraction(entry, denominator) for entry in row] for row in entries], n)


def upward(value: float) -> float:
    """Two digits, never below the value: a bound needs no more, and equal programs then write equal files."""
    return float(f"{value * 1.05:.1e}") if value > 0 else 0.0


def _upward(values: Any) -> Any:
    return [_upward(one) for one in values] if isinstance(values, (list, np.ndarray)) else upward(float(values))


# -- identification -----------------------------------------------------------------------------------------------------------------


def identification_vectors() -> list[IdentificationVector]:
    """See the module."""
    cases = [(n, n_u, p, True, True, 0) for n, n_u, p in [(2, 1, 1), (1, 2, 1), (2, 3, 1), (2, 1, 2), (3, 2, 2), (2, 3, 2)]]
    cases += [(3, 1, 3, True, True, 0), (2, 2, 3, True, True, 0), (3, 3, 3, True, True, 0)]
    cases += [(2, 2, 2, False, True, 0), (2, 2, 2, True, False, 0), (2, 2, 2, False, False, 0), (3, 1, 2, True, True, 4)]
    return [_identification(*case) for case in cases]


def _identification(n: int, n_u: int, p: int, feedthrough: bool, moving: bool, smoothing: int) -> IdentificationVector:
    rng = Random(f"{n} {n_u} {p}")
    A, B, C, D = stable(rng, n), drawn(rng, n, n_u, 3), drawn(rng, p, n, 5), drawn(rng, p, n_u, 7)
    u = drawn(rng, 70 + smoothing, n_u, 3)
    for _ in range(smoothing):
        u = u.rows(range(u.nrows - 1)) + u.rows(range(1, u.nrows))
    x0 = matrix([[20 + rng.randint(-9, 9)] for _ in range(n)], 1)
    D = D if feedthrough else Matrix.zero(D.field, p, n_u)
    x0 = x0 if moving else Matrix.zero(x0.field, n, 1)
    slug = f"n{n}-u{n_u}-p{p}" + ("" if feedthrough else "-no-D") + ("" if moving else "-at-rest") + ("-smooth" if smoothing else "")
    blank = IdentificationVector(slug, A, B, C, D, x0, u, n + 2, {})
    return IdentificationVector(slug, A, B, C, D, x0, u, n + 2, _model_bounds(blank))


def _model_bounds(vector: IdentificationVector) -> dict[str, Any]:
    """The largest bound of four routes."""
    y, u, s, n = floats(vector.y), floats(vector.u), vector.block_rows, vector.order
    errors: list[ModelError] = []
    for route, backward_error in (("qr", by_qr), ("gram", by_gram)):
        compressed = compress(y, u, block_rows=s, route=route)
        for found in (pi_moesp_from_compression(compressed, order=n), pi_moesp(y, u, order=n, block_rows=s, route=route)):
            where = setting(compressed, found)
            moved = noise_free_range(where, backward_error(where))
            errors.append(moesp_error(where, backward_error(where), moved))
            errors.append(output_error_error(where, moved, [(y, u)]))
    exact = poles(vector.A)
    of_poles = [one.poles[matched(np.linalg.eigvals(one.model.A).tolist(), exact)[0]] for one in errors]
    return {
        "markov": _upward(np.max([one.markov(2 * n + 2) for one in errors], axis=0)),
        "characteristic_polynomial": _upward(np.max([one.characteristic_polynomial for one in errors], axis=0)),
        "transfer": _upward([np.max([one.transfer(z) for one in errors], axis=0) for z in POINTS]),
        "poles": _upward(np.max(of_poles, axis=0)),
    }


# -- faults -------------------------------------------------------------------------------------------------------------------------


def fault_systems() -> list[tuple[str, ResidualSystem]]:
    """Left-invertible systems with m < p, all stable."""
    rng = Random("faults")

    def plain(n: int, m: int, p: int) -> ResidualSystem:
        return ResidualSystem(stable(rng, n), drawn(rng, n, m, 3), drawn(rng, p, n, 5), drawn(rng, p, m, 7))

    two = plain(3, 2, 3)
    three = plain(3, 1, 3)
    without = three.with_faults(three.F, Matrix.zero(three.field, 3, 1))
    units = matrix([[1, 0, 0], [0, Fraction(1, 10**4), 0], [0, 0, 10**3]], 3)
    return [
        ("one-fault", three),
        ("two-faults", two),
        ("delayed", without),
        ("bad-units", ResidualSystem(two.A, two.F, units @ two.C, units @ two.G)),
        ("longest-lag", plain(4, 1, 2)),
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


def fault_vectors() -> list[FaultVector]:
    """See the module."""
    return [_faults(slug, system) for slug, system in fault_systems()]


def _faults(slug: str, system: ResidualSystem) -> FaultVector:
    rng = Random(slug)
    n, windows = system.n, system.n + 2
    x0, v = drawn(rng, n, 1, 1), drawn(rng, 90, system.m, 3)
    known = structure(system)
    trajectory = simulate(system, x0, v)
    if rank(excitation_matrix(trajectory, windows)) < n + system.m * windows:
        raise ArithmeticError(f"{slug}: the record does not excite the system")
    r, basis = trajectory.residuals, known.fault_space.basis.transposed()
    found = noise_free_fault_space(floats(r), floats(system.A), floats(system.C), n_v=system.m)
    if not found.meaningful or found.error_bound is None:
        raise ArithmeticError(f"{slug}: no bound for the fault space")
    delay = known.delay_known_state
    if delay is None:
        raise ArithmeticError(f"{slug}: not left-invertible")
    return FaultVector(
        slug,
        system,
        x0,
        v,
        tuple(rank(hankel(r, s)) for s in range(1, windows + 1)),
        tuple(singular_values(hankel(r, s)) for s in range(1, windows + 1)),
        system.m,
        basis,
        v.nrows - delay,
        {"residual": _residual_bound(r, system), "space": upward(found.error_bound), "signal": _signal_bound(r, system, x0)},
    )


def _residual_bound(r: Matrix, system: ResidualSystem) -> float:
    """For y = r + the response from rest to u = 1, -1, 1, ... with B = F, D = G (see `fault_checks.with_input`)."""
    from .fault_checks import with_input

    y, u = with_input(r, system)
    model = StateSpaceModel(*(floats(M) for M in (system.A, system.F, system.C, system.G)))
    return upward(fitted_state_error(floats(y), floats(u), model, residual(floats(y), floats(u), model).r))


def _signal_bound(r: Matrix, system: ResidualSystem, x0: Matrix) -> float | None:
    """None where a zero on or outside the unit circle lets errors of the last samples grow backwards into the record."""
    A, F, C, G = (floats(M) for M in (system.A, system.F, system.C, system.G))
    start = floats(x0).ravel()
    found = reconstruct_fault(floats(r), A, F, C, G, x0=start)
    if found.zeros.size and float(np.max(np.abs(found.zeros))) >= 1:
        return None
    return upward(fault_signal_error(floats(r), A, F, C, G, found, x0=start))


def singular_values(H: Matrix) -> tuple[float, float]:
    """(below the least nonzero, above the largest) singular value of H, certified: root enclosures of the exact polynomial of H H'."""
    polynomial = (H @ H.transposed()).flint.charpoly()
    enclosures = [root.real for root, _ in polynomial.numer().complex_roots() if not root.contains(0)]
    lowest, highest = min(float(one.lower()) for one in enclosures), max(float(one.upper()) for one in enclosures)
    # One rounding of the root and of writing three digits: a thousandth away on the safe side.
    return float(f"{sqrt(lowest) * 0.999:.4e}"), float(f"{sqrt(highest) * 1.001:.4e}")


# -- structure ----------------------------------------------------------------------------------------------------------------------


def structure_systems() -> list[tuple[str, ResidualSystem]]:
    """Entries are eighths, so that floats hold them exactly."""
    rng = Random("structure")

    def plain(n: int, m: int, p: int, feedthrough: int) -> ResidualSystem:
        F, C = (matrix([[Fraction(rng.randint(-9, 9), 8) for _ in range(b)] for _ in range(a)], b) for a, b in ((n, m), (p, n)))
        A = matrix([[Fraction(rng.randint(-6, 6), 8) for _ in range(n)] for _ in range(n)], n)
        G = [[Fraction(rng.randint(1, 9), 8) if feedthrough > j else 0 for j in range(m)] for _ in range(p)]
        return ResidualSystem(A, F, C, matrix(G, m))

    square = plain(3, 2, 2, 2)
    channel = [["1/2", "1", "0"], ["0", "1/4", "0"], ["0", "0", "1/4"]]
    return [
        ("square-proper", square),
        ("square-half-proper", plain(4, 2, 2, 1)),
        ("square-strictly-proper", plain(3, 1, 1, 0)),
        ("tall-without-zeros", plain(3, 1, 3, 0)),
        ("zero-outside", ResidualSystem.of(channel, [["1"], ["-1"], ["0"]], [["1", "0", "1"], ["2", "0", "0"]], [["0"], ["0"]])),
        ("chain-of-delays", ResidualSystem.of([[0, 1, 0], [0, 0, 1], [0, 0, 0]], [[0], [0], [1]], [[1, 0, 0]], [[0]])),
        ("same-fault-twice", square.with_faults(_doubled(square.F), _doubled(square.G))),
        ("wide", plain(3, 3, 2, 1)),
    ]


def _doubled(given: Matrix) -> Matrix:
    return given.columns([0, 0])


def structure_vectors() -> list[StructureVector]:
    """See the module."""
    result = []
    for slug, system in structure_systems():
        known = structure(system)
        zeros = roots(known.invariant_zero_polynomial) if known.finite_zeros else ()
        asked = zeros if known.left_invertible else ()
        bounds = tuple(upward(zero_bound(system, z)) for z in asked)
        result.append(StructureVector(slug, system, known.kernel.normal_rank, asked, bounds, known.infinite_zero_orders))
    return result


def zero_bound(system: ResidualSystem, zero: complex) -> float:
    """SMALL (rows + columns) eps |P| |x| |y| / |y* E x| for the right null vector x of P(z) and the best left one y, E = diag(I, 0)."""
    A, F, C, G = (floats(M) for M in (system.A, system.F, system.C, system.G))
    n, m, p = system.n, system.m, system.p
    pencil = np.block([[zero * np.eye(n) - A, -F], [C, G]])
    left, values, right = np.linalg.svd(pencil)
    seen = int(np.sum(values > 1e-8 * values[0]))
    if seen != n + m - 1:
        raise ArithmeticError(f"{zero}: not a simple zero")
    derivative = np.concatenate([right[-1, :n].conj(), np.zeros(p)])
    conditioned = float(np.linalg.norm(left[:, seen:].conj().T @ derivative))
    return SMALL * (2 * n + m + p) * EPS * float(np.linalg.norm(pencil)) / conditioned


# -- consistency --------------------------------------------------------------------------------------------------------------------


def consistency_vectors() -> list[ConsistencyVector]:
    """One: a = 1/2, c = 9/10."""
    a, c, s = Fraction(1, 2), Fraction(9, 10), 3
    system = FaultySystem(ResidualSystem.of([[str(a)]], [[1]], [[1]], [[0]]), matrix([[1]], 1), matrix([[0]], 1))
    u_filter = Filter.of([[["1", "0"]]])
    v_filter = Filter.of([[["0", "1"]]], ["1", str(-c)])
    limits = population_limits(Experiment(system, s, s, u_filter, v_filter))
    if not limits.past_inputs.equals_observability_range:
        raise ArithmeticError("past inputs are not consistent here")
    left = np.linalg.svd(floats(limits.past_outputs.matrix))[0][:, :1]
    biased = float((left[:-1].T @ left[1:])[0, 0] / (left[:-1].T @ left[:-1])[0, 0])
    return [ConsistencyVector("coloured", a, c, s, 20000, 20250519, round(biased, 6))]


MAKERS: dict[str, Callable[[], Sequence[Any]]] = {
    "identification": identification_vectors,
    "faults": fault_vectors,
    "structure": structure_vectors,
    "consistency": consistency_vectors,
}
