"""PI-MOESP [V93] makes a model from inputs and outputs with coloured additive disturbances or faults, past inputs as instruments.

1  L31, L32, L33 from the compression of [Uf; Up; Yf]: L32 is Yf seen along the past inputs, with the future inputs projected out.
2  The column space of L32 tends into that of O_s where the faults are uncorrelated with the inputs at lags of both signs, and to all of it
for a white input and for most others, (A, B) controllable and the past window of n rows at least: left singular vectors for the order n; A
and C from its shift invariance. What is true of other inputs and faults: `exact.limits`, and proposition-1 of the ledger.
3  B, D and x0 by output-error least squares over all samples; by MOESP's regression where there are no data any more, or where A is
unstable.

Outputs are scaled to equal root mean square before step 2, so units do not matter. Singular values are those of the scaled L32 /
sqrt(columns).

The order, where not given, is where ln(sigma_k / sigma_(k+1)) is largest, sigma cut off below at the rounding level. The two smallest
values take no part unless they fall to that level: the smallest of a random matrix are spread out. The gap is clean when its ratio is at
least LEAD times every other ratio; else InvalidData lists the values, and the choice is the caller's. So it does where
A would be undetermined at a clean gap (condition of O_(s-1) above UNDETERMINED): few faults without noise leave L32 rank-deficient, with a
huge gap far beyond the order.

LEAD is calibrated: with ten, some 4 % of the orders that are told are wrong on noisy records with and without faults; with 1.5 three in ten
were, nearly all too low, where a faint state follows strong ones (`benchmarks/constants.py order`). `identify` tests orders instead.

pi_moesp                    from y and u: arrays, or pieces that can be read more than once
OrderUndecided              the refusal of an order that was left open, with the singular values
pi_moesp_experiments        from several experiments
pi_moesp_from_compression   from a compression alone
MoespModel                  the result: model, order, gap, singular values, x0, residual covariance, condition numbers, warnings
Gap, choose_order           the order rule
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import counted
from ....base.threads import one_thread
from ...data.validation import constant_channels, experiment, positive
from .compression import EPS, Compression, Pieces, compress, compress_chunks, merge
from .input_matrices import by_moesp, by_output_error, growth
from .models import StateSpaceModel
from .moesp_model import Gap, MoespModel, OrderUndecided

LEAD = 10.0  # calibrated, see the head
UNDETERMINED = 1e8  # condition of O_(s-1) above which A is not determined: told of an order that was given, refused for one that was not
EXCITED = 1e-13  # relative to its length and times the rows: what a direction of the inputs must exceed to be excited
AMPLIFICATION = 1e6  # growth over the record up to which an unstable model is still fitted by output error: ten digits remain


def choose_order(values: Array, floor: float, most: int) -> Gap:
    """Choose the order by the rule of the module's docstring on falling singular values; `floor` is the rounding level, `most` the largest
    order allowed.

    Without any value above the floor, the order is 0.
    """
    held = np.maximum(values, floor)
    if not len(values) or values[0] <= floor:
        return Gap(0, 1.0, 0, 1.0, False)
    # A value that follows the last one is at the floor only if rank cannot exceed what was seen.
    ratios = held[:-1] / held[1:]
    eligible = np.arange(len(ratios)) < min(most, len(values) - 2)
    eligible |= (held[1:] <= floor) & (np.arange(len(ratios)) < most)
    ranked = [int(k) for k in np.argsort(-ratios, kind="stable") if eligible[k]]
    if not ranked:
        return Gap(0, 1.0, 0, 1.0, False)
    best = ranked[0]
    following = ranked[1] if len(ranked) > 1 else best
    runner_up = float(ratios[following]) if following != best else 1.0
    ratio = float(ratios[best])
    return Gap(best + 1, ratio, following + 1, runner_up, ratio >= LEAD * runner_up)


def gap_at(values: Array, floor: float, order: int) -> Gap:
    """Return the gap at a given order, beside the largest elsewhere."""
    held = np.maximum(values, floor)
    ratios = held[:-1] / held[1:]
    others = [k for k in range(len(ratios)) if k != order - 1]
    best = max(others, key=lambda k: float(ratios[k]), default=order - 1)
    own = float(ratios[order - 1]) if order <= len(ratios) else 1.0
    other = float(ratios[best]) if others else 1.0
    return Gap(order, own, best + 1, other, own >= LEAD * other)


@dataclass(frozen=True, eq=False)
class Range:
    """What step 2 gives: A, C in units of the scaled outputs, the scale (p,), and the account of the order."""

    A: Array
    C: Array
    scale: Array
    values: Array
    gap: Gap
    condition: float
    warnings: tuple[str, ...]


def output_scale(outputs: Array, p: int, columns: int) -> Array:
    """Return the root mean square (p,) of each output, from the `columns` columns of its Hankel matrix up to a rotation; 1 for outputs that
    are zero.
    """
    energy = np.sum(outputs.reshape(-1, p, outputs.shape[1]) ** 2, axis=(0, 2))
    scale: Array = np.where(energy > 0, np.sqrt(energy / (outputs.shape[0] // p * columns)), 1.0)
    return scale


def _listed(values: Array, count: int = 24) -> str:
    listed = ", ".join(f"{value:.3g}" for value in values[:count])
    return listed + (f", ... ({len(values)} values)" if len(values) > count else "")


def system_range(projected: Array, scale: Array, floor: float, order: int | None, instruments: int) -> Range:
    """Find order, A and C from the projected outputs (s p, any), rows scaled by `scale` (p,) per output.

    InvalidData where the order asked for cannot be had, or no order is asked for and there is no clean gap, or one that leaves A
    undetermined.
    """
    p = len(scale)
    s = len(projected) // p
    scaled = projected / np.tile(scale, s)[:, np.newaxis]
    left, values, _ = np.linalg.svd(scaled, full_matrices=False)
    most = min(p * (s - 1), instruments)

    def undecided(message: str) -> InvalidData:
        return OrderUndecided(message, values) if most else InvalidData(message)

    if order is None:
        gap = choose_order(values, floor, most)
        if gap.order == 0:
            raise undecided(
                f"no dynamics are seen: no singular value ({_listed(values)}) that could be an order stands above the rounding level "
                f"{floor:.2g}; the outputs may depend on the "
                f"present input alone, or block_rows and past_rows are too small (orders up to {most} could be seen): raise them or "
                "pass order="
            )
        if not gap.clean:
            raise undecided(
                f"no clean gap in the singular values ({_listed(values)}): the largest is after {gap.order}, ratio {gap.ratio:.3g}, the "
                "next after "
                f"{gap.runner_up}, ratio {gap.runner_up_ratio:.3g}; a clean one is at least {LEAD:g} times the next. Pass "
                "order=, or try more block_rows, more samples, "
                f"or an input that excites more"
            )
    else:
        order = positive(order, "order", "state how many states the model has, or leave it out to take the gap in the singular values")
        if order > p * (s - 1):
            raise InvalidData(
                f"order = {order} is above p (block_rows - 1) = {p} * {s - 1} = {p * (s - 1)}, the most that the shift of O_s can carry: "
                f"pass a smaller order or block_rows >= {-(-order // p) + 1}"
            )
        if order > instruments:
            raise InvalidData(
                f"order = {order} is above the {instruments} directions of past inputs that serve as instruments: pass a smaller order "
                "or more past_rows"
            )
        gap = gap_at(values, floor, order)
    n = gap.order
    warnings = []
    if values[n - 1] <= floor:
        warnings.append(
            f"order {n} is above the rank seen in the data: singular value {n} is {values[n - 1]:.3g}, at the rounding level "
            f"{floor:.2g}; the states beyond mean nothing"
        )
    # Signs fixed by each column's largest entry, so that equal data give equal matrices.
    basis = left[:, :n]
    basis = basis * np.where(basis[np.argmax(np.abs(basis), axis=0), np.arange(n)] < 0, -1.0, 1.0)
    observability = basis * np.sqrt(np.maximum(values[:n], np.finfo(np.float64).tiny))
    upper = basis[:-p]
    A_basis, _, rank, shift_values = np.linalg.lstsq(upper, basis[p:], rcond=len(upper) * EPS)
    condition = float(shift_values[0] / shift_values[-1]) if shift_values[-1] > 0 else float("inf")
    if rank < n or condition > UNDETERMINED:
        if order is None:
            raise undecided(
                f"the largest gap in the singular values ({_listed(values)}), after {n}, ratio {gap.ratio:.3g}, leaves A undetermined "
                f"(O_(s-1) has condition {condition:.2g}): faults without noise make such gaps beyond the order, and so do block_rows at "
                f"or below the lag (here {s}). Pass order=, that of a smaller gap, or take more block_rows"
            )
        warnings.append(
            f"O_(s-1) has condition {condition:.2g}: block_rows = {s} is at or below the system's lag, or the order is too high; A is "
            "not determined. Take more block_rows"
        )
    # From the orthonormal basis to the balanced one, O = basis sqrt(values).
    roots = np.sqrt(np.maximum(values[:n], np.finfo(np.float64).tiny))
    A = A_basis * roots[np.newaxis, :] / roots[:, np.newaxis]
    return Range(A, observability[:p], scale, values, gap, condition, tuple(warnings))


def check_compression(compression: Compression) -> None:
    """Raise InvalidData for too few windows, and for inputs that do not excite the future window."""
    rows = len(compression.factor)
    if compression.columns < rows:
        lags = compression.past_rows + compression.block_rows
        needed = rows + compression.samples - compression.columns
        raise InvalidData(
            f"{compression.samples} samples are too few: they give "
            f"{counted(compression.columns, 'window')} of {lags} samples for {rows} rows of "
            "inputs and outputs; "
            f"at least {needed} samples are needed, or fewer block_rows and past_rows"
        )
    largest = float(np.abs(compression.factor).max())
    if not largest < 1e150:
        raise InvalidData(f"the signals are so large (about {largest:.1g}) that their squares overflow: choose other units")
    future = compression.factor[: compression.block_rows * compression.n_u, : compression.block_rows * compression.n_u]
    lengths = np.linalg.norm(future, axis=0)
    directions = 0 if np.any(lengths == 0) else int(np.linalg.matrix_rank(future / lengths, tol=len(future) * EXCITED))
    if directions < len(future):
        seen = int(np.linalg.matrix_rank(future)) if directions == 0 else directions
        raise InvalidData(
            f"u does not excite enough: its windows of block_rows = {compression.block_rows} samples span {seen} of {len(future)} "
            "directions (a constant, or a sum of few sines?); "
            f"use a richer input, fewer block_rows, or leave out inputs that never change"
        )


def _spread(source: Pieces) -> None:
    """Raise InvalidData for a constant input, which it names: the commonest lack of excitation."""
    least = greatest = None
    for _, part in source:
        low, high = part.min(axis=0), part.max(axis=0)
        least = low if least is None else np.minimum(least, low)
        greatest = high if greatest is None else np.maximum(greatest, high)
    assert least is not None and greatest is not None
    constant = constant_channels(least, greatest)
    if constant:
        raise InvalidData(
            f"input {', '.join(str(channel) for channel in constant)} (counted from 0) is constant: it excites nothing; leave it out, "
            "or record with an input that varies"
        )


def _instruments(past: Array, apart: Array) -> Array:
    """Return orthonormal directions (q n_u, k) among the past inputs' own (columns of `apart` = L22) that they excite; `past` is [L21 L22].

    Directions at the rounding level would be noise of the arithmetic, not instruments.
    """
    lengths = np.linalg.norm(past, axis=1)
    lengths[lengths == 0] = 1.0
    _, strengths, directions = np.linalg.svd(apart / lengths[:, np.newaxis])
    kept: Array = directions[strengths > len(apart) * EXCITED].T
    return kept


def _range_of(compression: Compression, order: int | None) -> Range:
    check_compression(compression)
    parts = compression.blocks()
    scale = output_scale(np.hstack([parts.l31, parts.l32, parts.l33]), compression.p, compression.columns)
    directions = _instruments(np.hstack([parts.l21, parts.l22]), parts.l22)
    projected = parts.l32 @ directions / np.sqrt(compression.columns)
    # The scaled Yf / sqrt(columns) has s p rows of length about one, and L's rounding is relative to it as a whole.
    floor = 10 * max(compression.rounding, EPS) * len(projected)
    return system_range(projected, scale, floor, order, directions.shape[1])


def _stability(A: Array) -> tuple[str, ...]:
    radius = float(np.max(np.abs(np.linalg.eigvals(A)), initial=0.0))
    if radius < 1:
        return ()
    return (f"the identified A is not stable: its largest eigenvalue has modulus {radius:.6g}; it is reported as it was found",)


def complete(found: Range, compression: Compression, experiments: Sequence[Pieces] | None) -> MoespModel:
    """Complete the record with B, D, x0 and the rest, by output error where there are data and A allows it, else by MOESP's regression."""
    A, scale = found.A, found.scale[:, np.newaxis]
    C = found.C * scale
    warnings = found.warnings + _stability(A)
    amplification = growth(A, compression.samples)
    covariance: Array | None = None
    if experiments is not None and amplification <= AMPLIFICATION:
        scaled = [((y / found.scale, u) for y, u in data) for data in experiments]
        inputs = by_output_error(scaled, A, found.C, compression.n_u)
        D = inputs.D * scale
        model = StateSpaceModel(A, inputs.B, C, D)
        # Parameters an output: B and x0 are shared by the p outputs.
        fitted = model.n_u + (model.n * model.n_u + model.n * len(experiments)) / model.p
        assert inputs.squares is not None
        covariance = inputs.squares * scale * found.scale / max(compression.samples - fitted, 1.0)
    else:
        if experiments is not None:
            warnings += (
                f"over the record the powers of A grow by {amplification:.2g}: B and D are from MOESP's regression, without output "
                "error, initial state and residual covariance",
            )
        inputs = by_moesp(compression, A, C)
        model = StateSpaceModel(A, inputs.B, C, inputs.D)
    if inputs.condition > 1e8:
        warnings += (f"the regression for B and D has condition {inputs.condition:.2g}: they are poorly determined",)
    conditions = {"inputs": compression.condition, "observability": found.condition, "input matrices": inputs.condition}
    return MoespModel(
        model, found.gap.order, found.values, found.gap, inputs.initial_states, covariance, conditions, compression.route, warnings
    )


