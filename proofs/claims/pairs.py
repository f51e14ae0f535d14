"""Claims about pairs (F', G') of fault matrices that give the same outputs with the same (A, C), and about what P makes of (Fhat, Ghat).

theorem-3         (i) every equivalent pair is (Fhat P, Ghat P); (ii) almost every P of full column rank gives an equivalent pair; it is
                  decided for each P: the pair is equivalent iff its normal rank is that of the system, m where that is left-invertible
one-determinant   the greatest common divisor of the maximal minors of the pencil of (A, Fhat P, C, Ghat P) is one small determinant,
                  D(q; P) = det [P | q b - a], n_z x n_z: nothing is expanded in P
bad-set           which P give a pair that is not equivalent, as a set: objection 2 answered with the exact set and its size. With (A, C)
                  observable: r = 1, none but P = 0; zeta = 0, the zeros of det P; r >= 2 and zeta >= 1, a cone of codimension at least
                  two, in which there always is a P of full column rank
canonical-form    the reduced row echelon form of Z names a class of fault matrices; what names a behaviour for any (A, C)
zero-assignment   a P places the finite zeros of the fault model at will; one leaves none, so that v needs no initial state
zeros-of-pairs    all good pairs have the same number of zeros, finite and infinite together; how many are finite changes with P
words, show       a pair as it stands in an outcome, and certificates of what it is; agrees: whether these say the same as D(q; P)
"""

from __future__ import annotations

import random
from collections import defaultdict
from collections.abc import Callable, Iterator
from itertools import islice

from ...exact.algebra.fields import QQ, PrimeField
from ...exact.algebra.matrices import Matrix, column_basis, rank
from ...exact.pairs.assignment import recoverable_pair
from ...exact.pairs.bad_variety import bad_set
from ...exact.pairs.canonical_form import behavior_name, fault_class, with_feedback
from ...exact.pairs.polynomial import Exceptional, judge
from ...exact.pairs.witnesses import BadPair, bad_pair
from ...exact.parametric.cofactors import generic_exceptional, generic_exceptional_without_feedthrough
from ...exact.structure.behavior import compare
from ...exact.structure.fault_columns import fault_space, with_pair
from ...exact.structure.kernel_rows import KernelRepresentation
from ...exact.system.systems import ResidualSystem
from ..boxes.box import Box, in_order, matrices_in_order
from ..evidence.alternatives import AlternativeEvidence, comparison_certificate, ranked
from ..evidence.families import adversarial, random_systems
from ..evidence.pairs_by_polynomial import PairByPolynomial, pencil_of
from ..evidence.subjects import kernel_once
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate, Unprovable, accept
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, accepted, certify_records, counterexample, witnessed
from .common import show_pair

# -- theorem-3-ii ----------------------------------------------------------------------------------------------------------


BOX = Box(n=(1, 1), m=(1, 2), p=(1, 2), total=5)
SMALL_BOX = Box(n=(1, 1), m=(1, 1), p=(1, 2), total=4)
ONE_STATE = Box(n=(1, 1), m=(1, 1), p=(1, 1), total=3)


def theorem_3_ii_every_p(bench: Workbench) -> Outcome:
    """Every P of full column rank is claimed to give an equivalent pair at s = lag + 1, for observable left-invertible systems."""
    return _smallest_bad_pair(
        lambda kernel: kernel.lag + 1, lambda alternative: True, "s = lag + 1, P with entries in {-1, 0, 1} and full column rank"
    )


def theorem_3_ii_not_every_p(bench: Workbench) -> Outcome:
    """There is a P of full column rank whose pair is not equivalent, at s = lag + 1."""
    return witnessed(theorem_3_ii_every_p(bench))


def theorem_3_ii_columns_in_space(bench: Workbench) -> Outcome:
    """Part (i): every (F', G') with the same behaviour for the same (A, C) has its columns in Z."""
    records = [e for e in bench.alternatives if e.equal]
    return certify_records(records, [e for e in records if not e.in_space], _words_of_alternative, _show_alternative)


def theorem_3_ii_almost_every(bench: Workbench) -> Outcome:
    """D(q; P) is no zero polynomial in P: each system has a good P, and the bad ones are zeros of polynomials that do not all vanish."""
    records = [e for e in bench.pairs_by_polynomial if e.purpose == "good"]
    return certify_records(records, [e for e in records if not e.equal], words, show, unit="systems")


def theorem_3_ii_criterion(bench: Workbench) -> Outcome:
    """For s >= lag + 1 the pair is equivalent iff its normal rank is that of the system, which is m where that is left-invertible."""
    records = [e for e in bench.alternatives if e.in_space]
    failing = [e for e in records if e.equal != (e.alternative_normal_rank == ranked(e.system).normal_rank)]
    return certify_records(records, failing, _words_of_alternative, _show_alternative)


