"""The float estimates against the exact branch: exact rational systems and trajectories, converted to floats at the
very end.

For systems of planted structure over Q: ranks, n_v, lag, n_z at every window from the lag on, and the space itself
within the bound that the estimate derives from conditioning. Each test prints got, bound and their ratio.
"""

from __future__ import annotations

from random import Random
from typing import Any

import numpy as np
import pytest

from faultspace.exact.algebra.matrices import Matrix, rank
from faultspace.exact.structure.fault_columns import fault_space as exact_fault_space
from faultspace.exact.structure.fault_columns import with_pair
from faultspace.exact.structure.inversion import delay_known_state, delay_unknown_state
from faultspace.exact.structure.kernel_rows import KernelRepresentation, kernel_representation
from faultspace.exact.structure.record import analyze
from faultspace.exact.structure.signals import excitation_matrix, simulate
from faultspace.exact.system.systems import ResidualSystem, read_system
from faultspace.numeric.audit.vectors.shipped_vectors import StructureVector, shipped
from faultspace.numeric.method.signal.pair_zeros import fault_zeros
from faultspace.numeric.method.signal.reconstruction import reconstruct_fault
from faultspace.numeric.method.space.by_ranks import fault_space
from faultspace.numeric.method.space.distances import containment_distance, subspace_distance
from tests.numeric.planted import paper_example
from tests.oracle.structured import Structure, planted_system

# Left indices, no right ones (left-invertible), infinite zero orders (one per fault), finite zeros.
STRUCTURES = [
    Structure((2,), (), (0,), ()),
    Structure((1, 2), (), (0,), ()),
    Structure((0, 1), (), (1,), ()),
    Structure((2,), (), (0, 1), ()),
    Structure((1,), (), (0,), (1,)),
    Structure((2, 2), (), (0, 0), ()),
    Structure((0, 3), (), (0,), ()),
    Structure((1, 1), (), (2,), ()),
]
SAMPLES = 60
# A float rank needs the excitation to stand clear of rounding; exact full rank is not enough.
EXCITED = 1e9


def floats(matrix: Matrix) -> Any:
    """Return a rational matrix, each entry correctly rounded."""
    return np.array(matrix.to_sympy().tolist(), dtype=float).reshape(matrix.shape)


def stable(system: ResidualSystem) -> ResidualSystem:
    """Return the system with q replaced by a multiple of q, so that A is a contraction: A and C A^k F shrink, the structure stays."""
    largest = max(1, int(np.ceil(np.max(np.abs(np.linalg.eigvals(floats(system.A))), initial=0) * 10 / 9)))
    shape = (system.n, system.n)
    scale = Matrix.of([[f"1/{largest}" if i == j else 0 for j in range(system.n)] for i in range(system.n)], shape=shape)
    # x'(k) = c^k x(k), v'(k) = c^k v(k) with c = 1/largest turns (A, F, C, G) into (cA, cF, C, G).
    return ResidualSystem(scale @ system.A, scale @ system.F, system.C, system.G)


def cases(seed: int, shape: Structure) -> tuple[ResidualSystem, KernelRepresentation, Any, Any, Any]:
    """Return system, kernel, exact fault signal, residuals in floats, and the exact condition number of the excitation."""
    attempt = 0
    while True:
        rng = Random(1000 * seed + attempt)
        system = stable(read_system(planted_system(rng, "Q", shape)).residual)
        x0 = Matrix.of([[rng.randint(-9, 9)] for _ in range(system.n)], shape=(system.n, 1))
        v = Matrix.of([[rng.randint(-9, 9) for _ in range(system.m)] for _ in range(SAMPLES)], shape=(SAMPLES, system.m))
        found = simulate(system, x0, v)
        longest = system.n + 2
        excitation = excitation_matrix(found, longest)
        if rank(excitation) == excitation.nrows and np.linalg.cond(floats(excitation)) < EXCITED:
            return system, kernel_representation(system), v, floats(found.residuals), floats(x0)
        attempt += 1


