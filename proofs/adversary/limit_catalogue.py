"""This lists every attack on what is said of the limits of PI-MOESP and PO-MOESP.

    on_the_range       the limit has all of the range of O_s: a determinant that changes its sign, a least singular value
    on_containment     the limit stays inside the range of O_s: a share outside of it
    on_inputs          B and D come out right: their bias
    limit_attacks      all of these, and those on settle-1

What a reading says is an identity between rational functions (a share or a bias that is zero) or the absence of a zero (a rank). The
first is broken by almost any point of a family, so that a few exact points decide; the second only on a hypersurface or thinner.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from ...exact.limits.hidden_states import hides_a_state
from ...exact.limits.moments import covariances
from ..evidence.attacks import Aim, Attack, Family, Floats
from ..evidence.experiments import LimitEvidence
from .feedback_attacks import feedback_attacks
from .float_limits import FloatLimits, determinant, float_limits, input_bias, least_ratio, outside, partial_covariance
from .limit_attacks import (
    Fails,
    decided_by,
    exact_determinant,
    led_family,
    moving_average_family,
    open_family,
    shaped_family,
    vector_family,
)

DETERMINANT = "det M of the limit O_s M, against Hadamard's bound"
ALONE = "M of the limit O_s M, against the standard deviations of the state and of the input"
LEAST = "the least singular value of M of the limit O_s M, against the largest"
SHARE = "the share of the limit outside the range of O_s, in the Frobenius norm"
SHARE_PO = "the share of PO-MOESP's limit outside the range of O_s, in the Frobenius norm"
FELT = "the response to u of the outputs that the fault alone makes, which output error takes for one of B and D"
BIAS = "the bias of B and D by MOESP's regression, against the size of B, D, F, G"

COLOURED = ([[0, 1]], [[0, 0]], [[0, 1]])


def limit_attacks() -> Iterator[Attack]:
    """Yields the attacks in the order of the ledger."""
    yield from _refuted()
    yield from _standing()
    yield from feedback_attacks()


def on_the_range(target: str, family: Family, fails: Fails, name: str, starts: int = 12) -> Attack:
    """Returns an attack that looks for a change of sign of det M where M is square, and for a small singular value where it is wide."""
    drawn = family.at([0.0] * len(family.box))
    measure: Callable[[FloatLimits], float]
    square = drawn.past * len(drawn.B[0]) == len(drawn.A)
    if len(drawn.A) == 1:
        measured, measure = ALONE, partial_covariance if square else _length
    elif square:
        measured, measure = DETERMINANT, lambda found: determinant(found.coordinates)
    else:
        measured, measure = LEAST, lambda found: least_ratio(found.coordinates)
    return Attack(
        target=target,
        name=name,
        aim=Aim.SIGN if square else Aim.ZERO,
        measured=measured,
        family=family,
        quantity=lambda point: measure(float_limits(family.at(point))),
        decide=decided_by(family.at, fails),
        exact=exact_determinant(family.at) if square else None,
        starts=starts,
    )


def on_containment(target: str, family: Family, fails: Fails, name: str, *, past_outputs: bool = False) -> Attack:
    """Returns an attack that looks for a share of the limit outside the range of O_s."""

    def quantity(point: Floats) -> float:
        found = float_limits(family.at(point))
        return outside(found.past_outputs if past_outputs else found.past_inputs, found.observability)

    measured = SHARE_PO if past_outputs else SHARE
    return Attack(target, name, Aim.NONZERO, measured, family, quantity, decided_by(family.at, fails), starts=8)


def on_inputs(target: str, family: Family, fails: Fails, name: str) -> Attack:
    """Returns an attack that looks for a bias of B or D."""
    return Attack(target, name, Aim.NONZERO, BIAS, family, lambda x: input_bias(family.at(x)), decided_by(family.at, fails), starts=8)


def _length(found: FloatLimits) -> float:
    """Returns the length of M for one state, against the same deviations."""
    return float(np.linalg.norm(found.coordinates) / np.prod(found.deviations))


def _refuted() -> Iterator[Attack]:
    """Yields attacks on statements that are false, and are found to be so: they show that the adversary can refute."""
    two_poles, double_pole = shaped_family(2, 2, 2, 3, 1), shaped_family(2, 2, 2, 3, 1, repeated=True)
    longer, averaged = shaped_family(2, 3, 2, 4, 1, repeated=True), moving_average_family(2, 2, 2, 4)
    yield on_the_range("proposition-1.two-sided-range", two_poles, not_whole, "two poles")
    yield on_the_range("proposition-1.two-sided-range", double_pole, not_whole, "a double pole")
    yield on_the_range("proposition-1.two-sided-range", longer, not_whole, "a double pole, s above n")
    yield on_the_range("proposition-1.two-sided-range", averaged, not_whole, "a double pole and a moving average")
    yield on_the_range("objection-1.two-sided-suffices", double_pole, not_right, "a double pole")
    yield on_the_range("without consistency: u white", double_pole, not_right, "a double pole")
    coloured = shaped_family(2, 2, 2, 3, 1, repeated=True, fault=COLOURED, words="v(k) = f(k) + f(k-2) of its own white f")
    yield on_the_range("past-outputs.past-inputs", coloured, lambda d: not d.past_outputs_within and not_right(d), "a double pole")
    lead_one, lead_two = (0, 1), (0, 0, 1)
    white = led_family(2, 2, lead_one, past=2)
    yield on_the_range("proposition-1.white-a-c", white, lambda d: d.white and _one_sided(d) and not d.equal, "a fault one sample ahead")
    yield on_inputs(
        "proposition-1.white-b-d", white, lambda d: d.white and _one_sided(d) and not d.inputs_right, "a fault one sample ahead"
    )
    yield on_inputs(
        "assumption-2.one-sided",
        white,
        lambda d: d.white and d.one_sided and not d.leads and not d.inputs_right,
        "a fault one sample ahead",
    )
    same_time = led_family(1, 2, (1,))
    yield on_inputs("assumption-2.without-lag-zero", same_time, lambda d: d.past_lags and not d.inputs_right, "v(k) = u(k)")
    averaged_two = led_family(1, 2, lead_two, taps=1)
    yield on_containment("proposition-1.coloured-a-c", averaged_two, lambda d: _one_sided(d) and not d.within, "a fault two samples ahead")
    longer_memory = led_family(1, 2, lead_two, reflections=3)
    yield on_containment("proposition-1.autoregressive-longer", longer_memory, lambda d: _regular(d) and not d.within, "u of order s + 1")
    fed = led_family(1, 2, lead_one, taps=1)
    yield on_containment("proposition-1.lead-one-with-feedthrough", fed, lambda d: _regular(d) and not d.within, "a moving average")
    po = open_family(1, 2, coloured_input=False, coloured_fault=True)
    yield on_containment(
        "past-outputs.coloured-fault",
        po,
        lambda d: d.white and _regular(d) and d.uncorrelated and d.equal and not d.past_outputs_within,
        "all matrices free",
        past_outputs=True,
    )


def _standing() -> Iterator[Attack]:
    """Yields attacks on statements that stand."""
    families: Sequence[tuple[str, str, Family]] = (
        ("proposition-1.two-sided-one-state", "s = 1", shaped_family(1, 1, 1, 3, 2)),
        ("proposition-1.two-sided-one-state", "s = 3", shaped_family(1, 3, 1, 4, 1)),
        ("proposition-1.two-sided-one-state", "a longer past", shaped_family(1, 2, 2, 4, 1)),
        ("proposition-1.two-sided-autoregressive", "two poles, s = n", shaped_family(2, 2, 2, 2, 0)),
        ("proposition-1.two-sided-autoregressive", "a double pole, s above n", shaped_family(2, 3, 2, 3, 0, repeated=True)),
        ("proposition-1.two-sided-autoregressive", "three poles", shaped_family(3, 3, 3, 3, 0)),
        ("proposition-1.two-sided-nilpotent", "n = 2", nilpotent_family(2, 2, 4, 1)),
        ("proposition-1.two-sided-nilpotent", "n = 3", nilpotent_family(3, 2, 5, 1)),
        ("proposition-1.two-sided-long-past", "two poles", shaped_family(2, 2, 7, 3, 1)),
        ("proposition-1.two-sided-long-past", "a double pole", shaped_family(2, 2, 7, 3, 1, repeated=True)),
        ("objection-1.two-sided-long-past", "a double pole", shaped_family(2, 2, 7, 3, 1, repeated=True)),
        ("past-outputs.past-inputs-long-past", "a double pole", shaped_family(2, 2, 7, 3, 1, repeated=True, fault=COLOURED)),
    )
    for target, name, family in families:
        yield on_the_range(target, family, not_right, name, starts=8)
    yield on_the_range("proposition-1.two-sided-one-state", vector_family(2, 1, 1, 2), not_right, "A = a I, two inputs", starts=8)
    for n, p in ((1, 2), (2, 2), (2, 1)):
        free = open_family(n, p, coloured_input=True, coloured_fault=True)
        yield on_containment(
            "proposition-1.two-sided", free, lambda d: d.uncorrelated and not (d.within and d.inputs_right), f"n = {n}, p = {p}"
        )
        plain = open_family(n, p, coloured_input=False, coloured_fault=False)
        yield on_containment(
            "past-outputs.white-fault",
            plain,
            lambda d: d.uncorrelated and not d.past_outputs_within,
            f"n = {n}, p = {p}",
            past_outputs=True,
        )
    for name, family in (
        ("two poles", shaped_family(2, 2, 2, 3, 1)),
        ("a double pole", shaped_family(2, 2, 2, 3, 1, repeated=True)),
        ("a double pole, s above n", shaped_family(2, 3, 2, 4, 1, repeated=True)),
    ):
        plain_range = on_the_range("proposition-1.two-sided-two-states", family, _formula_differs, name)
        yield replace(plain_range, aim=Aim.STRATUM)
    for n, p in ((1, 2), (2, 1)):
        free = open_family(n, p, coloured_input=True, coloured_fault=True)
        yield Attack(
            "proposition-1.two-sided-output-error",
            f"n = {n}, p = {p}",
            Aim.NONZERO,
            FELT,
            free,
            partial(_felt, free),
            decided_by(free.at, lambda d: d.uncorrelated and d.state_inputs is not None and not d.output_error_right),
            starts=8,
        )
    driven = led_family(1, 2, (0, 0, 1), reflections=2)
    yield on_containment("proposition-1.autoregressive", driven, lambda d: not d.within, "two samples ahead, order s")
    ahead = led_family(2, 2, (0, 1), taps=2, feedthrough=False)
    yield on_containment("proposition-1.lead-one", ahead, lambda d: not d.within, "a moving average of order 2")


def nilpotent_family(n: int, s: int, reflections: int, tail: int) -> Family:
    """Returns a family with all poles at 0 and u of any colour, whose parameters are those of u."""
    family = shaped_family(n, s, n, reflections, tail, repeated=True)
    words = family.words.replace(f"one pole {n} times", f"the pole 0 {n} times")
    return Family(words, family.box[1:], lambda point: family.at([0 * point[0], *point]))


def _felt(family: Family, point: Floats) -> float:
    """Returns the size of Cov(Yf, Uf) Cov(Uf)^-1 of the outputs that the fault alone makes."""
    drawn = family.at(point)
    unknown = replace(drawn, B=[[0] * len(row) for row in drawn.B], D=[[0] * len(row) for row in drawn.D])
    return float(np.linalg.norm(float_limits(unknown).response))


def _formula_differs(d: LimitEvidence) -> bool:
    """Return whether a state is lost and the formula has none, or the other way round; n = past = 2, one input."""
    return d.uncorrelated and _regular(d) and d.equal == hides_a_state(d.experiment, covariances(d.experiment))


def not_whole(d: LimitEvidence) -> bool:
    """Whether every hypothesis of "all of the range" is met, and it is not."""
    return d.uncorrelated and _regular(d) and not d.equal


def not_right(d: LimitEvidence) -> bool:
    """Whether the same hypotheses are met, and the range, B or D comes out wrong."""
    return d.uncorrelated and _regular(d) and not (d.equal and d.inputs_right)


def _regular(d: LimitEvidence) -> bool:
    return d.controllable and d.observable and d.long_past


def _one_sided(d: LimitEvidence) -> bool:
    return d.one_sided and _regular(d)
