"""Which single sensor or actuator explains the faults: the angle of each to the fault space, with how far it may be off.

An additive fault of sensor j is the column [0; e_j], one of actuator j is [B_j; D_j]. Such a fault can be the one that acts only if its
column lies in the fault space, and of one fault (n_v = 1) every column of the space explains what is seen. Of n_v faults, n_v columns of
the space do whose responses are independent (normal rank n_v, [G25] problem (11)).

isolate      the answer for a fault space and the model that it belongs to
Isolation    it, with a row for each sensor and each input, and the sets of them that explain everything
Cause        one row

The space and B, D are estimates. A column z = Q a + t of unit length, t off the span of the basis Q, lies in the true space iff t is what
the errors make of it: t = dQ a - dz, to first order linear in standard normal numbers, with the same ones for the model's errors in the
space and in z [MN89]. The states of two models are matched by the least-squares map of their observability matrices, as in
`space_uncertainty.py`, so that this turns [B_j; D_j] too. t in units of its covariance is chi-squared, which gives the probability; it does
not depend on the basis of the state or on units. The angle does, and is there to be looked at.

Where the likelihood of the model has other valleys, a cause is excluded only if it is in all of them, each with its probability; of an
actuator, whose column is another one there, nothing is known beyond the estimate's own valley.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, islice
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.chi_squared import chi_squared_tail
from ....base.errors import InvalidData
from ....base.sheets import Shown, counted
from ....base.threads import one_thread
from ...data.plain import by_name, plain
from ...data.validation import noise_deviations
from ..model.models import StateSpaceModel
from ..model.residuals import HasModel
from ..plotting import plot_angles
from ..ranks.sample_windows import EPS
from .estimate import FaultSpaceEstimate, SpaceOfValley

NO_ERRORS = (
    "the model is of PI-MOESP, which does not tell how sure it is, so that no angle to the fault space can be called small or large; a "
    "longer record of a stable plant, with its noise, has a model that tells it"
)
EXCLUDED, CONSISTENT = 0.01, 0.05  # a column whose probability lies between is undecided
WIDE = 0.5  # radians: above it, the first order says no more than that the space is not known (`identified_fault_space`)
DRAWS, SEED = 4000, 20251124
RANK = 1e-6  # singular values of responses of unit size below which they are dependent
MOST_SETS, MOST_TRIED = 12, 4000


@dataclass(frozen=True)
class SingleCause:
    """One single cause: `kind` is "sensor" or "actuator" of `channel`; `bound` in radians, which its angle stays below with probability
    0.95 where it is the cause; `p_value`, the chance of so large a deviation there; `answer` is "consistent", "excluded" or "undecided".
    Numbers are None where nothing could be computed."""

    kind: str
    channel: str
    bound: float | None
    p_value: float | None
    answer: str

    @property
    def name(self) -> str:
        """Return what it is, in words."""
        return f"{'a sensor' if self.kind == 'sensor' else 'an actuator'} fault on {self.channel}"


Kind = TypeVar("Kind", bound=SingleCause)


@dataclass(frozen=True)
class Cause(SingleCause):
    """One single cause, and the `angle` in radians from its column to the fault space, in the coordinates of the model."""

    angle: float

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict, angles in degrees."""
        bound = None if self.bound is None else plain(np.degrees(self.bound))
        angles = {"angle_degrees": plain(np.degrees(self.angle)), "bound_degrees": bound}
        return by_name(self, "kind", "channel", "p_value", "answer") | angles


@dataclass(frozen=True, repr=False)
class SingleCauses(Shown, Generic[Kind]):
    """A row of `causes` for each sensor and each input, what was found in words, and the `reason` why nothing can be said, or an empty
    string."""

    causes: tuple[Kind, ...]
    finding: str
    reason: str

    def of(self, answer: str) -> tuple[Kind, ...]:
        """Return the causes with this answer."""
        return tuple(cause for cause in self.causes if cause.answer == answer)

    @property
    def decided(self) -> bool:
        """Say whether the answer is one: a cause is named, or neither."""
        return not self.reason and (bool(self.of("consistent")) or not self.of("undecided"))

    @property
    def answer(self) -> str:
        """Return what was found, and first of all whether it is undecided."""
        return self.finding if self.decided else f"undecided: {self.finding}"

    @property
    def title(self) -> str:
        """Return the answer, short enough for one line."""
        return self.answer if len(self.answer) <= 80 else f"{self.answer[:77].rsplit(' ', 1)[0]} .."


