"""This groups the cases of a Monte Carlo study: its tables and its pictures are made from the groups.

Plan                 what a study does with each system, and which error it takes
StudyCases           the cases that came of a plan, with their errors
Group                the cases of one kind by one estimator: quantiles, and the median with its confidence interval
by_zeros, by_phase   the groups, by number of zeros and by minimum phase; cases_by_zeros, cases_by_phase their cases
median_interval      the distribution-free 95 % confidence interval of a median
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.special

from .study_cases import PAPER, Case, Failed

QUANTILES = (0.1, 0.25, 0.5, 0.75, 0.9)  # that a table shows
CONFIDENCE = 0.95  # of its intervals


@dataclass(frozen=True)
class Plan:
    """The plan says what a study does with its systems: `case` makes a Case of an index, a seed and a number of samples. `metric` names the
    field of `Errors` that is its error, and `worth` is the number of systems that are worth the start of a process."""

    name: str
    title: str
    metric: str
    metric_text: str
    estimators: tuple[str, ...]
    case: Callable[[int, np.random.SeedSequence, int], Case]
    worth: int


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


@dataclass(frozen=True, repr=False)
class StudyCases:
    """The cases of a study in order, with its plan, and those that could not be done; `seconds` is the time taken."""

    plan: Plan
    seed: int
    samples: int
    cases: tuple[Case, ...]
    seconds: float
    failed: tuple[Failed, ...] = ()

    def error(self, case: Case, estimator: str = PAPER) -> float | None:
        """Return the study's error of a case by an estimator; None where there is no estimate."""
        errors = case.estimates[estimator].errors
        return None if errors is None else float(getattr(errors, self.plan.metric))

    def random_error(self, case: Case) -> float:
        """Return the study's error of a random subspace."""
        return float(getattr(case.random, self.plan.metric))


def cases_by_zeros(study: StudyCases) -> dict[str, list[Case]]:
    """Return the cases by number of zeros: "0 zeros", "1 zero", ..."""
    kinds: dict[str, list[Case]] = {}
    for case in sorted(study.cases, key=lambda case: case.n_zeros):
        kinds.setdefault(f"{case.n_zeros} zero{'' if case.n_zeros == 1 else 's'}", []).append(case)
    return kinds


def cases_by_phase(study: StudyCases) -> dict[str, list[Case]]:
    """Return the cases without zeros, the minimum-phase ones, and those with a zero outside the unit circle; kinds that have a case."""
    kinds = {
        "no zeros": [case for case in study.cases if not case.zeros],
        "minimum phase": [case for case in study.cases if case.zeros and case.minimum_phase],
        "not minimum phase": [case for case in study.cases if case.zeros and not case.minimum_phase],
    }
    return {label: cases for label, cases in kinds.items() if cases}


def by_zeros(study: StudyCases) -> list[Group]:
    """Return a group for each number of zeros and each estimator."""
    return _groups(study, cases_by_zeros(study))


def by_phase(study: StudyCases) -> list[Group]:
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


def _groups(study: StudyCases, kinds: dict[str, list[Case]]) -> list[Group]:
    return [_group(study, label, cases, name) for label, cases in kinds.items() for name in study.plan.estimators]


def _group(study: StudyCases, label: str, cases: list[Case], estimator: str) -> Group:
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
