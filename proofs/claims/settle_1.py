"""settle-1: a fault that follows the input, v(k) = K u(k-1), biases PI-MOESP. One does; not every one does."""

from __future__ import annotations

from functools import partial

from ...exact.limits.moesp import PopulationLimits, limit
from ..evidence.experiments import Drawn, LimitEvidence, examine_experiment, following
from ..evidence.kept_experiments import kept
from ..trust.limit_certificates import certificates_of
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, accepted, witnessed
from .proposition_1 import certify_limits, show_words, smallest_limit

NOT_ALL = ("following-fault", "following-fault-regression", "following-fault-two-states")


def biased(bench: Workbench) -> Outcome:
    """There is such a fault with A and C right, as the limit has the range of O_s, and B or D wrong by either regression."""
    return witnessed(
        smallest_limit(
            bench,
            [partial(following, gain="1")],
            lambda e: _regular(e) and e.equal and not e.output_error_right and not e.inputs_right,
            "v(k) = u(k-1), u white",
        )
    )


def for_every_system(bench: Workbench) -> Outcome:
    """Every case is claimed to give wrong A, C, B or D; but the leading left singular vectors of a limit of rank n + 1 can span O_s."""
    made, words = [], []
    for name in NOT_ALL:
        found = limit(kept(name))
        evidence = examine_experiment("kept", found.experiment)
        larger = found.past_inputs.rank == found.experiment.system.residual.n + 1
        right = _regressions_right(found)
        if not (_regular(evidence) and larger and found.leading_vectors_right(found.past_inputs) and right):
            return Outcome(Verdict.ERROR, f"counterexamples/{name}.json refutes nothing")
        made += certificates_of(found)
        words.append(f"{show_words(evidence)}: B and D right by {' and by '.join(right)}")
    message = "; ".join(words) + (
        "; all limits of rank n + 1; that the n leading left singular vectors, outputs unscaled, span the range of O_s is decided in "
        "rational arithmetic beside the certificates"
    )
    certificates = accepted(made)
    return Outcome(Verdict.REFUTED, message, certificates)


def a_c_wrong(bench: Workbench) -> Outcome:
    """A and C are claimed to come out wrong, the limit having rank n + 1; but a zero of the fault at 0 can cancel the delay."""
    return smallest_limit(bench, [partial(following, gain="1")], lambda e: _regular(e) and e.equal, "v(k) = u(k-1), u white")


def not_both(bench: Workbench) -> Outcome:
    """It never is so that the limit has the range of O_s and output error gives the true B and D."""
    families = Drawn.FEEDBACK, Drawn.FEEDBACK_HIDDEN, Drawn.FEEDBACK_UNSEEN_IN_INPUTS
    records = [e for e in bench.limits if e.origin in families and e.observable and _seen(e)]
    return certify_limits(records, lambda e: not (e.equal and e.output_error_right))


def _regressions_right(found: PopulationLimits) -> list[str]:
    """Return the regressions that give the true B and D with the true A and C."""
    both = {"output error": found.true_AC, "MOESP's regression": found.moesp}
    return [name for name, one in both.items() if one is not None and found.bias(one).B.is_zero() and found.bias(one).D.is_zero()]


def _regular(e: LimitEvidence) -> bool:
    return _seen(e) and e.controllable and e.observable and e.long_past


def _seen(e: LimitEvidence) -> bool:
    """Return whether neither K nor [F; G] K is 0."""
    residual, K = e.experiment.system.residual, e.experiment.v_filter.numerator[1]
    return not ((residual.F @ K).is_zero() and (residual.G @ K).is_zero())
