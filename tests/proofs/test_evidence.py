"""Evidence is the structure of a system as accepted certificates state it: the same as exact computes, and refused where two disagree."""

from __future__ import annotations

from dataclasses import fields

import pytest

from faultspace.base.progress import silent
from faultspace.exact.algebra.matrices import Matrix, beside, rank, row_echelon
from faultspace.exact.structure.fault_columns import fault_space
from faultspace.exact.structure.record import Structure, analyze
from faultspace.exact.system.systems import ResidualSystem
from faultspace.exact.system.windows import window_matrix
from faultspace.proofs.evidence import corpus, questions
from faultspace.proofs.trust import checker
from faultspace.proofs.trust import structure_certificates as make
from faultspace.proofs.verdict.workbench import Workbench

SOURCES = list(corpus._sources(Workbench("quick", 1, silent)))[::12]


def structure(found: corpus.Evidence) -> Structure:
    """Return the Structure whose parts are the answers."""
    return Structure(**{field.name: getattr(found, field.name) for field in fields(Structure)})


ONE_STATE = ResidualSystem.of([[0]], [[1]], [[1]], [[0]])


def test_the_structure_that_certificates_state_is_the_one_that_is_computed() -> None:
    tried = set()
    for origin, system, weight in SOURCES:
        found = corpus.examine(origin, system, weight)
        assert structure(found).to_json() == analyze(system).to_json(), str(system)
        assert found.kernel.rows == analyze(system).kernel.rows
        assert (found.left_invertible, found.zeta) == (analyze(system).left_invertible, analyze(system).zeta)
        assert (found.origin, found.weight) == (origin, weight) and 0 < len(found.accepted) <= 10 + 2 * (system.n + 2)
        tried.add(str(system.field))
    assert len(tried) == 6


@pytest.mark.parametrize("place", range(0, len(SOURCES), 5))
def test_windows_have_certificates_of_their_own(place: int) -> None:
    origin, system, _ = SOURCES[place]
    found, kernel = corpus.examine(origin, system), analyze(system).kernel
    windows = range(1, system.n + 3)
    assert found.window_ranks == tuple(rank(window_matrix(system, s)) for s in windows)
    assert found.space_dimensions == tuple(fault_space(kernel, s).dimension for s in windows)
    assert found.without_feedthrough == members_without_feedthrough(found.fault_space.basis, system.p)


def members_without_feedthrough(basis: Matrix, p: int) -> int:
    """Return the rows whose g vanishes in a basis of the same space for which the entries of g were eliminated first."""
    n = basis.ncols - p
    gains_first = row_echelon(beside(basis.columns(range(n, n + p)), basis.columns(range(n)))).matrix
    return sum(gains_first.rows([i]).columns(range(p)).is_zero() for i in range(gains_first.nrows))


def test_a_refused_certificate_ends_the_examination(monkeypatch: pytest.MonkeyPatch) -> None:
    right = make.finite_zeros(ONE_STATE)
    wrong = right | {"statement": right["statement"] | {"invariant_zero_polynomial": ["0", "1"]}}
    monkeypatch.setattr(make, "finite_zeros", lambda system: wrong)
    with pytest.raises(checker.Rejected):
        corpus.examine("test", ONE_STATE)


def test_certificates_that_disagree_are_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """The checker accepts no false one: one is put in its way that is accepted unread."""
    monkeypatch.setattr(make, "left_invertible", lambda kernel: {"kind": "not-left-invertible", "statement": {}})
    monkeypatch.setattr(questions, "accept", lambda certificate: None)
    with pytest.raises(ArithmeticError, match="disagree on whether"):
        corpus.examine("test", ONE_STATE)