@pytest.mark.parametrize("shape", STRUCTURES, ids=str)
def test_the_space_at_every_window(shape: Structure) -> None:
    """n_z is the exact one at s = lag, too large there, at lag + 1 and later; the space agrees within the bound of
    conditioning.
    """
    for seed in range(3):
        system, kernel, _, r, _ = cases(seed, shape)
        A, C = floats(system.A), floats(system.C)
        lag = kernel.lag
        for s in range(max(lag, 1), system.n + 3):
            exact = exact_fault_space(kernel, s)
            found = fault_space(r, A, C, block_rows=s)
            assert found.n_z == exact.dimension, (s, lag, found.reason)
            assert found.lag == lag and found.n_v == kernel.normal_rank
            assert found.meaningful == (s >= lag + 1)
            truth = floats(exact.basis).T
            got = subspace_distance(truth, found.basis)
            if found.error_bound is None:
                assert found.equations == 0 and got == 0
                continue
            assert got <= found.error_bound
            print(f"{shape} s={s}: got {got:.1e}, bound {found.error_bound:.1e}, ratio {got / found.error_bound:.1e}")
        limit = exact_fault_space(kernel)
        assert fault_space(r, A, C).n_z == limit.dimension == analyze(system).zeta + system.m


def test_wrong_columns_at_the_lag() -> None:
    """At s = lag the float answer holds exact columns that are no faults of an equivalent system, and does not call
    itself meaningful.
    """
    system, kernel, _, r, _ = cases(5, Structure((2,), (), (0,), ()))
    short, limit = exact_fault_space(kernel, kernel.lag), exact_fault_space(kernel)
    assert short.dimension > limit.dimension
    found = fault_space(r, floats(system.A), floats(system.C), block_rows=kernel.lag)
    assert not found.meaningful
    assert containment_distance(floats(short.basis).T, found.basis) < 1e-9
    assert containment_distance(found.basis, floats(limit.basis).T) == 1.0


@pytest.mark.parametrize("shape", STRUCTURES, ids=str)
def test_zeros_and_delays(shape: Structure) -> None:
    """Both delays and the finite zeros are those of the exact branch."""
    for seed in range(3):
        system, kernel, _, _, _ = cases(seed, shape)
        found = fault_zeros(*(floats(M) for M in (system.A, system.F, system.C, system.G)))
        assert found.left_invertible
        assert found.delay_known_state == delay_known_state(kernel)
        assert found.delay_unknown_state == delay_unknown_state(kernel)
        polynomial = [float(c) for c in analyze(system).invariant_zero_polynomial]
        assert len(found.zeros) == len(polynomial) - 1
        for zero in found.zeros:
            size = sum(abs(c) * abs(zero) ** k for k, c in enumerate(polynomial))
            assert abs(np.polyval(polynomial[::-1], zero)) <= 1e-6 * max(size, 1e-3)


def _zeros_differ_by(found: Any, polynomial: list[float]) -> float:
    """Return the largest distance of the zeros from the roots of the exact polynomial, matched in the order of their parts."""
    due = np.sort_complex(np.roots(polynomial[::-1]))
    assert len(found) == len(due)
    return float(np.max(np.abs(np.sort_complex(found) - due), initial=0))


@pytest.mark.parametrize(
    ("shape", "F", "G"),
    [
        pytest.param((2, 1, 1), [["0"], ["0"]], [["0"]], id="F = G = 0"),
        pytest.param((2, 0, 1), [[], []], [[]], id="no fault"),
        pytest.param((2, 2, 1), [["0", "1"], ["0", "0"]], [["0", "0"]], id="a fault of two does nothing"),
        pytest.param((2, 2, 1), [["1", "2"], ["1", "2"]], [["1", "2"]], id="two faults alike"),
        pytest.param((2, 2, 1), [["1", "0"], ["0", "1"]], [["0", "0"]], id="more faults than outputs"),
    ],
)
def test_finite_zeros_are_those_of_the_pencil(shape: tuple[int, int, int], F: Any, G: Any) -> None:
    """This holds for systems left-invertible or not: where F = G = 0 they are the eigenvalues of A that C does not show."""
    n, m, p = shape
    for C in ([["0", "1"]], [["0", "0"]], [["1", "1"]]):
        given = {"A": [["1/2", "0"], ["0", "3/4"]], "F": F, "C": C, "G": G, "n": n, "m": m, "p": p}
        system = read_system(given).residual
        polynomial = [float(c) for c in analyze(system).invariant_zero_polynomial]
        found = fault_zeros(*(floats(M) for M in (system.A, system.F, system.C, system.G)))
        assert _zeros_differ_by(found.zeros, polynomial) < 1e-9, C


