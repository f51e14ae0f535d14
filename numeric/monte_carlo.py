"""The Monte Carlo study of the paper: how far the estimated fault space lies from the true one, over many random systems.

    study_as_published          the published settings and metric: s = 5, rank R_s taken as n_x + s n_v - zeros, noise "of 40 dB" that is
                                43 dB down, error = angles between [F; G] and the estimate over n_v pi/2
    study_as_corrected          s = 6, beyond the lag of every case; noise that is 40 dB down; error = two-sided distance between the true
                                fault space and the estimate over its maximum
    study_with_identified_model as published, but with A, B, C, D from PI-MOESP on the same data in place of the true ones
    STUDIES                     these functions by name
    Study, Case, Errors         the records: a study, one of its systems, the errors of one estimate
    Group, by_zeros, by_phase   medians and quantiles of a study's cases, by number of zeros and by minimum phase
    null_rows_estimate          the published estimator: the n_z columns that best satisfy N_s T_s(z) = 0

What is wrong with the published numbers, and how a case says so. With no zeros rank R_5 = 15 of 15 rows: there is no null row, every
column is a solution, and [F; G] lies in all of R^8. Such a case is marked `vacuous`: its error is zero by construction, for any data.
The normaliser n_v pi/2 exceeds the metric's maximum sqrt(n_v) pi/2, so that no error can reach 71 %. The metric measures containment
alone. So each case carries the errors by three metrics, and those of a random subspace of the same dimension.

Every system has a seed of its own, spawned from the study's: a case does not depend on the number of workers, a longer study begins
with the cases of a shorter one, and all three studies see the same systems and faults. Source: [G25] section V; [YL16].
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from typing import Any

import joblib
import numpy as np
from numpy.typing import NDArray

from .distances import author_error, containment_error, two_sided_error
from .fault_space_estimate import kernel_conditions, orthonormal
from .input_checks import InvalidData, positive
from .models import StateSpaceModel, observability_matrix
from .pi_moesp import pi_moesp
from .residual_windows import hankel_factor
from .residuals import residual
from .study_systems import MOST_ZEROS, N_V, N_X, NOISE_GAIN, SAMPLES, Experiment, P, StudySystem, experiment, study_system

Array = NDArray[np.float64]
Progress = Callable[[int, int, float], None]

SEED = 1907
PUBLISHED_WINDOW, CORRECTED_WINDOW = 5, N_X + 1
NOISE_LEVEL = 0.01
IDENTIFICATION_WINDOW = 20
# Samples over which the identified state basis is laid onto the true one.
ALIGNMENT_WINDOW = 2 * N_X
QUANTILES = (0.1, 0.25, 0.5, 0.75, 0.9)


@dataclass(frozen=True)
class Errors:
    """Of one estimate, as fractions. `published`: angles from [F; G] over n_v pi/2; `containment`: the same over sqrt(n_v) pi/2;
    `two_sided`: distance to the whole true fault space, dimensions included, over its maximum."""

    published: float
    containment: float
    two_sided: float


@dataclass(frozen=True)
class Case:
    """One system: its zeros, the window and rank taken, the estimate's errors and those of a random subspace of dimension n_z.

    `vacuous`: no null row is left, so the estimate is the whole space and says nothing. `decibels`: of the noise, as measured.
    `distance_to_unit_circle` of the nearest zero, None without zeros. `failure`: why there are no errors (identification refused), or None.
    """

    index: int
    zeros: tuple[float, ...]
    minimum_phase: bool
    distance_to_unit_circle: float | None
    decibels: float
    block_rows: int
    rows: int
    rank: int
    n_z: int
    vacuous: bool
    errors: Errors | None
    random: Errors
    failure: str | None = None

    @property
    def n_zeros(self) -> int:
        """Number of finite zeros."""
        return len(self.zeros)


@dataclass(frozen=True)
class Group:
    """The cases of one kind: how many, how many of them vacuous or failed; quantiles 10, 25, 50, 75, 90 % of the error and of a random
    subspace's, None where no case has an error."""

    label: str
    cases: int
    vacuous: int
    failed: int
    quantiles: tuple[float, ...] | None
    random_median: float | None

    @property
    def median(self) -> float | None:
        """Of the error, a fraction."""
        return None if self.quantiles is None else self.quantiles[QUANTILES.index(0.5)]


@dataclass(frozen=True)
class Study:
    """Cases in order. `metric` names the field of `Errors` that is the study's error; `seconds` is the time taken."""

    name: str
    title: str
    metric: str
    metric_text: str
    seed: int
    samples: int
    cases: tuple[Case, ...]
    seconds: float

    def error(self, case: Case) -> float | None:
        """The study's error of a case; None where identification failed."""
        return None if case.errors is None else float(getattr(case.errors, self.metric))

    def random_error(self, case: Case) -> float:
        """The same of a random subspace."""
        return float(getattr(case.random, self.metric))

    def to_json(self) -> dict[str, Any]:
        """A JSON-ready record: settings, tables, cases. Equal studies give equal records but for "seconds"."""
        return {
            "name": self.name,
            "title": self.title,
            "metric": self.metric,
            "metric_text": self.metric_text,
            "seed": self.seed,
            "samples": self.samples,
            "systems": len(self.cases),
            "vacuous": sum(case.vacuous for case in self.cases),
            "seconds": round(self.seconds, 3),
            "by_zeros": [asdict(group) for group in by_zeros(self)],
            "by_phase": [asdict(group) for group in by_phase(self)],
            "cases": [asdict(case) for case in self.cases],
        }


