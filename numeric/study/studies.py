"""This is the Monte Carlo study of the paper: how far the estimated fault space lies from the true one, over many random systems.

    monte_carlo            a plan carried out: a Study
    PUBLISHED            the published settings and metric: s = 5, rank R_s taken as n_x + s n_v - zeros, noise "of 40 dB" that is 43 dB
                         down, error = angles between [F; G] and the estimate over n_v pi/2
    IDENTIFIED           as published, but with A, B, C, D from PI-MOESP on the same data in place of the true ones
    CORRECTED            s = 6, beyond the lag of every case; noise that is 40 dB down; error = two-sided distance between the true fault
                         space and the estimate over its maximum; the library's estimator beside the published one
    CORRECTED_IDENTIFIED as corrected, with identified A, B, C, D
    STUDIES              these plans by name
    Plan, Study          the records: what to do, and what came of it, a Case (`study_cases`) for each system
    Group                the cases of one kind by one estimator: quantiles, and the median with its confidence interval
    by_zeros, by_phase   a study's groups, by number of zeros and by minimum phase; cases_by_zeros, cases_by_phase their cases
    median_interval      the distribution-free 95 % confidence interval of a median

What is wrong with the published numbers, and how a case says so. With no zeros rank R_5 = 15 of 15 rows: there is no null row, every
column is a solution, and [F; G] lies in all of R^8. Such a case is marked `vacuous`: its error is zero by construction, for any data.
The normaliser n_v pi/2 exceeds the metric's maximum sqrt(n_v) pi/2, so that no error can reach 71 %. The metric measures containment
alone. So each case carries the errors by three metrics, and those of a random subspace of the same dimension.

What the published program gives. Run as it stands on 2000 systems it has medians of 3.9, 0.92 and 1.04 % for 1, 2, 3 zeros under Octave;
a quarter of its "three zeros" then have four. Its generator plants two zeros in one fault, asks a zero finder whether three came out,
and where not plants one more. They always do (`study_systems`); but Octave's finder, which takes no tolerance, misses them in a quarter
of the draws, and the rank is then one too high. With a finder put in its place that counts zeros at a relative tolerance of 1e-9 (the
program asks for 1e-10), there are three in all of 400 and the median is 0.65 %. On the program's data this package's estimates have its
errors to 1e-12. The author's own plot, of 25 systems each, shows medians of about 2.3, 1.7 and 0.9 %: within sampling error of either;
which finder's behaviour his MATLAB had is not known.

Every system has a seed of its own, spawned from the study's: a case does not depend on the number of workers, a longer study begins
with the cases of a shorter one, and all studies see the same systems and faults. Source: [G25] section V; [YL16].
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import scipy.special

from ...base.errors import InvalidData
from ..data.validation import positive
from .cases import LIKELIHOOD, PAPER, Case, corrected_case, corrected_identified_case, identified_case, published_case
from .runs import SAMPLES
from .workers import Progress, in_order

SEED = 1907
QUANTILES = (0.1, 0.25, 0.5, 0.75, 0.9)
CONFIDENCE = 0.95


@dataclass(frozen=True)
class Plan:
    """The plan says what a study does with each system. `metric` names the field of `Errors` that is its error, and `worth` is the
    number of systems that are worth the start of a process."""

    name: str
    title: str
    metric: str
    metric_text: str
    estimators: tuple[str, ...]
    case: Callable[[int, np.random.SeedSequence, int], Case]
    worth: int


_CONTAINMENT = "angles from [F; G] to the estimate (containment) over n_v pi/2; at most 71 %"
_TWO_SIDED = "two-sided distance between the true fault space and the estimate, over its maximum"
_BOTH = (PAPER, LIKELIHOOD)
PUBLISHED = Plan(
    "published", "as published: s = 5, true A, B, C, D, noise 43 dB down", "published", _CONTAINMENT, (PAPER,), published_case, 300
)
IDENTIFIED = Plan(
    "identified", "identified: s = 5, A, B, C, D by PI-MOESP, noise 43 dB down", "published", _CONTAINMENT, (PAPER,), identified_case, 40
)
CORRECTED = Plan("corrected", "as corrected: s = 6, true A, B, C, D, noise 40 dB down", "two_sided", _TWO_SIDED, _BOTH, corrected_case, 20)
CORRECTED_IDENTIFIED = Plan(
    "corrected-identified",
    "corrected and identified: s = 6, A, B, C, D by PI-MOESP, noise 40 dB down",
    "two_sided",
    _TWO_SIDED,
    _BOTH,
    corrected_identified_case,
    20,
)
STUDIES = {plan.name: plan for plan in (PUBLISHED, IDENTIFIED, CORRECTED, CORRECTED_IDENTIFIED)}


@dataclass(frozen=True)
class Group:
    """The group holds the cases of one kind by one estimator; a field is None where there is nothing to report.

    It says how many cases there are and how many of them are vacuous, have no error, or have the true dimension; the quantiles 10, 25, 50,
    75, 90 % of the error with the confidence interval of its median; the median by containment alone, over that metric's own maximum (it is
    low where the estimate holds [F; G] but has a wrong dimension); and the median of a random subspace.
    """

    label: str
    estimator: str
    cases: int
    vacuous: int
    failed: int
    right_dimension: int
    quantiles: tuple[float, ...] | None
    interval: tuple[float, float] | None
    containment_median: float | None
    random_median: float

    @property
    def median(self) -> float | None:
        """Return the median of the error, as a fraction."""
        return None if self.quantiles is None else self.quantiles[QUANTILES.index(0.5)]


@dataclass(frozen=True)
class Study:
    """Cases in order; `seconds` is the time taken."""

    plan: Plan
    seed: int
    samples: int
    cases: tuple[Case, ...]
    seconds: float

    def error(self, case: Case, estimator: str = PAPER) -> float | None:
        """Return the study's error of a case by an estimator; None where there is no estimate."""
        errors = case.estimates[estimator].errors
        return None if errors is None else float(getattr(errors, self.plan.metric))

    def random_error(self, case: Case) -> float:
        """Return the study's error of a random subspace."""
        return float(getattr(case.random, self.plan.metric))

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready record: settings, tables, cases. Equal studies give equal records but for "seconds"."""
        plan = self.plan
        return {
            "name": plan.name,
            "title": plan.title,
            "metric": plan.metric,
            "metric_text": plan.metric_text,
            "estimators": list(plan.estimators),
            "seed": self.seed,
            "samples": self.samples,
            "systems": len(self.cases),
            "vacuous": sum(case.vacuous for case in self.cases),
            "seconds": round(self.seconds, 3),
            "by_zeros": [asdict(group) for group in by_zeros(self)],
            "by_phase": [asdict(group) for group in by_phase(self)],
            "cases": [asdict(case) for case in self.cases],
        }


def monte_carlo(
    plan: Plan | str,
    *,
    systems: int = 100,
    seed: int = SEED,
    samples: int = SAMPLES,
    jobs: int | None = None,
    cluster: str | None = None,
    on_progress: Progress | None = None,
) -> Study:
    """Run the paper's Monte Carlo study: how far the estimated fault space lies from the true one, over many random systems.

    `plan` is one of PUBLISHED, IDENTIFIED, CORRECTED and CORRECTED_IDENTIFIED, or its name in `STUDIES`: "published", "identified",
    "corrected", "corrected-identified". `systems` random systems are drawn, a quarter for each number of zeros from 0 to 3, with records of
    `samples` samples each; equal seeds give equal cases. `jobs` processes share the work (None: all cores, as far as they are worth their
    start), or the Dask cluster whose scheduler is at the address `cluster`; the results are the same. `on_progress` is called with (done,
    total, seconds left) as cases come in. The Study has `cases`, whose errors are fractions of the metric's maximum, and `to_json()`.
    Source: [G25] section V; [YL16] for the distances.

    Raises InvalidData for an unknown plan, for numbers out of range and for a cluster that cannot be used.

    >>> import faultspace as fs
    >>> study = fs.monte_carlo("published", systems=4, samples=200, jobs=1)
    >>> len(study.cases), study.plan.name
    (4, 'published')
    """
    if isinstance(plan, str):
        if plan not in STUDIES:
            raise InvalidData(f"plan: got {plan!r}; one of {', '.join(STUDIES)} is needed")
        plan = STUDIES[plan]
    systems, samples = positive(systems, "systems"), positive(samples, "samples")
    if seed < 0:
        raise InvalidData(f"seed: got {seed}; a whole number from 0 on is needed")
    start = time.perf_counter()
    tasks = [(index, child, samples) for index, child in enumerate(np.random.SeedSequence(seed).spawn(systems))]
    cases = in_order(plan.case, tasks, worth=plan.worth, jobs=jobs, cluster=cluster, progress=on_progress)
    return Study(plan, seed, samples, tuple(cases), time.perf_counter() - start)


def cases_by_zeros(study: Study) -> dict[str, list[Case]]:
    """Return the cases by number of zeros: "0 zeros", "1 zero", ..."""
    kinds: dict[str, list[Case]] = {}
    for case in sorted(study.cases, key=lambda case: case.n_zeros):
        kinds.setdefault(f"{case.n_zeros} zero{'' if case.n_zeros == 1 else 's'}", []).append(case)
    return kinds


def cases_by_phase(study: Study) -> dict[str, list[Case]]:
    """Return the cases without zeros, the minimum-phase ones, and those with a zero outside the unit circle; kinds that have a case."""
    kinds = {
        "no zeros": [case for case in study.cases if not case.zeros],
        "minimum phase": [case for case in study.cases if case.zeros and case.minimum_phase],
        "not minimum phase": [case for case in study.cases if case.zeros and not case.minimum_phase],
    }
    return {label: cases for label, cases in kinds.items() if cases}


def by_zeros(study: Study) -> list[Group]:
    """Return a group for each number of zeros and each estimator."""
    return _groups(study, cases_by_zeros(study))


def by_phase(study: Study) -> list[Group]:
    """Return a group for each kind of phase and each estimator."""
    return _groups(study, cases_by_phase(study))


def median_interval(values: list[float]) -> tuple[float, float] | None:
    """Return the order statistics between which the median lies with a probability of 95 % or more, whatever the distribution; None for
    fewer than six values, which have no such pair."""
    count = len(values)
    below = scipy.special.bdtr(np.arange(count), count, 0.5)  # P(at most k values lie below the median)
    k = int(np.sum(below <= (1 - CONFIDENCE) / 2))
    ordered = sorted(values)
    return (ordered[k - 1], ordered[count - k]) if k else None


def _groups(study: Study, kinds: dict[str, list[Case]]) -> list[Group]:
    return [_group(study, label, cases, name) for label, cases in kinds.items() for name in study.plan.estimators]


def _group(study: Study, label: str, cases: list[Case], estimator: str) -> Group:
    errors = [error for case in cases if (error := study.error(case, estimator)) is not None]
    contained = [found.containment for case in cases if (found := case.estimates[estimator].errors) is not None]
    return Group(
        label=label,
        estimator=estimator,
        cases=len(cases),
        vacuous=sum(case.vacuous for case in cases),
        failed=len(cases) - len(errors),
        right_dimension=sum(case.estimates[estimator].n_z == case.n_z for case in cases),
        quantiles=tuple(float(value) for value in np.quantile(errors, QUANTILES)) if errors else None,
        interval=median_interval(errors),
        containment_median=float(np.median(contained)) if contained else None,
        random_median=float(np.median([study.random_error(case) for case in cases])),
    )
