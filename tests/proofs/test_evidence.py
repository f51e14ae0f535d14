"""Evidence is the structure of a system as accepted certificates state it: the same as exact computes, and refused where two disagree.

What is counted as accepted is what the checker decided: each certificate once, however many records, readings and rows rest on it. Orbits
over small prime fields: every system in exactly one, invariants constant on each, counts by Burnside's lemma. What several claims want to
know of the same systems is found once, and is what it would be if it were found again.
"""

from __future__ import annotations

import threading
from collections import Counter
from dataclasses import fields
from itertools import product
from typing import Any

import numpy as np
import pytest

from faultspace.base.aside import aside
from faultspace.base.progress import silent
from faultspace.exact.algebra.fields import QQ
from faultspace.exact.algebra.matrices import Matrix, beside, rank, row_echelon
from faultspace.exact.structure.behavior import compare
from faultspace.exact.structure.fault_columns import fault_space
from faultspace.exact.structure.kernel_rows import KernelRepresentation, kernel_representation
from faultspace.exact.structure.record import Structure, analyze
from faultspace.exact.system.systems import ResidualSystem
from faultspace.exact.system.windows import window_matrix
from faultspace.proofs.deciding import Check
from faultspace.proofs.deciding import decided as answers_to
from faultspace.proofs.evidence import alternatives, corpus, pairs_by_polynomial, questions
from faultspace.proofs.evidence.alternatives import ALTERNATIVES, PAIRS, examine_alternative, examine_pair
from faultspace.proofs.evidence.exhaustive import all_systems, orbits
from faultspace.proofs.evidence.families import adversarial, random_systems, shift_registers
from faultspace.proofs.evidence.once_a_run import in_run
from faultspace.proofs.evidence.orbits_by_stages import orbits_by_stages
from faultspace.proofs.evidence.subjects import kernel_once, space_once
from faultspace.proofs.trust import checker, structure_certificates
from faultspace.proofs.trust import structure_certificates as make
from faultspace.proofs.trust.checker import Rejected
from faultspace.proofs.trust.structure_certificates import Certificate
from faultspace.proofs.verdict.ledger import load
from faultspace.proofs.verdict.verdicts import ClaimResult, ReadingResult, Report
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


def counting(monkeypatch: pytest.MonkeyPatch) -> set[str]:
    """Return a set into which the checker's decisions go from now on, by the names of the certificates."""
    decided: set[str] = set()
    decide = checker.decide

    def counted(one: dict[str, Any], *rest: Any) -> Any:
        decided.add(structure_certificates.sha256(one))
        return decide(one, *rest)

    monkeypatch.setattr(checker, "decide", counted)
    return decided


def test_a_certificate_on_which_several_rest_is_counted_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two readings, on pairs that share systems: their own counts, and that of the report, are of certificates that were decided."""
    decided = counting(monkeypatch)
    in_run("one of its own")
    systems = [one for one in random_systems(QQ, 12, seed=3) if one.n <= 3]
    bench = Workbench("quick", 1, silent)
    bench.put(ALTERNATIVES, [examine_alternative("itself", one, one) for one in systems for _ in range(3)])
    bench.put(PAIRS, [examine_pair("itself", one, one) for one in systems])
    claim = next(one for one in load() if one.id == "canonical-form")
    readings = [one for one in claim.readings if one.id in ("same-a-c",)]
    results = [ReadingResult(one, Check(one.check).done(bench), 0.0) for one in readings for _ in range(2)]
    report = Report("quick", (ClaimResult(claim, tuple(results)),), (), "", 0.0)
    assert report.decided() <= decided
    assert results[0].outcome.accepted == len(report.decided()) == len(results[0].outcome.all_decided) > len(systems)
    assert results[0].outcome.accepted <= 3 * len(set(systems)) + len(results[0].outcome.certificates), "a sum over records has four each"
    assert results[0].to_json()["certificates_accepted"] == results[0].outcome.accepted


@pytest.mark.searches
def test_a_second_run_of_the_same_process_counts_what_it_has_decided_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is kept of a system is kept for one run, though the processes that do the work outlive it."""
    checks = [Check("example_v.one_fault"), Check("zeros_of_pairs.number"), Check("canonical_form.popov_rows")]
    runs = []
    for _ in range(2):
        decided = counting(monkeypatch)
        found = answers_to(Workbench("quick", 1, silent), checks)
        runs.append(frozenset().union(*(found[one].found.all_decided for one in checks)))
        assert runs[-1] <= decided
    assert runs[0] == runs[1] and len(runs[0]) > 3000


Table = list[list[int]]


