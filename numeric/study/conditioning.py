"""This bounds how far rounding can carry an identified model from the one that exact arithmetic makes of the same data: to first order,
from norms that the floats themselves show.

Backward error. The factor L of H = [Uf; Up; Yf] is that of H + E. By QR each row of E is at most r (5 m + 35) u times its row of H for
r reflections of length m, u = 2^-53: counted from the analysis of one reflection in [H02, section 19.3]. By the Gram, G = H H' is wrong
by g |h_i| |h_j|, g about (columns + 4 lags) u times the cancellation of the end terms, and E = dG L^-T / 2 on the inputs: one condition
number more. Both are worst cases; errors that average out stay far below. `measured` takes an E found otherwise.

Amplification, in scaled channels and the orthonormal basis U of the range, where a change D of U is orthogonal to it:

    range     |D| <= |E_y - T E_f| / sigma_n(L32) where Yf = O X + T Uf without noise: Uf is projected out of itself, however smooth;
              |D| <= (|E_y| + sqrt 2 |[L31 L33]| |L_u^-1 E_u|) / (sigma_n - sigma_(n+1)) with noise     [W72]
    A         U+^+ (D- - D+ A), plus |U+^+|^2 |D| times what the shift leaves over, U+ and U- the rows but the last and first p
    B, D      |M^+| |dz - dM theta| + |M^+|^2 |dM| |rest| for either regression M theta = z     [GVL13, section 5.3]
    poles     |dA| times the eigenvalue's condition 1 / |y' x|; coefficients of det(zI - A): -tr(adj(zI - A) dA)     [GVL13, section 7.2]

Smaller steps (SVD, products, small least squares) count SMALL times their dimension units. First order means that a bound is to be
believed where `range` and the changes it leads to are small beside one.

BackwardError           |E| on future inputs and outputs, |L_u^-1 E_u|; `by_qr`, `by_gram`, `measured`
reflections_error, gram_error      the worst cases themselves
Setting, setting        the compression in scaled channels with U and the model in its basis
noise_free_range        the bound on |D| without noise; tests/numeric/rounding_bounds.py has that with noise
ModelError              bounds on A, B, C, D with `poles`, `characteristic_polynomial`, `markov`, `transfer`
moesp_error, output_error_error    ModelError by the two regressions for B and D
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...base.arrays import Array
from ..method.model.compression import EPS, Compression
from ..method.model.models import BLOCK, StateSpaceModel, lower_toeplitz, observability_matrix
from ..method.model.moesp_model import MoespModel
from ..method.model.past_inputs import output_scale

UNIT = EPS / 2
SMALL = 10.0


def reflections_error(width: int, rows: int) -> float:
    """Return the relative columnwise backward error of a sequential QR of `rows` rows, width columns, blocks of at least width / 2 rows."""
    blocks = -(-2 * rows // width)
    return width * (5.0 * rows + 35.0 * blocks) * UNIT


@dataclass(frozen=True)
class BackwardError:
    """Frobenius norms of E in scaled channels: `future` on Uf, `outputs` on Yf, and `turn` = |L_u^-1 E_u| for L_u of [Uf; Up]."""

    future: float
    outputs: float
    turn: float


@dataclass(frozen=True, eq=False)
class Setting:
    """The setting is the compression in channels of unit size, with L32 = U S V' there, and the model in the basis U.

    `lower` is L by rows Uf, Up, Yf; the scales are (n_u,) and (p,); U is (s p, n), and `values` are all singular values of L32.
    """

    compression: Compression
    input_scale: Array
    scale: Array
    lower: Array
    U: Array
    values: Array
    model: StateSpaceModel

    @property
    def n(self) -> int:
        """Return the order of the model."""
        return self.model.n

    def part(self, rows: str, columns: str) -> Array:
        """Return a block of L by the letters f, p, y of its rows and columns."""
        s, q = self.compression.block_rows * self.compression.n_u, self.compression.inputs
        spans = {"f": slice(0, s), "p": slice(s, q), "y": slice(q, None), "u": slice(0, q)}
        return self.lower[spans[rows], spans[columns]]


def _norm(matrix: Any) -> float:
    return float(np.linalg.norm(matrix, 2)) if matrix.size else 0.0


def frobenius(matrix: Any) -> float:
    """Return the Frobenius norm."""
    return float(np.linalg.norm(matrix))


def _least(matrix: Array) -> float:
    """Return the least singular value of a matrix with at least as many rows as columns, else of its transpose."""
    return float(np.linalg.svd(matrix, compute_uv=False)[-1])


def setting(compression: Compression, found: MoespModel) -> Setting:
    """Return the setting of a model found from this compression by `pi_moesp` or `pi_moesp_from_compression`."""
    s, q, p, n_u = compression.block_rows, compression.past_rows, compression.p, compression.n_u
    parts = compression.blocks()
    scale = output_scale(np.hstack([parts.l31, parts.l32, parts.l33]), p, compression.columns)
    input_scale = output_scale(parts.l11, n_u, compression.columns)
    units = np.concatenate([np.tile(input_scale, s + q), np.tile(scale, s)])
    lower = compression.factor.T / units[:, np.newaxis]
    inputs = compression.inputs
    left, values, _ = np.linalg.svd(lower[inputs:, s * n_u : inputs], full_matrices=False)
    # The model's basis is U sqrt(values / sqrt(columns)), up to signs that norms do not see.
    roots = np.sqrt(found.singular_values[: found.order])[:, np.newaxis]
    model = StateSpaceModel(
        found.A * roots / roots.T,
        found.B * roots * input_scale,
        found.C / scale[:, np.newaxis] / roots.T,
        found.D / scale[:, np.newaxis] * input_scale,
    )
    return Setting(compression, input_scale, scale, lower, left[:, : found.order], values, model)


def measured(where: Setting, relative: float) -> BackwardError:
    """Return E with every row at most `relative` times its row of H."""
    inputs = where.part("u", "u")
    turn = relative * frobenius(inputs) / _least(inputs)
    return BackwardError(relative * frobenius(where.part("f", "f")), relative * frobenius(where.lower[len(inputs) :]), turn)


def by_qr(where: Setting) -> BackwardError:
    """Bound the worst case of the sequential QR, the data themselves correctly rounded from exact ones included."""
    return measured(where, reflections_error(len(where.lower), where.compression.columns) + UNIT)


def gram_error(where: Setting) -> float:
    """Return g with |dG_ij| <= g |h_i| |h_j|: sums of `columns` products, end terms added, one factorisation and one solve."""
    compression = where.compression
    lags = compression.past_rows + compression.block_rows
    cancellation = max(1.0, compression.rounding / (EPS * compression.condition**2))
    return ((compression.columns + 4 * lags) * cancellation + 3 * compression.inputs) * UNIT


def by_gram(where: Setting) -> BackwardError:
    """Bound the worst case of the Gram by displacement with its input block factored, rounding of the data included."""
    inputs, outputs, unit = where.part("u", "u"), where.part("y", "u"), gram_error(where)
    least, size, response = _least(inputs), frobenius(inputs), frobenius(where.lower[len(inputs) :])
    future = 0.5 * unit * size * size / least
    gain = _norm(np.linalg.solve(inputs.T, outputs.T))
    rounded = measured(where, UNIT)
    return BackwardError(
        future + rounded.future,
        (unit * response * size + gain * 0.5 * unit * size**2) / least + rounded.outputs,
        0.5 * unit * (size / least) ** 2 + rounded.turn,
    )


def noise_free_range(where: Setting, backward: BackwardError) -> float:
    """Return the bound on |D| where the data are those of a model of the order taken, without noise and fault."""
    toeplitz = _toeplitz_norm(where.model, where.compression.block_rows)
    rounding = SMALL * len(where.U) * EPS * where.values[0]
    return float((backward.outputs + toeplitz * backward.future + rounding) / where.values[where.n - 1])


def _toeplitz_norm(model: StateSpaceModel, s: int) -> float:
    """Return |T_s(B, D)| by its block columns' Frobenius norms."""
    return float(np.sqrt(sum(frobenius(model.markov(k)) ** 2 for k in range(1, s + 1))))


