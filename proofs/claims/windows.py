"""Claims about the samples that show something of a system: ranks of windows, their gap, equality on a window, problem (11) at a window.

theorem-1        equal restricted behaviours on a window of length n_x imply output behaviour equivalence
theorem-2        rank [O_s T_s] = n_x + s n_v - zeta, zeta the number of transmission zeros (stated for minimal systems)
proposition-3    n_v = rank R_(s+1) - rank R_s; as rank [O_(s+1) T_(s+1)] - rank [O_s T_s], for data see assumption-4
objection-3      proposition-3 uses theorem-2, stated for minimal systems, while assumption 4 does not ask (A, F) to be controllable
problem-11       the maximal solution of N_s T_s = 0, N_s a basis of the left null space, is a basis (Fhat, Ghat) with n_z columns
window-ranks     every window at once, from the minimal indices of the pencil, without any hypothesis
sharp-windows    the lag for the rank gap, one sample more for problem (11) and for equality; none of the three can be shortened
reachable_part   the part of a system that faults reach; first_column_conditions: what rows ask of a first block column
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from itertools import islice, product

from ...exact.algebra.fields import QQ
from ...exact.algebra.matrices import Matrix, beside, column_basis, solve_left
from ...exact.structure.behavior import compare
from ...exact.structure.fault_columns import fault_space, with_pair
from ...exact.structure.kernel_rows import KernelRepresentation, column_conditions
from ...exact.system.systems import ResidualSystem
from ...exact.system.windows import reachability_matrix, window_matrix
from ..boxes.box import Box, grouped, in_order
from ..evidence.alternatives import PAIRS, PairEvidence, comparison_certificate
from ..evidence.corpus import CORPUS, Evidence
from ..evidence.families import adversarial, paper_example, random_systems, shift_registers
from ..evidence.parametric import gap_claim, inclusion_claim, zero_count_claim
from ..evidence.questions import MINIMAL, RANKS, WINDOW_SPACES, WINDOWS, ZEROS
from ..evidence.subjects import kernel_once
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate, accept, sha256
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, accepted, all_accepted, certify, certify_records, counterexample
from .common import gap_is_m_from, identity, ranks_and_inversion, show_pair, spaces, zeros

# -- theorem-1 -------------------------------------------------------------------------------------------------------------


BOX = Box(n=(1, 2), m=(1, 2), p=(1, 2), total=4)
PAIRS_BOX = Box(n=(1, 2), m=(1, 2), p=(1, 2), total=5)


def theorem_1_n_samples(bench: Workbench) -> Outcome:
    """n samples are claimed to decide, both systems having n states and being observable, controllable and left-invertible."""
    return _smallest_pair(same_A_and_C=False)


def theorem_1_n_samples_same_a_c(bench: Workbench) -> Outcome:
    """n samples are claimed to decide where both systems have the same (A, C)."""
    return _smallest_pair(same_A_and_C=True)


def theorem_1_n_plus_1_samples(bench: Workbench) -> Outcome:
    """n + 1 samples, n the larger number of states.

    Pair by pair, and by grouping on kernel rows: the rows of degree at most n, which n + 1 samples show, name the behaviour where no
    row has a larger degree; systems that share them are equal for ever. So one look at the degrees decides all pairs at once.
    """
    bench.need(PAIRS, CORPUS[RANKS])
    systems = bench.corpus((RANKS,))
    failing = [e for e in bench.pairs if e.first_difference is not None and e.first_difference > max(e.first.n, e.second.n) + 1]
    outcome = certify_records(bench.pairs, failing, _words, show_pair)
    longer = [e for e in systems if e.kernel.lag > e.system.n]
    if longer:
        words = f"{longer[0].system} has a kernel row of degree {longer[0].kernel.lag}"
        certificates = accepted([make.window_ranks(kernel_once(longer[0].system))])
        return Outcome(Verdict.REFUTED, words, certificates)
    total = sum(e.weight for e in systems)
    words = f"{outcome.evidence}; by kernel rows, none of degree above n, every pair of the {total} systems of the corpus"
    return replace(outcome, evidence=words, decided=outcome.decided | all_accepted(systems))


def theorem_1_lag_plus_1(bench: Workbench) -> Outcome:
    """One sample more than the larger of the two lags decides."""
    failing = [e for e in bench.pairs if e.first_difference is not None and e.first_difference > max(e.lags) + 1]
    return certify_records(bench.pairs, failing, _words, show_pair)


def theorem_1_either_lag(bench: Workbench) -> Outcome:
    """One sample more than either of the lags decides where the normal ranks are equal."""
    records = [e for e in bench.pairs if e.normal_ranks[0] == e.normal_ranks[1]]
    failing = [e for e in records if e.first_difference is not None and e.first_difference > min(e.lags) + 1]
    return certify_records(records, failing, _words, show_pair)


def theorem_1_sharp(bench: Workbench) -> Outcome:
    """For every n tried, two left-invertible systems with the same (A, C) agree on n samples and differ on n + 1."""
    largest = 12 if bench.full else 8
    certificates: list[Certificate] = []
    for n in range(1, largest + 1):
        idle, driven = (kernel_once(system) for system in shift_registers(n))
        pair = [make.window_equality(idle, driven, n), comparison_certificate(idle, driven)]
        if pair[1]["statement"]["window"] != n + 1:
            return Outcome(Verdict.REFUTED, f"the shift registers of length {n} differ elsewhere", accepted(pair))
        certificates += [*pair, make.left_invertible(idle), make.left_invertible(driven)]
    words = f"by one witness for every n = 1..{largest}: the shift register of length n with F = 0 against F = e_n"
    return Outcome(Verdict.CERTIFIED, words, accepted(certificates)[:8], frozenset(map(sha256, certificates)))


def theorem_1_parametric(bench: Workbench) -> Outcome:
    """With all entries of both systems indeterminate, inclusion on n + 1 samples is inclusion on every window."""
    quick = [(1, 1, 1), (1, 2, 1), (1, 1, 2), (1, 2, 2), (2, 1, 1), (2, 2, 1)]
    return identity(bench, inclusion_claim, quick, [(1, 3, 1), (2, 1, 2), (1, 3, 2), (2, 2, 2)])


def _smallest_pair(*, same_A_and_C: bool) -> Outcome:
    """The first system of the box with a partner equal on n samples but not on n + 1 makes it REFUTED, with its first partner."""

    def key(system: ResidualSystem) -> object:
        return column_basis(window_matrix(system, system.n)), (system.A, system.C) if same_A_and_C else None

    @cache
    def longer(system: ResidualSystem) -> Matrix:
        return column_basis(window_matrix(system, system.n + 1))

    for first, group in grouped(PAIRS_BOX, key, "observable and controllable and left_invertible"):
        second = next((other for other in group if longer(other) != longer(first)), None) if len(group) > 1 else None
        if second is not None:
            scope = f"{PAIRS_BOX}, both of the same dimensions, observable, controllable, left-invertible"
            return counterexample(f"{first} against {second}", scope, _pair_certificates(first, second))
    return Outcome(Verdict.ERROR, "no counterexample in the box")


def _pair_certificates(first: ResidualSystem, second: ResidualSystem) -> Iterator[Certificate]:
    kernels = kernel_once(first), kernel_once(second)
    yield make.window_equality(*kernels, first.n)
    yield comparison_certificate(*kernels)
    for kernel in kernels:
        yield make.left_invertible(kernel)
        yield make.matrix_rank("observability", kernel.system)
        yield make.matrix_rank("reachability", kernel.system)


def _words(record: PairEvidence) -> str:
    return f"{record.first} against {record.second}, first difference on {record.first_difference} samples"


# -- theorem-2 -------------------------------------------------------------------------------------------------------------


def theorem_2_transfer_function_zeros(bench: Workbench) -> Outcome:
    """The formula is claimed with the zeros of the transfer function, for observable left-invertible systems, controllable or not."""

    def confirm(system: ResidualSystem) -> bool:
        statements = {c["kind"]: c["statement"] for c in _with_reachable_part(system)}
        part = statements["finite-zeros"], statements["infinite-zeros"]
        zeta = len(part[0]["invariant_zero_polynomial"]) - 1 + sum(part[1]["infinite_zero_orders"])
        ranks = statements["window-ranks"]["window_ranks"]
        return any(ranks[s - 1] != system.n + s * system.m - zeta for s in range(max(system.n, 1), len(ranks) + 1))

    sought = in_order(BOX, "observable and left_invertible and not controllable", reduced=True)
    found = next((system for system in sought if confirm(system)), None)
    if found is None:
        return certify(
            bench,
            (*MINIMAL, *ZEROS),
            lambda e: e.observable and e.left_invertible and e.controllable,
            _formula,
            zeros,
        )
    return counterexample(f"{found}, whose transfer function is that of its reachable part", BOX, _with_reachable_part(found))


def theorem_2_parametric(bench: Workbench) -> Outcome:
    """With all entries indeterminate the formula holds on every stratum with r = m, where the zeros are counted on the pencil."""
    return identity(bench, zero_count_claim, [(1, 1, 1), (1, 2, 1), (1, 2, 2), (2, 1, 1)], [(2, 2, 1), (1, 3, 1), (2, 1, 2), (1, 3, 2)])


def _formula(e: Evidence) -> bool:
    return all(e.kernel.rank(s) == e.system.n + s * e.system.m - e.zeta for s in range(max(e.system.n, 1), e.system.n + 3))


def reachable_part(system: ResidualSystem) -> ResidualSystem:
    """Return the part of the system that faults reach, in a basis of the reachable states; minimal where the system is observable."""
    basis = column_basis(reachability_matrix(system))
    A, F = (solve_left(basis.transposed(), part.transposed()) for part in (system.A @ basis, system.F))
    if A is None or F is None:
        raise ArithmeticError("the reachable subspace is not invariant")
    return ResidualSystem(A.transposed(), F.transposed(), system.C @ basis, system.G)


def _with_reachable_part(system: ResidualSystem) -> Iterator[Certificate]:
    """Certificates of the window ranks, and of the zeros of the reachable part, which is minimal where the system is observable."""
    yield from zeros(system)
    part = reachable_part(system)
    yield make.finite_zeros(part)
    yield make.infinite_zeros(part)
    yield make.matrix_rank("observability", part)
    yield make.matrix_rank("reachability", part)


# -- proposition-3 ---------------------------------------------------------------------------------------------------------


def proposition_3_parametric(bench: Workbench) -> Outcome:
    """With all entries indeterminate, the gap is the normal rank from n on, on every stratum of the parameter space."""
    return identity(
        bench, gap_claim, [(1, 1, 1), (1, 2, 1), (1, 1, 2), (1, 2, 2), (2, 1, 1), (2, 2, 1)], [(1, 3, 1), (2, 1, 2), (1, 3, 2), (2, 2, 2)]
    )


# -- objection-3 -----------------------------------------------------------------------------------------------------------


def objection_3_controllability_needed(bench: Workbench) -> Outcome:
    """The formula is claimed to fail without controllability: the smallest such system where it holds; the paper's example is another."""

    def holds(system: ResidualSystem) -> bool:
        e = bench.examined(system, MINIMAL)
        return not e.controllable and e.observable and e.left_invertible and gap_is_m_from(lambda e: e.system.n)(e)

    sought = in_order(BOX, "observable and left_invertible and not controllable", reduced=True)
    found = next((system for system in sought if holds(system)), None)
    if found is None:
        return Outcome(Verdict.ERROR, "no uncontrollable system in the box with the right gap")
    example = paper_example().residual
    words = f"{found}, where the gap is m for s >= n all the same, as for the paper's example, which is not controllable either"
    return counterexample(words, BOX, [*zeros(found), *zeros(example)])


