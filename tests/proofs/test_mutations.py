"""Every mutation of a certificate is rejected, or its statement is still true: decided by the slow oracle, never by us.

certificates     small ones of every kind over Q, Q(a), GF(2), GF(3), zero dimensions included
mutations        every leaf changed in several ways; every element deleted, doubled, swapped with the next; every key deleted
survivors        the mutations that a checker accepts

Of a group of certificates a third of the mutations is tried, but a thousand at least; all where FAULTSPACE_THOROUGH is set.

FAULTSPACE_FORGERIES=100000 forges so many witnesses (forgeries.py); without it 1500.
"""

from __future__ import annotations

import copy
import json
import os
from collections.abc import Iterable, Iterator
from functools import cache
from itertools import islice
from random import Random
from typing import Any

import pytest

from faultspace.exact.algebra.fields import QQ, NumberField, PrimeField
from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.structure.behavior import separation
from faultspace.exact.structure.fault_columns import fault_space
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs.evidence.specimens import specimens
from faultspace.proofs.trust import checker, checker_fields
from faultspace.proofs.trust import structure_certificates as make
from tests.oracle import premise_holds, truth
from tests.proofs.examples import by_chain, experiments, limit_certificates, lines, stable
from tests.proofs.forgeries import false_ones, unlike
from tests.thorough import every, sampled

SQRT2 = NumberField(("-2", "0", "1"))  # type: ignore[arg-type]
LEAST = 1000  # mutations of a group
CUBIC = NumberField(("1", "-3", "-1", "4"))  # type: ignore[arg-type]

SYSTEMS = {
    "relations of degree 1": ResidualSystem.of([[0]], [[1]], [[1], [0]], [[0], [1]]),
    "rational, one zero": ResidualSystem.of([["1/2"]], [[1]], [[2]], [[1]]),
    "autonomous": ResidualSystem.of([[1]], [[0]], [[1]], [[0]]),
    "over Q(sqrt 2)": ResidualSystem.of([[[0, 1]]], [[1]], [[1], [[0, "1/2"]]], [[0], [1]], field=SQRT2),
    "over a cubic field": ResidualSystem.of([[[0, 1, 0]]], [[1]], [[1]], [[[0, 0, "1/2"]]], field=CUBIC),
    "over GF(2)": ResidualSystem.of([[1]], [[1]], [[1], [0]], [[0], [1]], field=PrimeField(2)),
    "over GF(3)": ResidualSystem.of([[2]], [[1]], [[1]], [[0]], field=PrimeField(3)),
    "no states": ResidualSystem.of([], [], [[], []], [[1], [2]], n=0, m=1, p=2),
    "no faults": ResidualSystem.of([[2]], [[]], [[1]], [[]], n=1, m=0, p=1),
    "no outputs": ResidualSystem.of([[1]], [[1]], [], [], n=1, m=1, p=0),
    "degree 2": ResidualSystem.of([[0, 1], [0, 0]], [[0], [1]], [[1, 0]], [[0]]),
}


def of_one_system(system: ResidualSystem) -> Iterator[dict[str, Any]]:
    """Yield certificates of every kind that one system has."""
    kernel = kernel_representation(system)
    yield make.window_ranks(kernel)
    yield make.left_invertible(kernel)
    yield make.inversion_delay(kernel, known_state=True)
    yield make.inversion_delay(kernel, known_state=False)
    yield make.behaviour_equality(kernel, kernel)
    yield make.window_equality(kernel, kernel, 1)
    for window in (None, 1, 2):
        yield make.fault_space(kernel, fault_space(kernel, window))
    yield make.window_ranks_of(system)
    for certificate in (make.window_ranks(kernel), make.left_invertible(kernel), make.behaviour_equality(kernel, kernel)):
        if "point" in certificate["witness"]:
            yield by_chain(certificate, kernel)
    for name in ("observability", "reachability", "toeplitz", "window"):
        yield make.matrix_rank(name, system, window=2)
    x0 = Matrix.of([[1]] * system.n, system.field, shape=(system.n, 1))
    v = Matrix.of([[k * k % 3] * system.m for k in range(4)], system.field, shape=(4, system.m))
    for name in ("residual-hankel", "excitation"):
        yield make.data_rank(name, system, x0, v, 2)
    yield make.finite_zeros(system)
    yield make.infinite_zeros(system)


def of_lines_and_stable_systems() -> Iterator[dict[str, Any]]:
    """Yield certificates of lines of faults with one and two faults; stable systems with real and complex eigenvalues."""
    for field in (QQ, SQRT2, PrimeField(2), PrimeField(3)):
        yield from (make.left_invertible_line(first, second) for first, second in lines(field))
    for field in (QQ, SQRT2, CUBIC):
        yield from (make.schur_stable(system) for system in stable(field))


