"""bad-set: which P give a pair that is not equivalent, as a set: objection 2 answered with the exact set and its size.

With (A, C) observable: r = 1, none but P = 0; zeta = 0, the zeros of det P; r >= 2 and zeta >= 1, a cone of codimension at least two, in
which there always is a P of full column rank.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from itertools import islice

from ...exact.algebra.fields import QQ, PrimeField
from ...exact.algebra.matrices import Matrix, rank
from ...exact.pairs.bad_variety import bad_set
from ...exact.pairs.polynomial import Exceptional, judge
from ...exact.pairs.witnesses import BadPair, bad_pair
from ...exact.structure.fault_columns import with_pair
from ...exact.system.systems import ResidualSystem
from ..boxes.box import Box, in_order
from ..evidence.alternatives import comparison_certificate
from ..evidence.families import adversarial, random_systems
from ..evidence.kept_kernels import kernel_once
from ..evidence.pairs_by_polynomial import pencil_of
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate, Unprovable, accept
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, accepted, certify_records, counterexample
from .one_determinant import show, words


def one_fault(bench: Workbench) -> Outcome:
    """Where (A, C) is observable and r = 1, every P other than 0 is good."""
    records = [e for e in bench.pairs_by_polynomial if e.observable and e.normal_rank == 1 and e.full_column_rank]
    return certify_records(records, [e for e in records if not e.equal], words, show)


def no_zeros(bench: Workbench) -> Outcome:
    """Where zeta = 0, P is square, and it is good iff det P is not zero: the bad P are a hypersurface of degree r."""
    records = [e for e in bench.pairs_by_polynomial if e.zeta == 0]
    return certify_records(records, [e for e in records if e.equal != e.full_column_rank], words, show)


def full_rank(bench: Workbench) -> Outcome:
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


def codimension_two(bench: Workbench) -> Outcome:
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


def codimension_unobservable(bench: Workbench) -> Outcome:
    """The codimension is claimed to be at least two when zeta >= 1, whether (A, C) is observable or not."""
    box = Box(n=(1, 1), m=(1, 1), p=(1, 1), total=3)
    for system in in_order(box, "not observable and left_invertible"):
        pencil = pencil_of(system)
        size = bad_set(pencil).codimension
        if pencil.zeta and size == 1:
            bad = bad_pair(pencil)
            if isinstance(bad, BadPair) and pencil.n_z == 2 and pencil.columns == 1:
                pair = kernel_once(with_pair(pencil.space, bad.verdict.P))
                certificates = [*_kernel(pencil), comparison_certificate(pencil.kernel, pair), make.left_invertible(pair)]
                text = f"{system}: P has two entries, and every multiple of {bad.verdict.P} is bad"
                return counterexample(text, box, certificates)
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
