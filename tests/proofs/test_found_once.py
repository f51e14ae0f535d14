"""What several claims want to know of the same systems is found once, and is what it would be if it were found again."""

from __future__ import annotations

import threading

import pytest

from faultspace.base.aside import aside
from faultspace.exact.structure.behavior import compare
from faultspace.exact.structure.fault_columns import fault_space
from faultspace.exact.structure.kernel_rows import KernelRepresentation, kernel_representation
from faultspace.exact.system.systems import ResidualSystem
from faultspace.proofs.evidence import alternatives, pairs_by_polynomial
from faultspace.proofs.evidence.families import adversarial, shift_registers
from faultspace.proofs.evidence.subjects import kernel_once, space_once
from faultspace.proofs.trust import structure_certificates
from faultspace.proofs.trust.checker import Rejected
from faultspace.proofs.trust.structure_certificates import Certificate

SYSTEMS = [system for _, system in adversarial() if system.n <= 2]


def test_what_is_kept_is_what_is_found() -> None:
    for system in SYSTEMS:
        assert kernel_once(system) is kernel_once(system)
        assert (kernel_once(system).rows, kernel_once(system).system) == (kernel_representation(system).rows, system)
        assert space_once(system).basis == fault_space(kernel_representation(system)).basis


def test_pairs_are_compared_once_in_each_order() -> None:
    for n in (1, 2, 3):
        idle, driven = shift_registers(n)
        assert alternatives.compared(idle, driven).first_difference == alternatives.compared(driven, idle).first_difference == n + 1
        assert alternatives.compared(idle, idle).first_difference is None
    for first in SYSTEMS:
        for second in SYSTEMS:
            if first.p == second.p:
                assert alternatives.compared(first, second).first_difference == compare(first, second).first_difference


def test_a_comparison_that_the_checker_refuses_is_not_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    """It is refused the next time too, and what was refused once is found where the certificate is right again."""
    system, other = (ResidualSystem.of([[k]], [[1]], [[1], [0]], [[0], [1]]) for k in (5, 7))
    made = alternatives.comparison_certificate

    def wrong(first: object, second: object) -> Certificate:
        return made(kernel_once(system), kernel_once(system)) | {"statement": {"first": system.to_json(), "second": other.to_json()}}

    monkeypatch.setattr(alternatives, "comparison_certificate", wrong)
    for _ in range(2):
        with pytest.raises(Rejected):
            alternatives.compared(system, other)
    monkeypatch.undo()
    assert alternatives.compared(system, other).first_difference == compare(system, other).first_difference == 2


def test_zeros_that_are_kept_are_those_of_the_system() -> None:
    """A delay has one infinite zero and no finite one, the gain q / (q - 2) a finite one at 0."""
    delay, gain = ResidualSystem.of([[0]], [[1]], [[1]], [[0]]), ResidualSystem.of([[2]], [[2]], [[1]], [[1]])
    for _ in range(2):
        assert (pairs_by_polynomial.certified_zeros(delay).polynomial, pairs_by_polynomial.certified_zeros(delay).infinite) == (("1",), 1)
        assert (pairs_by_polynomial.certified_zeros(gain).polynomial, pairs_by_polynomial.certified_zeros(gain).infinite) == (("0", "1"), 0)


def test_what_goes_on_aside_comes_to_whoever_asks() -> None:
    """It has begun before it is asked for, in another thread; what it raises is raised where it is asked for, each time."""
    begun, go_on = threading.Event(), threading.Event()

    def waits(number: int) -> tuple[int, int]:
        begun.set()
        assert go_on.wait(20)
        return number, threading.get_ident()

    future = aside(waits, 7)
    assert begun.wait(20) and not future.done()
    go_on.set()
    number, thread = future.result(20)
    assert number == 7 and thread != threading.get_ident()
    failed = aside(int, "seven")
    for _ in range(2):
        with pytest.raises(ValueError, match="seven"):
            failed.result(20)


def test_equality_on_no_samples_needs_no_certificate(monkeypatch: pytest.MonkeyPatch) -> None:
    """Equality before the first difference is certified wherever there is a sample before it."""
    windows: list[int] = []
    make = structure_certificates.window_equality

    def noted(first: KernelRepresentation, second: KernelRepresentation, window: int) -> Certificate:
        windows.append(window)
        return make(first, second, window)

    monkeypatch.setattr(structure_certificates, "window_equality", noted)
    idle, driven = shift_registers(2)
    silent = ResidualSystem.of([[0]], [[0]], [[0], [0]], [[0], [0]])
    later, at_once, never = (alternatives.examine_pair("", *pair) for pair in ((idle, driven), (idle, silent), (idle, idle)))
    assert (later.first_difference, len(later.accepted)) == (3, 4) and windows == [2]
    assert (at_once.first_difference, len(at_once.accepted)) == (1, 3) and (never.first_difference, len(never.accepted)) == (None, 2)