def study_as_published(
    *, systems: int = 100, seed: int = SEED, jobs: int | None = None, samples: int = SAMPLES, progress: Progress | None = None
) -> Study:
    """The study with the published settings and metric [G25], vacuous cases marked; a quarter of the systems for each number of zeros.

    `jobs` processes (None: all cores). `progress` is called with (done, total, seconds left) as cases come in. Raises InvalidData for
    numbers below one.
    """
    text = "angles from [F; G] to the estimate (containment) over n_v pi/2; at most 71 %"
    title = "as published: s = 5, true A, B, C, D, noise 43 dB down"
    return _study("published", title, "published", text, published_case, systems, seed, jobs, samples, progress)


def study_as_corrected(
    *, systems: int = 100, seed: int = SEED, jobs: int | None = None, samples: int = SAMPLES, progress: Progress | None = None
) -> Study:
    """The same systems and faults with a window beyond the lag, the stated noise and a distance that sees both directions. Arguments as
    `study_as_published`."""
    text = "two-sided distance between the true fault space and the estimate, over its maximum"
    title = "as corrected: s = 6, true A, B, C, D, noise 40 dB down"
    return _study("corrected", title, "two_sided", text, corrected_case, systems, seed, jobs, samples, progress)


def study_with_identified_model(
    *, systems: int = 100, seed: int = SEED, jobs: int | None = None, samples: int = SAMPLES, progress: Progress | None = None
) -> Study:
    """As published, with A, B, C, D identified by PI-MOESP (order given, s = 20) from the same data. Arguments as `study_as_published`."""
    text = "angles from [F; G] to the estimate (containment) over n_v pi/2; at most 71 %"
    title = "identified: s = 5, A, B, C, D by PI-MOESP, noise 43 dB down"
    return _study("identified", title, "published", text, identified_case, systems, seed, jobs, samples, progress)


STUDIES: dict[str, Callable[..., Study]] = {
    "published": study_as_published,
    "corrected": study_as_corrected,
    "identified": study_with_identified_model,
}


def by_zeros(study: Study) -> list[Group]:
    """One group for each number of zeros."""
    present = sorted({case.n_zeros for case in study.cases})
    return [_group(study, _zeros_label(k), [case for case in study.cases if case.n_zeros == k]) for k in present]


def by_phase(study: Study) -> list[Group]:
    """Cases without zeros, minimum-phase ones, and those with a zero outside the unit circle; groups that have a case."""
    kinds = {
        "no zeros": [case for case in study.cases if not case.zeros],
        "minimum phase": [case for case in study.cases if case.zeros and case.minimum_phase],
        "not minimum phase": [case for case in study.cases if case.zeros and not case.minimum_phase],
    }
    return [_group(study, label, cases) for label, cases in kinds.items() if cases]


def null_rows_estimate(r: Array, A: Array, C: Array, *, block_rows: int, rank: int, n_z: int) -> Array:
    """The n_z columns (n + p, n_z) that least violate N_s T_s(z) = 0, N_s the left singular vectors of R_s beyond the `rank` first.

    The estimator of the study: rank and n_z are given, no row is weighted. Without null rows every column fits: all of R^(n+p).
    """
    n, p = A.shape[0], C.shape[0]
    if rank >= p * block_rows:
        return np.eye(n + p)
    left = np.linalg.svd(hankel_factor(r, block_rows))[0]
    conditions = kernel_conditions(left[:, rank:].T.reshape(-1, block_rows, p), A, C).reshape(-1, n + p)
    return np.asarray(np.linalg.svd(np.linalg.qr(conditions, mode="r"))[2][n + p - n_z :].T)


def published_case(index: int, seed: np.random.SeedSequence, samples: int) -> Case:
    """Case `index` of `study_as_published`."""
    system, run, streams = _drawn(index, seed, samples, NOISE_LEVEL)
    r = run.y - system.model.simulate(run.u, streams[0].standard_normal(N_X))
    return _judged(index, system, run, r, system.model, np.eye(N_X), PUBLISHED_WINDOW, streams[1])


def corrected_case(index: int, seed: np.random.SeedSequence, samples: int) -> Case:
    """Case `index` of `study_as_corrected`."""
    system, run, streams = _drawn(index, seed, samples, NOISE_LEVEL / NOISE_GAIN)
    r = run.y - system.model.simulate(run.u, streams[0].standard_normal(N_X))
    return _judged(index, system, run, r, system.model, np.eye(N_X), CORRECTED_WINDOW, streams[1])


