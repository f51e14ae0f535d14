"""The claims on population limits follow from what certificates say, and change when that is tampered with."""

from __future__ import annotations

from dataclasses import replace
from itertools import islice
from random import Random

import pytest

from faultspace.base.progress import silent
from faultspace.exact.limits.experiments import Experiment
from faultspace.proofs.claims import experiments
from faultspace.proofs.evidence.experiments import (
    FAMILIES,
    LIMITS,
    Drawn,
    LimitEvidence,
    examine_experiment,
    experiments_in_order,
    first_look,
)
from faultspace.proofs.hypotheses.aimed_experiments import small_experiments
from faultspace.proofs.hypotheses.consistency import SMALL, consistency, driven
from faultspace.proofs.verdict.ablation import ablate
from faultspace.proofs.verdict.ledger import expected_without
from faultspace.proofs.verdict.verdicts import Verdict
from faultspace.proofs.verdict.workbench import Workbench
from tests.oracle import truth
from tests.thorough import every


@pytest.fixture(scope="module")
def bench() -> Workbench:
    """Return a workbench with experiments of each family, fourteen in a thorough run, and more of those in which v is independent of u."""
    made = Workbench("quick", 1, silent)
    counts = {name: 120 if name == Drawn.INDEPENDENT else 30 if "independent" in name else 14 for name in FAMILIES}
    made.limits = tuple(LIMITS.make((name, seed)) for name, count in counts.items() for seed in range(0, count, every()))
    return made


READINGS = (
    experiments.proposition_1_two_sided,
    experiments.proposition_1_white_a_c_seen,
    experiments.proposition_1_white_b_d_seen,
    experiments.proposition_1_autoregressive,
    experiments.proposition_1_lead_one,
    experiments.proposition_1_two_sided_output_error,
    experiments.proposition_1_two_sided_two_states,
    experiments.proposition_1_two_sided_one_state,
    experiments.proposition_1_two_sided_autoregressive,
    experiments.proposition_1_two_sided_nilpotent,
    experiments.proposition_1_two_sided_long_past,
    experiments.proposition_1_two_sided_long_past_inputs,
    experiments.settle_1_not_both,
    experiments.past_outputs_white_fault,
    experiments.past_outputs_past_inputs_long_past,
)


@pytest.mark.parametrize("reading", READINGS, ids=lambda f: f.__name__)
def test_a_reading_holds_and_falls_when_what_certificates_say_is_turned_round(reading: object, bench: Workbench) -> None:
    assert reading(bench).verdict == Verdict.CERTIFIED  # type: ignore[operator]

    def turned(d: LimitEvidence) -> LimitEvidence:
        if "K u(k-1)" in d.origin:
            system = d.experiment.system
            return replace(d, equal=True, inputs_right=True, state_inputs=(system.B, system.D))
        wrong = {"within": False, "equal": False, "inputs_right": False}
        kept_back = {} if "independent of u" in d.origin else {"past_outputs_within": not d.past_outputs_within}
        turned_round = None if d.state_inputs is None else d.state_inputs[::-1]
        return replace(d, state_inputs=turned_round, **wrong, **kept_back)  # type: ignore[arg-type]

    spoilt = Workbench("quick", 1, silent)
    spoilt.limits = tuple(turned(d) for d in bench.limits)
    if reading is experiments.proposition_1_white_b_d_seen:
        assert any(d.state_inputs is not None and d.state_inputs[0] != d.state_inputs[1] for d in bench.limits)
    assert reading(spoilt).verdict in (Verdict.REFUTED, Verdict.ERROR)  # type: ignore[operator]


REFUTED = (
    experiments.assumption_2_one_sided,
    experiments.assumption_2_without_lag_zero,
    experiments.proposition_1_white_a_c,
    experiments.proposition_1_white_b_d,
    experiments.proposition_1_coloured_a_c,
    experiments.proposition_1_two_sided_range,
    experiments.settle_1_a_c_wrong,
    experiments.settle_1_for_every_system,
    experiments.past_outputs_coloured_fault,
    experiments.past_outputs_past_inputs,
)


