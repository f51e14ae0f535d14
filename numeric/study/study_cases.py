"""One system of the Monte Carlo study is drawn, measured, estimated and judged.

    published_case, corrected_case               with the true A, B, C, D
    identified_case, corrected_identified_case   with A, B, C, D from PI-MOESP on the same data
    attempted                                    a case, or a Failed where it raised
    Case                                         the system's zeros, the noise, an estimate for each estimator, a random subspace
    Failed                                       in the place of a case that there is not: its index, and why
    Estimate                                     of one estimator: its dimension and errors
    Errors                                       the same angles in three metrics
    PAPER                                        the published factorisation, which is told the rank of R_s and n_z
    LIKELIHOOD                                   `fault_space_by_likelihood`, which is told n_v and counts the zeros itself
    LAWS                                         A, B, C, D by `arx_reduction`, told the order, and `fault_space_by_rows`, told n_v:
                                                 what `identify` does; it has a model of its own, and no other estimator's

A case is a function of its index and seed alone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from ...base.arrays import Array
from ...base.errors import InvalidData
from ...base.threads import one_thread
from ..method.model.asymptotic_likelihood import arx_reduction
from ..method.model.models import StateSpaceModel, observability_matrix
from ..method.model.past_inputs import pi_moesp
from ..method.model.residuals import residual
from ..method.rows.space_by_rows import fault_space_by_rows
from ..method.space.by_likelihood import fault_space_by_likelihood
from ..method.space.distances import containment_error, two_sided_error
from ..method.space.estimate import orthonormal
from .random_systems import MOST_ZEROS, N_V, N_X, P, StudySystem, study_system
from .runs import NOISE_GAIN, StudyRun, response, study_run
from .toeplitz_factorisation import toeplitz_factorisation

PUBLISHED_WINDOW, CORRECTED_WINDOW = 5, N_X + 1
NOISE_LEVEL = 0.01  # of the published study [G25]
IDENTIFICATION_WINDOW = 20
# Samples over which the identified state basis is laid onto the true one.
ALIGNMENT_WINDOW = 2 * N_X
PAPER, LIKELIHOOD, LAWS = "paper", "likelihood", "laws"


@dataclass(frozen=True)
class Errors:
    """The errors of one estimate, as fractions.

    `published` takes the angles from [F; G] over n_v pi/2, `containment` the same over sqrt(n_v) pi/2, and `two_sided` is the distance to
    the whole true fault space, dimensions included, over its maximum.
    """

    published: float
    containment: float
    two_sided: float


@dataclass(frozen=True)
class Estimate:
    """What one estimator made of a case: dimension and errors, or the reason why there are none."""

    n_z: int | None
    errors: Errors | None
    failure: str | None = None


@dataclass(frozen=True)
class Case:
    """A case is one system: its zeros, the window and rank taken, an estimate by name of estimator, and a random subspace of dimension n_z.

    It is `vacuous` where the rank leaves no null row, so that the published estimate is the whole space and says nothing. `decibels` are
    those of the noise as measured, and `distance_to_unit_circle` is that of the nearest zero, None without zeros.
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
    estimates: Mapping[str, Estimate]
    random: Errors

    @property
    def n_zeros(self) -> int:
        """Return the number of finite zeros."""
        return len(self.zeros)


@dataclass(frozen=True)
class Failed:
    """The case could not be done: `reason` says why on one line. An estimate that was refused is none of these, but has its own reason."""

    index: int
    reason: str


@dataclass(frozen=True)
class Truth:
    """What the published estimator is told: the rank of R_s and n_z; it is `vacuous` where the rank leaves no null row."""

    rank: int
    n_z: int
    vacuous: bool


def truth_of(n_zeros: int, window: int) -> Truth:
    """Return the rank that R_s has without noise at s = `window`, beyond the lag or not, and the dimension of its solution space."""
    rank = N_X + window * N_V - n_zeros
    vacuous = rank >= P * window
    return Truth(rank, N_X + P if vacuous else N_V + n_zeros, vacuous)


def seeds_of_parts(seed: np.random.SeedSequence) -> list[np.random.SeedSequence]:
    """Return the seeds of a case's system, run, initial state and random subspace."""
    # Not seed.spawn, which would count the children and so change with a second use.
    return [np.random.SeedSequence(seed.entropy, spawn_key=(*seed.spawn_key, part)) for part in range(4)]


def attempted(
    case: Callable[[int, np.random.SeedSequence, int], Case], index: int, seed: np.random.SeedSequence, samples: int
) -> Case | Failed:
    """Return case(index, seed, samples), and a Failed where that raises."""
    try:
        return case(index, seed, samples)
    except Exception as error:
        return Failed(index, " ".join(f"{type(error).__name__}: {error}".split()))


@one_thread()
def _with_true_model(
    window: int, level: float, estimators: tuple[str, ...], index: int, seed: np.random.SeedSequence, samples: int
) -> Case:
    """Estimate a case with the true matrices, the residual from a random initial state."""
    drawn = _Drawn(index, seed, samples, level, window)
    r = drawn.run.y - response(drawn.system.model, drawn.run.u, drawn.start.standard_normal(N_X))
    return drawn.case({name: drawn.estimate(name, r, drawn.system.model, np.eye(N_X)) for name in estimators})


