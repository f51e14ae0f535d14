"""Pairs (Fhat P, Ghat P): what D(q; P) says before is what certificates say after, and a claim notices when either is tampered with.

What took the place of withdrawn readings, attacked: poles and spectra degenerate on purpose, pasts of every length, both ends of s.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from fractions import Fraction
from random import Random
from typing import Any

import pytest

from faultspace.base.errors import InvalidInput
from faultspace.base.progress import silent
from faultspace.exact.algebra.matrices import Matrix, rank
from faultspace.exact.limits.experiments import Experiment, read_experiment
from faultspace.exact.limits.hidden_states import hides_a_state
from faultspace.exact.limits.moments import covariances
from faultspace.exact.pairs.witnesses import BadPair, bad_pair, good_columns
from faultspace.exact.structure.inversion import delay_unknown_state
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.system.systems import ResidualSystem
from faultspace.exact.system.windows import observability_matrix
from faultspace.proofs.brought.readings import decide_reading
from faultspace.proofs.claims import pairs, windows
from faultspace.proofs.evidence.alternatives import ALTERNATIVES
from faultspace.proofs.evidence.corpus import CORPUS, examine
from faultspace.proofs.evidence.experiments import LimitEvidence, examine_experiment, nilpotent_points
from faultspace.proofs.evidence.families import adversarial
from faultspace.proofs.evidence.pairs_by_polynomial import PAIRS_BY_POLYNOMIAL, PairByPolynomial, examine_by_polynomial, pencil_of
from faultspace.proofs.evidence.questions import FINITE_ZEROS, RANKS
from faultspace.proofs.evidence.refuting_experiments import WITHOUT_RANK, in_order, kept, seasonal
from faultspace.proofs.verdict.verdicts import Verdict
from faultspace.proofs.verdict.workbench import Workbench
from tests.oracle import truth


@pytest.fixture(scope="module")
def bench() -> Workbench:
    """Return a workbench with the pairs of every sixth system of the quick run."""
    made = Workbench("quick", 1, silent)
    made.pairs_by_polynomial = tuple(one for item in list(PAIRS_BY_POLYNOMIAL.items(made))[::6] for one in PAIRS_BY_POLYNOMIAL.make(item))
    made.alternatives = tuple(map(ALTERNATIVES.make, list(ALTERNATIVES.items(made))[::9]))
    return made


def good_and_bad() -> tuple[PairByPolynomial, PairByPolynomial]:
    system = ResidualSystem.of([[0]], [[1, 0]], [[1], [0]], [[0, 0], [0, 1]])
    pencil = pencil_of(system)
    bad = bad_pair(pencil)
    assert isinstance(bad, BadPair)
    return (
        examine_by_polynomial("named", "good", system, good_columns(pencil).verdict.P, None, 1),
        examine_by_polynomial("named", "bad", system, bad.verdict.P, None, 1),
    )


def test_a_good_and_a_bad_pair_of_full_column_rank() -> None:
    good, bad = good_and_bad()
    assert good.equal and good.polynomial and pairs.agrees(good)
    assert not bad.equal and not bad.polynomial and bad.full_column_rank and pairs.agrees(bad)


@pytest.mark.parametrize(
    "change",
    [{"polynomial": ("1", "1", "1")}, {"equal": False}, {"zero_polynomial": ("2", "1")}, {"pair_normal_rank": 0}, {"infinite_zeros": 9}],
    ids=lambda change: next(iter(change)),
)
def test_what_is_tampered_with_no_longer_agrees(change: dict[str, object]) -> None:
    good, bad = good_and_bad()
    assert not pairs.agrees(replace(good, **change))  # type: ignore[arg-type]
    assert not pairs.agrees(replace(bad, equal=True)) and not pairs.agrees(replace(bad, pair_normal_rank=2))


def test_readings_are_refuted_by_tampered_pairs(bench: Workbench) -> None:
    spoilt = Workbench("quick", 1, silent)
    spoilt.pairs_by_polynomial = tuple(replace(d, equal=not d.equal, zeta=d.zeta + 1) for d in bench.pairs_by_polynomial)
    for reading in (
        pairs.one_determinant_formula,
        pairs.zeros_of_pairs_number,
        pairs.bad_set_one_fault,
        pairs.zero_assignment_every_polynomial,
    ):
        assert reading(bench).verdict == Verdict.CERTIFIED, reading
        assert reading(spoilt).verdict in (Verdict.REFUTED, Verdict.ERROR), reading


def test_counterexamples_are_found_and_true_by_the_oracle(bench: Workbench) -> None:
    for reading in (pairs.zeros_of_pairs_split, pairs.bad_set_codimension_unobservable, pairs.zero_assignment_without_observability):
        outcome = reading(bench)
        assert outcome.verdict == Verdict.REFUTED and outcome.certificates
        assert all(truth(c["kind"], c["statement"]) for c in outcome.certificates)
    for reading in (pairs.canonical_form_any_a_c, pairs.canonical_form_feedback):
        outcome = reading(bench)
        assert outcome.verdict == Verdict.REFUTED
        assert all(truth(c["kind"], c["statement"]) for c in outcome.certificates)


def test_names_broken_on_purpose_are_noticed(bench: Workbench, monkeypatch: pytest.MonkeyPatch) -> None:
    assert pairs.canonical_form_same_a_c(bench).verdict == Verdict.CERTIFIED
    monkeypatch.setattr(pairs, "fault_class", lambda kernel: kernel.system.F)
    assert pairs.canonical_form_same_a_c(bench).verdict == Verdict.REFUTED


def test_every_left_invertible_named_system_with_a_fault_and_a_lag_has_a_late_partner() -> None:
    for _, system in adversarial():
        kernel = pencil_of(system).kernel
        if kernel.normal_rank == system.m > 0 and kernel.lag:
            partner = windows._partner(kernel)
            assert partner is not None and (partner.system.A, partner.system.C) == (system.A, system.C), system


def test_a_line_of_good_pairs_is_found_where_the_codimension_is_two() -> None:
    pencil = pencil_of(ResidualSystem.of([[0]], [[1, 0]], [[1], [0]], [[0, 0], [0, 1]]))
    line = pairs._line(pencil)
    assert line is not None and truth(line["kind"], line["statement"])
    hypersurface = pencil_of(ResidualSystem.of([[0]], [[1, 0]], [[0], [0]], [[1, 0], [0, 1]]))
    assert pairs._line(hypersurface) is None, "every line meets a hypersurface, over the closure"


def test_a_p_of_deficient_rank_is_bad() -> None:
    system = ResidualSystem.of([[0]], [[1, 0]], [[1], [0]], [[0, 0], [0, 1]])
    pencil = pencil_of(system)
    found = examine_by_polynomial("named", "deficient", system, Matrix.zero(system.field, pencil.n_z, pencil.columns), None, 1)
    assert not found.full_column_rank and not found.polynomial and pairs.agrees(found)


ROOTS = ("9/10", "-9/10", "99/100", "1/2", "0", "-1/2", "3/4")


def polynomial(roots: list[str]) -> list[Fraction]:
    """Return the polynomial 1, ... by falling powers, with these roots."""
    found = [Fraction(1)]
    for root in roots:
        found = [x - Fraction(root) * y for x, y in zip([*found, Fraction(0)], [Fraction(0), *found], strict=True)]
    return found


def some(random: Random, choices: tuple[str, ...], most: int, least: int = 0) -> list[str]:
    """Return choices with repetitions, so that poles are double and zeros cancel more often than not."""
    return [random.choice(choices) for _ in range(random.randint(least, most))]


def attack(seed: int) -> Experiment:
    """Companion A with poles of ROOTS; zeros of u there or on the unit circle, taps a period apart; a second input copies the first."""
    random = Random(seed)
    n, nu = random.choice((1, 2, 2, 3)), random.choice((1, 1, 2))
    top = polynomial(some(random, ROOTS, n, n))
    A = [[str(-x) for x in top[1:]]] + [["1" if j == i else "0" for j in range(n)] for i in range(n - 1)]
    apart = [Fraction(x) for x in (1, 0, 0, random.choice((-1, 1)))]
    num = random.choice((polynomial(some(random, (*ROOTS, "1", "-1"), 3)), apart, [Fraction(1)]))
    den = polynomial(some(random, ROOTS, 3))
    order, late = max(len(num), len(den)) - 1, random.randint(1, 5)
    lags: list[list[list[str]]] = [[["0"] * (nu + 1) for _ in range(nu)] for _ in range(max(len(num), late + 1 if nu == 2 else 1))]
    for lag, x in enumerate(num):
        lags[lag][0][0] = str(x)
    if nu == 2:
        lags[late][1][0] = "1"  # persistently exciting of finite order only, or, with a noise of its own, of every order
        lags[0][1][1] = random.choice(("0", "1"))
    unit = [["1" if i == j else "0" for j in range(n)] for i in range(n)]
    given: dict[str, Any] = {"A": A, "B": [[str(random.randint(-1, 1)) for _ in range(nu)] for _ in range(n)], "C": unit}
    given |= {"D": [["0"] * nu] * n, "F": [["1"]] * n, "G": [["0"]] * n}
    given |= {"s": random.randint(2, max(2, n + 1)), "past": random.choice((1, n, n + 1, n + order, n + max(order, late)))}
    own = [["0"] * nu + ["1"]]
    return read_experiment(given | {"u_filter": {"num": lags, "den": [str(x) for x in den]}, "v_filter": [own, own]})


def defied(d: LimitEvidence) -> list[str]:
    """Return the readings that this experiment refutes."""
    n, nu, past = d.experiment.system.residual.n, d.experiment.system.nu, d.experiment.past
    readings = {
        "two-sided": (d.uncorrelated, d.within and d.inputs_right),
        "two-sided-output-error": (d.uncorrelated and d.state_inputs is not None, d.output_error_right),
        "two-sided-one-state": (d.whole_range_expected and n == 1, d.equal),
        "two-sided-autoregressive": (d.whole_range_expected and d.autoregressive, d.equal),
        "two-sided-nilpotent": (d.whole_range_expected and d.nilpotent, d.equal),
        "two-sided-long-past": (d.whole_range_expected and d.past_of_input, d.equal),
    }
    if d.whole_range_expected and (n, past, nu) == (2, 2, 1):
        readings["two-sided-two-states"] = (True, d.equal != hides_a_state(d.experiment, covariances(d.experiment)))
    return [name for name, (applies, holds) in readings.items() if applies and not holds]


@pytest.mark.parametrize("first", range(0, 120, 20))
def test_no_degenerate_experiment_refutes_a_repair(first: int) -> None:
    for seed in range(first, first + 20):
        try:
            d = examine_experiment("attack", attack(seed))
        except InvalidInput as refusal:
            assert "covariance over s + past" in str(refusal)
            continue
        assert defied(d) == [], seed


def test_the_attack_meets_every_hypothesis() -> None:
    met: Counter[str] = Counter()
    for seed in range(120):
        experiment = attack(seed)
        met["one state"] += experiment.system.residual.n == 1
        met["two inputs"] += experiment.system.nu == 2
        met["autoregressive"] += len(experiment.u_filter.numerator) == 1
        met["past of the input"] += experiment.past >= experiment.system.residual.n + experiment.u_filter.memory
    assert min(met.values()) >= 10, met


@pytest.mark.parametrize("past", range(2, 9))
def test_a_longer_past_finds_the_state_that_the_shortest_hides(past: int) -> None:
    d = examine_experiment("period 3", seasonal(in_order()[0], past=past))
    assert d.equal == (past > 2) and defied(d) == [] and d.past_of_input == (past == 8)


@pytest.mark.parametrize("name", WITHOUT_RANK)
def test_what_withdrew_the_old_reading_does_not_touch_the_new_ones(name: str) -> None:
    d = examine_experiment("kept", kept(name))
    assert not d.equal and defied(d) == []


def test_a_nilpotent_point_for_every_spectrum() -> None:
    points = list(nilpotent_points())
    assert len({(str(e.u_filter.to_json()), e.system.residual.n, e.s) for e in points}) == len(points) > 100
    for experiment in points[::12]:
        d = examine_experiment("nilpotent", experiment)
        assert d.whole_range_expected and d.nilpotent and d.equal


def test_finite_zeros_count_with_multiplicity() -> None:
    """Each finite zero of these is the value of an unobservable mode; there is one zero more than modes, and v is not determined."""
    found = [(name, system) for name, system in adversarial() if "unobservable mode" in name]
    assert len(found) == 2
    bench = Workbench("quick", 1, lambda stage, done, total: None)
    bench.put_answers(CORPUS, [examine(*one) for one in found])
    outcome = decide_reading(bench, "trajectory-recovered--no-finite-zeros")
    assert outcome.verdict == Verdict.CERTIFIED
    for (_, system), evidence in zip(found, bench.corpus((RANKS, FINITE_ZEROS)), strict=True):
        hidden = system.n - rank(observability_matrix(system, system.n))
        assert (
            evidence.left_invertible and evidence.finite_zeros == hidden + 1 and delay_unknown_state(kernel_representation(system)) is None
        )
        certificate = next(c for c in outcome.certificates if c["kind"] == "finite-zeros")
        statement = certificate["statement"]
        assert statement["invariant_zero_polynomial"] == ["0", "0", "1"] and truth("finite-zeros", statement)
