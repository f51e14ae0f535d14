"""This is everything that is known exactly about the population limit of an experiment, as `faultspace limit` prints it.

PopulationLimits   both limits, the regressions for B and D, their bias, and the ARX model that `identify` begins with
limit              from an Experiment, or from what an experiment's file holds
markov_parameters  D, CB, CAB, ...
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from os import PathLike
from typing import Any

from ...base.errors import InvalidInput, shorten
from ...base.sheets import Shown
from ..algebra.fields import QQ
from ..algebra.matrices import Matrix, beside, stacked
from ..algebra.notation import matrix_lines, polynomial
from ..algebra.stability import rational_characteristic_polynomial
from ..system.windows import observability_matrix
from .autoregression import ARXLimit, longest_arx_limit
from .column_space import Limit, past_input_and_output_limit, past_input_limit
from .experiments import Experiment, read_experiment
from .inputs import InputLimit, by_moesp, by_output_error
from .leading_vectors import leading_vectors_span
from .moments import Covariances, WindowCovariances, covariances, window_covariances

LONGEST_ENTRY = 24


@dataclass(frozen=True, repr=False)
class PopulationLimits(Shown):
    """What subspace identification converges to for one Experiment: both limits, and B and D of the regressions; `limit` makes it.

    `past_inputs` (PI-MOESP) and `past_outputs` (PO-MOESP) are limits of shape s p x (rows of the instruments), with their ranks beside that
    of O_s. `true_AC` and `moesp` are the limits of B (n x nu) and D (p x nu) in the basis of the true A and C, by output error and by
    MOESP's own regression, and None where they are not unique; `bias` subtracts the true ones. `arx` is the limit of the ARX model with s
    lags, or with fewer where only these have one, and None where none has: `identify` reduces it to n states. Source: [G25] Proposition 1;
    [V93], [VV07] and [LW92] for the methods. Raises nothing by itself.

    >>> import faultspace as fs
    >>> system = {"A": [["1/2"]], "B": [[1]], "C": [[1]], "D": [[0]], "F": [[1]], "G": [[0]]}
    >>> found = fs.limit({**system, "s": 2, "past": 2, "u_filter": [[[1, 0]]], "v_filter": [[[0, 1]]]})
    >>> found
    <PopulationLimits: 1 state, 1 fault, 1 output, 1 input; s = 2, past = 2>
    >>> found.true_AC.B, found.bias(found.true_AC).B
    ([[1]], [[0]])
    """

    experiment: Experiment
    known: Covariances
    blocks: WindowCovariances
    past_inputs: Limit
    past_outputs: Limit
    true_AC: InputLimit | None
    moesp: InputLimit | None

    @cached_property
    def arx(self) -> ARXLimit | None:
        """The limit of the ARX model with s lags, or with the most, below, for which it is unique; None where there is none."""
        try:
            return longest_arx_limit(self.experiment, self.experiment.s)
        except InvalidInput:
            return None

    def arx_bias(self, found: ARXLimit) -> list[Matrix]:
        """The result is by what the first Markov parameters of the ARX model's plant miss the true ones, p x nu each.

        They are 2 n + 1, and n + 1 more than lags where the lags are more than n: all are right where these are. With A G - B in the place
        of the plant, those beyond the lags are C' A^k B, which vanish for every k where n of them do.
        """
        system = self.experiment.system
        count = system.residual.n + max(system.residual.n, found.lags) + 1
        true = markov_parameters(system.residual.A, system.B, system.residual.C, system.D, count)
        return [one - other for one, other in zip(found.markov(count), true, strict=True)]

    @property
    def title(self) -> str:
        """This says how many states, faults, outputs and inputs there are, and how many block rows, s and past, the windows have."""
        return self.experiment.sizes

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield what `faultspace limit` prints, as (name, value) pairs."""
        system = self.experiment.system.residual
        yield "past inputs as instruments (PI-MOESP)", ""
        yield from _of_limit(self, self.past_inputs)
        yield "past inputs and outputs as instruments (PO-MOESP)", ""
        yield from _of_limit(self, self.past_outputs)
        yield "the system itself", ""
        yield "characteristic polynomial of A", _polynomial(rational_characteristic_polynomial(system.A))
        for title, regression in (("with the true A and C, by output error", self.true_AC), ("by MOESP's regression", self.moesp)):
            yield f"B and D {title}", ""
            if regression is None:
                yield "B, D", "not unique"
                continue
            bias = self.bias(regression)
            yield from _of_regression(regression, bias)
        yield "an ARX model, which identify reduces to the order", ""
        yield from _of_arx(self, self.arx)

    def to_json(self) -> dict[str, Any]:
        """Return what `faultspace limit EXPERIMENT --json` prints."""
        result = {
            "n": self.experiment.system.residual.n,
            "s": self.experiment.s,
            "past": self.experiment.past,
            **self.of_limit(self.past_inputs),
            "past_outputs": self.of_limit(self.past_outputs),
        }
        for name, found in (("true_AC", self.true_AC), ("moesp", self.moesp)):
            result[name] = None if found is None else {"B": found.B.to_json(), "D": found.D.to_json(), "bias": self._bias(found)}
        arx = self.arx
        result["arx"] = None if arx is None else arx.to_json() | {"bias": [matrix.to_json() for matrix in self.arx_bias(arx)]}
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
        """This tells whether the leading left singular vectors of `found`, one of the two limits, span the range of O_s: see
        `leading_vectors`.
        """
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
        """Return the limit minus the true B and D."""
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
    """Return D, CB, CAB, ...: `count` matrices p x nu."""
    result, state = [D], B
    for _ in range(count - 1):
        result.append(C @ state)
        state = A @ state
    return result


