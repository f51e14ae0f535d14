"""The bound of the fault space is tested against another parametrisation, against exact likelihoods, and on functions broken."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import scipy.optimize

from faultspace.base.arrays import Array
from faultspace.base.errors import InvalidData
from faultspace.numeric import FaultSpectra, SpaceUncertainty, StateSpaceModel, fault_space_bound
from faultspace.numeric.method.model.models import observability_matrix
from faultspace.numeric.method.model.weighted_reduction import circle
from faultspace.numeric.method.ranks.sample_windows import observed_coordinates
from faultspace.numeric.method.space.estimate import kernel_conditions, orthonormal
from faultspace.numeric.method.space.space_uncertainty import turned_by_model, turned_by_rows
from faultspace.numeric.study import space_information as room
from faultspace.numeric.study.driving_spectra import filtered, white

Bound = Callable[[StateSpaceModel, Array, Array, FaultSpectra, int], SpaceUncertainty]
Matrices = tuple[Array, ...]
Made = Callable[[Array], Matrices]  # A, B, C, D, F, G of free parameters


def free(n: int, p: int, n_v: int) -> tuple[Made, int]:
    """All matrices are free: no zeros."""
    shapes = [(n, n), (n, 1), (p, n), (p, 1), (n, n_v), (p, n_v)]
    cuts = np.cumsum([a * b for a, b in shapes])

    def made(x: Array) -> Matrices:
        return tuple(part.reshape(shape) for part, shape in zip(np.split(x, cuts[:-1]), shapes, strict=True))

    return made, int(cuts[-1])


def with_a_zero(n: int, p: int, n_v: int) -> tuple[Made, int]:
    """A zero at z in the first fault, with state w: (A - z) w + f = 0, C w + g = 0, so that w and z take the place of f and g."""
    inner, size = free(n, p, n_v - 1)

    def made(x: Array) -> Matrices:
        A, B, C, D, F, G = inner(x[:size])
        w, z = x[size : size + n], x[-1]
        return A, B, C, D, np.column_stack([z * w - A @ w, F]), np.column_stack([-C @ w, G])

    return made, size + n + 1


def space(matrices: Matrices, rows: int) -> Array:
    """Return the projector on the fault space: of the solutions of the left kernel of windows of `rows` samples."""
    A, _, C, _, F, G = matrices
    p = len(C)
    markov = [G, *(observability_matrix(A, C, rows - 1) @ F).reshape(-1, *G.shape)]
    toeplitz = np.block([[markov[i - j] if i >= j else np.zeros_like(G) for j in range(rows)] for i in range(rows)])
    window = np.hstack([observability_matrix(A, C, rows), toeplitz])
    left, values, _ = np.linalg.svd(window)
    kernel = left[:, int(np.sum(values > 1e-9 * values[0])) :].T
    conditions = kernel_conditions(kernel.reshape(len(kernel), rows, p), A, C).reshape(-1, len(A) + p)
    _, strengths, right = np.linalg.svd(conditions)
    return np.asarray(right[int(np.sum(strengths > 1e-9)) :].T)


def by_reparametrisation(made: Made, x: Array, spectra: FaultSpectra, N: int, angles: Array) -> Array:
    """Return the covariance of the basis's error by numerical derivatives: the Gaussian likelihood at each angle, the faults' spectrum and
    the level of the noise unknown there and taken out one angle after the other."""
    truth = made(x)
    n, (p, n_v) = len(truth[0]), truth[5].shape
    z = np.exp(1j * angles)[:, None, None]

    def at(x: Array) -> tuple[Any, Any]:
        A, B, C, D, F, G = made(x)
        resolvent = C @ np.linalg.inv(z * np.eye(n) - A)
        return resolvent @ B + D, resolvent @ F + G

    steps = 1e-6 * np.eye(len(x))
    H = at(x)[1]
    dG, dH = ((np.array([at(x + s)[i] for s in steps]) - np.array([at(x - s)[i] for s in steps])) / 2e-6 for i in (0, 1))
    faults, noise, driven = spectra.faults(angles), spectra.noise(angles), spectra.input(angles)
    units = [np.outer(a, b) for a in np.eye(n_v) for b in np.eye(n_v)]
    hermitian = [unit + unit.T for unit in units] + [1j * (unit - unit.T) for unit in units]
    information = np.zeros((len(x), len(x)))
    for m in range(len(angles)):
        S, R, h = faults[m], noise[m], H[m]
        inverse = np.linalg.inv(h @ S @ h.conj().T + R)
        changes = [d @ S @ h.conj().T + h @ S @ d.conj().T for d in dH[:, m]]
        changes += [h @ one @ h.conj().T for one in hermitian] + [R]
        whitened = np.array([(inverse @ change).ravel() for change in changes])
        turned = np.array([(inverse @ change).T.ravel() for change in changes])
        fisher = (whitened @ turned.T).real / 2
        q = len(x)
        fisher = fisher[:q, :q] - fisher[:q, q:] @ np.linalg.pinv(fisher[q:, q:], rcond=1e-10) @ fisher[q:, :q]
        responses = dG[:, m] * np.sqrt(driven[m, 0, 0].real)
        information += N / len(angles) * (fisher + np.einsum("iau,ab,jbu->ij", responses.conj(), inverse, responses).real)
    covariance = np.linalg.pinv(information, rcond=1e-9, hermitian=True)

    def aligned(x: Array) -> Array:
        matrices = made(x)
        to_true = np.linalg.lstsq(
            observability_matrix(truth[0], truth[2], 2 * n), observability_matrix(matrices[0], matrices[2], 2 * n), rcond=None
        )[0]
        Z = space(matrices, n + 1)
        Z = orthonormal(np.vstack([to_true @ Z[:n], Z[n:]]))
        return np.asarray(Z @ Z.T)

    Q = space(truth, n + 1)
    # dP = dQ Q' + Q dQ', and dQ Q' off the span is what is compared: it does not depend on which basis of the span was taken.
    off = np.eye(n + p) - Q @ Q.T
    moved = np.array([(off @ (aligned(x + s) - aligned(x - s)) @ Q @ Q.T / 2e-6).ravel() for s in steps])
    return np.asarray(moved.T @ covariance @ moved)


def stated(bound: SpaceUncertainty, Q: Array) -> Array:
    """Return the covariance of dQ Q' that a bound states for the basis Q, up to a rotation of that."""
    moved = (bound.root @ Q.T).reshape(len(bound.root), -1)
    return np.asarray(moved.T @ moved)