@one_thread()
def _with_identified_model(
    window: int, level: float, estimators: tuple[str, ...], index: int, seed: np.random.SeedSequence, samples: int
) -> Case:
    """Estimate a case with the identified model; a refusal of the identification is recorded, not raised."""
    drawn = _Drawn(index, seed, samples, level, window)
    by_laws = {LAWS: drawn.estimate_by_laws()} if LAWS in estimators else {}
    of_residual = [name for name in estimators if name != LAWS]
    try:
        model = pi_moesp(drawn.run.y, drawn.run.u, order=N_X, block_rows=IDENTIFICATION_WINDOW).model
        r = residual(drawn.run.y, drawn.run.u, model).r
    except InvalidData as error:
        return drawn.case(dict.fromkeys(of_residual, Estimate(None, None, str(error))) | by_laws)
    to_true = _aligned(drawn.system.model, model)
    return drawn.case({name: drawn.estimate(name, r, model, to_true) for name in of_residual} | by_laws)


CORRECTED_LEVEL = NOISE_LEVEL / NOISE_GAIN  # noise of 1 %
published_case = partial(_with_true_model, PUBLISHED_WINDOW, NOISE_LEVEL, (PAPER,))
corrected_case = partial(_with_true_model, CORRECTED_WINDOW, CORRECTED_LEVEL, (PAPER, LIKELIHOOD))
identified_case = partial(_with_identified_model, PUBLISHED_WINDOW, NOISE_LEVEL, (PAPER,))
corrected_identified_case = partial(_with_identified_model, CORRECTED_WINDOW, CORRECTED_LEVEL, (PAPER, LIKELIHOOD, LAWS))


def _aligned(true: StateSpaceModel, found: StateSpaceModel) -> Array:
    """Return T with O_true T = O_found, by least squares: it takes the identified state to the true one."""
    wanted, seen = (observability_matrix(each.A, each.C, ALIGNMENT_WINDOW) for each in (true, found))
    return np.asarray(np.linalg.lstsq(wanted, seen, rcond=None)[0], dtype=np.float64)


class _Drawn:
    """The object holds system, run and what is known of them before anything is estimated; one case after the other has a zero more."""

    def __init__(self, index: int, seed: np.random.SeedSequence, samples: int, level: float, window: int) -> None:
        of_system, of_run, of_start, of_subspace = seeds_of_parts(seed)
        self.index, self.window = index, window
        self.system: StudySystem = study_system(index % (MOST_ZEROS + 1), of_system)
        self.run: StudyRun = study_run(self.system, of_run, level=level, samples=samples)
        self.start, self.subspace = np.random.default_rng(of_start), np.random.default_rng(of_subspace)
        self.truth = truth_of(self.system.n_zeros, window)

    def estimate(self, name: str, r: Array, model: StateSpaceModel, to_true: Array) -> Estimate:
        """Estimate by the estimator of that name from r and the model's A, C, and measure the error in the true state basis."""
        try:
            if name == PAPER:
                found = toeplitz_factorisation(r, model.A, model.C, block_rows=self.window, rank=self.truth.rank, n_z=self.truth.n_z)
            else:
                found = fault_space_by_likelihood(r, model.A, model.C, n_v=N_V).basis
        except InvalidData as error:
            return Estimate(None, None, str(error))
        return self._judged(found, to_true)

    def estimate_by_laws(self) -> Estimate:
        """Estimate model and fault space from outputs and inputs about their means, as `identify` does, with order and n_v told."""
        y, u = self.run.y, self.run.u
        try:
            model = arx_reduction(y, u, order=N_X)
            found = fault_space_by_rows(y - y.mean(axis=0), u - u.mean(axis=0), model.model.A, model.model.C, n_v=N_V)
        except (InvalidData, np.linalg.LinAlgError) as error:
            return Estimate(None, None, str(error))
        return self._judged(found.basis, _aligned(self.system.model, model.model))

    def _judged(self, found: Array, to_true: Array) -> Estimate:
        """Return the estimate with the basis `found` (n + p, n_z), whose states `to_true` takes to the true ones."""
        return Estimate(found.shape[1], _errors(self.system, orthonormal(np.vstack([to_true @ found[:N_X], found[N_X:]]))))

    def case(self, estimates: Mapping[str, Estimate]) -> Case:
        """Make the record of the case."""
        system = self.system
        return Case(
            index=self.index,
            zeros=tuple(float(z) for z in system.zeros),
            minimum_phase=system.minimum_phase,
            distance_to_unit_circle=system.distance_to_unit_circle if system.n_zeros else None,
            decibels=self.run.decibels,
            block_rows=self.window,
            rows=P * self.window,
            rank=self.truth.rank,
            n_z=self.truth.n_z,
            vacuous=self.truth.vacuous,
            estimates=estimates,
            random=_errors(system, orthonormal(self.subspace.standard_normal((N_X + P, self.truth.n_z)))),
        )


def _errors(system: StudySystem, estimate: Array) -> Errors:
    containment = containment_error(system.fault_columns, estimate)
    # No estimate has fewer columns than there are faults, so both metrics are the same angles over other maxima.
    return Errors(float(containment / np.sqrt(N_V)), containment, two_sided_error(system.Z, estimate))