def limit(experiment: Experiment | Mapping[str, Any]) -> PopulationLimits:
    """Compute what PI-MOESP and PO-MOESP converge to as the number of samples goes to infinity, exact in every number.

    Source: [G25]; [VV07] for PI- and PO-MOESP.

    Parameters
    ----------
    experiment : Experiment or dict
        A dict is what an experiment's file holds: "A", "B", "C", "D", "F", "G" with rational entries, the block rows "s" and "past",
        and the filters "u_filter" and "v_filter" (and "w_filter" of the noise) that make the stationary input, fault and noise out of
        white noise.

    Returns
    -------
    PopulationLimits
        `past_inputs` and `past_outputs` have ranks and column spaces beside the one of O_s; `true_AC` and `moesp` are the limits of B
        (n x n_u) and D (p x n_u), None where they are not unique.

    Raises
    ------
    InvalidInput
        Where A is not stable, where an entry is not rational, and where the input does not excite s + past block rows.

    Examples
    --------
    >>> import faultspace as fs
    >>> system = {"A": [["1/2"]], "B": [[1]], "C": [[1]], "D": [[0]], "F": [[1]], "G": [[0]]}
    >>> found = fs.limit({**system, "s": 2, "past": 2, "u_filter": [[[1, 0]]], "v_filter": [[[0, 1]]]})
    >>> found.past_inputs.rank, found.past_inputs.equals_observability_range
    (1, True)
    """
    if isinstance(experiment, Mapping):
        experiment = read_experiment(experiment)
    if not isinstance(experiment, Experiment):
        hint = (
            "; that of a file is faultspace.exact.read_experiment(json.load(open(path)))" if isinstance(experiment, (str, PathLike)) else ""
        )
        raise InvalidInput(f"experiment: got {shorten(experiment)}, expected an Experiment or the dict of an experiment's file{hint}")
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


def _of_limit(found: PopulationLimits, limit: Limit) -> Iterator[tuple[str, str]]:
    yield "rank of the limit", f"{limit.rank}; of O_s {limit.observability_rank}, of both together {limit.joint_rank}"
    yield "column space", _columns(limit, found.experiment.system.residual.n)
    if limit.contains_observability_range and not limit.equals_observability_range:
        yield "", _leading(limit.observability_rank, found.leading_vectors_right(limit))
    if limit.state is not None:
        yield "characteristic polynomial of its A", _polynomial(limit.state.characteristic_polynomial)