NOISE = np.array([[0.04, 0.01, 0.0], [0.01, 0.09, 0.0], [0.0, 0.0, 0.02]])
CASES = {
    "one row": (free, 2, 2, 1),
    "two rows of unequal degree": (free, 3, 3, 1),
    "a zero": (with_a_zero, 3, 3, 2),
    "a zero and two rows": (with_a_zero, 3, 3, 1),
    "no states": (free, 0, 2, 1),
}


def drawn(name: str) -> tuple[Made, Array, FaultSpectra]:
    family, n, p, n_v = CASES[name]
    made, size = family(n, p, n_v)
    rng = np.random.default_rng(3)
    x = rng.standard_normal(size)
    x[: n * n] *= 0.5 / max(np.max(np.abs(np.linalg.eigvals(x[: n * n].reshape(n, n))), initial=0.5), 0.5)
    faults = filtered([1.0], [1.0, -0.6], n_v)
    return made, x, FaultSpectra(filtered([1.0, 0.5], [1.0]), faults, lambda angles: filtered([1.0, 0.3], [1.0])(angles) * NOISE[:p, :p])


def agrees(bound: Bound, name: str) -> bool:
    made, x, spectra = drawn(name)
    A, B, C, D, F, G = made(x)
    slow = by_reparametrisation(made, x, spectra, 100, circle(128))
    root = bound(StateSpaceModel(A, B, C, D), F, G, spectra, 100).root
    # The basis of the bound is any orthonormal one: that of the true space is turned to it by what annihilates neither.
    fast = np.sort(np.linalg.eigvalsh(np.einsum("qaz,qbz->ab", root, root)))
    n_p = len(C) + len(A)
    slow = slow.reshape(n_p, n_p, n_p, n_p)
    return bool(np.allclose(fast, np.sort(np.linalg.eigvalsh(np.einsum("aibi->ab", slow))), rtol=1e-4, atol=1e-4 * fast[-1]))