# -- problem-11 ------------------------------------------------------------------------------------------------------------


def problem_11_first_block_column(bench: Workbench) -> Outcome:
    """Is it enough that N_s annihilates the first block column of T_s(z)? The smallest system and column that say no."""
    for system in in_order(BOX, "observable and left_invertible"):
        kernel = kernel_once(system)
        window = kernel.lag + 1
        on_first = first_column_conditions(kernel, window)
        on_all = [column_conditions(row.coefficients, system.A, system.C) for row in kernel.rows_within(window)]
        for entries in product((-1, 0, 1), repeat=system.n + system.p):
            z = Matrix.of([[x] for x in entries])
            if all((one @ z).is_zero() for one in on_first) and not all((one @ z).is_zero() for one in on_all):
                words = f"{system}, z = {list(entries)}, s = {window}"
                return counterexample(words, f"{BOX}, s = lag + 1", [make.first_column_only(kernel, window, z), make.window_ranks(kernel)])
    return Outcome(Verdict.ERROR, "no counterexample in the box")


def first_column_conditions(kernel: KernelRepresentation, window: int) -> list[Matrix]:
    """Return rows (1 x (n + p)) that kill z = [f; g] iff every left null row of [O_s T_s] annihilates (g, C f, C A f, ...)."""
    system = kernel.system
    n, p = system.n, system.p
    outputs = [beside(Matrix.zero(system.field, p, n), Matrix.identity(system.field, p))]
    state = beside(Matrix.identity(system.field, n), Matrix.zero(system.field, n, p))
    for _ in range(window - 1):
        outputs.append(system.C @ state)
        state = system.A @ state
    found = []
    for row in kernel.rows_within(window):
        for shift in range(window - row.degree):
            first, *rest = (row.coefficients.rows([k]) @ outputs[k + shift] for k in range(row.degree + 1))
            found.append(sum(rest, first))
    return found


