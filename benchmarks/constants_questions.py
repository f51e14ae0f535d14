"""The questions of `constants.py`: which constants, on which records, and what a right answer is.

Answer      a verdict (right, undecided, wrong) and, where what was found can be compared with the truth, an error
Constant    name, the modules that use it, its value
Question    name, constants, `records`: (trial, seed, samples) -> one function a kind of record, which asks and may keep what no constant
            changes
QUESTIONS   by name

Draws are those of `fault_dimension.py` and `fault_space.py`, whose heads describe them. `order` draws stable systems of 1, 2, 3 and 5
states, one input and 3 outputs, with 0 to 2 of the study's faults and with noise 60, 40 and 20 dB below each output, window 10.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from types import ModuleType
from unittest.mock import patch

import numpy as np
from numpy.typing import NDArray

from benchmarks.fault_dimension import CELLS, Cell, fault_signals, noise, random_plant, residuals
from benchmarks.fault_space import SHAPES, Trial, angle, paper_like, two_rows
from faultspace.base.errors import InvalidData
from faultspace.numeric.method.model import past_inputs
from faultspace.numeric.method.ranks import residual_laws
from faultspace.numeric.method.ranks.one_row import WindowMoments
from faultspace.numeric.method.ranks.rank_gap import fault_dimension
from faultspace.numeric.method.ranks.residual_laws import LawLevel, law_level
from faultspace.numeric.method.space import by_likelihood
from faultspace.numeric.method.space.estimate import FaultSpaceEstimate
from faultspace.numeric.plant.healthy import against_healthy, healthy_model

Array = NDArray[np.float64]
Ask = Callable[[], "Answer"]
FAINT = (60.0, 40.0, 20.0)
STATES = (1, 2, 3, 5)
WINDOW = 10


@dataclass(frozen=True)
class Answer:
    """A verdict is "right", "undecided" or "wrong"; what is found may have an `error`, also where it is undecided."""

    verdict: str
    error: float | None = None


@dataclass(frozen=True)
class Constant:
    """A constant is patched in all modules that use it."""

    name: str
    owners: tuple[ModuleType, ...]

    @property
    def value(self) -> float | int:
        """Return the value as it is; whole numbers stay whole."""
        found = getattr(self.owners[0], self.name)
        return int(found) if isinstance(found, int) else float(found)


@dataclass(frozen=True)
class Question:
    """This is a rule with constants, and the records on which it is asked."""

    name: str
    constants: tuple[Constant, ...]
    records: Callable[[int, int, int], Iterator[Ask]]


def of(names: str, *owners: ModuleType) -> tuple[Constant, ...]:
    """Return the constants of these names."""
    return tuple(Constant(name, owners) for name in names.split())


def verdict(found: int | None, true: int) -> str:
    """Return what an answer is that may be left open."""
    return "undecided" if found is None else "right" if found == true else "wrong"


def of_orders(trial: int, seed: int, samples: int) -> Iterator[Ask]:
    """Ask PI-MOESP for the order of noisy records with and without faults."""
    for n in STATES:
        for m in range(3):
            for decibel in FAINT:
                random = np.random.default_rng((seed, trial, n, m))
                plant, u = random_plant(random, 3, m, n), random.standard_normal((samples, 1))
                y = np.add(*plant.respond(random.standard_normal(n), u, fault_signals(random, samples, m)))
                levels = y.std(axis=0) * 10.0 ** (-decibel / 20.0)
                yield _order(y + noise(random, samples, levels), u, n)


def _order(y: Array, u: Array, n: int) -> Ask:
    def ask() -> Answer:
        try:
            return Answer(verdict(past_inputs.pi_moesp(y, u, block_rows=WINDOW).order, n))
        except InvalidData:
            return Answer("undecided")

    return ask


def _cells(*models: str) -> Sequence[Cell]:
    return [cell for cell in CELLS if cell.model in models and np.isfinite(cell.decibel)]


def of_laws(trial: int, seed: int, samples: int) -> Iterator[Ask]:
    """Count the faults of a residual alone; what the laws leave of a record is computed once, for no constant changes it."""
    for cell in _cells("true", "identified"):
        r, u, _, _ = residuals(cell, np.random.default_rng((seed, cell.p, cell.m, trial)), samples)
        yield _laws(cell, r, u if cell.model == "identified" else None)


def _laws(cell: Cell, r: Array, u: Array | None) -> Ask:
    known: dict[tuple[int, bytes], LawLevel] = {}

    def level(moments: WindowMoments, mixes: tuple[Array, ...]) -> LawLevel:
        key = (moments.channels, b"".join(mix.tobytes() for mix in mixes))
        return known[key] if key in known else known.setdefault(key, law_level(moments, mixes))

    def ask() -> Answer:
        with patch.object(residual_laws, "law_level", level):
            return Answer(verdict(fault_dimension(r, u=u).n_v, cell.m))

    return ask


def against_healthy_records(trial: int, seed: int, samples: int) -> Iterator[Ask]:
    """Count the faults that stand out of a healthy record."""
    for cell in _cells("healthy"):
        found = residuals(cell, np.random.default_rng((seed, cell.p, cell.m, trial)), samples)
        yield _healthy(cell, *found)


def _healthy(cell: Cell, r: Array, u: Array, quiet: Array, before: Array) -> Ask:
    def ask() -> Answer:
        reference = healthy_model.healthy_reference(quiet, before)
        return Answer(verdict(against_healthy.fault_dimension_against_healthy(r, reference, u=u).n_v, cell.m))

    return ask


def of_spaces(trial: int, seed: int, samples: int) -> Iterator[Ask]:
    """Ask for the number of zeros and the space by likelihood."""
    for one in _trials(trial, seed, samples):
        yield _space(one, by_likelihood.fault_space_by_likelihood)


def _trials(trial: int, seed: int, samples: int) -> Iterator[Trial]:
    own = 1000 * seed + trial
    yield from (paper_like(zeros, samples, own) for zeros in range(4))
    yield from (two_rows(shape, samples, own) for shape in SHAPES)


def _space(trial: Trial, estimate: Callable[..., FaultSpaceEstimate]) -> Ask:
    def ask() -> Answer:
        found = estimate(trial.r, trial.A, trial.C, n_v=trial.n_v)
        n_z = trial.Z.shape[1]
        said = verdict(found.n_z if found.decided else None, n_z)
        return Answer(said, angle(trial, found.basis) if found.n_z == n_z else None)

    return ask


LAWS = "ALARM CLEAR CLEAR_LAST CLEAR_SINGLE SLACK SLACK_LAST SETTLED STEEP SPARSE"
QUESTIONS = {
    question.name: question
    for question in (
        Question("order", of("LEAD", past_inputs), of_orders),
        Question("laws", of(LAWS, residual_laws), of_laws),
        Question(
            "healthy",
            (
                *of("MOST_LAGS SPENT FREEDOM MANY_TAPERS", healthy_model),
                *of("FEW_TAPERS", healthy_model, against_healthy),
                *of("TURNED", against_healthy),
            ),
            against_healthy_records,
        ),
        Question("space", of("IDLE NEEDED QUIET", by_likelihood), of_spaces),
    )
}