@one_thread()
def pi_moesp(
    y: ArrayLike | Iterable[tuple[ArrayLike, ArrayLike]],
    u: ArrayLike | None = None,
    *,
    order: int | None = None,
    block_rows: int,
    past_rows: int | None = None,
    route: str | None = None,
) -> MoespModel:
    """Identify the model of one experiment by PI-MOESP [V93].

    Parameters
    ----------
    y, u : array_like, (N, p) and (N, n_u)
        In any units, not modified; without `u`, `y` gives the consecutive pieces (y, u) anew at each `iter`, as a list or a record does.
        Arrays are read in such pieces, too: extra memory does not grow with N.
    order : int, optional
        n, chosen by the gap of the singular values where it is not given.
    block_rows : int
        s, beyond the lag: p (s - 1) >= n.
    past_rows : int, optional
        By default `block_rows`; past_rows n_u >= n.
    route : str, optional
        As in `compress`.

    Returns
    -------
    MoespModel
        A, B, C, D, with the singular values.

    Raises
    ------
    InvalidData
        Data or arguments that cannot give a model, or can be read only once.
    OrderUndecided
        The order is left open and there is no clean gap, or one that leaves A undetermined.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import pi_moesp
    >>> u = np.random.default_rng(1).standard_normal((300, 1))
    >>> y = np.zeros((300, 1))
    >>> for k in range(299):
    ...     y[k + 1] = 0.5 * y[k] + u[k]
    >>> found = pi_moesp(y, u, block_rows=5)
    >>> found.order, found.A.round(6).tolist()
    (1, [[0.5]])
    """
    source = experiment(y, u)
    return _modelled([source], _compressed(y, u, source, block_rows, past_rows, route), order)


