"""The population limits tell of the consistency of PI-MOESP and PO-MOESP: each statement on random systems, each boundary by a case.

"Equal to the range of O_s" needs (A, B~) controllable, B~ being the B that is seen, and a past window of n rows.
"""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from random import Random
from typing import Any

import pytest

from faultspace.exact.algebra.fields import QQ
from faultspace.exact.algebra.matrices import Matrix, beside, column_basis, rank, stacked
from faultspace.exact.limits.column_space import state_part
from faultspace.exact.limits.experiments import Experiment
from faultspace.exact.limits.moesp import PopulationLimits, limit
from faultspace.exact.system.systems import ResidualSystem
from faultspace.exact.system.windows import observability_matrix, reachability_matrix
from tests.exact.experiment_families import Rows, driven, rows, system, white_with_leads

SCALAR: dict[str, Any] = {
    "A": [["1/2"]],
    "B": [["1"]],
    "C": [["1"], ["0"]],
    "D": [["0"], ["0"]],
    "F": [["1"]],
    "G": [["0"], ["1"]],
    "nu": 1,
    "n": 1,
    "m": 1,
    "p": 2,
}
ONE: Rows = [["1"]]
NONE: Rows = [["0"]]


def controllable(A: Matrix, B: Matrix) -> bool:
    rest = Matrix.zero(QQ, 1, A.nrows), Matrix.zero(QQ, 1, B.ncols)
    return rank(reachability_matrix(ResidualSystem(A, B, *rest))) == A.nrows


def unbiased(found: PopulationLimits) -> bool:
    """Return whether both regressions give the true B and D, where they give one."""
    return all(
        regression is None or (found.bias(regression).B.is_zero() and found.bias(regression).D.is_zero())
        for regression in (found.true_AC, found.moesp)
    )


def leads(given: dict[str, Any], s: int, past: int, u: list[str], den: list[str], phi: list[str]) -> Experiment:
    """The result is v(k) = sum_j phi_j u(k+j) for one input and one fault, u = (sum_j u_j q^-j / den) e, all of it delayed by the largest
    lead.
    """
    delay = len(phi) - 1
    product = [Fraction(0)] * (len(u) + delay)
    for j, weight in enumerate(phi):
        for i, x in enumerate(u):
            product[i + delay - j] += Fraction(weight) * Fraction(x)
    numerator = [NONE] * delay + [[[x]] for x in u]
    return driven(given, s, past, {"num": numerator, "den": den}, {"num": [[[str(x)]] for x in product], "den": den})


@pytest.mark.parametrize("seed", range(20))
def test_an_independent_fault_leaves_everything_right(seed: int) -> None:
    """Any colour of u, v and w, each from its own noise: L is inside O_s, equal to it iff (A, B) is controllable; B, D exact."""
    random = Random(seed)
    n, m, nu, p = (random.randint(1, top) for top in (3, 2, 2, 3))
    given = system(random, n, m, p, nu)
    u = [[row + ["0"] * m for row in rows(random, nu, nu)] for _ in range(2)]
    u[0] = [[*("1" if i == j else "0" for j in range(nu)), *["0"] * m] for i in range(nu)]
    v = [[["0"] * nu + row for row in rows(random, m, m)] for _ in range(2)]
    experiment = driven(given, n + 1, n, {"num": u, "den": ["1", "-1/2"]}, {"num": v, "den": ["1", "1/3", "1/5"]}, [rows(random, p, p)])
    found = limit(experiment)
    A, B = experiment.system.residual.A, experiment.system.B
    assert found.past_inputs.within_observability_range and unbiased(found)
    if controllable(A, B):
        assert found.past_inputs.equals_observability_range


@pytest.mark.parametrize("seed", range(20))
def test_a_white_input_that_the_fault_follows_ahead_of_time(seed: int) -> None:
    """v(k) = sum_j phi_j u(k+j): L is inside O_s; by output error B + sum_j A^j F phi_j and D + G phi_0 + sum_j C A^(j-1) F phi_j."""
    random = Random(seed)
    n, m, nu, p = (random.randint(1, top) for top in (3, 2, 2, 3))
    given = system(random, n, m, p, nu)
    phi = [rows(random, m, nu) for _ in range(random.randint(1, 4))]
    found = limit(white_with_leads(given, n + 1, n, phi))
    residual, B, D = found.experiment.system.residual, found.experiment.system.B, found.experiment.system.D
    column = residual.F
    D = D + residual.G @ Matrix.of(phi[0])
    for j, weight in enumerate(phi):
        B = B + column @ Matrix.of(weight)
        if j + 1 < len(phi):
            D = D + residual.C @ column @ Matrix.of(phi[j + 1])
        column = residual.A @ column
    assert found.past_inputs.within_observability_range
    assert found.past_inputs.equals_observability_range or not controllable(residual.A, B)
    if found.true_AC is not None:
        assert (found.true_AC.B, found.true_AC.D) == (B, D)


