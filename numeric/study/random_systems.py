"""These are the random systems of the Monte Carlo study, each from a seed of its own.

    StudySystem      A, B, C, D with fault matrices F, G, the finite zeros they were built with, and the fault space Z
    study_system     a random stable system with n = 5, n_u = 1, p = 3, n_v = 2 and a given number of finite zeros
    with_zeros       F, G for given A, C such that the fault system loses rank at each given number
    pencil_zeros     finite zeros of A, F, C, G from the pencil alone, by random compression to square pencils

The zeros are constructed as follows. F and G have a zero at z with state w and fault direction g iff

    (A - z I) w + F g = 0,    C w + G g = 0,    (w, g) != 0,

which for given z and g is linear in (w, F, G). All planted zeros together are one homogeneous system; F, G are drawn from the standard
normal distribution on the pairs that solve it. One zero is planted in the first fault, two in one fault each. Three: two are planted in
the first fault, and the third follows. For with A a companion matrix and C = [Q 0], states that differ by ker C = span(e4, e5) make V* =
span(e3, e4, e5), whatever the two zeros are: f = -e2 + a e3 + b e4 + c e5 and g = -C e3 up to a factor, three zeros whose sum is the
trace a + A[5, 5]. This is the distribution of the published generator [G25], its third zero included, and also the length of that fault
column: the generator draws it in a basis of the intersection of two spaces whose columns are 1/sqrt(2) long.

So the numbers are zeros by construction; that there are no others is verified by `pencil_zeros`, which knows nothing of the
construction, and a system with others is drawn again.

With W the matrix of the states w, Z = im [F; G] + [A; C] W + [W; 0]: rank G = n_v, so there are no zeros at infinity.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack, null_space

from ...base.arrays import Array
from ...base.errors import InvalidData
from ...base.sheets import counted
from ..method.model.models import StateSpaceModel

ComplexArray = NDArray[np.complex128]

N_X, N_U, P, N_V = 5, 1, 3, 2
# Length of the published generator's basis of an intersection: the column of three zeros is that much weaker.
INTERSECTION_BASIS = 1 / np.sqrt(2)
# The faults that zeros are planted in, for 0, 1, 2, 3 zeros; of three the last one follows.
DIRECTIONS: tuple[tuple[int, ...], ...] = ((), (0,), (0, 1), (0, 0))
MOST_ZEROS = len(DIRECTIONS) - 1
ATTEMPTS = 1000
# A zero counts where the pencil's least singular value is that far below its size, and two zeros are one within this.
ZERO_TOLERANCE = 1e-8


@dataclass(frozen=True, eq=False)
class StudySystem:
    """The system is x+ = A x + B u + F v, y = C x + D u + G v + w.

    `zeros` (k,) are real and ascending, `Z` (n + p, n_v + k) is orthonormal and spans the fault space, and `attempts` draws were made.
    """

    model: StateSpaceModel
    F: Array
    G: Array
    zeros: Array
    Z: Array
    attempts: int

    @property
    def n_zeros(self) -> int:
        """Return the number of finite zeros; there are none at infinity."""
        return int(self.zeros.size)

    @property
    def minimum_phase(self) -> bool:
        """Say whether no zero lies outside the unit circle."""
        return bool(np.all(np.abs(self.zeros) <= 1))

    @property
    def distance_to_unit_circle(self) -> float:
        """Return the distance of the nearest zero to the unit circle; it is NaN without zeros."""
        return float(np.min(np.abs(np.abs(self.zeros) - 1))) if self.zeros.size else float("nan")

    @property
    def fault_columns(self) -> Array:
        """Return [F; G], (n + p, n_v)."""
        return np.vstack([self.F, self.G])


def study_system(n_zeros: int, seed: np.random.SeedSequence | int) -> StudySystem:
    """Return a system with exactly `n_zeros` finite zeros, 0 to 3, the same for the same seed. Raises InvalidData for other numbers."""
    if n_zeros not in range(MOST_ZEROS + 1):
        raise InvalidData(f"n_zeros: got {n_zeros}; systems with 0, 1, 2 or 3 finite zeros can be built")
    rng = np.random.default_rng(seed)
    for attempt in range(1, ATTEMPTS + 1):
        A = companion(draw_poles(rng))
        B, D = rng.standard_normal((N_X, N_U)), rng.standard_normal((P, N_U))
        C = np.hstack([np.linalg.qr(rng.standard_normal((P, P)))[0], np.zeros((P, N_X - P))])
        zeros = rng.standard_normal(len(DIRECTIONS[n_zeros]))
        F, G, W = with_zeros(A, C, zeros, DIRECTIONS[n_zeros], rng)
        if n_zeros > zeros.size:
            third, state = _third_zero(A, F, C, G, zeros)
            zeros, W = np.append(zeros, third), np.column_stack([W, state])
            F[:, 0], G[:, 0] = INTERSECTION_BASIS * F[:, 0], INTERSECTION_BASIS * G[:, 0]
        if _as_intended(A, F, C, G, np.sort(zeros)):
            model = StateSpaceModel(A, B, C, D)
            return StudySystem(model, F, G, np.sort(zeros), _fault_space(A, F, C, G, W), attempt)
    raise InvalidData(f"no system with exactly {counted(n_zeros, 'zero')} was found in {ATTEMPTS} attempts: try another seed")


def with_zeros(
    A: Array, C: Array, zeros: Sequence[float] | Array, directions: Sequence[int], rng: np.random.Generator, n_v: int = N_V
) -> tuple[Array, Array, Array]:
    """Return F (n, n_v), G (p, n_v) and W (n, k): zero i at zeros[i] with state W[:, i] and fault direction unit vector directions[i].

    F, G are normal on the space of all that do, which is that of the paper's generator [G25]. Raises InvalidData where there are none.
    """
    n, p = A.shape[0], C.shape[0]
    count, height = len(directions), (n + p) * n_v
    # Unknowns: the columns of [F; G] one below the other, then the states w.
    equations = np.zeros((count, n + p, height + n * count))
    for i, (z, column) in enumerate(zip(zeros, directions, strict=True)):
        equations[i, :, (n + p) * column : (n + p) * (column + 1)] = np.eye(n + p)
        equations[i, :, height + n * i : height + n * (i + 1)] = np.vstack([A - z * np.eye(n), C])
    solutions = null_space(equations.reshape(count * (n + p), -1)) if count else np.eye(height)
    if solutions.shape[1] == 0:
        raise InvalidData(
            f"{counted(count, 'zero')} {'is' if count == 1 else 'are'} too many for {counted(n, 'state')}, "
            f"{counted(p, 'output')} and {counted(n_v, 'fault')} in these directions: ask for fewer zeros"
        )
    # An orthonormal basis of the [F; G] alone. A normal draw of all entries is projected on their space, which makes a normal draw there
    # that is the same with every processor; coefficients in the basis would not be, for rounding decides which basis LAPACK finds.
    basis, sizes, right = np.linalg.svd(solutions[:height], full_matrices=False)
    kept = sizes > 1e-10 * sizes[0]
    draw = np.ascontiguousarray(basis[:, kept].T) @ rng.standard_normal(height)
    columns = (basis[:, kept] @ draw).reshape(n_v, n + p).T
    states = (solutions[height:] @ (right[kept].T @ (draw / sizes[kept]))).reshape(count, n).T
    return columns[:n], columns[n:], states


def pencil_zeros(A: Array, F: Array, C: Array, G: Array, rng: np.random.Generator | None = None) -> ComplexArray:
    """Return the finite zeros of P(q) = [[q I - A, -F], [C, G]] with p >= n_v, by modulus; a simple one counts once, multiple ones are
    merged.

    p - n_v random combinations of outputs are left out, which leaves a square pencil whose eigenvalues contain the zeros; those at which
    the whole pencil loses rank are the zeros. Two independent compressions must agree, so that no zero is lost to an unlucky one.
    """
    rng = np.random.default_rng(0) if rng is None else rng
    found = np.concatenate([_candidates(A, F, C, G, rng) for _ in range(2)])
    merged: list[complex] = []
    for z in found[_lose_rank(A, F, C, G, found)]:
        if all(abs(z - other) > 1e-5 * max(1.0, abs(z)) for other in merged):
            merged.append(z)
    return np.array(sorted(merged, key=lambda z: (abs(z), z.real, z.imag)), dtype=np.complex128)


def draw_poles(rng: np.random.Generator) -> ComplexArray:
    """Return five poles: real ones uniform in (-1, 1), pairs of uniform modulus and uniform angle, each with probability one half."""
    poles: list[complex] = []
    while len(poles) < N_X:
        radius, angle = rng.uniform(-1, 1), rng.uniform(-np.pi, np.pi)
        pole = radius * np.exp(1j * angle)
        pair = len(poles) < N_X - 1 and rng.random() < 0.5
        poles += [pole, np.conj(pole)] if pair else [complex(radius)]
    return np.array(poles)


def companion(poles: ComplexArray) -> Array:
    """Return the matrix with ones above the diagonal whose last row holds the characteristic polynomial of these poles."""
    A = np.eye(len(poles), k=1)
    A[-1] = -np.real(np.poly(poles))[:0:-1]
    return A


def _third_zero(A: Array, F: Array, C: Array, G: Array, zeros: Array) -> tuple[float, Array]:
    """Return the zero that follows from two planted in the first fault, from the trace, and its state."""
    f, g = F[:, 0], G[:, 0]
    third = -f[2] / f[1] + A[-1, -1] - zeros.sum()
    pencil = np.vstack([np.column_stack([A - third * np.eye(N_X), f]), np.column_stack([C, g])])
    return float(third), np.asarray(np.linalg.svd(pencil)[2][-1, :N_X])


def _as_intended(A: Array, F: Array, C: Array, G: Array, zeros: Array) -> bool:
    """Say whether the pencil has these zeros and no others, and G full column rank, so that none is at infinity."""
    if np.linalg.cond(G) > 1 / ZERO_TOLERANCE or (zeros.size > 1 and np.min(np.diff(zeros)) < 1e-3):
        return False
    found = pencil_zeros(A, F, C, G)
    if found.size != zeros.size:
        return False
    return bool(np.all(np.abs(found[np.argsort(found.real)] - zeros) < 1e-5 * np.maximum(1.0, np.abs(zeros))))


def _fault_space(A: Array, F: Array, C: Array, G: Array, W: Array) -> Array:
    """Return orthonormal basis of im [F; G] + [A; C] W + [W; 0], whose dimension is n_v + k: [A; C] w lies in the span of the others."""
    p, k = C.shape[0], W.shape[1]
    states = W / np.linalg.norm(W, axis=0)
    return np.asarray(np.linalg.qr(np.block([[F, states], [G, np.zeros((p, k))]]))[0])


def _candidates(A: Array, F: Array, C: Array, G: Array, rng: np.random.Generator) -> ComplexArray:
    n, n_v = F.shape
    mix = np.linalg.qr(rng.standard_normal((C.shape[0], C.shape[0])))[0][:n_v]
    constant = np.block([[A, F], [-mix @ C, -mix @ G]])
    linear = np.diag([1.0] * n + [0.0] * n_v)
    # LAPACK's own function: scipy.linalg.eigvals takes ten times as long as it for matrices as small as these.
    real, imaginary, denominator, *_, info = lapack.dggev(constant, linear, compute_vl=0, compute_vr=0)
    assert info == 0, info
    finite = denominator != 0
    return np.asarray((real[finite] + 1j * imaginary[finite]) / denominator[finite], dtype=np.complex128)


def _lose_rank(A: Array, F: Array, C: Array, G: Array, points: ComplexArray) -> NDArray[np.bool_]:
    """Say at which of the points (k,) the pencil's least singular value is nothing beside the largest."""
    constant, linear = np.block([[-A, -F], [C, G]]), np.eye(A.shape[0] + C.shape[0], A.shape[0] + F.shape[1])
    linear[A.shape[0] :] = 0
    values = np.linalg.svd(constant + points[:, None, None] * linear, compute_uv=False)
    return np.asarray(values[:, -1] <= ZERO_TOLERANCE * values[:, 0])