@dataclass(frozen=True, eq=False)
class ModelError:
    """Bounds on |dA|, |dB|, |dC| and |dD| of `model`, all in scaled channels and the basis U; `range` is the bound on |D|."""

    model: StateSpaceModel
    input_scale: Array
    scale: Array
    range: float
    A: float
    B: float
    C: float
    D: float

    @property
    def poles(self) -> Array:
        """Return a bound for each pole, in the order of numpy.linalg.eigvals(model.A): infinite for a multiple one."""
        values, right = np.linalg.eig(self.model.A)
        with np.errstate(divide="ignore", invalid="ignore"):
            # Rows of the inverse are left eigenvectors with y' x = 1.
            try:
                left = np.linalg.inv(right)
            except np.linalg.LinAlgError:
                return np.full(len(values), np.inf)
            conditions = np.linalg.norm(left, axis=1) * np.linalg.norm(right, axis=0)
        return np.asarray(conditions * (self.A + SMALL * len(values) * EPS * frobenius(self.model.A)))

    @property
    def characteristic_polynomial(self) -> Array:
        """Return a bound for each coefficient of z^(n-1), ..., z, 1 in det(zI - A)."""
        A, n = self.model.A, self.model.n
        bounds, adjugate = np.empty(n), np.eye(n)
        for k in range(n):  # Faddeev and Leverrier: adj(zI - A) = sum of adjugate_k z^(n-1-k)
            bounds[k] = float(np.sum(np.linalg.svd(adjugate, compute_uv=False))) * self.A
            product = A @ adjugate
            adjugate = product - np.trace(product) / (k + 1) * np.eye(n)
        return bounds

    def markov(self, count: int) -> Array:
        """Return a bound for every entry of the Markov parameters D, CB, ..., (count, p, n_u), in the data's own units.

        It is of every order in |dA|, |dB|, |dC|: the first one vanishes for high powers of a nilpotent A.
        """
        A, B, C = self.model.A, self.model.B, self.model.C
        bounds = np.full(count, self.D)
        power = np.eye(self.model.n)
        before, rest = list[float](), list[float]()  # |(C + dC) A^k|, |(A + dA)^k (B + dB)| at most
        powers = list[float]()  # |A^k|
        for k in range(count - 1):
            powers.append(_norm(power))
            row, column = _norm(C @ power), _norm(power @ B)
            before.append(row + self.C * powers[k])
            rest.append(column + self.B * powers[k] + self.A * sum(powers[j] * rest[k - 1 - j] for j in range(k)))
            bounds[k + 1] = self.C * column + before[k] * self.B + self.A * sum(before[j] * rest[k - 1 - j] for j in range(k))
            power = A @ power
        units = self.scale[:, np.newaxis] / self.input_scale
        return np.asarray(bounds[:, np.newaxis, np.newaxis] * units)

    def transfer(self, z: complex) -> Array:
        """Return a bound for every entry of D + C (zI - A)^-1 B, (p, n_u), in the data's own units."""
        resolvent = np.linalg.inv(z * np.eye(self.model.n) - self.model.A)
        before, after = float(np.linalg.norm(self.model.C @ resolvent, 2)), float(np.linalg.norm(resolvent @ self.model.B, 2))
        bound = self.D + self.C * after + before * self.A * after + before * self.B
        return np.asarray(bound * self.scale[:, np.newaxis] / self.input_scale)