def test_lead_one_by_hand() -> None:
    """With v(k) = u(k+1), output error finds B + AF and D + CF; with G = 0 MOESP's regression finds them too, with G != 0 it does not."""
    for G, agrees in (([["0"], ["0"]], True), ([["1"], ["1"]], False)):
        found = limit(white_with_leads(SCALAR | {"G": G, "C": [["1"], ["2"]]}, 3, 2, [NONE, ONE]))
        assert found.true_AC is not None and found.moesp is not None
        assert Matrix.of([["3/2"]]) == found.true_AC.B and Matrix.of([[1], [2]]) == found.true_AC.D
        assert ((found.moesp.B, found.moesp.D) == (found.true_AC.B, found.true_AC.D)) == agrees


def test_controllability_of_the_b_that_is_seen_is_needed() -> None:
    """A = 1/2, F = 1, B = -1/2, v(k) = u(k+1): (A, B) is controllable, B + AF = 0, and the limit is zero."""
    found = limit(white_with_leads(SCALAR | {"B": [["-1/2"]]}, 3, 3, [NONE, ONE]))
    assert found.past_inputs.rank == 0 and found.past_inputs.matrix.is_zero()
    assert not found.past_inputs.contains_observability_range and found.past_inputs.state is None


def test_a_moving_average_input_ruins_a_and_c() -> None:
    """With u = e(k) + e(k-1)/2 and v = e(k+1) the limit has rank 2 for one state."""
    experiment = driven(SCALAR, 3, 3, [NONE, ONE, [["1/2"]]], [ONE])
    found = limit(experiment)
    assert (found.past_inputs.rank, found.past_inputs.joint_rank) == (2, 2)
    # The same with v(k) = u(k+1), a fault that is a filter of the input alone.
    assert limit(leads(SCALAR, 3, 3, ["1", "1/2"], ["1"], ["0", "1"])).past_inputs.rank == 2


def test_a_moving_average_input_with_lead_one_and_no_feedthrough() -> None:
    """With G = 0, lead 1 and any colour the limit stays inside O_s; with a lead of 2 or G != 0 it leaves it, in most systems."""
    seen: Counter[tuple[int, bool, bool]] = Counter()
    for seed in range(24):
        random = Random(seed)
        n, lead, feedthrough = random.randint(1, 2), 1 + seed % 2, seed % 4 >= 2
        given = system(random, n, 1, 2, 1)
        if not feedthrough:
            given["G"] = [["0"], ["0"]]
        found = limit(leads(given, n + 1, n, ["1", "1/2"], ["1", "-1/3"], ["0"] * lead + ["1"]))
        seen[lead, feedthrough, found.past_inputs.within_observability_range] += 1
    assert seen[1, False, False] == 0 and seen[1, False, True] == 6
    assert min(seen[1, True, False], seen[2, False, False], seen[2, True, False]) >= 4


@pytest.mark.parametrize("seed", range(12))
def test_an_autoregressive_input_of_order_at_most_s(seed: int) -> None:
    """Any lead and any G will do: given Uf what comes later no longer depends on the past. Of order s + 1 it does."""
    random = Random(seed)
    n = random.randint(1, 2)
    s = n + 1
    given = system(random, n, 1, 2, 1)
    for order in (s, s + 1):
        den = ["1", *(str(Fraction(random.choice([-1, 1]), 3 * order)) for _ in range(order))]
        found = limit(leads(given, s, n, ["1"], den, ["1", "-1/2", "1/3"]))
        if order == s:
            assert found.past_inputs.within_observability_range
        elif seed == 0:
            assert not found.past_inputs.within_observability_range


def degree_with_delay(experiment: Experiment, K: Matrix) -> int:
    """The result is the McMillan degree of the transfer function from u to y where v(k) = K u(k-1)."""
    residual, nu = experiment.system.residual, experiment.system.nu
    A = stacked(beside(residual.A, residual.F @ K), Matrix.zero(QQ, nu, residual.n + nu))
    B = stacked(experiment.system.B, Matrix.identity(QQ, nu))
    joint = ResidualSystem(A, B, beside(residual.C, residual.G @ K), Matrix.zero(QQ, residual.p, nu))
    return rank(observability_matrix(joint, residual.n + nu) @ reachability_matrix(joint))