def identified_case(index: int, seed: np.random.SeedSequence, samples: int) -> Case:
    """Case `index` of `study_with_identified_model`; a refusal of the identification is recorded, not raised."""
    system, run, streams = _drawn(index, seed, samples, NOISE_LEVEL)
    try:
        model = pi_moesp(run.y, run.u, order=N_X, block_rows=IDENTIFICATION_WINDOW).model
        r = residual(run.y, run.u, model).r
    except InvalidData as error:
        return _judged(index, system, run, None, system.model, np.eye(N_X), PUBLISHED_WINDOW, streams[1], str(error))
    # O_true T = O_identified: T takes the identified state to the true one.
    true, found = (observability_matrix(each.A, each.C, ALIGNMENT_WINDOW) for each in (system.model, model))
    to_true = np.asarray(np.linalg.lstsq(true, found, rcond=None)[0], dtype=np.float64)
    return _judged(index, system, run, r, model, to_true, PUBLISHED_WINDOW, streams[1])


def _drawn(
    index: int, seed: np.random.SeedSequence, samples: int, level: float
) -> tuple[StudySystem, Experiment, tuple[np.random.Generator, np.random.Generator]]:
    """System, run, and the generators of the residual's start and of the random subspace; one after the other a zero more."""
    # Not seed.spawn, which would count the children and so change with a second use.
    of_system, of_run, of_start, of_subspace = (
        np.random.SeedSequence(seed.entropy, spawn_key=(*seed.spawn_key, part)) for part in range(4)
    )
    system = study_system(index % (MOST_ZEROS + 1), of_system)
    run = experiment(system, of_run, level=level, samples=samples)
    return system, run, (np.random.default_rng(of_start), np.random.default_rng(of_subspace))


def _judged(
    index: int,
    system: StudySystem,
    run: Experiment,
    r: Array | None,
    model: StateSpaceModel,
    to_true: Array,
    window: int,
    draw: np.random.Generator,
    failure: str | None = None,
) -> Case:
    """The case of the residual r (None: failed), estimated with `model`'s A and C and judged in the true state basis."""
    rank = N_X + window * N_V - system.n_zeros
    vacuous = rank >= P * window
    n_z = N_X + P if vacuous else N_V + system.n_zeros
    errors = None
    if r is not None:
        found = null_rows_estimate(r, model.A, model.C, block_rows=window, rank=rank, n_z=n_z)
        errors = _errors(system, orthonormal(np.vstack([to_true @ found[:N_X], found[N_X:]])))
    nearest = system.distance_to_unit_circle
    return Case(
        index=index,
        zeros=tuple(float(z) for z in system.zeros),
        minimum_phase=system.minimum_phase,
        distance_to_unit_circle=nearest if system.n_zeros else None,
        decibels=run.decibels,
        block_rows=window,
        rows=P * window,
        rank=rank,
        n_z=n_z,
        vacuous=vacuous,
        errors=errors,
        random=_errors(system, orthonormal(draw.standard_normal((N_X + P, n_z)))),
        failure=failure,
    )


def _errors(system: StudySystem, estimate: Array) -> Errors:
    columns = system.fault_columns
    return Errors(author_error(columns, estimate), containment_error(columns, estimate), two_sided_error(system.Z, estimate))


def _study(
    name: str,
    title: str,
    metric: str,
    metric_text: str,
    case: Callable[[int, np.random.SeedSequence, int], Case],
    systems: int,
    seed: int,
    jobs: int | None,
    samples: int,
    progress: Progress | None,
) -> Study:
    systems, samples = positive(systems, "systems"), positive(samples, "samples")
    workers = min(joblib.cpu_count() if jobs is None else positive(jobs, "jobs"), systems)
    if seed < 0:
        raise InvalidData(f"seed: got {seed}; a whole number from 0 on is needed")
    start = time.perf_counter()
    tasks = (joblib.delayed(case)(i, child, samples) for i, child in enumerate(np.random.SeedSequence(seed).spawn(systems)))
    # One BLAS thread a worker: the matrices are small and the cores are taken.
    with joblib.parallel_config(backend="loky", inner_max_num_threads=1):
        results = joblib.Parallel(n_jobs=workers, return_as="generator")(tasks)
        cases = tuple(_watched(results, systems, start, progress))
    return Study(name, title, metric, metric_text, seed, samples, cases, time.perf_counter() - start)


def _watched(results: Iterable[Case], total: int, start: float, progress: Progress | None) -> Iterable[Case]:
    for done, case in enumerate(results, 1):
        if progress is not None:
            progress(done, total, (time.perf_counter() - start) * (total - done) / done)
        yield case


def _zeros_label(k: int) -> str:
    return f"{k} zero" if k == 1 else f"{k} zeros"


def _group(study: Study, label: str, cases: list[Case]) -> Group:
    errors = [error for case in cases if (error := study.error(case)) is not None]
    quantiles = tuple(float(value) for value in np.quantile(errors, QUANTILES)) if errors else None
    random = float(np.median([study.random_error(case) for case in cases])) if cases else None
    return Group(label, len(cases), sum(case.vacuous for case in cases), len(cases) - len(errors), quantiles, random)