def theorem_3_ii_criterion_left_invertible(bench: Workbench) -> Outcome:
    """Among left-invertible systems the criterion is that the pair has normal rank m."""
    records = [e for e in bench.alternatives if e.in_space and e.left_invertible]
    return certify_records(
        records, [e for e in records if e.equal != (e.alternative_normal_rank == e.system.m)], _words_of_alternative, _show_alternative
    )


def theorem_3_ii_criterion_window_n(bench: Workbench) -> Outcome:
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


def _words_of_alternative(record: AlternativeEvidence) -> str:
    return f"{record.system} with F' = {record.alternative.F}, G' = {record.alternative.G}"


def _show_alternative(record: AlternativeEvidence) -> Iterator[Certificate]:
    kernels = kernel_once(record.system), kernel_once(record.alternative)
    yield comparison_certificate(*kernels)
    yield make.fault_space(kernels[0], fault_space(kernels[0]))
    yield make.window_ranks(kernels[1])


# -- one-determinant -------------------------------------------------------------------------------------------------------


def one_determinant_formula(bench: Workbench) -> Outcome:
    """D(q; P), made monic, is the zero polynomial of the pair that the diagonal form of its pencil shows; zero where the rank falls."""
    failing = [e for e in bench.pairs_by_polynomial if not agrees(e)]
    return certify_records(bench.pairs_by_polynomial, failing, words, show)


def one_determinant_parametric(bench: Workbench) -> Outcome:
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


# -- bad-set ---------------------------------------------------------------------------------------------------------------


def bad_set_one_fault(bench: Workbench) -> Outcome:
    """Where (A, C) is observable and r = 1, every P other than 0 is good."""
    records = [e for e in bench.pairs_by_polynomial if e.observable and e.normal_rank == 1 and e.full_column_rank]
    return certify_records(records, [e for e in records if not e.equal], words, show)


def bad_set_no_zeros(bench: Workbench) -> Outcome:
    """Where zeta = 0, P is square, and it is good iff det P is not zero: the bad P are a hypersurface of degree r."""
    records = [e for e in bench.pairs_by_polynomial if e.zeta == 0]
    return certify_records(records, [e for e in records if e.equal != e.full_column_rank], words, show)


def bad_set_full_rank(bench: Workbench) -> Outcome:
    """A bad P of full column rank exists iff r >= 1 and (A, C) is not observable, or r >= 2 and zeta >= 1."""
    systems = {e.system: e for e in bench.pairs_by_polynomial}
    with_one = {e.system for e in bench.pairs_by_polynomial if e.purpose == "bad" and e.full_column_rank and not e.equal}
    failing = []
    for system, e in systems.items():
        predicted = (e.normal_rank >= 1 and not e.observable) or (e.normal_rank >= 2 and e.zeta >= 1)
        # where none is predicted, every P of full column rank that was chosen has to be good
        contradicted = any(not x.equal and x.full_column_rank for x in bench.pairs_by_polynomial if x.system == system)
        if predicted != (system in with_one) or (not predicted and contradicted):
            failing.append(e)
    return certify_records([e for e in bench.pairs_by_polynomial if e.purpose in ("good", "bad")], failing, words, show)


def bad_set_codimension_two(bench: Workbench) -> Outcome:
    """Where (A, C) is observable, r >= 2 and zeta >= 1, the codimension is at least two: some line of P meets no bad one."""
    tried = [pencil for pencil in _pencils(bench) if pencil.observable and pencil.columns >= 2 and pencil.zeta >= 1]
    decided, missed = list[str](), 0
    headline: tuple[Certificate, ...] = ()
    for done, pencil in enumerate(tried):
        bench.progress("looking for lines without a bad P", done, len(tried))
        stated = bad_set(pencil).codimension
        if stated is not None and stated < 2:
            certificates = accepted(_kernel(pencil))
            return Outcome(Verdict.REFUTED, f"codimension {stated} for {pencil.system}", certificates)
        line = _line(pencil)
        if line is None:
            missed += 1
            continue
        decided.append(accept(line))
        headline = headline or (line, *accepted(_kernel(pencil)))
    if not decided:
        return Outcome(Verdict.ERROR, "no line was found for any system")
    note = f"; for {missed} more by counting parameters alone" if missed else ""
    words = f"on {len(decided)} systems, named and random over Q and GF(10007), by a line each{note}"
    return Outcome(Verdict.CERTIFIED, words, headline, frozenset(decided))


