"""example-v: n_v = 1, two columns in (Fhat, Ghat), (A, F) not controllable, and the caption that the review quotes.

Decided over the example's own number field: F is an eigenvector of A to a root of 4 q^3 - q^2 - 3 q + 1, irreducible over Q.
"""

from __future__ import annotations

from ...exact.algebra.matrices import Matrix
from ...exact.structure.fault_columns import fault_space
from ..evidence.families import paper_example
from ..evidence.once_a_run import once_a_run
from ..evidence.subjects import kernel_once
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, accepted

SAMPLES = 24


@once_a_run(1)
def _certificates() -> dict[str, Certificate]:
    """Everything about the example is certified here, and accepted by the checker."""
    system = paper_example().residual
    kernel = kernel_once(system)
    found = {
        "ranks": make.window_ranks(kernel),
        "inversion": make.left_invertible(kernel),
        "known": make.inversion_delay(kernel, known_state=True),
        "unknown": make.inversion_delay(kernel, known_state=False),
        "finite": make.finite_zeros(system),
        "infinite": make.infinite_zeros(system),
        "observability": make.matrix_rank("observability", system),
        "reachability": make.matrix_rank("reachability", system),
        "limit": make.fault_space(kernel, fault_space(kernel)),
    }
    for s in range(1, 7):
        found[f"space {s}"] = make.fault_space(kernel, fault_space(kernel, s))
    # x(0) and a fault that excite everything: values of k -> (k^3 mod 7) - 3 and the first unit vectors, all rational
    v = Matrix.of([[k**3 % 7 - 3 + (k % 5 == 2)] for k in range(SAMPLES)], system.field)
    x0 = Matrix.of([[1], [-1], [2]], system.field)
    for s in (5, 6):
        found[f"excitation {s}"] = make.data_rank("excitation", system, x0, v, s)
        found[f"R{s}"] = make.data_rank("residual-hankel", system, x0, v, s)
    accepted(found.values())
    return found


def _outcome(holds: bool, words: str, *names: str) -> Outcome:
    found = _certificates()
    certificates = tuple(found[name] for name in names)
    return Outcome(Verdict.CERTIFIED if holds else Verdict.REFUTED, words, certificates)


def example_v_one_fault(bench: Workbench) -> Outcome:
    """The example is left-invertible, and its gap is 1 for every s >= lag."""
    says = _certificates()["ranks"]["statement"]
    indices, r = says["left_minimal_indices"], says["normal_rank"]
    words = f"window ranks {says['window_ranks']} for s = 1..6, left minimal indices {indices}, normal rank {r}"
    return _outcome(says["normal_rank"] == 1 and says["window_ranks"] == [2, 4, 5, 6, 7, 8], words, "ranks", "inversion")


def example_v_two_columns(bench: Workbench) -> Outcome:
    """The example has n_z = 2 in the limit, which is reached at s = lag + 1."""
    found = _certificates()
    sizes = [len(found[f"space {s}"]["statement"]["basis"]) for s in range(1, 7)]
    basis = found["limit"]["statement"]["basis"]
    words = f"n_z = {sizes} for s = 1..6, in the limit {len(basis)} with basis rows {basis}"
    return _outcome(len(basis) == 2 and sizes[2:] == [2, 2, 2, 2], words, "limit", "space 2", "space 3")


def example_v_window_of_assumption_4(bench: Workbench) -> Outcome:
    """The example is claimed to have two columns already at s = max(l, n_x - 1)."""
    found = _certificates()
    s = max(found["known"]["statement"]["delay"], paper_example().residual.n - 1)
    size = len(found[f"space {s}"]["statement"]["basis"])
    return _outcome(size == 2, f"at s = max(l, n_x - 1) = {s} problem (11) has {size} columns", f"space {s}", "known")


def example_v_not_controllable(bench: Workbench) -> Outcome:
    """In the example (A, F) is not controllable, and (A, C) is observable."""
    found = _certificates()
    reach, observe = (found[name]["statement"]["rank"] for name in ("reachability", "observability"))
    return _outcome(reach < 3 and observe == 3, f"rank of [F AF A^2F] is {reach}, of O_3 it is {observe}", "reachability", "observability")


def example_v_zeros_and_delays(bench: Workbench) -> Outcome:
    """The example has one zero, at infinity; its lag is 2, and its delay is 1 whether the initial state is known or not."""
    found = _certificates()
    finite = len(found["finite"]["statement"]["invariant_zero_polynomial"]) - 1
    orders = found["infinite"]["statement"]["infinite_zero_orders"]
    delays = [found[name]["statement"]["delay"] for name in ("known", "unknown")]
    lag = max(found["ranks"]["statement"]["left_minimal_indices"])
    words = f"{finite} finite zeros, infinite zero orders {orders}, lag {lag}, delays {delays[0]} (state known) and {delays[1]} (unknown)"
    return _outcome((finite, orders, lag, delays) == (0, [1], 2, [1, 1]), words, "finite", "infinite", "known", "unknown")


def example_v_seventh_singular_value(bench: Workbench) -> Outcome:
    """The caption that the review quotes is read as a rank: the seventh singular value of R5 is negligible, so that rank R5 = 6."""
    r5, r6, words = _data_ranks()
    return _outcome(r5 == 6 and r6 == 7, words, "R5", "R6", "excitation 5", "excitation 6")


def example_v_rank_difference(bench: Workbench) -> Outcome:
    """The review concludes, rightly, that rank R6 - rank R5 = 1."""
    r5, r6, words = _data_ranks()
    return _outcome(r6 - r5 == 1, words, "R5", "R6", "excitation 6")


def _data_ranks() -> tuple[int, int, str]:
    found = _certificates()
    r5, r6, e5, e6 = (found[name]["statement"]["rank"] for name in ("R5", "R6", "excitation 5", "excitation 6"))
    words = f"on {SAMPLES} exact samples with [X; V_s] of full row rank ({e5} at s = 5, {e6} at s = 6): rank R5 = {r5}, rank R6 = {r6}"
    return r5, r6, words