def invertible(q: int, size: int) -> list[tuple[Table, Table]]:
    """Return GL_size(q) with inverses, by trying every pair of matrices."""
    tables = [[list(e[i * size : (i + 1) * size]) for i in range(size)] for e in product(range(q), repeat=size * size)]
    one = [[int(i == j) for j in range(size)] for i in range(size)]
    return [(a, b) for a in tables for b in tables if times(a, b, q, size) == one]


def times(a: Table, b: Table, q: int, cols: int) -> Table:
    return [[sum(x * row[j] for x, row in zip(line, b, strict=True)) % q for j in range(cols)] for line in a]


def naive_orbits(q: int, n: int, p: int, m: int) -> Counter[int]:
    """Sizes of the orbits, by applying the whole group to one system after the other."""
    groups = [invertible(q, size) for size in (n, p, m)]
    left = {tuple(map(str, (s.A, s.F, s.C, s.G))): s for s in all_systems(q, n, p, m)}
    sizes: Counter[int] = Counter()
    while left:
        _, system = next(iter(left.items()))
        A, F, C, G = ([[int(x) for x in row] for row in part.elements()] for part in (system.A, system.F, system.C, system.G))
        orbit = set()
        for (T, S), (U, _), (V, _) in product(*groups):
            moved = (
                times(times(T, A, q, n), S, q, n),
                times(times(T, F, q, m), V, q, m),
                times(times(U, C, q, n), S, q, n),
                times(times(U, G, q, m), V, q, m),
            )
            orbit.add(tuple(str(part).replace("'", "") for part in moved))
        for key in orbit:
            del left[key]
        sizes[len(orbit)] += 1
    return sizes


@pytest.mark.parametrize("q, n, p, m", [(2, 1, 1, 1), (2, 1, 2, 1), (2, 2, 1, 1), (3, 1, 1, 1), (3, 1, 2, 1), (2, 1, 2, 2)])
def test_orbits_are_those_of_the_group(q: int, n: int, p: int, m: int) -> None:
    found = orbits(q, n, p, m)
    assert sum(orbit.size for orbit in found) == q ** ((n + p) * (n + m))
    assert Counter(orbit.size for orbit in found) == naive_orbits(q, n, p, m)


@pytest.mark.parametrize("q, n, p, m", [(2, 0, 1, 1), (2, 1, 0, 1), (2, 1, 1, 0), (3, 0, 0, 0)])
def test_zero_dimensions(q: int, n: int, p: int, m: int) -> None:
    assert sum(orbit.size for orbit in orbits(q, n, p, m)) == q ** ((n + p) * (n + m))


def invariants(system: ResidualSystem) -> tuple[object, ...]:
    report = analyze(system).to_json()
    return tuple(str(report[key]) for key in report if key not in ("fault_space", "field"))


def test_invariants_of_all_systems_are_those_of_their_orbits() -> None:
    every = Counter(invariants(system) for system in all_systems(2, 1, 2, 1))
    weighted: Counter[tuple[object, ...]] = Counter()
    for orbit in orbits(2, 1, 2, 1):
        weighted[invariants(orbit.system)] += orbit.size
    assert every == weighted


SYSTEMS = [system for _, system in adversarial() if system.n <= 2]


@pytest.mark.parametrize(("n", "p", "m"), [(0, 0, 0), (1, 1, 1), (2, 1, 1), (1, 2, 2), (2, 0, 2), (2, 2, 0), (0, 2, 2), (3, 0, 0)])
def test_orbits_by_stages_are_those_of_the_list_of_all_systems(n: int, p: int, m: int) -> None:
    """The sizes are the same, and no two representatives lie in one orbit."""
    found, listed = list(orbits_by_stages(n, p, m)), orbits(2, n, p, m)
    assert sorted(one.size for one in found) == sorted(one.size for one in listed)
    assert sum(one.size for one in found) == 2 ** ((n + p) * (n + m))


@pytest.mark.parametrize(("n", "p", "m"), [(1, 1, 1), (2, 1, 1), (1, 1, 2)])
def test_a_representative_stands_for_what_every_change_of_basis_makes_of_it(n: int, p: int, m: int) -> None:
    groups = [[np.array(g).reshape(k, k) for g in product((0, 1), repeat=k * k) if round(np.linalg.det(np.array(g).reshape(k, k))) % 2]
              for k in (n, p, m)]  # fmt: skip
    seen: set[bytes] = set()
    for one in orbits_by_stages(n, p, m):
        A, F, C, G = (np.array(part.to_json(), dtype=np.int64) for part in (one.system.A, one.system.F, one.system.C, one.system.G))
        images = set()
        for T, U, V in product(*groups):
            back = next(S for S in groups[0] if not ((S @ T + np.eye(n)) % 2).any())
            images.add(b"".join((part % 2).astype(np.int8).tobytes() for part in (T @ A @ back, T @ F @ V, U @ C @ back, U @ G @ V)))
        assert len(images) == one.size and not images & seen
        seen |= images
    assert len(seen) == 2 ** ((n + p) * (n + m))


