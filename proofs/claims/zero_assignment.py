"""zero-assignment: a P places the finite zeros of the fault model at will; one leaves none, so that v needs no initial state."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

from ...exact.algebra.fields import QQ
from ...exact.pairs.assignment import recoverable_pair
from ...exact.pairs.polynomial import Exceptional
from ...exact.system.systems import ResidualSystem
from ..boxes.box import Box, in_order
from ..evidence.alternatives import comparison_certificate
from ..evidence.families import adversarial, random_systems
from ..evidence.kept_kernels import kernel_once
from ..evidence.pairs_by_polynomial import PairByPolynomial, pencil_of
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate, accept
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, accepted, certify_records, counterexample
from .one_determinant import show, words


def every_polynomial(bench: Workbench) -> Outcome:
    """Where (A, C) is observable, every monic polynomial of degree at most zeta is the zero polynomial of the pair of some P."""
    return _placed(bench, lambda pair: pair.observable)


def unobservable(bench: Workbench) -> Outcome:
    """Observable or not, so is every multiple, of degree at most zeta, of the characteristic polynomial of the unobservable modes."""
    return _placed(bench, lambda pair: True)


def without_observability(bench: Workbench) -> Outcome:
    """The same is claimed without observability; but an unobservable mode is a zero of every pair."""
    box = Box(n=(1, 1), m=(1, 1), p=(1, 1), total=3)
    for system in in_order(box, "not observable and left_invertible"):
        pencil = pencil_of(system)
        if pencil.zeta:
            certificates = [make.finite_zeros(system), make.matrix_rank("observability", system), *_space(pencil)]
            note = f"{system}: no pair is without finite zeros, its unobservable mode is a zero of each"
            return counterexample(note, box, certificates)
    return Outcome(Verdict.ERROR, "no counterexample in the box")


def recoverable(bench: Workbench) -> Outcome:
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


def _placed(bench: Workbench, applies: object) -> Outcome:
    records = [e for e in bench.pairs_by_polynomial if e.wanted is not None and applies(e)]  # type: ignore[operator]
    failing = [e for e in records if not (e.equal and e.zero_polynomial == e.wanted)]
    return certify_records(records, failing, _words, show)


def _words(pair: PairByPolynomial) -> str:
    return f"{words(pair)}, wanted zero polynomial {list(pair.wanted or ())}"


def _space(pencil: Exceptional) -> Iterator[Certificate]:
    system: ResidualSystem = pencil.system
    yield make.fault_space(kernel_once(system), pencil.space)