def _shift_error(where: Setting, moved: float) -> float:
    """Return |dA| for |D| = moved and the rounding of the small least squares."""
    p = len(where.scale)
    upper, lower = where.U[:-p], where.U[p:]
    amplified = 1.0 / _least(upper)
    A = np.linalg.lstsq(upper, lower, rcond=None)[0]
    rest = _norm(lower - upper @ A)
    moved += SMALL * len(where.U) * EPS
    return float(amplified * np.hypot(1.0, _norm(A)) * moved + amplified**2 * rest * moved)


def _powers(model: StateSpaceModel, count: int) -> tuple[Array, Array]:
    """Return |A^k| and |C A^k| for k = 0 .. count - 1."""
    states, outputs, power = np.empty(count), np.empty(count), np.eye(model.n)
    for k in range(count):
        states[k], outputs[k] = _norm(power), _norm(model.C @ power)
        power = power @ model.A
    return states, outputs


def _observability_error(model: StateSpaceModel, s: int, dA: float, dC: float) -> float:
    """Return |dO_s|: block k moves by dC A^k + sum_j C A^j dA A^(k-1-j)."""
    states, outputs = _powers(model, s)
    blocks = [dC * states[k] + dA * float(np.dot(outputs[:k], states[:k][::-1])) for k in range(s)]
    return frobenius(np.array(blocks))