def test_larger_vectors_than_a_number_has_bits_are_refused() -> None:
    with pytest.raises(ValueError, match="n \\+ m"):
        next(orbits_by_stages(4, 1, 3))


def test_what_is_kept_is_what_is_found() -> None:
    for system in SYSTEMS:
        assert kernel_once(system) is kernel_once(system)
        assert (kernel_once(system).rows, kernel_once(system).system) == (kernel_representation(system).rows, system)
        assert space_once(system).basis == fault_space(kernel_representation(system)).basis


def test_pairs_are_compared_once_in_each_order() -> None:
    for n in (1, 2, 3):
        idle, driven = shift_registers(n)
        assert alternatives.compared(idle, driven).first_difference == alternatives.compared(driven, idle).first_difference == n + 1
        assert alternatives.compared(idle, idle).first_difference is None
    for first in SYSTEMS:
        for second in SYSTEMS:
            if first.p == second.p:
                assert alternatives.compared(first, second).first_difference == compare(first, second).first_difference


def test_a_comparison_that_the_checker_refuses_is_not_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    """It is refused the next time too, and what was refused once is found where the certificate is right again."""
    system, other = (ResidualSystem.of([[k]], [[1]], [[1], [0]], [[0], [1]]) for k in (5, 7))
    made = alternatives.comparison_certificate

    def wrong(first: object, second: object) -> Certificate:
        return made(kernel_once(system), kernel_once(system)) | {"statement": {"first": system.to_json(), "second": other.to_json()}}

    monkeypatch.setattr(alternatives, "comparison_certificate", wrong)
    for _ in range(2):
        with pytest.raises(Rejected):
            alternatives.compared(system, other)
    monkeypatch.undo()
    assert alternatives.compared(system, other).first_difference == compare(system, other).first_difference == 2


def test_zeros_that_are_kept_are_those_of_the_system() -> None:
    """A delay has one infinite zero and no finite one, the gain q / (q - 2) a finite one at 0."""
    delay, gain = ResidualSystem.of([[0]], [[1]], [[1]], [[0]]), ResidualSystem.of([[2]], [[2]], [[1]], [[1]])
    for _ in range(2):
        assert (pairs_by_polynomial.certified_zeros(delay).polynomial, pairs_by_polynomial.certified_zeros(delay).infinite) == (("1",), 1)
        assert (pairs_by_polynomial.certified_zeros(gain).polynomial, pairs_by_polynomial.certified_zeros(gain).infinite) == (("0", "1"), 0)


def test_what_goes_on_aside_comes_to_whoever_asks() -> None:
    """It has begun before it is asked for, in another thread; what it raises is raised where it is asked for, each time."""
    begun, go_on = threading.Event(), threading.Event()

    def waits(number: int) -> tuple[int, int]:
        begun.set()
        assert go_on.wait(20)
        return number, threading.get_ident()

    future = aside(waits, 7)
    assert begun.wait(20) and not future.done()
    go_on.set()
    number, thread = future.result(20)
    assert number == 7 and thread != threading.get_ident()
    failed = aside(int, "seven")
    for _ in range(2):
        with pytest.raises(ValueError, match="seven"):
            failed.result(20)


def test_equality_on_no_samples_needs_no_certificate(monkeypatch: pytest.MonkeyPatch) -> None:
    """Equality before the first difference is certified wherever there is a sample before it."""
    windows: list[int] = []
    make = structure_certificates.window_equality

    def noted(first: KernelRepresentation, second: KernelRepresentation, window: int) -> Certificate:
        windows.append(window)
        return make(first, second, window)

    monkeypatch.setattr(structure_certificates, "window_equality", noted)
    idle, driven = shift_registers(2)
    silent = ResidualSystem.of([[0]], [[0]], [[0], [0]], [[0], [0]])
    later, at_once, never = (alternatives.examine_pair("", *pair) for pair in ((idle, driven), (idle, silent), (idle, idle)))
    assert (later.first_difference, len(later.accepted)) == (3, 4) and windows == [2]
    assert (at_once.first_difference, len(at_once.accepted)) == (1, 3) and (never.first_difference, len(never.accepted)) == (None, 2)