@one_thread()
def pi_moesp_experiments(
    experiments: Sequence[tuple[ArrayLike | Pieces, ArrayLike | None]],
    *,
    order: int | None = None,
    block_rows: int,
    past_rows: int | None = None,
    route: str | None = None,
) -> MoespModel:
    """Identify one model of several experiments with the same channels, each with an own initial state, by PI-MOESP [V93].

    Parameters
    ----------
    experiments : list of (y, u)
        Each y (N_i, p) and u (N_i, n_u) with its own number of samples, all in the same units.
    order, block_rows, past_rows, route
        As of `pi_moesp`.

    Returns
    -------
    MoespModel
        As of `pi_moesp`.

    Raises
    ------
    InvalidData
        As `pi_moesp`, and where no experiment is given.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import StateSpaceModel, pi_moesp_experiments
    >>> model = StateSpaceModel([[0.5]], [[1.0]], [[1.0]], [[0.0]])
    >>> inputs = np.split(np.random.default_rng(1).standard_normal((300, 1)), [100])
    >>> pi_moesp_experiments([(model.simulate(u), u) for u in inputs], block_rows=5).A.round(6).tolist()
    [[0.5]]
    """
    if len(experiments) == 0:
        raise InvalidData("no experiment: give at least one pair (y, u)")
    sources = [experiment(y, u) for y, u in experiments]
    compressions = [_compressed(y, u, source, block_rows, past_rows, route) for (y, u), source in zip(experiments, sources, strict=True)]
    return _modelled(sources, merge(*compressions), order)


def _compressed(y: Any, u: ArrayLike | None, source: Pieces, block_rows: int, past_rows: int | None, route: str | None) -> Compression:
    """Compress arrays, which show their shapes beforehand, or pieces."""
    if u is not None:
        return compress(y, u, block_rows=block_rows, past_rows=past_rows, route=route)
    return compress_chunks(source, block_rows=block_rows, past_rows=past_rows, route=route)


def _modelled(sources: Sequence[Pieces], compression: Compression, order: int | None) -> MoespModel:
    """Return the model of all experiments from their merged compression; a lack of excitation is told by the constant input, if there is
    one."""
    try:
        check_compression(compression)
    except InvalidData:
        if len(sources) == 1:
            _spread(sources[0])
        raise
    return complete(_range_of(compression, order), compression, sources)


@one_thread()
def pi_moesp_from_compression(compression: Compression, *, order: int | None = None) -> MoespModel:
    """Return the model from a compression alone, with B and D by MOESP's own regression [V93]; no initial state and no residual
    covariance."""
    return complete(_range_of(compression, order), compression, None)