def _columns(limit: Limit, n: int) -> str:
    if limit.equals_observability_range:
        if limit.rank < n:
            return "that of O_s, which is not of rank n: (A, C) is not observable on s samples"
        return "that of O_s: A and C are consistent" if limit.state else "that of O_s, but s is too small to tell A"
    if limit.within_observability_range:
        return "inside that of O_s, and smaller: states are missing"
    if limit.contains_observability_range:
        return f"that of O_s and {limit.rank - limit.observability_rank} more: the rank does not tell the order {n}"
    return "neither inside that of O_s nor around it: nothing in it spans that of O_s"


def _leading(count: int, right: bool) -> str:
    """This says what becomes of O_s where the limit has more columns than it, and the largest singular values choose among them."""
    vectors = "its leading left singular vector" if count == 1 else f"its {count} leading left singular vectors"
    if right:
        return f"{vectors} {'spans' if count == 1 else 'span'} that of O_s all the same, with the outputs as they are scaled here"
    return f"{vectors} {'does' if count == 1 else 'do'} not span that of O_s, with the outputs as they are scaled here"


def _of_regression(found: InputLimit, bias: InputLimit) -> Iterator[tuple[str, str]]:
    for name, matrix, error in (("B", found.B, bias.B), ("D", found.D, bias.D)):
        yield from _lines(f"limit of {name}", matrix)
        if error.is_zero():
            yield f"its bias for {name}", "none"
        else:
            yield from _lines(f"its bias for {name}", error)


def _of_arx(found: PopulationLimits, arx: ARXLimit | None) -> Iterator[tuple[str, str]]:
    """The lines say how far its plant is from the true one, and how far the reduced one can be."""
    if arx is None:
        yield "lags", "none for which it is unique"
        return
    asked = found.experiment.s
    yield "lags", f"{arx.lags}"
    if arx.lags != asked:
        yield "", f"with {asked} the limit is not unique: some"
        yield "", "mixture of outputs has no noise"
    bias = found.arx_bias(arx)
    if all(matrix.is_zero() for matrix in bias):
        yield "its plant", "the true one: reduced to the order it"
        yield "", "stays so, whatever colour the input has"
        return
    sizes = [abs(float(Fraction(int(x.p), int(x.q)))) for matrix in bias for row in matrix.elements() for x in row]
    yield "its plant", "not the true one: its first Markov"
    yield "", f"parameters miss by up to {max(sizes):.3g}"
    if not arx.open_loop:
        yield "", "the input follows the faults or leads"
        yield "", "them: more lags need not help"
    elif arx.misfit is None:
        yield "its misfit", "not known: a mixture of outputs is"
        yield "", "predicted exactly, for want of noise"
    else:
        share = float(arx.misfit)
        yield "its misfit", f"{share:.3g} of the power of what no"
        yield "", "prediction can know; of the plant"
        yield "", f"reduced to the order at most {4 * share:.3g}"
        yield "", "both tend to 0 with more lags, and no"
        yield "", "state is lost to the input's colour"


def _lines(name: str, matrix: Matrix) -> Iterator[tuple[str, str]]:
    """The lines show the matrix in full, or in decimals where an entry is too long to be read; --json has the fractions."""
    lines = matrix_lines(matrix) or [f"empty, {matrix.nrows} x {matrix.ncols}"]
    entries = [entry for row in matrix.elements() for entry in row]
    if any(len(str(entry)) > LONGEST_ENTRY for entry in entries):
        about = [[f"{float(Fraction(int(x.p), int(x.q))):.9g}" for x in row] for row in matrix.elements()]
        width = max(len(text) for row in about for text in row)
        lines = ["[ " + "  ".join(text.rjust(width) for text in row) + " ] about" for row in about]
    yield from ((name if i == 0 else "", line) for i, line in enumerate(lines))


def _polynomial(coefficients: Sequence[object]) -> str:
    return polynomial([QQ.element(c) for c in coefficients], QQ)
