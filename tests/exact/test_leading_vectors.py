"""The leading left singular vectors of a limit are compared with numpy's; boundary cases are done by hand, and the limit's own sentence.

The formula for the systems of two states of which an input hides one, against the limit itself; Levinson's recursion by numpy.
"""

from __future__ import annotations

from fractions import Fraction
from random import Random

import numpy as np
import pytest

from faultspace.exact.algebra.matrices import Matrix, column_basis, left_null_space, rank
from faultspace.exact.limits.experiments import Experiment, read_experiment
from faultspace.exact.limits.hidden_states import hides_a_state, reflections
from faultspace.exact.limits.leading_vectors import leading_vectors_span
from faultspace.exact.limits.moesp import limit
from faultspace.exact.limits.moments import covariances
from faultspace.proofs.evidence.experiments import examine_experiment
from faultspace.proofs.evidence.refuting_experiments import WITHOUT_RANK, kept


def floats(matrix: Matrix) -> np.ndarray:
    """The entries are rounded to doubles."""
    return np.array([[float(x.p) / float(x.q) for x in row] for row in matrix.elements()])


def by_numpy(L: Matrix, Gamma: Matrix, observability: Matrix) -> bool:
    """The result is the same from singular values in floats, with a Cholesky factor as the root of Gamma."""
    left, sizes, _ = np.linalg.svd(floats(L) @ np.linalg.inv(np.linalg.cholesky(floats(Gamma))).T)
    n = rank(observability)
    wanted = np.linalg.qr(floats(column_basis(observability)))[0]
    gap = sizes[n - 1] > (1 + 1e-9) * (sizes[n] if n < len(sizes) else 0) and sizes[n - 1] > 1e-9
    return bool(gap and np.linalg.norm(wanted - left[:, :n] @ (left[:, :n].T @ wanted)) < 1e-9)


def integers(random: Random, nrows: int, ncols: int) -> Matrix:
    """These are small entries."""
    return Matrix.of([[random.randint(-3, 3) for _ in range(ncols)] for _ in range(nrows)], shape=(nrows, ncols))


@pytest.mark.parametrize("seed", range(60))
def test_as_numpy_has_it(seed: int) -> None:
    """L = inside a + outside b with a and b orthogonal under Gamma^-1 in two cases of three: then it is their sizes that decide."""
    random = Random(seed)
    n, rows, columns = random.randint(1, 2), random.randint(3, 5), random.randint(4, 6)
    observability = integers(random, rows, n)
    while rank(observability) < n:
        observability = integers(random, rows, n)
    root = integers(random, columns, columns)
    Gamma = root @ root.transposed() + Matrix.identity(root.field, columns)
    outside = left_null_space(observability).transposed()
    a = integers(random, n, columns)
    b = integers(random, outside.ncols, columns) if seed % 3 == 0 else _orthogonal(random, a, Gamma, outside.ncols)
    for factor in ("1/50", "1", "50"):
        L = observability @ a + _scaled(outside, factor) @ b
        assert leading_vectors_span(L, Gamma, observability) == by_numpy(L, Gamma, observability)


def _orthogonal(random: Random, a: Matrix, Gamma: Matrix, count: int) -> Matrix:
    """The result is the rows b with b Gamma^-1 a' = 0."""
    inverse = Matrix(Gamma.field, Gamma.nrows, Gamma.nrows, Gamma.flint.inv())
    across = left_null_space(inverse @ a.transposed())
    return integers(random, count, across.nrows) @ across


def _scaled(matrix: Matrix, factor: str) -> Matrix:
    return matrix @ Matrix.of([[factor if i == j else "0" for j in range(matrix.ncols)] for i in range(matrix.ncols)])


def test_both_answers_come_up() -> None:
    seen = set()
    for seed in range(60):
        random = Random(seed)
        observability, a = Matrix.of([[1], [0]]), Matrix.of([[random.randint(1, 3), 0]])
        L = observability @ a + Matrix.of([[0], [1]]) @ Matrix.of([[0, random.randint(1, 3)]])
        seen.add(leading_vectors_span(L, Matrix.identity(a.field, 2), observability))
    assert seen == {True, False}


def test_a_tie_a_missing_direction_and_irrational_values() -> None:
    one, two = Matrix.of([[1], [0]]), Matrix.identity(Matrix.of([[1]]).field, 2)
    assert not leading_vectors_span(two, two, one)  # a tie: the leading vector is not determined
    assert not leading_vectors_span(Matrix.of([[0, 0], [0, 0]]), two, one)
    assert leading_vectors_span(Matrix.of([[1, 0], [0, 0]]), two, one)
    golden = Matrix.of([[1, 1, 0], [1, 0, 0], [0, 0, 1]])  # singular values 1.618, .618 inside, 1 outside
    three = Matrix.identity(golden.field, 3)
    inside = three.columns([0, 1])
    assert not leading_vectors_span(golden, three, inside)
    assert leading_vectors_span(Matrix.of([[1, 1, 0], [1, 0, 0], [0, 0, "3/5"]]), three, inside)
    twice = Matrix.of([[1, 0, 1], [0, "1/2", 0]])  # an instrument that is a copy of another
    assert leading_vectors_span(twice, Matrix.of([[1, 0, 1], [0, 1, 0], [1, 0, 1]]), Matrix.of([[1], [0]]))