@cache
def every_certificate() -> list[dict[str, Any]]:
    """Return the certificates of all kinds and systems of this file, made once; nothing changes them."""
    of_one = [c for system in SYSTEMS.values() for c in of_one_system(system)]
    return [*of_one, *of_two_systems(), *of_lines_and_stable_systems(), *of_experiments()]


def of_experiments() -> Iterator[dict[str, Any]]:
    """Yield the certificates of population limits."""
    for about in experiments().values():
        yield from limit_certificates(about)


def of_two_systems() -> Iterator[dict[str, Any]]:
    """Yield certificates of inclusion and difference, over Q, Q(sqrt 2) and GF(2); and a column that only the first block column
    accepts.
    """
    for field in (QQ, SQRT2, PrimeField(2)):
        small = ResidualSystem.of([[0]], [[0]], [[1], [0]], [[0], [1]], field=field)
        large = ResidualSystem.of([[0]], [[1, 0]], [[1], [0]], [[0, 0], [0, 1]], field=field)
        yield make.behaviour_inclusion(small, kernel_representation(large))
        other = ResidualSystem.of([[1]], [[1]], [[1], [0]], [[0], [1]], field=field)
        assert separation(other, kernel_representation(small)) is not None
        yield make.behaviour_difference(other, kernel_representation(small))
        kernel = kernel_representation(ResidualSystem.of([[0]], [[1]], [[1], [0]], [[0], [1]], field=field))
        yield make.first_column_only(kernel, 2, Matrix.of([[0], [1], [0]], field))


def changed(leaf: object) -> Iterator[object]:
    """Other leaves in the place of this one."""
    if isinstance(leaf, bool):
        return
    if isinstance(leaf, int):
        yield from (leaf + 1, leaf - 1, 0, None, str(leaf))
    elif leaf is None:
        yield from (0, 1)
    elif isinstance(leaf, str):
        if leaf[:1] in "-0123456789" and leaf:
            top = leaf.split("/")[0]
            yield from ("0", "1", leaf + "/2", *(f"{number}{leaf[len(top) :]}" for number in (-int(top), int(top) + 1, 2 * int(top))))
        else:
            yield from ("", "known", "unknown", "window", "toeplitz", "Q", "past-inputs", "true-AC", "moesp", *checker.KINDS)


def mutations(node: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], Any]]:
    """Yield (path, replacement of the node at that path) for every mutation below this node."""
    if isinstance(node, dict):
        for key in node:
            yield path, {k: v for k, v in node.items() if k != key}
            yield from mutations(node[key], (*path, key))
    elif isinstance(node, list):
        for i in range(len(node)):
            yield path, node[:i] + node[i + 1 :]
            yield path, node[: i + 1] + node[i:]
            if i + 1 < len(node) and node[i] != node[i + 1]:
                yield path, [*node[:i], node[i + 1], node[i], *node[i + 2 :]]
            yield from mutations(node[i], (*path, i))
    else:
        for leaf in changed(node):
            yield path, leaf


def mutated(certificate: dict[str, Any], path: tuple[Any, ...], value: Any) -> Any:
    """Return a copy with the node at the path replaced; what is beside the path is shared."""
    if not path:
        return value
    result: Any = copy.copy(certificate)
    result[path[0]] = mutated(certificate[path[0]], path[1:], value)
    return result


def survivors(certificate: dict[str, Any], step: int = 1) -> tuple[int, list[dict[str, Any]]]:
    """Return how many mutations are tried, one in `step`, and those that the checker accepts."""
    count, found = 0, []
    for path, value in islice(mutations(certificate), 0, None, step):
        candidate = mutated(certificate, path, value)
        if candidate == certificate:
            continue
        count += 1
        try:
            checker.verify(candidate)
        except (checker.Malformed, checker.Rejected):
            continue
        found.append(candidate)
    return count, found


def falsehoods(found: list[dict[str, Any]]) -> list[str]:
    """The accepted mutations whose statement the oracle denies, or the checker does not call an assumption where it is one."""
    decided: dict[str, bool] = {}
    for candidate in found:
        key = json.dumps([candidate["kind"], candidate["statement"]], sort_keys=True)
        if key not in decided:
            if premise_holds(candidate["kind"], candidate["statement"]):
                decided[key] = truth(candidate["kind"], candidate["statement"])
            else:
                decided[key] = checker.verify(candidate).assumes != []
    return [key for key, true in decided.items() if not true]


