"""This lists every attack on what is said of the limits of PI-MOESP and PO-MOESP.

    on_the_range       the limit has all of the range of O_s: a determinant that changes its sign
    on_containment     the limit stays inside the range of O_s: a share outside of it
    on_inputs          B and D come out right: their bias
    limit_attacks      all of these, and those on settle-1

What a reading says is an identity between rational functions (a share or a bias that is zero) or the absence of a zero (a rank). The
first is broken by almost any point of a family, so that a few exact points decide; the second only on a hypersurface or thinner.
"""

from __future__ import annotations

from collections.abc import Iterator

from ..evidence.attacks import Aim, Attack, Family, Floats
from ..evidence.experiments import LimitEvidence
from .feedback_attacks import feedback_attacks
from .float_limits import determinant, float_limits, input_bias, outside
from .limit_attacks import Fails, decided_by, exact_determinant, led_family, moving_average_family, open_family, shaped_family

DETERMINANT = "det M of the limit O_s M, against Hadamard's bound"
SHARE = "the share of the limit outside the range of O_s, in the Frobenius norm"
SHARE_PO = "the share of PO-MOESP's limit outside the range of O_s, in the Frobenius norm"
BIAS = "the bias of B and D by MOESP's regression, against the size of B, D, F, G"

COLOURED = ([[0, 1]], [[0, 0]], [[0, 1]])


def limit_attacks() -> Iterator[Attack]:
    """Yield the attacks in the order of the ledger."""
    yield from _refuted()
    yield from feedback_attacks()


def on_the_range(target: str, family: Family, fails: Fails, name: str) -> Attack:
    """Return an attack that looks for a change of sign of det M, of a family with past nu = n."""
    return Attack(
        target=target,
        name=name,
        aim=Aim.SIGN,
        measured=DETERMINANT,
        family=family,
        quantity=lambda point: determinant(float_limits(family.at(point)).coordinates),
        decide=decided_by(family.at, fails),
        exact=exact_determinant(family.at),
    )


def on_containment(target: str, family: Family, fails: Fails, name: str, *, past_outputs: bool = False) -> Attack:
    """Return an attack that looks for a share of the limit outside the range of O_s."""

    def quantity(point: Floats) -> float:
        found = float_limits(family.at(point))
        return outside(found.past_outputs if past_outputs else found.past_inputs, found.observability)

    measured = SHARE_PO if past_outputs else SHARE
    return Attack(target, name, Aim.NONZERO, measured, family, quantity, decided_by(family.at, fails), starts=8)


def on_inputs(target: str, family: Family, fails: Fails, name: str) -> Attack:
    """Return an attack that looks for a bias of B or D."""
    return Attack(target, name, Aim.NONZERO, BIAS, family, lambda x: input_bias(family.at(x)), decided_by(family.at, fails), starts=8)


def _refuted() -> Iterator[Attack]:
    """Yield attacks on statements that are false, and are found to be so: they show that the adversary can refute."""
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
    po = open_family(1, 2)
    yield on_containment(
        "past-outputs.coloured-fault",
        po,
        lambda d: d.white and _regular(d) and d.uncorrelated and d.equal and not d.past_outputs_within,
        "all matrices free",
        past_outputs=True,
    )


def not_whole(d: LimitEvidence) -> bool:
    """Return whether every hypothesis of "all of the range" is met, and it is not."""
    return d.uncorrelated and _regular(d) and not d.equal


def not_right(d: LimitEvidence) -> bool:
    """Return whether the same hypotheses are met, and the range, B or D comes out wrong."""
    return d.uncorrelated and _regular(d) and not (d.equal and d.inputs_right)


def _regular(d: LimitEvidence) -> bool:
    return d.controllable and d.observable and d.long_past


def _one_sided(d: LimitEvidence) -> bool:
    return d.one_sided and _regular(d)