@pytest.mark.parametrize(
    "shape",
    [Structure((1,), (0,), (0,), (1,)), Structure((2,), (1,), (0,), (1,)), Structure((), (2,), (1,), (0, 1))],
    ids=str,
)
def test_finite_zeros_beside_right_indices(shape: Structure) -> None:
    for seed in range(3):
        system = stable(read_system(planted_system(Random(seed), "Q", shape)).residual)
        polynomial = [float(c) for c in analyze(system).invariant_zero_polynomial]
        found = fault_zeros(*(floats(M) for M in (system.A, system.F, system.C, system.G)))
        assert not found.left_invertible and len(polynomial) == len(shape.roots) + 1
        assert _zeros_differ_by(found.zeros, polynomial) < 1e-6


@pytest.mark.parametrize("shape", STRUCTURES, ids=str)
def test_the_signal_with_its_delay(shape: Structure) -> None:
    """From a known state v is recovered exactly up to the delay; from an unknown one too where the exact branch says
    that this can be.
    """
    for seed in range(3):
        system, kernel, v, r, x0 = cases(seed, shape)
        matrices = [floats(M) for M in (system.A, system.F, system.C, system.G)]
        truth = floats(v)
        found = reconstruct_fault(r, *matrices, x0=x0.ravel())
        delay = delay_known_state(kernel)
        assert delay is not None and found.delay == delay and found.misfit < 1e-9
        first, last = found.trusted
        if not shape.roots:
            assert (first, last) == (0, SAMPLES - delay)
        assert np.max(np.abs(found.v - truth)[first:last], initial=0) < 1e-5
        unknown = reconstruct_fault(r, *matrices)
        assert unknown.misfit < 1e-9
        if delay_unknown_state(kernel) is not None:
            assert unknown.delay == delay_unknown_state(kernel)
            assert np.max(np.abs(unknown.v - truth)[slice(*unknown.trusted)]) < 1e-5


def test_a_pair_that_the_exact_branch_calls_equivalent_explains_the_floats() -> None:
    """(Fhat P, Ghat P) from the exact space: the float smoother reproduces r; a pair outside does not."""
    system, kernel, _, r, _ = cases(2, Structure((2,), (), (1,), ()))
    space = exact_fault_space(kernel)
    pair = with_pair(space, Matrix.of([[1], [1]]))
    A, C = floats(system.A), floats(system.C)
    assert reconstruct_fault(r, A, floats(pair.F), C, floats(pair.G)).misfit < 1e-6
    outside = np.random.default_rng(0).standard_normal((system.n + system.p, 1))
    assert reconstruct_fault(r, A, outside[: system.n], C, outside[system.n :]).misfit > 1e-3


def test_the_papers_example() -> None:
    """The exact example over its cubic field and the float one have the same dimensions at s = 1 .. 6, and lag 2."""
    example = paper_example()
    exact = read_system(
        {
            "A": [["0", "1", "0"], ["0", "0", "1"], ["-1/4", "3/4", "1/4"]],
            "F": [["1"], [["0", "1", "0"]], [["0", "0", "1"]]],
            "C": [["1", "0", "0"], ["0", "1", "0"]],
            "G": [["0"], ["0"]],
            "field": {"minimal_polynomial": ["1", "-3", "-1", "4"]},
        }
    ).residual
    kernel = kernel_representation(exact)
    v = np.random.default_rng(0).standard_normal((200, 1))
    x, r = np.ones(3), np.empty((200, 2))
    for k in range(200):
        r[k] = example.C @ x
        x = example.A @ x + example.F @ v[k]
    for s in range(1, 7):
        found = fault_space(r, example.A, example.C, block_rows=s)
        assert found.n_z == exact_fault_space(kernel, s).dimension == (5 if s < 3 else 2)
        assert found.lag == kernel.lag == 2


@pytest.mark.parametrize("vector", shipped("structure"), ids=lambda vector: vector.slug)
def test_zeros_and_delays_are_the_same_in_other_units(vector: StructureVector) -> None:
    A, F, C, G = (floats(M) for M in (vector.system.A, vector.system.F, vector.system.C, vector.system.G))
    faults, outputs = 2.0 ** np.arange(-30, -30 + F.shape[1]), 2.0 ** (-25 + 20 * (np.arange(len(C)) % 3))[:, None]
    plain, other = fault_zeros(A, F, C, G), fault_zeros(A, F * faults, C * outputs, G * faults * outputs)
    assert other.left_invertible == plain.left_invertible == vector.left_invertible
    assert (other.delay_known_state, other.delay_unknown_state) == (plain.delay_known_state, plain.delay_unknown_state)
    assert np.allclose(other.zeros, plain.zeros, rtol=1e-7, atol=1e-9)
    if vector.left_invertible:
        assert len(plain.zeros) == len(vector.zeros)
