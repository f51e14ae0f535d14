"""States and faults without output explain what windows lack: true certificates pass, false ones do not, and each check is needed."""

from __future__ import annotations

import copy
from random import Random

import pytest

from benchmarks.ladder_systems import FAMILIES
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.system.systems import ResidualSystem, read_system
from faultspace.proofs.rocq.export import translated
from faultspace.proofs.trust import checker
from faultspace.proofs.trust import structure_certificates as make
from tests.proofs.basis_mutants import is_true, needed, random_system
from tests.proofs.examples import Certificate, written

PRIME = 2**27 - 39
HIDDEN = ResidualSystem.of([[0]], [[1]], [[PRIME], [0]], [[0], [1]])  # modulo the prime no output shows the state
DEAF = ResidualSystem.of([], [], [[]], [[PRIME]], n=0, m=1, p=1)  # and none the fault
BOTH = read_system({"A": [[1, 1], [0, 2]], "F": [[0, 3], [1, 0]], "C": [[0, 1], [0, 0]], "G": [[0, 0], [1, 0]]}).residual


def stated(system: ResidualSystem) -> Certificate | None:
    """Return the certificate with what is nulled, of a system of any size."""
    found = make.window_ranks_of(system)
    return written(found) if "nulling" in found["witness"] else None


def forged(system: ResidualSystem, row: list[list[int]], states: list[list[int]], faults: list[list[int]]) -> Certificate:
    """Return the certificate that states and faults would give which are zero, or have an output."""
    mu, count = len(row) - 1, system.n + 3
    ranks = [k * (system.p - 1) + min(k, mu) for k in range(1, count + 1)]
    statement = {"system": system.to_json(), "normal_rank": system.p - 1, "left_minimal_indices": [mu], "window_ranks": ranks}
    nulling = {"states": states, "faults": faults, "motion": [[0] * len(states) for _ in faults]}
    witness = {"prime": PRIME, "point": 5, "kernel_modulo": [{"pivot": 0, "coefficients": row}], "nulling": nulling}
    return written({"format": "faultspace-certificate/1", "kind": "window-ranks", "statement": statement, "witness": witness})


# The reason that is left out -> a false statement that then passes.
NEEDED = {
    "has an output, or leaves the states": forged(HIDDEN, [[1, 0]], [[1]], [[0]]),
    "the states of nulling may be dependent": forged(HIDDEN, [[1, 0]], [[0]], [[0]]),
    "the faults of nulling may be dependent": forged(DEAF, [[1]], [], [[0]]),
}


@pytest.mark.parametrize("reason", NEEDED)
def test_without_one_of_the_checks_something_false_passes(reason: str, monkeypatch: pytest.MonkeyPatch) -> None:
    needed(NEEDED[reason], reason, monkeypatch)


def test_true_ones_are_accepted_and_changed_ones_are_refused_or_true() -> None:
    rng, accepted, refused, d_or_e = Random(16), 0, 0, set[tuple[bool, bool]]()
    for _ in range(600):
        certificate = stated(random_system(rng))
        if certificate is None:
            continue
        checker.verify(certificate)
        assert is_true(certificate["statement"])
        null = certificate["witness"]["nulling"]
        d_or_e.add((bool(null["states"]), len(null["faults"]) > len(null["states"])))
        accepted += 1
        for _ in range(3):
            mutant = copy.deepcopy(certificate)
            w = mutant["witness"]["nulling"]
            rows = [row for key in ("states", "faults", "motion") for row in w[key] if row]
            if rows and rng.random() < 0.7:
                row = rng.choice(rows)
                row[rng.randrange(len(row))] = rng.choice((0, 1, -2, "1/2", PRIME))
            elif w["faults"]:
                del w["faults"][-1], w["motion"][-1]
            try:
                checker.verify(mutant)
            except (checker.Rejected, checker.Malformed):
                refused += 1
            else:
                assert is_true(mutant["statement"])
    assert accepted > 80 and refused > 100 and d_or_e == {(True, True), (True, False), (False, True)}


def test_planted_subspaces_are_found_in_every_family() -> None:
    for family in FAMILIES[2:]:
        for n in (4, 8, 24):
            certificate = written(make.window_ranks_of(read_system(family.specimen(n).to_json()).residual))
            assert len(certificate["witness"]["nulling"]["states"]) == n // 2
            checker.verify(certificate)


def test_each_kind_of_state_and_fault_counts() -> None:
    certificate = stated(BOTH)
    assert certificate is not None
    null = certificate["witness"]["nulling"]
    assert (len(null["states"]), len(null["faults"])) == (1, 2)
    assert checker.verify(certificate).assumes == []
    assert is_true(certificate["statement"])


def test_rocq_gets_exact_rows_in_their_place() -> None:
    certificate = stated(BOTH)
    assert certificate is not None
    exact = written(make.window_ranks(kernel_representation(BOTH)))
    assert translated(certificate) == translated(exact)
