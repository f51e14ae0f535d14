"""theorem-3: (i) every equivalent pair is (Fhat P, Ghat P); (ii) almost every P of full column rank gives an equivalent pair.

Part (ii) is decided for each P: the pair is equivalent iff its normal rank is that of the system, m where that is left-invertible.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ...exact.algebra.matrices import Matrix, column_basis
from ...exact.structure.behavior import compare
from ...exact.structure.fault_columns import fault_space, with_pair
from ...exact.structure.kernel_rows import KernelRepresentation
from ..boxes.box import Box, in_order, matrices_in_order
from ..evidence.alternatives import AlternativeEvidence, comparison_certificate, ranked
from ..evidence.kept_kernels import kernel_once
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, certify_records, counterexample, witnessed
from .one_determinant import show as show_pair
from .one_determinant import words as pair_words

BOX = Box(n=(1, 1), m=(1, 2), p=(1, 2), total=5)


def every_p(bench: Workbench) -> Outcome:
    """Every P of full column rank is claimed to give an equivalent pair at s = lag + 1, for observable left-invertible systems."""
    return _smallest_bad_pair(
        lambda kernel: kernel.lag + 1, lambda alternative: True, "s = lag + 1, P with entries in {-1, 0, 1} and full column rank"
    )


def not_every_p(bench: Workbench) -> Outcome:
    """There is a P of full column rank whose pair is not equivalent, at s = lag + 1."""
    return witnessed(every_p(bench))


def columns_in_space(bench: Workbench) -> Outcome:
    """Part (i): every (F', G') with the same behaviour for the same (A, C) has its columns in Z."""
    records = [e for e in bench.alternatives if e.equal]
    return certify_records(records, [e for e in records if not e.in_space], words, show)


def almost_every(bench: Workbench) -> Outcome:
    """D(q; P) is no zero polynomial in P: each system has a good P, and the bad ones are zeros of polynomials that do not all vanish."""
    records = [e for e in bench.pairs_by_polynomial if e.purpose == "good"]
    return certify_records(records, [e for e in records if not e.equal], pair_words, show_pair, unit="systems")


def criterion(bench: Workbench) -> Outcome:
    """For s >= lag + 1 the pair is equivalent iff its normal rank is that of the system, which is m where that is left-invertible."""
    records = [e for e in bench.alternatives if e.in_space]
    failing = [e for e in records if e.equal != (e.alternative_normal_rank == ranked(e.system).normal_rank)]
    return certify_records(records, failing, words, show)


def criterion_left_invertible(bench: Workbench) -> Outcome:
    """Among left-invertible systems the criterion is that the pair has normal rank m."""
    records = [e for e in bench.alternatives if e.in_space and e.left_invertible]
    return certify_records(records, [e for e in records if e.equal != (e.alternative_normal_rank == e.system.m)], words, show)


def criterion_window_n(bench: Workbench) -> Outcome:
    """The criterion is claimed with Fhat and Ghat taken at s = n."""
    return _smallest_bad_pair(
        lambda kernel: kernel.system.n,
        lambda alternative: alternative.normal_rank == alternative.system.m,
        "s = n, P with entries in {-1, 0, 1} and full column rank, pair of normal rank m",
    )


def _smallest_bad_pair(
    window: Callable[[KernelRepresentation], int], counts: Callable[[KernelRepresentation], bool], scope: str
) -> Outcome:
    """The outcome is REFUTED by the first system and P of full column rank whose pair counts and is not equivalent.

    Every P with the same column space gives the same pair, up to a change of the faults, so that one of them is looked at.
    """
    for system in in_order(BOX, "observable and left_invertible"):
        kernel = kernel_once(system)
        space, seen = fault_space(kernel, window(kernel)), set[Matrix]()
        for P in matrices_in_order(space.dimension, system.m):
            columns = column_basis(P)
            if columns.ncols < system.m or columns in seen:
                continue
            seen.add(columns)
            alternative = kernel_once(with_pair(space, P))
            if counts(alternative) and compare(kernel, alternative).first_difference is not None:
                certificates = [
                    comparison_certificate(kernel, alternative),
                    make.fault_space(kernel, space),
                    make.left_invertible(kernel),
                    make.left_invertible(alternative),
                    make.matrix_rank("observability", system),
                ]
                return counterexample(f"{system}, P = {P}", f"{BOX}, {scope}", certificates)
    return Outcome(Verdict.ERROR, "no counterexample in the box")


def words(record: AlternativeEvidence) -> str:
    return f"{record.system} with F' = {record.alternative.F}, G' = {record.alternative.G}"


def show(record: AlternativeEvidence) -> Iterator[Certificate]:
    kernels = kernel_once(record.system), kernel_once(record.alternative)
    yield comparison_certificate(*kernels)
    yield make.fault_space(kernels[0], fault_space(kernels[0]))
    yield make.window_ranks(kernels[1])