def bad_set_codimension_unobservable(bench: Workbench) -> Outcome:
    """The codimension is claimed to be at least two when zeta >= 1, whether (A, C) is observable or not."""
    for system in in_order(ONE_STATE, "not observable and left_invertible"):
        pencil = pencil_of(system)
        size = bad_set(pencil).codimension
        if pencil.zeta and size == 1:
            bad = bad_pair(pencil)
            if isinstance(bad, BadPair) and pencil.n_z == 2 and pencil.columns == 1:
                pair = kernel_once(with_pair(pencil.space, bad.verdict.P))
                certificates = [*_kernel(pencil), comparison_certificate(pencil.kernel, pair), make.left_invertible(pair)]
                text = f"{system}: P has two entries, and every multiple of {bad.verdict.P} is bad"
                return counterexample(text, ONE_STATE, certificates)
    return Outcome(Verdict.ERROR, "no counterexample in the box")


def _kernel(pencil: Exceptional) -> Iterator[Certificate]:
    yield make.fault_space(pencil.kernel, pencil.space)
    yield make.window_ranks(pencil.kernel)


def _pencils(bench: Workbench) -> Iterator[Exceptional]:
    systems = [s for _, s in adversarial() if s.n <= 4]
    systems += islice(random_systems(QQ, 4000, seed=11), 1500 if bench.full else 80)
    systems += islice(random_systems(PrimeField(10007), 4000, seed=12), 300 if bench.full else 20)
    for system in systems:
        if system.field == QQ or isinstance(system.field, PrimeField):
            yield pencil_of(system)


def _line(pencil: Exceptional) -> Certificate | None:
    """A line through two random P that meets no bad one is sought; nearly every line does where the codimension is two or more."""
    rng, field = random.Random(str(pencil.system)), pencil.system.field
    shape = (pencil.n_z, pencil.columns)
    for _ in range(6):
        ends: list[ResidualSystem] = []
        while len(ends) < 2:
            P = Matrix.of([[rng.randint(-3, 3) for _ in range(shape[1])] for _ in range(shape[0])], field, shape=shape)
            if rank(P) == shape[1] and judge(pencil, P).good:
                ends.append(with_pair(pencil.space, P))
        try:
            return make.left_invertible_line(*ends)
        except Unprovable:
            continue
    return None


# -- canonical-form --------------------------------------------------------------------------------------------------------


def canonical_form_same_a_c(bench: Workbench) -> Outcome:
    """Two systems with the same (A, C) have the same behaviour iff their Z have the same reduced row echelon form."""
    failing = [
        e for e in bench.alternatives if e.equal != (fault_class(ranked(e.system).kernel) == fault_class(ranked(e.alternative).kernel))
    ]
    return certify_records(bench.alternatives, failing, lambda e: f"{e.system} and {e.alternative}", _show_spaces)


def canonical_form_any_a_c(bench: Workbench) -> Outcome:
    """The same is claimed for different (A, C): equal behaviours have equal Z. This finds the smallest system and feedback that say no."""
    for system in in_order(SMALL_BOX, "observable and controllable and left_invertible"):
        kernel = kernel_once(system)
        for similar in (system, ResidualSystem(system.A, -system.F, -system.C, system.G)):
            for gain in (0, 1, -1):
                other = kernel_once(with_feedback(similar, [[gain]]))
                if fault_space(other).basis != fault_space(kernel).basis:
                    certificates = [comparison_certificate(kernel, other), make.fault_space(kernel, fault_space(kernel))]
                    certificates.append(make.fault_space(other, fault_space(other)))
                    text = f"{system} and {other.system}, made of it by a change of basis of the state and v + {gain} x for v"
                    return counterexample(text, f"{SMALL_BOX}, gain in {{0, 1, -1}}", certificates)
    return Outcome(Verdict.ERROR, "no counterexample in the box")


def canonical_form_feedback(bench: Workbench) -> Outcome:
    """B is claimed to name (A, C): but feedback of the state into the fault gives a system with other A and C and the same behaviour."""
    for system in in_order(SMALL_BOX, "observable and controllable and left_invertible"):
        kernel = kernel_once(system)
        other = kernel_once(with_feedback(system, [[1]]))
        if (other.system.A, other.system.C) != (system.A, system.C):
            certificates = [comparison_certificate(kernel, other)]
            if certificates[0]["kind"] == "behaviour-equality":
                return counterexample(f"{system} and, with K = 1, {other.system}", SMALL_BOX, certificates)
    return Outcome(Verdict.ERROR, "no counterexample in the box")


def canonical_form_popov_rows(bench: Workbench) -> Outcome:
    """Whatever (A, C), n and m are, the behaviours are equal iff the Popov rows of N(q) are."""
    failing = [
        e
        for e in bench.pairs
        if (e.first_difference is None) != (behavior_name(ranked(e.first).kernel) == behavior_name(ranked(e.second).kernel))
    ]
    return certify_records(bench.pairs, failing, lambda e: f"{e.first} and {e.second}", show_pair)