# -- window-ranks ----------------------------------------------------------------------------------------------------------


def window_ranks_ranks(bench: Workbench) -> Outcome:
    """rank [O_s T_s] = s r + sum of min(s, eta_i), which is compared with the rank of each window by itself for s = 1, ..., n + 2."""
    return certify(
        bench,
        (RANKS, WINDOWS),
        lambda e: True,
        lambda e: all(e.kernel.rank(s) == rank for s, rank in enumerate(e.window_ranks, 1)),
        _windows,
    )


def window_ranks_solutions(bench: Workbench) -> Outcome:
    """Problem (11) at window s has dimension n + p - sum of (eta_i + 1) over eta_i <= s - 1."""

    def holds(e: Evidence) -> bool:
        predicted = [
            e.system.n + e.system.p - sum(eta + 1 for eta in e.kernel.left_minimal_indices if eta < s)
            for s in range(1, len(e.space_dimensions) + 1)
        ]
        return list(e.space_dimensions) == predicted

    return certify(bench, (RANKS, WINDOW_SPACES), lambda e: True, holds, spaces(lambda s: s.n + 1))


def _windows(system: ResidualSystem) -> Iterator[Certificate]:
    yield make.window_ranks(kernel_once(system))
    for s in range(1, system.n + 2):
        yield make.matrix_rank("window", system, window=s)