def moesp_error(where: Setting, backward: BackwardError, moved: float) -> ModelError:
    """Bound the errors of the model whose B and D come from MOESP's regression (`pi_moesp_from_compression`).

    `moved` bounds |D|, as `noise_free_range` does.
    """
    model, compression = where.model, where.compression
    s, n = compression.block_rows, model.n
    dA, dC = _shift_error(where, moved), moved
    # Products of n by n matrices are those of an A wrong by n units.
    dO = _observability_error(model, s, dA + n * UNIT * frobenius(model.A), dC + n * UNIT * frobenius(model.C))
    # This regression weighs outputs in their own units; with weights of one at the most, bounds on scaled outputs stand.
    weights = where.scale / where.scale.max()
    heavy = np.tile(weights, s)[:, np.newaxis]
    seen_states = heavy * observability_matrix(model.A, model.C, s)
    D = weights[:, np.newaxis] * model.D
    left, sizes, _ = np.linalg.svd(seen_states, full_matrices=True)
    kernel = left[:, n:]
    future = where.part("f", "f")
    response = heavy * np.linalg.solve(future.T, where.part("y", "f").T).T
    turned = dO / float(sizes[n - 1]) + SMALL * len(seen_states) * EPS
    small = SMALL * len(seen_states) * EPS
    columns, n_u, p = n + len(where.scale), compression.n_u, compression.p
    regressor = np.zeros((s, len(kernel.T), columns))
    for k in range(s):
        regressor[k, :, :p] = kernel[k * p : (k + 1) * p].T
        regressor[k, :, p:] = kernel[(k + 1) * p :].T @ seen_states[: (s - 1 - k) * p]
    M = regressor.reshape(-1, columns)
    # Column scaling inside the least squares changes nothing in exact arithmetic.
    least = _least(M)
    theta = np.vstack([D, model.B])
    through = M @ theta
    rest = (kernel.T @ response).reshape(len(kernel.T), s, n_u).transpose(1, 0, 2).reshape(-1, n_u) - through
    toeplitz = lower_toeplitz(np.vstack([D, seen_states[: (s - 1) * p] @ model.B]).reshape(s, p, n_u))
    smallest = _least(future)
    hidden = heavy * np.hstack([where.part("y", "p"), where.part("y", "y")])
    seen = kernel.T @ hidden
    turned_solve = SMALL * len(future) * EPS * frobenius(future)  # the triangular solve's own backward error
    dZ = (backward.outputs + _norm(response) * (backward.future + turned_solve)) / smallest
    dZ += _norm(seen) * backward.future / smallest**2
    dT = float(np.sqrt(s)) * dO * frobenius(model.B)
    wrong = turned * frobenius(response - toeplitz) + dZ + dT + small * (frobenius(response) + frobenius(M) * frobenius(theta))
    dM = float(np.sqrt(s)) * (turned * np.hypot(1.0, _norm(seen_states)) + dO) + small * frobenius(M)
    d_theta = wrong / least + dM * frobenius(rest) / least**2
    return ModelError(model, where.input_scale, where.scale, moved, dA, d_theta, dC, d_theta / float(weights.min()))