def _show_spaces(record: AlternativeEvidence) -> Iterator[Certificate]:
    kernels = kernel_once(record.system), kernel_once(record.alternative)
    yield comparison_certificate(*kernels)
    for kernel in kernels:
        yield make.fault_space(kernel, fault_space(kernel))


# -- zero-assignment -------------------------------------------------------------------------------------------------------


def zero_assignment_every_polynomial(bench: Workbench) -> Outcome:
    """Where (A, C) is observable, every monic polynomial of degree at most zeta is the zero polynomial of the pair of some P."""
    return _placed(bench, lambda pair: pair.observable)


def zero_assignment_unobservable(bench: Workbench) -> Outcome:
    """Observable or not, so is every multiple, of degree at most zeta, of the characteristic polynomial of the unobservable modes."""
    return _placed(bench, lambda pair: True)


def zero_assignment_without_observability(bench: Workbench) -> Outcome:
    """The same is claimed without observability; but an unobservable mode is a zero of every pair."""
    for system in in_order(ONE_STATE, "not observable and left_invertible"):
        pencil = pencil_of(system)
        if pencil.zeta:
            certificates = [
                make.finite_zeros(system),
                make.matrix_rank("observability", system),
                make.fault_space(pencil.kernel, pencil.space),
            ]
            note = f"{system}: no pair is without finite zeros, its unobservable mode is a zero of each"
            return counterexample(note, ONE_STATE, certificates)
    return Outcome(Verdict.ERROR, "no counterexample in the box")


def zero_assignment_recoverable(bench: Workbench) -> Outcome:
    """Every system has an equivalent pair with r faults whose v(0) is determined by the outputs, whatever the initial state is."""
    systems = [s for _, s in adversarial() if s.n <= 4] + list(islice(random_systems(QQ, 600, seed=9), 400 if bench.full else 20))
    headline: tuple[Certificate, ...] = ()
    decided = set[str]()
    for done, system in enumerate(systems):
        bench.progress("making pairs whose fault needs no initial state", done, len(systems))
        found = recoverable_pair(pencil_of(system))
        kernels = kernel_once(system), kernel_once(found.assignment.system)
        certificates = comparison_certificate(*kernels), make.inversion_delay(kernels[1], known_state=False)
        decided.update(map(accept, certificates))
        if certificates[0]["kind"] != "behaviour-equality" or certificates[1]["statement"]["delay"] is None:
            return Outcome(Verdict.REFUTED, f"fails on {system}", accepted(certificates), frozenset(decided))
        headline = headline if headline or not (system.n and system.m) else certificates
    message = f"no counterexample found: one pair each for {len(systems)} systems, named and random"
    return Outcome(Verdict.CERTIFIED, message, headline, frozenset(decided))


def _placed(bench: Workbench, applies: Callable[[PairByPolynomial], bool]) -> Outcome:
    records = [e for e in bench.pairs_by_polynomial if e.wanted is not None and applies(e)]
    failing = [e for e in records if not (e.equal and e.zero_polynomial == e.wanted)]
    return certify_records(records, failing, lambda pair: f"{words(pair)}, wanted zero polynomial {list(pair.wanted or ())}", show)


# -- zeros-of-pairs --------------------------------------------------------------------------------------------------------


def zeros_of_pairs_number(bench: Workbench) -> Outcome:
    """Every good pair has zeta zeros, finite and infinite counted together."""
    records = [e for e in bench.pairs_by_polynomial if e.equal]
    failing = [e for e in records if len(e.zero_polynomial) - 1 + e.infinite_zeros != e.zeta]
    return certify_records(records, failing, words, show)


def zeros_of_pairs_split(bench: Workbench) -> Outcome:
    """All good pairs of a system are claimed to have the same number of finite zeros."""
    groups: dict[ResidualSystem, list[PairByPolynomial]] = defaultdict(list)
    for pair in bench.pairs_by_polynomial:
        if pair.equal and pair.system.field.to_json() == "Q":
            groups[pair.system].append(pair)
    records = [pair for pairs in groups.values() for pair in pairs]
    for system in sorted(groups, key=lambda s: (s.n + s.m + s.p, s.n, s.m, s.p)):
        fewest, most = (choose(groups[system], key=lambda e: len(e.zero_polynomial)) for choose in (min, max))
        if len(fewest.zero_polynomial) < len(most.zero_polynomial):
            texts = f"{words(fewest)} has {len(fewest.zero_polynomial) - 1} finite zeros, {words(most)} has {len(most.zero_polynomial) - 1}"
            return counterexample(texts, "n + m + p among the systems whose pairs were judged", [*show(fewest), *show(most)])
    return certify_records(records, [], words, show)
