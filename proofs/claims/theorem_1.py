"""theorem-1: equal restricted behaviours on a window of length n_x imply output behaviour equivalence."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache

from ...exact.algebra.matrices import Matrix, column_basis
from ...exact.system.systems import ResidualSystem
from ...exact.system.windows import window_matrix
from ..boxes.box import Box, grouped
from ..evidence.alternatives import PAIRS, PairEvidence, comparison_certificate
from ..evidence.corpus import CORPUS
from ..evidence.families import shift_registers
from ..evidence.kept_kernels import kernel_once
from ..evidence.parametric import inclusion_claim
from ..evidence.questions import RANKS
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate, sha256
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, accepted, all_accepted, certify_records, counterexample
from .common import identity

BOX = Box(n=(1, 2), m=(1, 2), p=(1, 2), total=5)


def n_samples(bench: Workbench) -> Outcome:
    """n samples are claimed to decide, both systems having n states and being observable, controllable and left-invertible."""
    return _smallest_pair(same_A_and_C=False)


def n_samples_same_a_c(bench: Workbench) -> Outcome:
    """n samples are claimed to decide where both systems have the same (A, C)."""
    return _smallest_pair(same_A_and_C=True)


def n_plus_1_samples(bench: Workbench) -> Outcome:
    """n + 1 samples, n the larger number of states.

    Pair by pair, and by grouping on kernel rows: the rows of degree at most n, which n + 1 samples show, name the behaviour where no
    row has a larger degree; systems that share them are equal for ever. So one look at the degrees decides all pairs at once.
    """
    bench.need(PAIRS, CORPUS[RANKS])
    systems = bench.corpus((RANKS,))
    failing = [e for e in bench.pairs if e.first_difference is not None and e.first_difference > max(e.first.n, e.second.n) + 1]
    outcome = certify_records(bench.pairs, failing, _words, _show)
    longer = [e for e in systems if e.kernel.lag > e.system.n]
    if longer:
        words = f"{longer[0].system} has a kernel row of degree {longer[0].kernel.lag}"
        certificates = accepted(_of_one(longer[0].system))
        return Outcome(Verdict.REFUTED, words, certificates)
    total = sum(e.weight for e in systems)
    words = f"{outcome.evidence}; by kernel rows, none of degree above n, every pair of the {total} systems of the corpus"
    return replace(outcome, evidence=words, decided=outcome.decided | all_accepted(systems))


def lag_plus_1(bench: Workbench) -> Outcome:
    """One sample more than the larger of the two lags decides."""
    failing = [e for e in bench.pairs if e.first_difference is not None and e.first_difference > max(e.lags) + 1]
    return certify_records(bench.pairs, failing, _words, _show)


def either_lag(bench: Workbench) -> Outcome:
    """One sample more than either of the lags decides where the normal ranks are equal."""
    records = [e for e in bench.pairs if e.normal_ranks[0] == e.normal_ranks[1]]
    failing = [e for e in records if e.first_difference is not None and e.first_difference > min(e.lags) + 1]
    return certify_records(records, failing, _words, _show)


def sharp(bench: Workbench) -> Outcome:
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


def parametric(bench: Workbench) -> Outcome:
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

    for first, group in grouped(BOX, key, "observable and controllable and left_invertible"):
        second = next((other for other in group if longer(other) != longer(first)), None) if len(group) > 1 else None
        if second is not None:
            scope = f"{BOX}, both of the same dimensions, observable, controllable, left-invertible"
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


def _of_one(system: ResidualSystem) -> Iterator[Certificate]:
    yield make.window_ranks(kernel_once(system))


def _show(record: PairEvidence) -> Iterator[Certificate]:
    kernels = kernel_once(record.first), kernel_once(record.second)
    yield comparison_certificate(*kernels)
    yield make.window_ranks(kernels[0])
    yield make.window_ranks(kernels[1])
