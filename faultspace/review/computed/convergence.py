"""Population limits, exact, with estimates from longer and longer records that close in on them.

convergence   the object: for each experiment and method the median distance at each N to the exact limit and to the truth
CHOSEN        experiment, method and what is to be seen
Method        what is estimated from a record, and where `limit` has its exact value
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from ...base.arrays import Array
from ...base.progress import Progress, silent
from ...exact.limits.experiments import Experiment
from ...exact.limits.moesp import limit, markov_parameters
from ...numeric.method.model.input_matrices import by_output_error
from ...numeric.method.model.models import StateSpaceModel
from ...numeric.method.model.past_inputs import pi_moesp
from ...numeric.method.model.past_outputs import po_moesp
from .experiments import model, packaged, record

LENGTHS = (300, 1000, 3000, 10_000, 30_000, 100_000)
SEEDS = 8
Document = Mapping[str, Any]


@dataclass(frozen=True)
class Method:
    """`estimate` takes a record; `exact` reads the same numbers from the answer of `limit`, None where there is no limit of that form;
    `true` takes them from the plant, and `right` says, exactly, whether the limit is the truth. `of` says in words what the numbers are."""

    name: str
    of: str
    estimate: Callable[[Experiment, Array, Array], Array]
    exact: Callable[[Document], Array | None]
    true: Callable[[StateSpaceModel], Array]
    right: Callable[[Experiment, Document], bool]


def _markov(found: StateSpaceModel) -> Array:
    return np.asarray(found.markov(2 * found.n + 1)).ravel()


def _moesp(name: str, identify: Callable[..., Any], key: str | None) -> Method:
    def estimate(experiment: Experiment, y: Array, u: Array) -> Array:
        n = experiment.system.residual.n
        return _markov(identify(y, u, order=n, block_rows=experiment.s, past_rows=experiment.past).model)

    def exact(document: Document) -> Array | None:
        found = (document if key is None else document[key])["markov"]
        return None if found is None else _numbers(found)

    def right(experiment: Experiment, document: Document) -> bool:
        system, residual = experiment.system, experiment.system.residual
        truth = markov_parameters(residual.A, system.B, residual.C, system.D, 2 * residual.n + 1)
        return bool((document if key is None else document[key])["markov"] == [part.to_json() for part in truth])

    return Method(name, "the first 2 n + 1 Markov parameters", estimate, exact, _markov, right)


def _by_output_error(experiment: Experiment, y: Array, u: Array) -> Array:
    plant = model(experiment)
    found = by_output_error([[(y, u)]], plant.A, plant.C, plant.n_u)
    return np.concatenate([found.B.ravel(), found.D.ravel()])


METHODS = {
    "output-error": Method(
        "output error with the true A and C",
        "B and D",
        _by_output_error,
        lambda document: np.concatenate([_numbers(document["true_AC"][name]) for name in ("B", "D")]),
        lambda plant: np.concatenate([plant.B.ravel(), plant.D.ravel()]),
        lambda _, document: not any(_numbers(document["true_AC"]["bias"][name]).any() for name in ("B", "D")),
    ),
    "PI-MOESP": _moesp("PI-MOESP", pi_moesp, None),
    "PO-MOESP": _moesp("PO-MOESP", po_moesp, "past_outputs"),
}
CHOSEN = (
    (
        "fault-follows-input",
        "output-error",
        "The fault is half of the input, one sample later. Even with the true A and C the estimates of B and D close in on wrong values, "
        "which are known exactly.",
    ),
    (
        "independent-fault",
        "PI-MOESP",
        "The fault is coloured and independent of the input, and the sensors are noisy. With past inputs as instruments the limit is the "
        "truth, and the estimates close in on it.",
    ),
    (
        "independent-fault",
        "PO-MOESP",
        "On the same records, past outputs as instruments leave an error, however long the record is.",
    ),
)


def convergence(lengths: Sequence[int] = LENGTHS, seeds: int = SEEDS, *, on_progress: Progress = silent) -> dict[str, Any]:
    """Return the Euclidean distances of what each method estimates, as medians over seeds."""
    curves = []
    for place, (name, method, words) in enumerate(CHOSEN):
        on_progress("estimating from longer and longer records", place, len(CHOSEN))
        curves.append({"experiment": name, "words": words, **_curve(packaged(name), METHODS[method], lengths, seeds)})
    return {"lengths": list(lengths), "seeds": seeds, "curves": curves}


def _curve(experiment: Experiment, method: Method, lengths: Sequence[int], seeds: int) -> dict[str, Any]:
    document = limit(experiment).to_json()
    exact, truth = method.exact(document), method.true(model(experiment))
    to_limit, to_truth = [], []
    for N in lengths:
        estimates = [method.estimate(experiment, *record(experiment, N, 1000 * seed + 1)) for seed in range(seeds)]
        if exact is not None:
            to_limit.append(_median(estimates, exact))
        to_truth.append(_median(estimates, truth))
    return {
        "method": method.name,
        "of": method.of,
        "n": experiment.system.residual.n,
        "true_AC": document["true_AC"],
        "limit": {name: document[name] for name in ("limit_rank", "observability_rank")},
        "past_outputs": {name: document["past_outputs"][name] for name in ("limit_rank", "observability_rank")},
        "right": method.right(experiment, document),
        "bias": None if exact is None else float(np.linalg.norm(exact - truth)),
        "to_limit": to_limit or None,
        "to_truth": to_truth,
    }


def _median(estimates: Sequence[Array], exact: Array) -> float:
    return float(np.median([np.linalg.norm(one - exact) for one in estimates]))


def _numbers(nested: Any) -> Array:
    """Return all fractions of nested lists of strings, in their order."""
    if isinstance(nested, list):
        return np.concatenate([_numbers(one) for one in nested]) if nested else np.zeros(0)
    return np.array([float(Fraction(nested))])
