"""Each broken implementation is caught by the check that is named for it; the matrix of mutants against checks is printed (-s)."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from faultspace.numeric.audit.adapter import ZeroStructure
from faultspace.numeric.audit.checks.catalogue import all_checks
from faultspace.numeric.audit.records import Demand
from faultspace.numeric.audit.running import audit
from faultspace.numeric.audit.vectors.shipped_vectors import shipped
from tests.numeric.audit.breaking import Mutant
from tests.numeric.audit.manner_mutants import CORES
from tests.numeric.audit.mutants import MUTANTS, REFUSES
from tests.numeric.audit.unseen.table import kept
from tests.thorough import THOROUGH

NAMED = [(mutant, slug) for mutant in MUTANTS for slug in (mutant.caught_by, *mutant.also)]
# Of each kind of check, which the first two words of a slug tell, one mutant is asked daily, here or among the unseen.
DAILY = {"-".join(slug.split("-")[:2]): (mutant.name, slug) for mutant, slug in reversed(NAMED)}


def _marks(mutant: Mutant, slug: str) -> list[pytest.MarkDecorator]:
    daily = (mutant.name, slug) in DAILY.values()
    alone = mutant.name == "one-core" and CORES < 2
    return [pytest.mark.mutants] * (not daily) + [pytest.mark.skipif(alone, reason="one core")] * alone


@pytest.mark.parametrize(
    ("mutant", "slug"), [pytest.param(one, slug, id=f"{one.name}-{slug}", marks=_marks(one, slug)) for one, slug in NAMED]
)
def test_the_named_check_catches_it(mutant: Mutant, slug: str) -> None:
    # A noisy record takes a second: one of them shows it.
    records = audit(mutant.adapter, only=[f"{slug}[one-fault-in-noise]" if "noisy" in slug and not THOROUGH else slug])
    failed = [record for record in records if record.failed]
    print(f"{mutant.name}: {len(failed)} of {len(records)} {slug}: {', '.join(record.vector for record in failed)}")
    assert failed, mutant.wrong
    # What writes into a read-only array is stopped, as is who finds what is no number, or every other sample.
    stopped = mutant.name in ("changed-and-restored", "strides-ignored", "thinned", *REFUSES)
    assert ("refused" if stopped else "fail") in {record.verdict for record in failed}


@pytest.mark.parametrize(
    ("name", "plain"),
    [
        ("floor-of-a-range", "fault-space"),
        ("ranks-padded", "window-ranks"),
        ("count-padded", "fault-dimension"),
        ("space-padded", "fault-space"),
        ("unsuspecting", "fault-space"),
        ("square-memory", "exact-recovery"),
        ("square-time", "window-ranks"),
        ("limited-range", "exact-recovery"),
        ("residual-rounded", "residual-free-of-input"),
        ("signal-limited", "fault-signal"),
    ],
)
def test_the_plain_check_would_not_have_seen_it(name: str, plain: str) -> None:
    (mutant,) = (one for one in MUTANTS if one.name == name)
    (record,) = audit(mutant.adapter, only=[f"{plain}[{'n2-u1-p1' if plain == 'exact-recovery' else 'one-fault'}]"])
    assert not record.failed


def _answers_everything() -> SimpleNamespace:
    """This gives some answer of the right kind whatever the question."""
    return SimpleNamespace(
        identify=lambda y, u, order, block_rows: (
            np.eye(max(order, 1)) / 2,
            np.ones((max(order, 1), u.shape[1])),
            np.ones((y.shape[1], max(order, 1))),
            np.ones((y.shape[1], u.shape[1])),
        ),
        residual=lambda y, u, A, B, C, D: y,
        window_ranks=lambda r, windows: [r.shape[1]] * windows,
        fault_dimension=lambda r: 1,
        fault_space=lambda r, A, C, n_v, block_rows: np.eye(len(A) + len(C))[:, :n_v],
        reconstruct=lambda r, A, F, C, G, x0: np.zeros((len(r), F.shape[1])),
        structure=lambda A, F, C, G: ZeroStructure(1, [], [0], True),
        count_faults=lambda y, u, order: 1,
        identified_fault_space=lambda y, u, order, n_v: (
            np.eye(max(order, 1)) / 2,
            np.ones((y.shape[1], max(order, 1))),
            np.eye(max(order, 1) + y.shape[1])[:, :n_v],
        ),
    )


REFUSALS = sorted({check.slug for check in all_checks() if check.slug.startswith("refuses-")})


def test_who_answers_everything_fails_every_check_that_takes_a_refusal() -> None:
    records = audit(_answers_everything(), only=REFUSALS)
    assert {record.slug for record in records} == set(REFUSALS)
    assert {record.verdict for record in records} == {"fail"}


def test_every_must_is_seen_to_fail() -> None:
    """Each is caught by a mutant, by one whose writer had not seen the checks, or by an implementation that answers everything."""
    assert len({mutant.name for mutant in MUTANTS}) == len(MUTANTS)
    musts = {check.slug for check in all_checks() if check.kind is not Demand.FREE}
    assert musts == {slug for _, slug in NAMED} | {name.partition("[")[0] for name in kept().values()} | set(REFUSALS)


def test_an_absolute_threshold_is_right_in_the_units_that_it_was_made_for() -> None:
    """What the check sees is the units: the same method passes at one scale and gives all of R^(n+p) at another."""
    (mutant,) = (one for one in MUTANTS if one.name == "space-at-1e-9")
    (here,) = audit(mutant.adapter, only=["fault-space[one-fault]"])
    assert not here.failed
    (there,) = audit(mutant.adapter, only=["fault-space-1e6[one-fault]"])
    (vector,) = (one for one in shipped("faults") if one.slug == "one-fault")
    assert there.failed and there.quantity == "dimension of the fault space"
    assert there.got == vector.system.n + vector.system.p - vector.space.ncols