@pytest.mark.parametrize("name", CASES)
def test_as_in_another_parametrisation(name: str) -> None:
    assert agrees(fault_space_bound, name)


def of_twice_the_samples(model: StateSpaceModel, F: Array, G: Array, spectra: FaultSpectra, N: int) -> SpaceUncertainty:
    return fault_space_bound(model, F, G, spectra, 2 * N)


def of_faults_without_colour(model: StateSpaceModel, F: Array, G: Array, spectra: FaultSpectra, N: int) -> SpaceUncertainty:
    return fault_space_bound(model, F, G, replace(spectra, faults=white(spectra.faults(np.array([1.0]))[0])), N)


def of_equal_noise(model: StateSpaceModel, F: Array, G: Array, spectra: FaultSpectra, N: int) -> SpaceUncertainty:
    return fault_space_bound(model, F, G, replace(spectra, noise=white(0.05 * np.eye(len(G)))), N)


@pytest.mark.parametrize("broken", [of_twice_the_samples, of_faults_without_colour, of_equal_noise])
def test_a_broken_bound_is_noticed(broken: Bound) -> None:
    assert not agrees(broken, "two rows of unequal degree")


def test_rows_and_model_are_tied(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = room._Tied._of_model
    monkeypatch.setattr(room._Tied, "_of_model", lambda self: 0 * whole(self))
    assert not agrees(fault_space_bound, "two rows of unequal degree")


def mean_squares(bound: SpaceUncertainty) -> float:
    return float(np.sum(bound.root**2))


def test_the_exact_likelihood_of_a_static_system_attains_it() -> None:
    """y = D u + G v + w: the likeliest G spans the large eigenvectors of what u leaves of y."""
    rng = np.random.default_rng(5)
    records, samples, G, deviation = 2000, 100, np.array([[1.0], [0.5], [-0.3]]), 0.1
    y = rng.standard_normal((records, samples, 1)) @ G.T + deviation * rng.standard_normal((records, samples, 3))
    u = rng.standard_normal((records, samples, 1))
    left = y - u @ (np.swapaxes(u, 1, 2) @ y) / np.sum(u * u, axis=1, keepdims=True)
    found = np.linalg.eigh(np.swapaxes(left, 1, 2) @ left)[1][:, :, -1]
    cosines = np.abs(found @ G[:, 0]) / np.linalg.norm(G)
    static = StateSpaceModel(np.zeros((0, 0)), np.zeros((0, 1)), np.zeros((3, 0)), np.ones((3, 1)))
    spectra = FaultSpectra(white([[1.0]]), white([[1.0]]), white(deviation**2 * np.eye(3)))
    errors = np.arccos(cosines) ** 2
    stated = mean_squares(fault_space_bound(static, np.zeros((0, 1)), G, spectra, samples - 1))
    assert abs(np.mean(errors) / stated - 1) < 4 * np.std(errors) / np.mean(errors) / np.sqrt(records)
    assert abs(np.mean(errors) / stated - 0.5) > 0.3 and abs(np.mean(errors) / stated - 2) > 0.3


@pytest.mark.slow
def test_an_exact_likelihood_of_a_dynamic_system_attains_it() -> None:
    """Periodic records of one state, so that frequencies are independent; disturbed by Q s + w, Q the unit vector along the fault transfer
    and s white, so that the size of the transfer tells nothing: the likelihood is a sum of squares."""
    rng = np.random.default_rng(8)
    truth = np.array([0.6, 1.0, 0.8, -0.5, 0.3, 0.0, 0.5, 1.0, 0.4])
    n, p, samples, power, noise, records = 1, 2, 256, 1.0, 1e-2, 150
    made, _ = free(n, p, 1)
    angles = 2 * np.pi * (np.arange(samples // 2) + 0.5) / samples
    z = np.exp(1j * angles)

    def transfers(x: Array) -> tuple[Any, Any]:
        A, B, C, D, F, G = made(x)
        half = C[:, 0] / (z[:, None] - A[0, 0])
        H = half * F[0, 0] + G[:, 0]
        return half * B[0, 0] + D[:, 0], H / np.linalg.norm(H, axis=1, keepdims=True)

    def normal(*shape: int) -> Any:
        return (rng.standard_normal(shape) + 1j * rng.standard_normal(shape)) / np.sqrt(2)

    G, Q = transfers(truth)
    A, B, C, D, F, fault_G = made(truth)
    size = np.linalg.norm(C[:, 0] / (z[:, None] - A[0, 0]) * F[0, 0] + fault_G[:, 0], axis=1)
    Z = orthonormal(space(made(truth), 2))
    errors = []
    for _ in range(records):
        u = normal(len(z), 1)
        y = G * u + Q * np.sqrt(power) * normal(len(z), 1) + np.sqrt(noise) * normal(len(z), p)

        def residuals(x: Array, y: Any = y, u: Any = u) -> Array:
            G, Q = transfers(x)
            e = y - G * u
            across = (Q[:, 0] * e[:, 1] - Q[:, 1] * e[:, 0]) / np.sqrt(noise)
            along = np.sum(Q.conj() * e, axis=1) / np.sqrt(power + noise)
            return np.concatenate([across.real, across.imag, along.real, along.imag])

        found = made(scipy.optimize.least_squares(residuals, truth, method="lm", max_nfev=2000).x)
        to_true = np.linalg.lstsq(observability_matrix(A, C, 2), observability_matrix(found[0], found[2], 2), rcond=None)[0]
        estimate = space(found, 2)
        estimate = orthonormal(np.vstack([to_true @ estimate[:n], estimate[n:]]))
        errors.append(np.sum((estimate - Z @ (Z.T @ estimate)) ** 2))

    def faults(at: Array) -> Any:
        return (power / np.interp(at, angles, size) ** 2)[:, None, None]

    spectra = FaultSpectra(white([[1.0]]), faults, white(noise * np.eye(p)))
    stated = mean_squares(fault_space_bound(StateSpaceModel(A, B, C, D), F, fault_G, spectra, samples))
    ratio, spread = np.mean(errors) / stated, np.std(errors) / stated / np.sqrt(records)
    assert abs(ratio - 1) < 4 * spread < 0.6


def test_neither_units_nor_bases_matter() -> None:
    made, x, spectra = drawn("a zero and two rows")
    A, B, C, D, F, G = made(x)
    plain = fault_space_bound(StateSpaceModel(A, B, C, D), F, G, spectra, 100)
    weaker = replace(spectra, faults=lambda at: spectra.faults(at) / 100)
    again = fault_space_bound(StateSpaceModel(A, B, C, D), 10 * F, 10 * G, weaker, 400)
    assert np.isclose(mean_squares(plain), 4 * mean_squares(again), rtol=1e-6)
    turn = np.linalg.qr(np.random.default_rng(0).standard_normal((3, 3)))[0]
    turned = fault_space_bound(StateSpaceModel(turn @ A @ turn.T, turn @ B, C @ turn.T, D), turn @ F, G, spectra, 100)
    assert np.isclose(mean_squares(plain), mean_squares(turned), rtol=1e-6)
    units = np.array([1e-4, 1.0, 1e5])[:, None]
    other = replace(spectra, noise=lambda at: spectra.noise(at) * units * units.T)
    small = fault_space_bound(StateSpaceModel(A, B, units * C, units * D), F, units * G, other, 100)
    assert small.angle() != plain.angle()  # an angle between columns of [f; g] has units
    assert np.all(np.isfinite(small.root))


def test_louder_faults_help_and_noise_never_does() -> None:
    made, x, spectra = drawn("a zero")
    A, B, C, D, F, G = made(x)
    model = StateSpaceModel(A, B, C, D)
    noisy = fault_space_bound(model, F, G, replace(spectra, noise=lambda at: 4 * spectra.noise(at)), 100)
    quiet = fault_space_bound(model, F, G, spectra, 100)
    assert mean_squares(noisy) > mean_squares(quiet)
    unknown_model = fault_space_bound(model, F, G, replace(spectra, input=lambda at: spectra.input(at) / 100), 100)
    assert mean_squares(unknown_model) > mean_squares(quiet)


def test_kernel_rows_have_least_degrees() -> None:
    made, x, _ = drawn("two rows of unequal degree")
    A, _, C, _, F, G = made(x)
    assert [len(row) - 1 for row in room.kernel_rows(A, F, C, G)] == [1, 2]
    # The second output is not reached by the fault, and shows its own state alone: a row of degree one of that output.
    A, C = np.diag([0.5, -0.3, 0.8]), np.array([[1.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, -1.0, 0.0]])
    rows = room.kernel_rows(A, np.array([[1.0], [2.0], [0.0]]), C, np.array([[0.3], [0.0], [0.7]]))
    assert [len(row) - 1 for row in rows] == [1, 2] and np.allclose(rows[0][:, [0, 2]], 0)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"A": 1.1 * np.eye(3)}, "not stable"),
        ({"G": np.zeros((2, 2))}, "shapes"),
        ({"F": np.zeros((3, 3)), "G": np.eye(3)}, "no kernel row"),
        ({"F": np.ones((3, 2)), "G": np.ones((3, 2))}, "dependent"),
        ({"spectra": FaultSpectra(white(np.eye(2)), white(np.eye(2)), white(np.eye(3)))}, "spectrum of the input"),
        ({"spectra": FaultSpectra(white([[1.0]]), white(np.eye(3)), white(np.eye(3)))}, "spectrum of the faults"),
        ({"spectra": FaultSpectra(white([[1.0]]), white(np.eye(2)), white(np.eye(2)))}, "spectrum of the noise"),
        ({"spectra": FaultSpectra(white([[1.0]]), white(np.eye(2)), white(np.zeros((3, 3))))}, "no power"),
    ],
)
def test_what_has_no_bound_is_refused(change: dict[str, Any], says: str) -> None:
    made, x, spectra = drawn("a zero")
    A, B, C, D, F, G = made(x)
    asked: dict[str, Any] = {"A": A, "F": F, "G": G, "spectra": spectra} | change
    with pytest.raises(InvalidData, match=says):
        fault_space_bound(StateSpaceModel(asked["A"], B, C, D), asked["F"], asked["G"], asked["spectra"], 100)


