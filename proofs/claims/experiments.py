"""Claims about what PI-MOESP converges to, decided on exact population limits of experiments.

proposition-1      under assumptions 1 to 3 PI-MOESP recovers A, B, C, D consistently
assumption-2       (1/N) sum u(k-l) v(k)^T -> 0 for all l >= 0, which with assumption 1 is said to give (1/N) V_s U_s^T -> 0
past-outputs       with past outputs among the instruments, as tools have them, a coloured fault can bias the estimate
settle-1           a fault that follows the input, v(k) = K u(k-1), biases PI-MOESP. One does; not every one does
drives             a system with u and v(k) = sum phi_j u(k+j)
smallest_limit     the first small experiment that meets a condition, with its certificates
smallest_seasonal  the same among inputs of period 3
show, show_words   certificates of an experiment, and the experiment as it stands in an outcome
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from itertools import product
from typing import Any

from ...exact.algebra.matrices import Matrix
from ...exact.limits.experiments import Experiment
from ...exact.limits.hidden_states import hides_a_state
from ...exact.limits.moesp import PopulationLimits, limit
from ...exact.limits.moments import covariances
from ...exact.parametric.leads import lead_identities
from ..evidence.experiments import (
    NILPOTENT,
    Drawn,
    Drive,
    LimitEvidence,
    examine_experiment,
    experiment_of,
    experiments_in_order,
    following,
    leading,
)
from ..evidence.refuting_experiments import BOX as BOX_OF_PERIOD
from ..evidence.refuting_experiments import WITHOUT_RANK, in_order, kept, seasonal
from ..trust.limit_certificates import certificates_of
from ..trust.structure_certificates import Certificate
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, accepted, certify_records, counterexample, witnessed

# -- proposition-1 ---------------------------------------------------------------------------------------------------------


WHITE = (["1"], ["1"])
MOVING_AVERAGE = (["1", "1/2"], ["1"])
BOX = "n = m = nu = 1, F = 1, D = 0, p <= 2, A in {0, 1/2}, entries of B, C, G in {-1, 0, 1, 2}"


def drives(inputs: Sequence[tuple[list[str], list[str]]], phis: Sequence[list[str]]) -> list[Drive]:
    """Return functions that give a system the input u and the fault v(k) = sum phi_j u(k+j), for each u and phi."""
    return [partial(leading, u=u, den=den, phi=phi) for u, den in inputs for phi in phis]


LEADS = [["0", "1"], ["0", "2"], ["0", "0", "1"]]


def proposition_1_white_a_c(bench: Workbench) -> Outcome:
    """With u white and one-sided, (A, B) controllable and (A, C) observable, the limit is claimed to have the range of O_s."""
    return smallest_limit(bench, drives([WHITE], LEADS), lambda e: _regular(e) and not e.equal, "v leads u by one or two samples")


def proposition_1_white_a_c_seen(bench: Workbench) -> Outcome:
    """With u white and v leading it, the limit lies in the range of O_s; it is all of it iff (A, B + sum A^j F phi_j) is controllable."""
    records = [e for e in bench.limits if e.origin == Drawn.WHITE_LED and e.observable and e.long_past]
    return certify_limits(records, lambda e: e.within and e.equal == e.seen_controllable)


def proposition_1_white_b_d(bench: Workbench) -> Outcome:
    """With u white and one-sided, B and D by regression with the true A and C are claimed to be right.

    The claim is refuted where the limit gives these A and C, and both B and D are wrong.
    """

    def fails(e: LimitEvidence) -> bool:
        system, found = e.experiment.system, e.state_inputs
        return _regular(e) and e.equal and found is not None and found[0] != system.B and found[1] != system.D

    return smallest_limit(bench, drives([WHITE], LEADS), fails, "v leads u by one or two samples, the limit having the range of O_s")


def proposition_1_white_b_d_fails(bench: Workbench) -> Outcome:
    """There is a fault that is uncorrelated with a white u at all l >= 0, leaves A and C right, and moves B and D."""
    return witnessed(proposition_1_white_b_d(bench))


def proposition_1_white_b_d_seen(bench: Workbench) -> Outcome:
    """With u white and the true A, C, output error gives B + sum A^j F phi_j and D + G phi_0 + sum over j >= 1 of C A^(j-1) F phi_j."""
    records = [e for e in bench.limits if e.origin in (Drawn.WHITE_LED, Drawn.SIMULTANEOUS) and e.state_inputs is not None]
    return certify_limits(records, lambda e: e.state_inputs == _seen(e))


def proposition_1_coloured_a_c(bench: Workbench) -> Outcome:
    """With u coloured and one-sided, (A, B) controllable and (A, C) observable, the limit is claimed to lie in the range of O_s."""
    return smallest_limit(
        bench, drives([MOVING_AVERAGE], [["0", "0", "1"]]), lambda e: _regular(e) and not e.within, "u = e(k) + e(k-1)/2, v(k) = u(k+2)"
    )


def proposition_1_autoregressive(bench: Workbench) -> Outcome:
    """With u autoregressive of order at most s and v leading it, the limit still lies in the range of O_s."""
    return certify_limits([e for e in bench.limits if e.origin == Drawn.AUTOREGRESSIVE_LED], lambda e: e.within)


def proposition_1_autoregressive_longer(bench: Workbench) -> Outcome:
    """With u autoregressive of order s + 1 and v leading it, the limit is claimed to lie there too."""
    den = ["1", "-1/2", "1/4", "-1/8"]
    inputs = drives([(["1"], den)], [["0", "1"], ["0", "0", "1"]])
    return smallest_limit(bench, inputs, lambda e: _observed(e) and not e.within, "u of order 3, s = 2")


def proposition_1_lead_one(bench: Workbench) -> Outcome:
    """With G = 0, v(k) = u(k+1) and u of any colour, the limit still lies in the range of O_s."""
    return certify_limits([e for e in bench.limits if e.origin == Drawn.LEAD_ONE], lambda e: e.within)


def proposition_1_lead_one_with_feedthrough(bench: Workbench) -> Outcome:
    """The same is claimed with G other than 0."""
    return smallest_limit(
        bench, drives([MOVING_AVERAGE], [["0", "1"]]), lambda e: _observed(e) and not e.within, "u = e(k) + e(k-1)/2, v(k) = u(k+1)"
    )


def proposition_1_two_sided(bench: Workbench) -> Outcome:
    """With u and v uncorrelated at all lags, the limit lies in the range of O_s, and B and D are right by either regression."""
    return certify_limits([e for e in bench.limits if e.uncorrelated], lambda e: e.within and e.inputs_right)


def proposition_1_two_sided_output_error(bench: Workbench) -> Outcome:
    """Output error with the true A and C gives the true B and D, whatever the colour of u is."""
    return certify_limits([e for e in bench.limits if e.uncorrelated and e.state_inputs is not None], lambda e: e.output_error_right)


def proposition_1_two_sided_range(bench: Workbench) -> Outcome:
    """The limit is claimed to be all of that range for u of any colour, (A, B) controllable, past >= n: inputs of period 3 refute it."""
    return smallest_seasonal(lambda e: e.whole_range_expected and not e.equal, taps=1, others=WITHOUT_RANK)


def proposition_1_two_sided_one_state(bench: Workbench) -> Outcome:
    """Return all of that range with one state, B not 0 and past >= 1, whatever the colour and the number of inputs are."""
    records = [e for e in _expected(bench) if e.experiment.system.residual.n == 1]
    return certify_limits(records, lambda e: e.equal)


def proposition_1_two_sided_two_states(bench: Workbench) -> Outcome:
    """With n = past = 2 and one input it is less than the range for exactly the A that a formula names; both kinds are tried."""
    sizes = 2, 2, 1
    records = [e for e in _expected(bench) if (e.experiment.system.residual.n, e.experiment.past, e.experiment.system.nu) == sizes]
    records += [examine_experiment("kept in counterexamples/", kept(name)) for name in WITHOUT_RANK]
    found = certify_limits(records, lambda e: e.equal != hides_a_state(e.experiment, covariances(e.experiment)))
    lost = sum(not e.equal for e in records)
    if found.verdict == Verdict.CERTIFIED and lost in (0, len(records)):
        return replace(found, verdict=Verdict.ERROR, evidence="every experiment tried is of one kind")
    return replace(found, evidence=f"{found.evidence}; {lost} of them lose a state")


def proposition_1_two_sided_autoregressive(bench: Workbench) -> Outcome:
    """Return all of that range where u is autoregressive of order at most s."""
    return certify_limits([e for e in _expected(bench) if e.autoregressive], lambda e: e.equal)


def proposition_1_two_sided_nilpotent(bench: Workbench) -> Outcome:
    """Return all of that range where A is nilpotent, whatever the colour of u is."""
    return certify_limits([e for e in _expected(bench) if e.nilpotent], lambda e: e.equal)


def proposition_1_two_sided_long_past(bench: Workbench) -> Outcome:
    """Return all of that range where past >= n + the order of the filter of u, whatever the colour of u is."""
    return certify_limits([e for e in _expected(bench) if e.past_of_input], lambda e: e.equal)


def proposition_1_two_sided_long_past_inputs(bench: Workbench) -> Outcome:
    """With such a past B and D are right as well, by either regression."""
    return certify_limits([e for e in _expected(bench) if e.past_of_input], lambda e: e.equal and e.inputs_right)


def proposition_1_two_sided_almost_every(bench: Workbench) -> Outcome:
    """For a fixed u the exceptional (A, B) are common zeros of rational functions; at one nilpotent A they do not all vanish."""
    records = bench.material(NILPOTENT)
    return certify_limits([e for e in records if e.whole_range_expected], lambda e: e.equal)


def proposition_1_parametric(bench: Workbench) -> Outcome:
    """With all entries indeterminate, a pulse of u is answered as by B + sum A^j F phi_j and D + G phi_0 + sum C A^(j-1) F phi_j."""
    largest = range(3) if bench.full else range(2)
    dimensions = list(product((1, 2), (1, 2), (1, 2), (1, 2), largest))
    found = [lead_identities(*sizes) for sizes in dimensions]
    words = (
        f"at {len(found)} dimensions n, nu, m, p <= 2, leads up to {max(largest)}: Cov(Yf, Up) = O_s [...] for white u; "
        f"{sum(record.expanded for record in found)} identities of sympy expanded again by FLINT"
    )
    return Outcome(Verdict.IDENTITY, words)


def smallest_limit(bench: Workbench, inputs: Sequence[Drive], fails: Callable[[LimitEvidence], bool], scope: str) -> Outcome:
    """The outcome is REFUTED by the first of the small experiments that fails, as the checker has accepted it."""
    for experiment in experiments_in_order(inputs):
        if fails(bench.looked_at(experiment)) and fails(evidence := bench.examined_experiment(experiment)):
            return counterexample(show_words(evidence), f"{BOX}, {scope}", show(evidence))
    return Outcome(Verdict.ERROR, "no counterexample among the small experiments")


def smallest_seasonal(fails: Callable[[LimitEvidence], bool], taps: int, others: Sequence[str]) -> Outcome:
    """The smallest failing experiment with an input of period 3 makes it REFUTED, and so do the `others`, kept in counterexamples/."""
    for one in in_order():
        evidence = examine_experiment("search", seasonal(one, taps))
        if not fails(evidence):
            continue
        wrong = [name for name in others if not fails(examine_experiment("kept", kept(name)))]
        if wrong:
            return Outcome(Verdict.ERROR, f"counterexamples/{wrong[0]}.json refutes nothing")
        return counterexample(f"{show_words(evidence)}; and {', '.join(others)} of counterexamples/", BOX_OF_PERIOD, show(evidence)[:2])
    return Outcome(Verdict.ERROR, "no counterexample in the family")


def show(evidence: LimitEvidence) -> list[Certificate]:
    """Certificates of both limits and of the regressions."""
    return certificates_of(limit(evidence.experiment))


def show_words(evidence: LimitEvidence) -> str:
    """Return the experiment as it stands in an outcome."""
    e = evidence.experiment
    u, v = e.u_filter.to_json(), e.v_filter.to_json()
    return f"{e.system.residual}, B={e.system.B}, D={e.system.D}, s = {e.s}, past = {e.past}, u = {u}, v = {v}".replace("'", "")


def certify_limits(records: Sequence[LimitEvidence], holds: Callable[[LimitEvidence], bool]) -> Outcome:
    """Return the outcome of the statement `holds` on all of these experiments."""
    return certify_records(records, [e for e in records if not holds(e)], show_words, show, unit="experiments")


def _observed(e: LimitEvidence) -> bool:
    return e.controllable and e.observable


def _expected(bench: Workbench) -> list[LimitEvidence]:
    return [e for e in bench.limits if e.whole_range_expected]


def _regular(e: LimitEvidence) -> bool:
    return e.one_sided and e.controllable and e.observable and e.long_past


def _seen(e: LimitEvidence) -> tuple[Matrix, Matrix]:
    """Return the B and D that output error sees where v leads u."""
    residual, B, D = e.experiment.system.residual, e.experiment.system.B, e.experiment.system.D
    delay = len(e.experiment.u_filter.numerator) - 1
    phi = [e.experiment.v_filter.numerator[delay - j] for j in range(delay + 1)]
    column = residual.F
    D = D + residual.G @ phi[0]
    for j, weight in enumerate(phi):
        B = B + column @ weight
        if j + 1 < len(phi):
            D = D + residual.C @ column @ phi[j + 1]
        column = residual.A @ column
    return B, D


# -- assumption-2 ----------------------------------------------------------------------------------------------------------


def assumption_2_one_sided(bench: Workbench) -> Outcome:
    """The claim is that no correlation at l >= 0 is enough: a fault that leads a white input has none there, and moves B and D."""
    return smallest_limit(
        bench, drives([WHITE], [["0", "1"]]), lambda e: e.one_sided and not e.leads and not e.inputs_right, "v(k) = u(k+1), u white"
    )


def assumption_2_without_lag_zero(bench: Workbench) -> Outcome:
    """The claim is that no correlation at l >= 1 is enough: v(k) = u(k) has none there, and moves B or D."""
    return smallest_limit(bench, drives([WHITE], [["1"]]), lambda e: e.past_lags and not e.inputs_right, "v(k) = u(k), u white")


# -- past-outputs ----------------------------------------------------------------------------------------------------------


def past_outputs_coloured_fault(bench: Workbench) -> Outcome:
    """With u white and v coloured and independent of u, the limit of PO-MOESP is claimed to lie in the range of O_s, as PI-MOESP's does."""

    def drive(system: dict[str, Any]) -> Experiment:
        return experiment_of(system, [[["1", "0"]]], [[["0", "1"]], [["0", "1"]]])

    return smallest_limit(
        bench,
        [drive],
        lambda e: e.controllable and e.observable and e.equal and not e.past_outputs_within,
        "u white, v(k) = f(k) + f(k-1) of its own white f",
    )


