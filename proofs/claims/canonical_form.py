"""canonical-form: the reduced row echelon form of Z names a class of fault matrices; what names a behaviour for any (A, C)."""

from __future__ import annotations

from collections.abc import Iterator

from ...exact.pairs.canonical_form import behavior_name, fault_class, with_feedback
from ...exact.structure.fault_columns import fault_space
from ...exact.system.systems import ResidualSystem
from ..boxes.box import Box, in_order
from ..evidence.alternatives import AlternativeEvidence, PairEvidence, comparison_certificate, ranked
from ..evidence.kept_kernels import kernel_once
from ..trust import structure_certificates as make
from ..trust.structure_certificates import Certificate
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, certify_records, counterexample


def same_a_c(bench: Workbench) -> Outcome:
    """Two systems with the same (A, C) have the same behaviour iff their Z have the same reduced row echelon form."""
    failing = [e for e in bench.alternatives if e.equal != (_fault_class(e.system) == _fault_class(e.alternative))]
    return certify_records(bench.alternatives, failing, lambda e: f"{e.system} and {e.alternative}", _show_alternative)


def any_a_c(bench: Workbench) -> Outcome:
    """The same is claimed for different (A, C): equal behaviours have equal Z. This finds the smallest system and feedback that say no."""
    box = Box(n=(1, 1), m=(1, 1), p=(1, 2), total=4)
    for system in in_order(box, "observable and controllable and left_invertible"):
        kernel = kernel_once(system)
        for similar in (system, ResidualSystem(system.A, -system.F, -system.C, system.G)):
            for gain in (0, 1, -1):
                other = kernel_once(with_feedback(similar, [[gain]]))
                if fault_space(other).basis != fault_space(kernel).basis:
                    certificates = [comparison_certificate(kernel, other), make.fault_space(kernel, fault_space(kernel))]
                    certificates.append(make.fault_space(other, fault_space(other)))
                    text = f"{system} and {other.system}, made of it by a change of basis of the state and v + {gain} x for v"
                    return counterexample(text, f"{box}, gain in {{0, 1, -1}}", certificates)
    return Outcome(Verdict.ERROR, "no counterexample in the box")


def feedback(bench: Workbench) -> Outcome:
    """B is claimed to name (A, C): but feedback of the state into the fault gives a system with other A and C and the same behaviour."""
    box = Box(n=(1, 1), m=(1, 1), p=(1, 2), total=4)
    for system in in_order(box, "observable and controllable and left_invertible"):
        kernel = kernel_once(system)
        other = kernel_once(with_feedback(system, [[1]]))
        if (other.system.A, other.system.C) != (system.A, system.C):
            certificates = [comparison_certificate(kernel, other)]
            if certificates[0]["kind"] == "behaviour-equality":
                return counterexample(f"{system} and, with K = 1, {other.system}", box, certificates)
    return Outcome(Verdict.ERROR, "no counterexample in the box")


def popov_rows(bench: Workbench) -> Outcome:
    """Whatever (A, C), n and m are, the behaviours are equal iff the Popov rows of N(q) are."""
    failing = [e for e in bench.pairs if (e.first_difference is None) != (_name(e.first) == _name(e.second))]
    return certify_records(bench.pairs, failing, lambda e: f"{e.first} and {e.second}", _show_pair)


def _fault_class(system: ResidualSystem) -> object:
    return fault_class(ranked(system).kernel)


def _name(system: ResidualSystem) -> object:
    return behavior_name(ranked(system).kernel)


def _show_alternative(record: AlternativeEvidence) -> Iterator[Certificate]:
    kernels = kernel_once(record.system), kernel_once(record.alternative)
    yield comparison_certificate(*kernels)
    for kernel in kernels:
        yield make.fault_space(kernel, fault_space(kernel))


def _show_pair(record: PairEvidence) -> Iterator[Certificate]:
    kernels = kernel_once(record.first), kernel_once(record.second)
    yield comparison_certificate(*kernels)
    for kernel in kernels:
        yield make.window_ranks(kernel)