def output_error_error(where: Setting, moved: float, experiments: Sequence[tuple[Array, Array]], *, relative: float = UNIT) -> ModelError:
    """Bound the errors of the model whose B and D come from output error (`pi_moesp`, or `pi_moesp_experiments` with these y (N, p), u (N,
    n_u)).

    `relative` is by how much each sample may be wrong in relation to itself. The regressor is built here in full: for records of some
    thousand samples.
    """
    model, n = where.model, where.model.n
    n_u, p = where.compression.n_u, where.compression.p
    dA, dC = _shift_error(where, moved), moved
    parameters = n * n_u + p * n_u
    count = max(len(y) for y, _ in experiments)
    outputs = _powers(model, count)[1]
    gain = float(outputs.sum())  # of x(k+1) = A x(k) + d(k) to C x
    # One sum of BLOCK samples' products at the most.
    step = (BLOCK * (n_u + n) + n) * UNIT
    dA_used, dC_used = dA + step * frobenius(model.A), dC + step * frobenius(model.C)
    regressors, rests, moves = [], [], []
    wrong = 0.0
    for number, (y, u) in enumerate(experiments):
        scaled_u, scaled_y = u / where.input_scale, y / where.scale
        own, state_size = regressor_of(model, scaled_u)
        whole = np.zeros((own.shape[0], len(experiments) * n + parameters))
        whole[:, number * n : (number + 1) * n] = own[:, :n]
        whole[:, len(experiments) * n :] = own[:, n:]
        solution = np.linalg.lstsq(own, scaled_y.ravel(), rcond=None)[0]
        regressors.append(whole)
        rests.append(scaled_y.ravel())
        trajectory = state_norm(model, scaled_u, solution[:n])
        vectors = (1 + n_u) * n * n + BLOCK * (n_u + p)
        # Two factorisations one after the other, the first of what one linear map turns into rows.
        rounding = reflections_error(parameters + n + 1, own.shape[0]) + reflections_error(vectors, -(-len(y) // 4))
        sized = rounding * (gain * (state_size + frobenius(scaled_u) * np.sqrt(n)) + frobenius(own))
        rounded = relative + step
        wrong += (dC_used + gain * dA_used) * trajectory
        wrong += rounded * (gain * frobenius(model.B) + frobenius(model.D)) * frobenius(scaled_u) + rounded * frobenius(scaled_y)
        wrong += sized * float(np.linalg.norm(np.append(solution, 1.0)))
        moves.append((dC_used + gain * dA_used) * state_size + sized + relative * np.sqrt(n + 1.0) * (gain + 1) * frobenius(scaled_u))
    Phi, z = np.vstack(regressors), np.concatenate(rests)
    lengths = np.linalg.norm(Phi, axis=0)
    lengths[lengths == 0] = 1.0
    theta = np.linalg.lstsq(Phi / lengths, z, rcond=None)[0]
    rest = float(np.linalg.norm(z - Phi / lengths @ theta))
    least = _least(Phi / lengths)
    shared = lengths[len(experiments) * n :]
    moved_regressor = float(np.linalg.norm(moves)) / float(lengths.min())
    d_phi = wrong / least + moved_regressor * rest / least**2
    dB = d_phi / float(shared[: n * n_u].min(initial=np.inf)) if n else 0.0
    return ModelError(model, where.input_scale, where.scale, moved, dA, dB, dC, d_phi / float(shared[n * n_u :].min()))


def regressor_of(model: StateSpaceModel, u: Array) -> tuple[Array, float]:
    """Return Phi (N p, n + n n_u + p n_u) with y = Phi [x0, B by columns, D by rows], and the Frobenius norm of the states behind it."""
    n, p, n_u, N = model.n, model.p, u.shape[1], len(u)
    Phi, energy = np.zeros((N, p, n + n * n_u + p * n_u)), 0.0
    state = np.zeros((n, n + n * n_u))
    state[:, :n] = np.eye(n)
    for k in range(N):
        Phi[k, :, : n + n * n_u] = model.C @ state
        energy += float(np.sum(state**2))
        state = model.A @ state
        for channel in range(n_u):
            first = n + channel * n
            state[:, first : first + n] += u[k, channel] * np.eye(n)
        for output in range(p):
            first = n + n * n_u + output * n_u
            Phi[k, output, first : first + n_u] = u[k]
    return Phi.reshape(N * p, -1), float(np.sqrt(energy))


def state_norm(model: StateSpaceModel, u: Any, x0: Any) -> float:
    """Return the Frobenius norm of the states x(0), ..., x(N - 1)."""
    states = StateSpaceModel(model.A, model.B, np.eye(model.n), np.zeros((model.n, u.shape[1]))).simulate(u, x0)
    return frobenius(states)