@dataclass(frozen=True, repr=False)
class Isolation(SingleCauses[Cause]):
    """Which single sensors and actuators lie in a fault space, and which of them explain it.

    causes   a row for each sensor, in the order of the outputs, then for each actuator, in the order of the inputs
    n_v      the number of faults of the space
    sets     the sets of n_v consistent causes that explain everything together; of one fault, single ones
    answer   that in plain words
    reason   why nothing can be said, where that is so; else empty

    The angles are in radians, in the coordinates of the model. Raises ImportError in `plot()` without matplotlib. Source: [G25] problem
    (11), [MN89].

    >>> import numpy as np
    >>> from faultspace.numeric import StateSpaceModel, fault_space, isolate
    >>> model = StateSpaceModel([[0.5]], [[1.0]], [[1.0], [1.0]], [[0.0], [0.0]])
    >>> v = np.random.default_rng(1).standard_normal((200, 1))
    >>> r = np.hstack([np.zeros((200, 1)), v]) + model.simulate(np.zeros((200, 1)), x0=[1.0])
    >>> isolate(fault_space(r, model.A, model.C, n_v=1), model)
    <Isolation: a sensor fault on y2 explains it, and no other single sensor or actuator does>
    """

    n_v: int | None
    sets: tuple[tuple[Cause, ...], ...]

    @property
    def decided(self) -> bool:
        """Say whether the answer is one: of one fault a cause is named, of several a set, or neither."""
        return super().decided and (self.n_v == 1 or bool(self.sets) or not self.of("undecided"))

    def sheet(self) -> Iterator[tuple[str, str]]:
        """Yield the answer and a line for each cause."""
        yield "answer", self.answer
        if self.reason:
            yield "why", self.reason
        for cause in self.causes:
            bound = "" if cause.bound is None else f", bound {np.degrees(cause.bound):.3g}"
            chance = "" if cause.p_value is None else f", p {cause.p_value:.2g}"
            yield cause.name, f"{cause.answer}: {np.degrees(cause.angle):.3g} degrees{bound}{chance}"

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict, angles in degrees."""
        sets = [[cause.name for cause in several] for several in self.sets]
        return by_name(self, "answer", "reason", "n_v", "causes") | {"sets": sets}

    def plot(self, ax: Any = None) -> Any:
        """Draw the angles as bars with their bounds into the matplotlib axes `ax`, new ones where None are given, and return them. Raises
        ImportError without matplotlib."""
        rows = [(f"{cause.kind} {cause.channel}", cause.angle, cause.bound, cause.answer) for cause in self.causes]
        return plot_angles(rows, ax=ax)


@one_thread()
def isolate(
    space: FaultSpaceEstimate,
    model: StateSpaceModel | HasModel,
    *,
    outputs: Sequence[str] | None = None,
    inputs: Sequence[str] | None = None,
    units: ArrayLike | None = None,
) -> Isolation:
    """Say which single sensors and actuators lie in a fault space, and which of them explain the faults.

    A cause is "excluded" where its probability is below 0.01, "consistent" where it is 0.05 or more and the bound is below half a radian,
    and else "undecided". All are undecided where the space is. Source: [G25] problem (11), [MN89].

    Parameters
    ----------
    space : FaultSpaceEstimate
        Of `identified_fault_space` for a ReducedModel, whose errors are then in every bound; of any other function for a StateSpaceModel.
    model : ReducedModel or StateSpaceModel
        A, B, C, D of the shapes (n, n), (n, n_u), (p, n), (p, n_u), of a StateSpaceModel taken as right.
    outputs, inputs : list of str, optional
        Names of the channels, by default y1, .., u1, ..
    units : (p,) or (p, p), optional
        Sizes of the outputs, in units of y, by which the states of two models are matched: the roots of their mean squares, by default
        ones; or U, where the space was found in mixtures U^-1 y of unit size.

    Returns
    -------
    Isolation
        A row for each sensor and input, and the sets of them that explain everything.

    Raises
    ------
    InvalidData
        Shapes and names that do not fit.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import StateSpaceModel, fault_space, isolate
    >>> model = StateSpaceModel([[0.5]], [[1.0]], [[1.0], [1.0]], [[0.0], [0.0]])
    >>> v = np.random.default_rng(1).standard_normal((200, 1))
    >>> r = model.simulate(v)
    >>> isolate(fault_space(r, model.A, model.C, n_v=1), model).answer
    'an actuator fault on u1 explains it, and no other single sensor or actuator does'
    """
    matrices: Any = getattr(model, "model", model)
    (p, n), n_u = matrices.C.shape, matrices.B.shape[1]
    if space.n != n or len(space.basis) != n + p:
        got = f"{counted(len(space.basis), 'row')} and {counted(space.n, 'state')}"
        raise InvalidData(
            f"space: got {got} for a model of {counted(n, 'state')} and {counted(p, 'output')}; needed is the fault space of this model"
        )
    names = channels(outputs, inputs, p, n_u)
    weight = _weight(units, p)
    columns = np.hstack([np.vstack([np.zeros((n, p)), np.eye(p)]), np.vstack([matrices.B, matrices.D])])
    uncertainty = getattr(model, "uncertainty", None)
    errors = np.zeros((0, n + p, p + n_u)) if uncertainty is None else _column_errors(matrices, uncertainty.root, weight)
    identified = matrices is not model
    reason = NO_ERRORS if identified and uncertainty is None else _refusal(space, identified, len(errors))
    labels = [("sensor", name) for name in names[0]] + [("actuator", name) for name in names[1]]
    causes = tuple(
        _cause(kind, name, columns[:, j], errors[:, :, j], space, undecided=bool(reason)) for j, (kind, name) in enumerate(labels)
    )
    sets = () if reason or space.n_v is None else _sets(causes, columns, matrices, space.n_v)
    finding = reason or (words_of_one(causes, "it") if space.n_v == 1 else _words_of_sets(causes, sets, space.n_v or 0))
    return Isolation(causes, finding, reason, space.n_v, sets)


def channels(outputs: Sequence[str] | None, inputs: Sequence[str] | None, p: int, n_u: int) -> tuple[list[str], list[str]]:
    """Return names of p outputs and n_u inputs, by default y1, .., u1, .. Raises InvalidData for other numbers of names."""
    names = (list(outputs or [f"y{j + 1}" for j in range(p)]), list(inputs or [f"u{j + 1}" for j in range(n_u)]))
    for given, count, what in ((names[0], p, "outputs"), (names[1], n_u, "inputs")):
        if len(given) != count:
            raise InvalidData(f"{what}: got {len(given)} names for {count}; one for each is needed")
    return names


def _refusal(space: FaultSpaceEstimate, reduced: bool, model_errors: int) -> str:
    """Return why nothing can be said of any cause; an empty string where something can."""
    if not space.meaningful:
        return f"the fault space means nothing: {space.reason}"
    if space.n_v is None or not space.decided:
        return "the dimension of the fault space is undecided: a direction that belongs to it may be missing, or one too many in it"
    if space.basis.shape[1] == len(space.basis):
        return "every column lies in the fault space, so that causes cannot be told apart"
    if space.uncertainty is None and space.error_bound is None:
        return "nothing is known of how sure the fault space is"
    if reduced and (space.method != "kernel rows" or space.uncertainty is None or len(space.uncertainty.root) <= model_errors):
        return "the fault space takes A and C of the model as right, which they are not"
    return ""


def _weight(units: ArrayLike | None, p: int) -> Array:
    """Return U^-1 (p, p). Raises InvalidData for units that are none."""
    if np.ndim(units) != 2:  # type: ignore[arg-type]
        return np.diag(1 / (np.ones(p) if units is None else noise_deviations(units, p)))
    mixed = np.asarray(units, dtype=np.float64)
    sizes = np.linalg.norm(mixed, axis=1) if mixed.shape == (p, p) and np.all(np.isfinite(mixed)) else np.zeros(p)
    if not np.all(sizes > 0) or np.linalg.cond(mixed / sizes[:, None]) * EPS > 1:
        raise InvalidData(f"units: got the shape {mixed.shape} for {p} outputs; one number each is needed, or an invertible matrix of them")
    return np.asarray(np.linalg.inv(mixed / sizes[:, None]) / sizes)


def _column_errors(matrices: StateSpaceModel, root: Array, weight: Array) -> Array:
    """Return the errors (K, n + p, p + n_u) of the columns of sensors and actuators, as linear maps of the numbers of the model's root:
    those of B and D, and the turn of the states of the true model to those of this one."""
    (p, n), n_u = matrices.C.shape, matrices.B.shape[1]
    entries = root.T.reshape(root.shape[1], n + p, n + n_u)
    of_A, of_C = entries[:, :n, :n], entries[:, n:, :n]
    columns = np.zeros((len(entries), n + p, p + n_u))
    columns[:, :, p:] = entries[:, :, n:]
    if n:
        blocks, moves, power, moved = [], [], np.eye(n), np.zeros((len(entries), n, n))
        for _ in range(2 * n):
            blocks.append(weight @ matrices.C @ power)
            moves.append(weight @ (of_C @ power + matrices.C @ moved))
            power, moved = power @ matrices.A, of_A @ power + matrices.A @ moved
        turn = np.linalg.pinv(np.concatenate(blocks)) @ np.concatenate(moves, axis=1)
        columns[:, :n, p:] += turn @ matrices.B
    return columns


def _cause(kind: str, channel: str, column: Array, errors: Array, space: FaultSpaceEstimate, *, undecided: bool) -> Cause:
    """Return what is to say of one column (n + p,) with these errors (K, n + p)."""
    size = float(np.linalg.norm(column))
    if size == 0.0:
        return Cause(kind, channel, None, None, "undecided", np.pi / 2)
    z, Q = column / size, space.basis
    inside = Q.T @ z
    off = z - Q @ inside
    angle = float(np.arctan2(np.linalg.norm(off), np.linalg.norm(inside)))
    if undecided:
        return Cause(kind, channel, None, None, "undecided", angle)
    if space.uncertainty is None:
        assert space.error_bound is not None
        bound = float(np.arcsin(min(space.error_bound, 1.0)))
        return Cause(kind, channel, bound, None, "undecided" if bound > WIDE else "consistent" if angle <= bound else "excluded", angle)
    spread = space.uncertainty.root @ inside
    if len(errors):
        moved = errors / size
        spread[-len(errors) :] -= moved - (moved @ Q) @ Q.T
    across = np.linalg.qr(Q, mode="complete")[0][:, Q.shape[1] :]
    bound, here = _test(across.T @ off, spread @ across)
    own, *others = space.uncertainty.valleys or (None,)
    chance = here if own is None else own.weight * here + sum(valley.weight * _elsewhere(kind, z, valley) for valley in others)
    answer = "consistent" if here >= CONSISTENT else "excluded" if chance < EXCLUDED else "undecided"
    return Cause(kind, channel, bound, chance, "undecided" if bound > WIDE else answer, angle)


def _elsewhere(kind: str, z: Array, valley: SpaceOfValley) -> float:
    """Return the chance of a column in another valley of the likelihood; of an actuator nothing is known there, where B, D are others."""
    if kind != "sensor":
        return 1.0
    Q = valley.basis
    inside = Q.T @ z
    across = np.linalg.qr(Q, mode="complete")[0][:, Q.shape[1] :]
    return _test(across.T @ (z - Q @ inside), valley.root @ inside @ across)[1]


def _test(off: Array, spread: Array) -> tuple[float, float]:
    """Return the angle that chance stays below with probability 0.95, and the chance of `off` (d,), where chance is spread.T (q, d) times
    standard normal numbers."""
    least = np.linalg.lstsq(spread.T, off, rcond=None)
    numbers, rank = least[0], int(least[2])
    reached = float(np.linalg.norm(spread.T @ numbers - off)) <= RANK * float(np.linalg.norm(off))
    chance = chi_squared_tail(float(numbers @ numbers), max(rank, 1)) if reached else 0.0
    draws = np.random.default_rng(SEED).standard_normal((DRAWS, len(spread))) @ spread
    return float(np.arctan(np.quantile(np.linalg.norm(draws, axis=1), 0.95))), chance


def _sets(causes: Sequence[Cause], columns: Array, model: StateSpaceModel, n_v: int) -> tuple[tuple[Cause, ...], ...]:
    """Return the sets of n_v consistent causes whose responses are independent."""
    inside = [j for j, cause in enumerate(causes) if cause.answer == "consistent"]
    n = len(model.A)
    radius = 2 * max(1.0, float(np.max(np.abs(np.linalg.eigvals(model.A)), initial=0.0)))
    points = radius * np.exp(1j * np.array([0.3, 1.1, 2.3]))
    responses = np.array([columns[n:] + model.C @ np.linalg.solve(point * np.eye(n) - model.A, columns[:n]) for point in points])
    found = []
    for several in islice(combinations(inside, n_v), MOST_TRIED):
        parts = responses[:, :, several]
        parts = parts / np.maximum(np.linalg.norm(parts, axis=1, keepdims=True), np.finfo(np.float64).tiny)
        if np.any(np.linalg.svd(parts, compute_uv=False)[:, -1] > RANK):
            found.append(tuple(causes[j] for j in several))
    return tuple(found[:MOST_SETS])


def answering(causes: Sequence[Any], answer: str) -> list[str]:
    """Return the names of the causes with this answer."""
    return [cause.name for cause in causes if cause.answer == answer]


def words_of_one(causes: Sequence[Any], what: str, why: str = "") -> str:
    """Return in plain words which single cause explains `what`, none named alone where another one is consistent too; `why` says of those
    that are undecided why they are."""
    still, names = answering(causes, "undecided"), answering(causes, "consistent")
    rest = f"; undecided: whether {_listed(still, 'or')} does{why}" if still else ""
    if len(names) == 1:
        return f"{names[0]} explains {what}{rest or ', and no other single sensor or actuator does'}"
    if names:
        return f"{_listed(names, 'and')} explain {what}, each by itself: the data cannot tell which{rest}"
    if still:
        return f"{_listed(still, 'or')} may explain {what}, and nothing else does{why}"
    return f"neither: no single sensor and no single actuator explains {what}"


def _words_of_sets(causes: Sequence[Cause], sets: Sequence[Sequence[Cause]], n_v: int) -> str:
    still, alone = answering(causes, "undecided"), answering(causes, "consistent")
    rest = f"; undecided: {_listed(still, 'or')}" if still else ""
    if len(sets) == 1:
        return f"{_listed([cause.name for cause in sets[0]], 'and')} explain the {n_v} faults together{rest}"
    if sets:
        listed = " or ".join(_listed([cause.name for cause in several], "and") for several in sets[:4])
        more = f", or {counted(len(sets) - 4, 'more set')}" if len(sets) > 4 else ""
        return f"together the {n_v} faults are explained by {listed}{more}: the data cannot tell which{rest}"
    if still:
        return f"{n_v} faults act, and {_listed([*alone, *still], 'and')} may be among them"
    verb = "is" if len(alone) == 1 else "are"
    some = f"; only {_listed(alone, 'and')} {verb} consistent with the fault space, and more acts" if alone else ""
    return f"neither: no {n_v} sensors and actuators explain the {n_v} faults{some}"


def _listed(names: Sequence[str], word: str) -> str:
    """Return the names as one phrase, `word` before the last."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} {word} {names[-1]}"