def test_a_fault_that_follows_the_input() -> None:
    """v(k) = K u(k-1), u white: the rank is the McMillan degree from u to y, most often n + rank K."""
    gains: Counter[int] = Counter()
    for seed in range(24):
        random = Random(seed)
        n, p, m, nu = (random.randint(1, 2) for _ in range(4))
        K = rows(random, m, nu)
        unit = [["1" if i == j else "0" for j in range(nu)] for i in range(nu)]
        experiment = driven(system(random, n, m, p, nu), n + nu + 1, n + nu, [unit], [[["0"] * nu] * m, K])
        found = limit(experiment)
        assert found.past_inputs.rank == found.past_outputs.rank == degree_with_delay(experiment, Matrix.of(K))
        gains[found.past_inputs.rank - n] += 1
    assert gains[1] >= 8 and gains[2] >= 1


def test_a_fault_that_follows_the_input_unseen() -> None:
    """C A^-1 F K = G K cancels the pole at 0: rank n, and A, C are right though v(k) = K u(k-1)."""
    one = SCALAR | {"C": [["1"]], "D": [["0"]], "p": 1}
    for G, gain in (("0", 1), ("2", 0)):
        found = limit(driven(one | {"G": [[G]]}, 3, 3, [ONE], [NONE, ONE]))
        assert found.past_inputs.rank == 1 + gain
        assert found.past_inputs.equals_observability_range == (gain == 0)
        assert not unbiased(found)


@pytest.mark.parametrize("seed", range(10))
def test_a_fault_equal_to_the_input(seed: int) -> None:
    """With v = u of any colour A and C come out right, and either regression with either instruments finds B + F and D + G."""
    random = Random(seed)
    n, p, nu = random.randint(1, 3), random.randint(1, 2), random.randint(1, 2)
    unit = [["1" if i == j else "0" for j in range(nu)] for i in range(nu)]
    u = {"num": [unit, rows(random, nu, nu)], "den": ["1", "-1/2"]}
    found = limit(driven(system(random, n, nu, p, nu), n + 1, n, u, u))
    residual, B, D = found.experiment.system.residual, found.experiment.system.B, found.experiment.system.D
    for one in (found.past_inputs, found.past_outputs):
        assert one.within_observability_range
        assert one.equals_observability_range or not controllable(residual.A, B + residual.F)
    for regression in (found.true_AC, found.moesp):
        assert regression is None or (regression.B, regression.D) == (B + residual.F, D + residual.G)


WHITE_W = [[["1", "0"], ["0", "1"]]]
FAULTS: dict[str, Any] = {
    "white": [[["0", "1"]]],
    "moving average of order 1": [[["0", "1"]], [["0", "1/2"]]],
    "moving average of order 2": [[["0", "1"]], [["0", "1/2"]], [["0", "1/3"]]],
    "autoregressive": {"num": [[["0", "1"]]], "den": ["1", "-1/2"]},
}


@pytest.mark.parametrize(
    ("fault", "G", "w", "within"),
    [
        ("white", "1", WHITE_W, True),
        ("white", "1", None, True),
        ("white", "0", [*WHITE_W, *WHITE_W], False),
        ("moving average of order 1", "0", WHITE_W, True),
        ("moving average of order 1", "1", WHITE_W, False),
        ("moving average of order 2", "0", WHITE_W, False),
        ("autoregressive", "0", WHITE_W, False),
        ("autoregressive", "1", None, False),
    ],
)
def test_past_outputs_as_instruments_want_whiteness(fault: str, G: str, w: Any, within: bool) -> None:
    """With v independent of u, past inputs are right; past outputs are only if what is ahead of them is uncorrelated with them."""
    given = SCALAR | {"G": [["0"], [G]], "C": [["1"], ["1/3"]]}
    found = limit(driven(given, 3, 2, [[["1", "0"]], [["1/2", "0"]]], FAULTS[fault], w))
    assert found.past_inputs.equals_observability_range and unbiased(found)
    assert found.past_outputs.equals_observability_range == within
    assert found.past_outputs.contains_observability_range


def test_the_true_order_is_exceeded_by_the_fault_model() -> None:
    """Past outputs, v autoregressive of order 1, no noise: the limit of rank n + 1 carries a model whose poles are those of A and of v."""
    one = SCALAR | {"C": [["1"], ["2"]]}
    fault = {"num": [[["0", "1"]]], "den": ["1", "-1/3"]}
    found = limit(driven(one, 4, 4, [[["1", "0"]]], fault))
    assert found.past_outputs.rank == 2 and found.past_outputs.state is None
    state = state_part(column_basis(found.past_outputs.matrix), 2)
    assert state is not None and state.characteristic_polynomial == (Fraction(1, 6), Fraction(-5, 6), Fraction(1))