def mutate_all(certificates: Iterable[dict[str, Any]]) -> None:
    """Every mutation of every certificate is rejected or true, and most are rejected."""
    total = accepted = 0
    group = list(certificates)
    there_are = sum(1 for certificate in group for _ in mutations(certificate))
    step = max(1, min(every(), there_are // LEAST))
    for certificate in group:
        checker.verify(certificate)
        count, found = survivors(certificate, step)
        total, accepted = total + count, accepted + len(found)
        false = falsehoods(found)
        assert false == [], f"{certificate['kind']}: of {count} mutations {len(found)} are accepted and these false: {false}"
    assert total > 500 and accepted < total / 2, f"{total} mutations, {accepted} accepted, all of them true"


@pytest.mark.parametrize("name", SYSTEMS)
def test_mutations_about_one_system_are_rejected_or_true(name: str) -> None:
    mutate_all(of_one_system(SYSTEMS[name]))


def test_mutations_about_two_systems_are_rejected_or_true() -> None:
    mutate_all(of_two_systems())


def test_mutations_about_lines_and_stability_are_rejected_or_true() -> None:
    mutate_all(of_lines_and_stable_systems())


def test_mutations_of_the_specimens_are_rejected_or_true() -> None:
    mutate_all(json.loads(json.dumps(specimens())))


@pytest.mark.parametrize("name", list(experiments())[:: every()])
def test_mutations_about_experiments_are_rejected_or_true(name: str) -> None:
    mutate_all(limit_certificates(experiments()[name]))


def test_every_kind_is_mutated() -> None:
    assert {c["kind"] for c in every_certificate()} == set(checker.KINDS)


def test_foreign_systems_are_always_rejected() -> None:
    foreign = ResidualSystem.of([[7]], [[1]], [[1]], [[1]]).to_json()
    kinds = set()
    for certificate in every_certificate():
        own = [value for key, value in certificate["statement"].items() if key in checker.SUBJECTS]
        checker.verify(certificate, own)
        for others in ([foreign], [*own, foreign]):
            with pytest.raises(checker.Rejected, match="the statement is not about"):
                checker.verify(certificate, others)
        kinds.add(certificate["kind"])
    assert kinds == set(checker.KINDS)


def test_forged_witnesses_prove_nothing_false(monkeypatch: pytest.MonkeyPatch) -> None:
    count, known = int(os.environ.get("FAULTSPACE_FORGERIES", "1500")), every_certificate()
    found, tally = false_ones(Random(count), known, count, sample=100)
    assert found == []
    assert {*tally.tried} == {*checker.KINDS} and sum(tally.accepted.values()) > count / 20 and tally.false_statements > 5
    monkeypatch.setattr(
        checker_fields.System, "unhinted", lambda *_: None
    )  # a checker without its lower bounds is fooled by the same forger
    assert false_ones(Random(count), known, 1500, sample=1)[0] != []


def test_a_checker_that_remembers_says_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    """A run keeps what it read of a system, and which rows it saw to span: no forged certificate gets through by that, or is lost."""
    count, known = int(os.environ.get("FAULTSPACE_FORGERIES", "1500")) // 2, every_certificate()
    assert unlike(Random(count), known, count) == []
    spanned_by = checker.System.spanned_by

    def careless(self: checker.System, *args: Any) -> None:
        if not self.spanned:
            spanned_by(self, *args)

    monkeypatch.setattr(checker.System, "spanned_by", careless)
    assert unlike(Random(count), known, count) != []


# Refusals of the checker, each taken out in turn: by part of its reason, with a kind where a false mutation then gets through.
REFUSALS = {
    "does not annihilate the system": "behaviour-equality",
    "the bounds do not meet": "window-ranks",
    "are not the degrees of the rows": "window-ranks",
    "window_ranks do not follow": "window-ranks",
    "stays below the number of faults": "left-invertible",
    "the minors may have a common zero": "left-invertible-line",
    "an eigenvalue is not inside the unit circle": "schur-stable",
    "the covariance does not solve the Lyapunov equation": "input-limit",
    "the series does not solve its equation": "input-limit",
    "the response is not that of the future inputs": "input-limit",
    "the normal equations fail": "input-limit",
    "C x(q) + G v(q) = 0 fails": "not-left-invertible",
    "the left inverse does not give v(0)": "inversion-delay",
    "the output of the ambiguous word is not zero": "inversion-delay",
    "a basis column does not solve problem (11)": "fault-space",
    "more solutions than the basis spans": "fault-space",
    "a left null row does not vanish": "matrix-rank",
    "the rank modulo the prime is smaller": "matrix-rank",
    "the multipliers do not give the diagonal": "finite-zeros",
    "the word satisfies the row": "behaviour-difference",
}


@pytest.mark.parametrize("refusal", sampled(REFUSALS, 10))
def test_a_checker_without_one_of_its_refusals_lets_something_false_through(refusal: str, monkeypatch: pytest.MonkeyPatch) -> None:
    strict = checker.require

    def lenient(condition: object, reason: str, error: type[Exception] = checker.Rejected) -> None:
        if refusal not in reason:
            strict(condition, reason, error)

    kind = REFUSALS[refusal]
    certificates = every_certificate()
    monkeypatch.setattr(checker, "require", lenient)
    assert any(falsehoods(survivors(c)[1]) for c in certificates if c["kind"] == kind)