@pytest.mark.parametrize("reading", REFUTED, ids=lambda f: f.__name__)
def test_counterexamples_are_true_by_the_oracle(reading: object, bench: Workbench) -> None:
    outcome = reading(bench)  # type: ignore[operator]
    assert outcome.verdict == Verdict.REFUTED
    assert all(truth(c["kind"], c["statement"]) for c in outcome.certificates)


@pytest.mark.slow  # the main job looks for the same counterexamples
def test_every_hypothesis_of_consistency_but_the_colour_is_needed(bench: Workbench) -> None:
    rows = ablate(bench, consistency(), expected_without()["consistency"])
    assert all(row.as_expected for row in rows) and len(rows) == 7 + 21


def test_an_ablation_that_sees_no_failure_is_not_as_expected(bench: Workbench) -> None:
    expected = expected_without()["consistency"]
    seen = [driven(record) for record in bench.limits[:: every(4)]]
    blind = ablate(bench, replace(consistency(), holds=lambda subject: True, subjects=lambda bench: seen), expected)
    assert len(blind) == 7 + 21 and not all(row.as_expected for row in blind)


def test_a_counterexample_to_consistency_is_what_accepted_certificates_say() -> None:
    """Not what a first look says: one that sees failures everywhere leads to no subject that the certificates do not show to fail."""
    few = [driven(first_look(experiment)) for experiment in islice(small_experiments(), 5)]
    small = Workbench("quick", 1, silent)
    for looks in (few, [replace(one, model_right=False) for one in few]):
        small.put(SMALL, looks)
        assert consistency().over_q(small, ("u white",)).subject is None
        shown = consistency().over_q(small, ("v(k), u(k) uncorrelated",)).subject
        assert shown is not None and len(shown.accepted) >= 2 and not (shown.model_right and shown.record.inputs_right)
    assert all(not one.accepted for one in few)


@pytest.mark.parametrize("name", FAMILIES)
def test_a_family_is_what_its_name_says(name: str) -> None:
    experiment = FAMILIES[name](Random(5))
    assert isinstance(experiment, Experiment)
    d = examine_experiment(name, experiment)
    assert d.uncorrelated == ("independent" in name)
    assert d.white == (name.startswith(("u white", "u and v white")))
    assert d.past_lags or "K u(k-1)" in name or "coloured" in name or "moving" in name or "autoregressive" in name


@pytest.mark.parametrize("name", FAMILIES)
def test_a_first_look_sees_what_the_accepted_certificates_state(name: str) -> None:
    experiment = FAMILIES[name](Random(f"{name} 1"))
    accepted = examine_experiment("first look", experiment)
    assert len(accepted.accepted) >= 2 and first_look(experiment) == replace(accepted, accepted=frozenset())


def test_a_search_rests_on_accepted_certificates_and_not_on_its_first_look(monkeypatch: pytest.MonkeyPatch) -> None:
    """A look that sees failures everywhere brings no counterexample, and one that fails is put before the checker."""
    bench = Workbench("quick", 1, silent)
    inputs = experiments.drives([experiments.WHITE], experiments.LEADS)
    few = list(islice(experiments_in_order(inputs), 40))
    monkeypatch.setattr(experiments, "experiments_in_order", lambda inputs: iter(few))
    found = experiments.smallest_limit(bench, inputs, lambda e: not e.equal, "")
    put = {e.experiment for e in bench._examined_experiments.values()}
    assert found.verdict == Verdict.REFUTED and len(put) == 1 <= len(bench._looks)
    few = few[:5]
    never = experiments.smallest_limit(bench, inputs, lambda e: not e.accepted, "")
    assert never.verdict == Verdict.ERROR and "no counterexample" in never.evidence
