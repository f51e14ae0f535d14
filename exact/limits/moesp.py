"""Everything that is known exactly about the population limit of an experiment, as `faultspace limit` prints it.

PopulationLimits   both limits, the regressions for B and D, their bias
population_limits  from an Experiment
limit              from an Experiment to the JSON-ready dict
markov_parameters  D, CB, CAB, ...
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..algebra.fields import QQ
from ..algebra.matrices import Matrix, beside, stacked
from ..system.windows import observability_matrix
from .column_space import Limit, past_input_and_output_limit, past_input_limit
from .experiments import Experiment
from .inputs import InputLimit, by_moesp, by_output_error
from .leading_vectors import leading_vectors_span
from .moments import Covariances, WindowCovariances, covariances, window_covariances


@dataclass(frozen=True)
class PopulationLimits:
    """past_inputs (PI-MOESP), past_outputs (PO-MOESP), and the limits of B, D in the basis of the given A and C (None: not unique)."""

    experiment: Experiment
    known: Covariances
    blocks: WindowCovariances
    past_inputs: Limit
    past_outputs: Limit
    true_AC: InputLimit | None
    moesp: InputLimit | None

    def to_json(self) -> dict[str, Any]:
        """What `faultspace limit EXPERIMENT --json` prints."""
        result = {
            "n": self.experiment.system.residual.n,
            "s": self.experiment.s,
            "past": self.experiment.past,
            **self.of_limit(self.past_inputs),
            "past_outputs": self.of_limit(self.past_outputs),
        }
        for name, found in (("true_AC", self.true_AC), ("moesp", self.moesp)):
            result[name] = None if found is None else {"B": found.B.to_json(), "D": found.D.to_json(), "bias": self._bias(found)}
        return result

    def of_limit(self, found: Limit) -> dict[str, Any]:
        """One limit; "markov" holds D, CB, CAB, ... of the limit's A, C with B, D by output error, 2 n + 1 matrices."""
        state = found.state
        return {
            "limit_rank": found.rank,
            "observability_rank": found.observability_rank,
            "joint_rank": found.joint_rank,
            "within_observability_range": found.within_observability_range,
            "contains_observability_range": found.contains_observability_range,
            "equals_observability_range": found.equals_observability_range,
            "leading_vectors_span_observability_range": self.leading_vectors_right(found),
            "A_characteristic_polynomial": None if state is None else [QQ.write(QQ.element(c)) for c in state.characteristic_polynomial],
            "markov": self._markov(found),
        }

    def leading_vectors_right(self, found: Limit) -> bool:
        """Whether the leading left singular vectors of `found`, one of the two limits, span the range of O_s: see `leading_vectors`."""
        if found.equals_observability_range or not found.contains_observability_range:
            return found.equals_observability_range
        u, y, blocks, known = self.known.process.u, self.known.process.y, self.blocks, self.known
        before = range(-self.experiment.past, 0)
        gram, crossed = known.windows(u, u, before, before), blocks.uf_up
        if found is self.past_outputs:
            across, own = known.windows(u, y, before, before), known.windows(y, y, before, before)
            gram = stacked(beside(gram, across), beside(across.transposed(), own))
            crossed = beside(crossed, blocks.uf_yp)
        projected = gram - crossed.transposed() @ found.projection
        return leading_vectors_span(found.matrix, projected, observability_matrix(self.experiment.system.residual, self.experiment.s))

    def bias(self, found: InputLimit) -> InputLimit:
        """The limit minus the true B and D."""
        return InputLimit(found.B - self.experiment.system.B, found.D - self.experiment.system.D)

    def _bias(self, found: InputLimit) -> dict[str, Any]:
        bias = self.bias(found)
        return {"B": bias.B.to_json(), "D": bias.D.to_json()}

    def _markov(self, found: Limit) -> list[list[list[object]]] | None:
        if found.state is None:
            return None
        model = by_output_error(self.known, found.state.A, found.state.C)
        if model is None:
            return None
        parts = markov_parameters(found.state.A, model.B, found.state.C, model.D, 2 * found.state.A.nrows + 1)
        return [part.to_json() for part in parts]


def markov_parameters(A: Matrix, B: Matrix, C: Matrix, D: Matrix, count: int) -> list[Matrix]:
    """D, CB, CAB, ...: `count` matrices p x nu."""
    result, state = [D], B
    for _ in range(count - 1):
        result.append(C @ state)
        state = A @ state
    return result


def population_limits(experiment: Experiment) -> PopulationLimits:
    """All of it. Raises InvalidInput where the input does not excite s + past block rows."""
    residual = experiment.system.residual
    known = covariances(experiment)
    blocks = window_covariances(experiment, known)
    return PopulationLimits(
        experiment,
        known,
        blocks,
        past_input_limit(experiment, blocks),
        past_input_and_output_limit(experiment, blocks),
        by_output_error(known, residual.A, residual.C),
        by_moesp(blocks, observability_matrix(residual, experiment.s), residual.p),
    )


def limit(experiment: Experiment) -> dict[str, Any]:
    """The JSON-ready answer to an experiment, exact in every number. Raises InvalidInput as `population_limits`."""
    return population_limits(experiment).to_json()