def test_a_change_of_the_model_turns_the_space_as_numerical_derivatives_say() -> None:
    """Of the rows, A and C, which need not fit each other, in coordinates that are not the observed ones."""
    rng = np.random.default_rng(4)
    n, p = 3, 2
    A, C, row = 0.4 * rng.standard_normal((n, n)), rng.standard_normal((p, n)), rng.standard_normal((n, p))
    coordinates = observed_coordinates(rng.standard_normal((50, p)) * [1.0, 30.0], A, C, n + 1)

    def basis(model: Array, row: Array) -> Array:
        """Return a basis in the states of A, for rows of y, the states mapped to those of A."""
        conditions = kernel_conditions(row[None], model[:n], model[n:])[0]
        columns = np.linalg.svd(conditions)[2][len(conditions) :].T
        true, other = (observability_matrix(a[:n], a[n:], 2 * n) for a in (np.vstack([A, C]), model))
        return orthonormal(np.vstack([np.linalg.lstsq(true, other, rcond=None)[0] @ columns[:n], columns[n:]]))

    start = np.vstack([A, C])
    Q = basis(start, row)
    inner = [row * coordinates.scale]
    conditions = kernel_conditions(inner[0][None], coordinates.A, coordinates.C)[0]
    columns = np.linalg.svd(conditions)[2][len(conditions) :].T
    # An orthonormal basis of the same span may be turned: compare dQ Q', which is not.
    answered = orthonormal(coordinates.back(columns))

    def slow(of_model: Array, of_row: Array) -> Array:
        there, back = (basis(start + step * of_model, row + step * of_row) for step in (1e-6, -1e-6))
        return np.asarray((np.eye(n + p) - Q @ Q.T) @ (there @ there.T - back @ back.T) @ Q @ Q.T / 2e-6)

    of_rows = turned_by_rows(inner, coordinates, columns)
    for k, unit in enumerate(np.eye(row.size)):
        change = unit.reshape(row.shape) / coordinates.scale
        assert np.allclose(of_rows[k] @ answered.T, slow(0 * start, change), atol=1e-6)
    of_model = turned_by_model(inner, coordinates, columns)
    T, scale = coordinates.T, coordinates.scale[:, None]
    for k, unit in enumerate(np.eye(start.size)):
        change = unit.reshape(start.shape)
        given = np.vstack([np.linalg.inv(T) @ change[:n] @ T, scale * change[n:] @ T])
        assert np.allclose(of_model[k] @ answered.T, slow(given, 0 * row), atol=1e-5)