def past_outputs_white_fault(bench: Workbench) -> Outcome:
    """With u and v white and independent and no other noise, it does lie there."""
    return certify_limits([e for e in bench.limits if e.origin == Drawn.INDEPENDENT_WHITE], lambda e: e.past_outputs_within)


def past_outputs_past_inputs(bench: Workbench) -> Outcome:
    """Where the limit of PO-MOESP leaves the range, PI-MOESP is claimed to be right: some inputs of period 3 defeat both."""
    others = [name for name in WITHOUT_RANK if name.endswith("coloured-fault") or name.startswith("rational")]
    return smallest_seasonal(lambda e: e.whole_range_expected and not e.past_outputs_within and not e.equal, taps=3, others=others)


def past_outputs_past_inputs_long_past(bench: Workbench) -> Outcome:
    """It is right where past >= n + the order of the filter of u."""
    records = [e for e in _expected(bench) if e.past_of_input and not e.past_outputs_within]
    return certify_limits(records, lambda e: e.equal and e.inputs_right)


# -- settle-1 --------------------------------------------------------------------------------------------------------------


NOT_ALL = ("following-fault", "following-fault-regression", "following-fault-two-states")


def settle_1_biased(bench: Workbench) -> Outcome:
    """There is such a fault with A and C right, as the limit has the range of O_s, and B or D wrong by either regression."""
    return witnessed(
        smallest_limit(
            bench,
            [partial(following, gain="1")],
            lambda e: _follows(e) and e.equal and not e.output_error_right and not e.inputs_right,
            "v(k) = u(k-1), u white",
        )
    )


