"""This is the Monte Carlo study of the paper: how far the estimated fault space lies from the true one, over many random systems.

    monte_carlo          a plan carried out: a Study
    PUBLISHED            the published settings and metric: s = 5, rank R_s taken as n_x + s n_v - zeros, noise "of 40 dB" that is 43 dB
                         down, error = angles between [F; G] and the estimate over n_v pi/2
    IDENTIFIED           as published, but with A, B, C, D from PI-MOESP on the same data in place of the true ones
    CORRECTED            s = 6, beyond the lag of every case; noise that is 40 dB down; error = two-sided distance between the true fault
                         space and the estimate over its maximum; the library's estimator beside the published one
    CORRECTED_IDENTIFIED as corrected, with A, B, C, D identified by PI-MOESP; beside it what `identify` does, with a model of its own
    STUDIES              these plans by name
    check_memory         refuses more systems or samples than memory holds
    Study                what came of a plan: a Case for each system, read by people, programs and notebooks
    done_by              each result of tasks as it comes, whoever worked on it

What is wrong with the published numbers, and how a case says so. With no zeros rank R_5 = 15 of 15 rows: there is no null row, every
column is a solution, and [F; G] lies in all of R^8. Such a case is marked `vacuous`: its error is zero by construction, for any data.
The normaliser n_v pi/2 exceeds the metric's maximum sqrt(n_v) pi/2, so that no error can reach 71 %. The metric measures containment
alone. So each case carries the errors by three metrics, and those of a random subspace of the same dimension.

What the published program gives. Run as it stands on 2000 systems it has medians of 3.9, 0.92 and 1.04 % for 1, 2, 3 zeros under Octave;
a quarter of its "three zeros" then have four. Its generator plants two zeros in one fault, asks a zero finder whether three came out,
and where not plants one more. They always do (`random_systems.py`); but Octave's finder, which takes no tolerance, misses them in a quarter
of the draws, and the rank is then one too high. With a finder put in its place that counts zeros at a relative tolerance of 1e-9 (the
program asks for 1e-10), there are three in all of 400 and the median is 0.65 %. On the program's data this package's estimates have its
errors to 1e-12. The author's own plot, of 25 systems each, shows medians of about 2.3, 1.7 and 0.9 %: within sampling error of either;
which finder's behaviour his MATLAB had is not known.

Every system has a seed of its own, spawned from the study's: a case does not depend on the number of workers, a longer study begins
with the cases of a shorter one, and all studies see the same systems and faults. Source: [G25] section V; [YL16].
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, TypeVar

import numpy as np
import psutil

from ...base.errors import InvalidData, shorten
from ...base.progress import Progress, silent
from ...base.sheets import Shown, counted
from ...base.tasks import Died, Task, Tasks, as_they_come, processes
from ..data.plain import by_name
from ..data.validation import positive
from .groups import Group, Plan, StudyCases, by_phase, by_zeros
from .plots import errors_by_zeros
from .runs import SAMPLES
from .study_cases import (
    LAWS,
    LIKELIHOOD,
    PAPER,
    Case,
    Failed,
    attempted,
    corrected_case,
    corrected_identified_case,
    identified_case,
    published_case,
)

SEED = 1907
CASE_BYTES = 1 << 12
"""No case of a study takes more memory; `tests/numeric/test_study_memory.py` measures it."""
SAMPLE_BYTES = 1 << 14
"""No record takes more for each of its samples while a case is made of it; measured there as well."""

_CONTAINMENT = "angles from [F; G] to the estimate (containment) over n_v pi/2; at most 71 %"
_TWO_SIDED = "two-sided distance between the true fault space and the estimate, over its maximum"
_BOTH = (PAPER, LIKELIHOOD)
PUBLISHED = Plan(
    "published", "as published: s = 5, true A, B, C, D, noise 43 dB down", "published", _CONTAINMENT, (PAPER,), published_case, 1000
)
IDENTIFIED = Plan(
    "identified", "identified: s = 5, A, B, C, D by PI-MOESP, noise 43 dB down", "published", _CONTAINMENT, (PAPER,), identified_case, 40
)
CORRECTED = Plan("corrected", "as corrected: s = 6, true A, B, C, D, noise 40 dB down", "two_sided", _TWO_SIDED, _BOTH, corrected_case, 20)
CORRECTED_IDENTIFIED = Plan(
    "corrected-identified",
    "corrected and identified: s = 6, A, B, C, D by PI-MOESP (laws: by reduction), noise 40 dB down",
    "two_sided",
    _TWO_SIDED,
    (*_BOTH, LAWS),
    corrected_identified_case,
    20,
)
STUDIES = {plan.name: plan for plan in (PUBLISHED, IDENTIFIED, CORRECTED, CORRECTED_IDENTIFIED)}


@dataclass(frozen=True, repr=False)
class Study(StudyCases, Shown):
    """The study is a plan carried out on so many systems: `cases` in order, `failed` for those that could not be done, `seed`, `samples` of
    each record, `seconds` taken.

    `summary()` tells people the errors, `plot()` draws them, and `to_json()` hands everything to other programs. Raises ImportError in
    `plot()` without matplotlib. Source: [G25] section V.
    """

    @property
    def title(self) -> str:
        """Return what the study is, on one short line."""
        return f"Monte Carlo study, {self.plan.name}: {len(self.cases)} system{'' if len(self.cases) == 1 else 's'}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield what there is to say of it, as pairs of a name and a value: the settings, then a line for each group of cases."""
        yield "plan", self.plan.title
        yield "error", self.plan.metric_text
        yield "records", f"{self.samples} samples each, seed {self.seed}"
        if self.failed:
            yield "failed", f"{counted(len(self.failed), 'case')}, the first because: {self.failed[0].reason}"
        for heading, groups in (("errors by number of finite zeros", by_zeros(self)), ("errors by phase", by_phase(self))):
            yield heading, ""
            for group in groups:
                yield f"{group.label}, {group.estimator}", _in_words(group)

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready record: settings, tables, cases. Equal studies give equal records."""
        rows: dict[str, Any] = {"by_zeros": by_zeros(self), "by_phase": by_phase(self), "cases": self.cases, "failed": self.failed}
        return {
            **by_name(self.plan, "name", "title", "metric", "metric_text", "estimators"),
            **by_name(self, "seed", "samples"),
            "systems": len(self.cases) + len(self.failed),
            "vacuous": sum(case.vacuous for case in self.cases),
            **{name: [asdict(row) for row in several] for name, several in rows.items()},
        }

    def plot(self, ax: Any = None) -> Any:
        """Draw the errors by number of finite zeros into the matplotlib axes `ax`, new ones where None are given, and return them. Raises
        ImportError without matplotlib."""
        return errors_by_zeros(self, ax)


def monte_carlo(
    plan: Plan | str,
    *,
    systems: int = 100,
    seed: int = SEED,
    samples: int = SAMPLES,
    jobs: int | None = None,
    cluster: str | None = None,
    known: Mapping[int, Case] | None = None,
    on_cases: Callable[[Sequence[Case | Failed]], None] | None = None,
    on_progress: Progress | None = None,
) -> Study:
    """Run the paper's Monte Carlo study: how far the estimated fault space lies from the true one, over many random systems.

    `plan` is one of PUBLISHED, IDENTIFIED, CORRECTED and CORRECTED_IDENTIFIED, or its name in `STUDIES`: "published", "identified",
    "corrected", "corrected-identified". `systems` random systems are drawn, a quarter for each number of zeros from 0 to 3, with records of
    `samples` samples each; equal seeds give equal cases. `jobs` processes share the work (None: all cores, as far as they are worth their
    start), or the Dask cluster whose scheduler is at the address `cluster`; the results are the same. `on_progress` is called with (name
    of the plan, done, total) as cases come in, and `on_cases` with the cases themselves, in the order in which they come, so that they can
    be kept; what was kept of a study with the same plan, seed and samples is `known`, by index, and not done again. The Study has `cases`,
    whose errors are fractions of the metric's maximum, `summary()`, `plot()` and `to_json()`.
    Source: [G25] section V; [YL16] for the distances.

    A process that is killed is replaced, and its cases are done again. A case that raises, or whose process ends each time, is one of
    `failed`, with the reason.

    Raises InvalidData for an unknown plan, for numbers out of range, for more than memory holds, and for a cluster that cannot be used.

    >>> import faultspace as fs
    >>> study = fs.monte_carlo("published", systems=4, samples=200, jobs=1)
    >>> len(study.cases), study.plan.name
    (4, 'published')
    """
    if isinstance(plan, str):
        if plan not in STUDIES:
            raise InvalidData(f"plan: got {plan!r}; one of {', '.join(STUDIES)} is needed")
        plan = STUDIES[plan]
    if not isinstance(plan, Plan):
        raise InvalidData(f"plan: got {shorten(plan)}; one of {', '.join(STUDIES)} is needed")
    systems, samples = positive(systems, "systems"), positive(samples, "samples")
    if samples < 2:
        raise InvalidData(f"samples: got {samples}; noise relative to a standard deviation needs 2 or more")
    if seed < 0:
        raise InvalidData(f"seed: got {seed}; a whole number from 0 on is needed")
    start = time.perf_counter()
    found: dict[int, Case | Failed] = {index: case for index, case in (known or {}).items() if 0 <= index < systems}
    check_memory(systems, samples)
    left = [index for index in range(systems) if index not in found]
    heard = on_progress or silent
    heard(plan.name, len(found), systems)
    for k, came in done_by(attempted, _Cases(plan, seed, samples, left), worth=plan.worth, jobs=jobs, cluster=cluster):
        one = Failed(left[k], came.reason) if isinstance(came, Died) else came
        if on_cases is not None:
            on_cases([one])
        found[one.index] = one
        heard(plan.name, len(found), systems)
    each = [found[index] for index in range(systems)]
    cases, failed = tuple(one for one in each if isinstance(one, Case)), tuple(one for one in each if isinstance(one, Failed))
    return Study(plan, seed, samples, cases, time.perf_counter() - start, failed)


@dataclass(frozen=True)
class _Cases:
    """The tasks of a study: the cases with these indices, whose seeds are made when they are asked for."""

    plan: Plan
    seed: int
    samples: int
    indices: Sequence[int]

    def __len__(self) -> int:
        return len(self.indices)

    def __getitem__(self, number: int) -> Task:
        index = self.indices[number]
        # What SeedSequence(seed).spawn gives each of them, without the others.
        return self.plan.case, index, np.random.SeedSequence(self.seed, spawn_key=(index,)), self.samples


def check_memory(systems: int, samples: int, plans: int = 1) -> None:
    """Raise InvalidData where the cases of so many plans, or a record, may need more memory than there is."""
    there = psutil.virtual_memory().available
    for name, count, each in (("systems", systems, CASE_BYTES * plans), ("samples", samples, SAMPLE_BYTES)):
        if count * each > there:
            most = there // each
            raise InvalidData(
                f"{name}: got {count}, which may take {count * each / 2**30:.3g} GB of memory, of which {there / 2**30:.3g} are free; ask "
                f"for {most} at most" + (", and for the others with another seed" if name == "systems" else "")
            )


def _in_words(group: Group) -> str:
    """Return what the errors of a group are: the median with what surrounds it, or why there are none."""
    systems = f"{group.cases} system{'' if group.cases == 1 else 's'}"
    if group.quantiles is None:
        return f"{systems}, all refused"
    if group.vacuous == group.cases:
        return f"{systems}, all vacuous: no null row, the error is zero by construction"
    low, *_, high = group.quantiles
    said = [f"{systems}, median {_percent(group.median)}, 10 % and 90 % quantiles {_percent(low)} and {_percent(high)}"]
    if group.interval is not None:
        said.append(f"the median lies in {_percent(group.interval[0])} .. {_percent(group.interval[1])} with 95 % confidence")
    said.append(f"a random subspace has {_percent(group.random_median)}")
    said.append(f"dimension right in {group.right_dimension}")
    said += [f"{count} {what}" for count, what in ((group.vacuous, "vacuous"), (group.failed, "refused")) if count]
    return "; ".join(said)


def _percent(value: float | None) -> str:
    return "unknown" if value is None else f"{100 * value:.2g} %"


Result = TypeVar("Result")


def done_by(
    function: Callable[..., Result], tasks: Tasks, *, worth: int, jobs: int | None = None, cluster: str | None = None
) -> Iterator[tuple[int, Result | Died]]:
    """Yield the number of each task with function(*task), as it comes; `jobs` processes (None: all cores), or the workers of the Dask
    scheduler at the address `cluster`.

    Raises InvalidData for numbers below one, for a cluster and jobs at once, and for a cluster that cannot be used.
    """
    if cluster is not None and jobs is not None:
        raise InvalidData(f"jobs: got {jobs} together with a cluster, which decides for itself; leave one of them out")
    count = processes(-1) if jobs is None else positive(jobs, "jobs")
    return as_they_come(function, tasks, count=min(count, -(-len(tasks) // worth)), cluster=cluster)
