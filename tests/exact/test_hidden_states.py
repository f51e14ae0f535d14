"""The formula for the systems of two states of which an input hides one, against the limit itself; Levinson's recursion by numpy."""

from __future__ import annotations

from fractions import Fraction
from random import Random

import numpy as np
import pytest

from faultspace.exact.limits.experiments import Experiment, read_experiment
from faultspace.exact.limits.hidden_states import hides_a_state, reflections
from faultspace.exact.limits.moesp import limit
from faultspace.exact.limits.moments import covariances


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