@pytest.mark.parametrize("name", ["following-fault", "following-fault-two-states"])
def test_a_fault_that_follows_the_input_and_biases_nothing(name: str) -> None:
    """One more rank than states, and yet A, C, and B, D by output error are right; with the outputs scaled apart they need not be."""
    found = limit(kept(name))
    ranks, n = found.past_inputs, found.experiment.system.residual.n
    assert ranks.rank == n + 1 and ranks.contains_observability_range and found.leading_vectors_right(ranks)
    assert found.true_AC is not None and found.bias(found.true_AC).B.is_zero() and found.bias(found.true_AC).D.is_zero()
    true = sorted(np.linalg.eigvals(floats(found.experiment.system.residual.A)).real)
    p = found.experiment.system.residual.p
    assert np.allclose(_poles(floats(ranks.matrix), p, n), true, atol=1e-9)
    scales = np.diag([1.0 if row % p == 0 else 3.0 for row in range(ranks.matrix.nrows)])
    assert np.allclose(_poles(scales @ floats(ranks.matrix), p, n), true, atol=1e-9) == (p == 1)  # the weights of the outputs decide


def _poles(L: np.ndarray, p: int, n: int) -> list[float]:
    """From the n leading left singular vectors; u is white, so that Gamma is the identity."""
    leading = np.linalg.svd(L)[0][:, :n]
    return sorted(np.linalg.eigvals(np.linalg.lstsq(leading[:-p], leading[p:], rcond=None)[0]).real)


@pytest.mark.parametrize("name", WITHOUT_RANK)
def test_a_rank_is_lost_though_the_fault_is_uncorrelated(name: str) -> None:
    d = examine_experiment("kept", kept(name))
    assert d.whole_range_expected and d.within and d.inputs_right and not d.equal
    assert d.limit_rank == 1 and d.experiment.system.residual.n == 2


def test_observable_on_s_samples_and_not_on_one_less() -> None:
    found = limit(kept("observable-late"))
    assert found.past_inputs.equals_observability_range and found.past_inputs.state is None


def experiment(A: list[list[str]], num: list[str], den: list[str], s: int = 2) -> Experiment:
    """The experiment has B = e1, C = I and a fault of its own noise."""
    given = {"A": A, "B": [["1"], ["0"]], "C": [["1", "0"], ["0", "1"]], "D": [["0"], ["0"]], "F": [["1"], ["0"]], "G": [["0"], ["0"]]}
    u = {"num": [[[x, "0"]] for x in num], "den": den}
    return read_experiment(given | {"s": s, "past": 2, "u_filter": u, "v_filter": [[["0", "1"]]]})


def companion(a: Fraction, b: Fraction) -> list[list[str]]:
    """The companion matrix has the poles a and b."""
    return [[str(a + b), str(-a * b)], ["1", "0"]]


@pytest.mark.parametrize("s", [2, 3])
@pytest.mark.parametrize("seed", range(12))
def test_as_the_limit_has_it(seed: int, s: int) -> None:
    """u(k) = -k (1 + d) u(k-s-1) - d u(k-2s-2) + e(k), and k d a b (a^s - b^s) / (a - b) is 1 or not."""
    random = Random(seed)
    a, b = (Fraction(random.randint(91, 99), 100) for _ in range(2))
    powers = sum(a**i * b ** (s - 1 - i) for i in range(s))  # (a^s - b^s) / (a - b)
    d = Fraction(random.randint(93, 99), 100)
    k = 1 / (d * a * b * powers)
    assert k < 1
    for factor, lost in ((Fraction(1), True), (Fraction(99, 100), False)):
        den = ["1", *["0"] * s, str(k * factor * (1 + d)), *["0"] * s, str(d)]
        given = experiment(companion(a, b), ["1"], den, s)
        assert hides_a_state(given, covariances(given)) == lost
        assert limit(given).past_inputs.rank == (1 if lost else 2)


@pytest.mark.parametrize(
    ("A", "lost"),
    [
        ([["0", "1"], ["0", "0"]], False),
        ([["1/2", "0"], ["1", "0"]], False),
        ([["9/10", "1"], ["0", "9/10"]], False),
    ],
)
def test_singular_and_repeated(A: list[list[str]], lost: bool) -> None:
    given = experiment(A, ["1", "-9/10"], ["1", "1/2"])
    assert hides_a_state(given, covariances(given)) == lost


def test_of_other_sizes_it_says_nothing() -> None:
    given = read_experiment(experiment([["1/2", "0"], ["1", "1/3"]], ["1"], ["1"]).to_json() | {"past": 3})
    with pytest.raises(ValueError, match="two states"):
        hides_a_state(given, covariances(given))


@pytest.mark.parametrize("seed", range(10))
def test_reflection_coefficients_are_partial_correlations(seed: int) -> None:
    random = Random(seed)
    taps = [random.randint(-3, 3) for _ in range(4)] + [1]
    r = [Fraction(sum(x * y for x, y in zip(taps, taps[lag:], strict=False))) for lag in range(5)] + [Fraction(0)]
    gram = np.array([[float(r[abs(i - j)]) for j in range(6)] for i in range(6)])
    for order, gamma in enumerate(reflections(r), 1):
        inverse = np.linalg.inv(gram[: order + 1, : order + 1])
        assert float(gamma) == pytest.approx(-inverse[0, order] / np.sqrt(inverse[0, 0] * inverse[order, order]), abs=1e-12)
