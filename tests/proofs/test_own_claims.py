"""Pairs (Fhat P, Ghat P): what D(q; P) says before is what certificates say after, and a claim notices when either is tampered with."""

from __future__ import annotations

from dataclasses import replace

import pytest

from faultspace.base.progress import silent
from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.pairs.witnesses import BadPair, bad_pair, good_columns
from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs.claims import pairs, windows
from faultspace.proofs.evidence.alternatives import ALTERNATIVES
from faultspace.proofs.evidence.families import adversarial
from faultspace.proofs.evidence.pairs_by_polynomial import PAIRS_BY_POLYNOMIAL, PairByPolynomial, examine_by_polynomial, pencil_of
from faultspace.proofs.verdict.verdicts import Verdict
from faultspace.proofs.verdict.workbench import Workbench
from tests.oracle import truth


@pytest.fixture(scope="module")
def bench() -> Workbench:
    """Return a workbench with the pairs of every sixth system of the quick run."""
    made = Workbench("quick", 1, silent)
    made.pairs_by_polynomial = tuple(one for item in list(PAIRS_BY_POLYNOMIAL.items(made))[::6] for one in PAIRS_BY_POLYNOMIAL.make(item))
    made.alternatives = tuple(one for item in list(ALTERNATIVES.items(made))[::9] for one in ALTERNATIVES.make(item))
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