# -- sharp-windows ---------------------------------------------------------------------------------------------------------


def sharp_windows_equality_as_many_faults(bench: Workbench) -> Outcome:
    """A left-invertible system with m >= 1 and lag >= 1 has a partner that agrees with it on lag samples and differs on lag + 1.

    The partner has the same (A, C) and as many faults, and is left-invertible too.
    """
    systems = [s for _, s in adversarial() if s.n <= 6] + list(islice(random_systems(QQ, 4000, seed=13), 400 if bench.full else 24))
    headline: tuple[Certificate, ...] = ()
    tried, decided = 0, set[str]()
    for done, system in enumerate(systems):
        bench.progress("comparing partners that differ late", done, len(systems))
        kernel = kernel_once(system)
        if kernel.normal_rank < system.m or system.m == 0 or kernel.lag == 0:
            continue
        partner = _partner(kernel)
        if partner is None:
            return Outcome(Verdict.REFUTED, f"no partner found for {system}", accepted(ranks_and_inversion(system)), frozenset(decided))
        compared = make.window_equality(kernel, partner, kernel.lag), comparison_certificate(kernel, partner)
        certificates = (*compared, make.left_invertible(kernel), make.left_invertible(partner))
        decided.update(map(accept, certificates))
        alike = all(certificate["kind"] == "left-invertible" for certificate in certificates[2:])
        if certificates[1]["statement"]["window"] != kernel.lag + 1 or partner.system.m != system.m or not alike:
            return Outcome(Verdict.ERROR, f"the partner of {system} is not as it was to be")
        tried += 1
        headline = headline or certificates
    words = f"no counterexample found: one partner each for {tried} systems, named and random over Q"
    return Outcome(Verdict.CERTIFIED, words, headline, frozenset(decided))


def _partner(kernel: KernelRepresentation) -> KernelRepresentation | None:
    """Return a system whose fault columns are moved by solutions of problem (11) on lag samples that are none on lag + 1."""
    system: ResidualSystem = kernel.system
    space, rng = fault_space(kernel, kernel.lag), random.Random(str(system))
    for _ in range(60):
        P = Matrix.of([[rng.randint(-2, 2) for _ in range(system.m)] for _ in range(space.dimension)], shape=(space.dimension, system.m))
        other = kernel_once(with_pair(space, P))
        alike = other.normal_rank == system.m and other.rank(kernel.lag) == kernel.rank(kernel.lag)
        if alike and compare(kernel, other).first_difference == kernel.lag + 1:
            return other
    return None