def settle_1_for_every_system(bench: Workbench) -> Outcome:
    """Every case is claimed to give wrong A, C, B or D; but the leading left singular vectors of a limit of rank n + 1 can span O_s."""
    made, words = [], []
    for name in NOT_ALL:
        found = limit(kept(name))
        evidence = examine_experiment("kept", found.experiment)
        larger = found.past_inputs.rank == found.experiment.system.residual.n + 1
        right = _regressions_right(found)
        if not (_follows(evidence) and larger and found.leading_vectors_right(found.past_inputs) and right):
            return Outcome(Verdict.ERROR, f"counterexamples/{name}.json refutes nothing")
        made += certificates_of(found)
        words.append(f"{show_words(evidence)}: B and D right by {' and by '.join(right)}")
    message = "; ".join(words) + (
        "; all limits of rank n + 1; that the n leading left singular vectors, outputs unscaled, span the range of O_s is decided in "
        "rational arithmetic beside the certificates"
    )
    certificates = accepted(made)
    return Outcome(Verdict.REFUTED, message, certificates)


def settle_1_a_c_wrong(bench: Workbench) -> Outcome:
    """A and C are claimed to come out wrong, the limit having rank n + 1; but a zero of the fault at 0 can cancel the delay."""
    return smallest_limit(bench, [partial(following, gain="1")], lambda e: _follows(e) and e.equal, "v(k) = u(k-1), u white")


def settle_1_not_both(bench: Workbench) -> Outcome:
    """It never is so that the limit has the range of O_s and output error gives the true B and D."""
    families = Drawn.FEEDBACK, Drawn.FEEDBACK_HIDDEN, Drawn.FEEDBACK_UNSEEN_IN_INPUTS
    records = [e for e in bench.limits if e.origin in families and e.observable and _moves(e)]
    return certify_limits(records, lambda e: not (e.equal and e.output_error_right))


def _regressions_right(found: PopulationLimits) -> list[str]:
    """Return the regressions that give the true B and D with the true A and C."""
    both = {"output error": found.true_AC, "MOESP's regression": found.moesp}
    return [name for name, one in both.items() if one is not None and found.bias(one).B.is_zero() and found.bias(one).D.is_zero()]


def _follows(e: LimitEvidence) -> bool:
    return _moves(e) and e.controllable and e.observable and e.long_past


def _moves(e: LimitEvidence) -> bool:
    """Return whether neither K nor [F; G] K is 0."""
    residual, K = e.experiment.system.residual, e.experiment.v_filter.numerator[1]
    return not ((residual.F @ K).is_zero() and (residual.G @ K).is_zero())
