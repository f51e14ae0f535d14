"""one-determinant: the greatest common divisor of the maximal minors of the pencil of (A, Fhat P, C, Ghat P) is one small determinant.

D(q; P) = det [P | q b - a], n_z x n_z: nothing is expanded in P.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...exact.parametric.cofactors import generic_exceptional, generic_exceptional_without_feedthrough
from ..evidence.alternatives import comparison_certificate
from ..evidence.kept_kernels import kernel_once
from ..evidence.pairs_by_polynomial import PairByPolynomial
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, certify_records


def formula(bench: Workbench) -> Outcome:
    """D(q; P), made monic, is the zero polynomial of the pair that the diagonal form of its pencil shows; zero where the rank falls."""
    failing = [e for e in bench.pairs_by_polynomial if not agrees(e)]
    return certify_records(bench.pairs_by_polynomial, failing, words, show)


def parametric(bench: Workbench) -> Outcome:
    """All entries of A, C, F, G and P indeterminate: every maximal minor is a multiple of D, the cofactors have no common factor over
    the field of the entries."""
    dimensions = [(1, 1, 1), (1, 2, 1), (1, 2, 2), (2, 2, 1), (2, 1, 1), (1, 1, 2)]
    if bench.full:
        dimensions += [(n, p, m) for n in range(3) for p in range(4) for m in range(3) if (n, p, m) not in dimensions]
    expanded = count = 0
    for done, (n, p, m) in enumerate(dimensions):
        bench.progress(f"taking all entries as indeterminates, n={n} p={p} m={m}", done, len(dimensions))
        cases = [generic_exceptional(n, p, m)]
        cases += [generic_exceptional_without_feedthrough(n, p, m)] if 0 < m < p and m <= n else []
        expanded += sum(case.expanded for case in cases)
        count += len(cases)
    listed = ", ".join(str(d).replace(" ", "") for d in dimensions)
    words = (
        f"{count} cases at (n,p,m) = {listed}, G = 0 apart where m < p: generically D is det P, det(P1 + qP2) or the pencil's "
        f"own determinant; {expanded} identities of sympy expanded again by FLINT"
    )
    return Outcome(Verdict.IDENTITY, words)


def agrees(pair: PairByPolynomial) -> bool:
    """Return whether D and the certificates say the same of a pair."""
    if not pair.polynomial:
        return pair.pair_normal_rank < pair.normal_rank and not pair.equal
    zeros = len(pair.polynomial) - 1 + pair.infinite_zeros
    return pair.polynomial == pair.zero_polynomial and pair.pair_normal_rank == pair.normal_rank and pair.equal and zeros == pair.zeta


def words(pair: PairByPolynomial) -> str:
    """Return the pair as it stands in an outcome."""
    return f"{pair.system} with F' = {pair.pair.F}, G' = {pair.pair.G}"


def show(pair: PairByPolynomial) -> Iterator[Certificate]:
    """Yield certificates of what the pair is: equivalent or not, its normal rank, its zeros."""
    kernels = kernel_once(pair.system), kernel_once(pair.pair)
    yield comparison_certificate(*kernels)
    yield make.window_ranks(kernels[1])
    yield make.finite_zeros(pair.pair)
    yield make.infinite_zeros(pair.pair)
