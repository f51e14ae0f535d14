"""Attacks on what is said of pairs of systems, of pairs (Fhat P, Ghat P), and of trajectories.

pair_attacks      all of them
pair_family       a square system and a P: its D(q; P) vanishes in P where two numbers do, both affine in a column of P
driven_family     a system with one fault, x(0) and a short fault signal
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np

from ...exact.algebra.matrices import Matrix, rank
from ...exact.pairs.canonical_form import with_feedback
from ...exact.structure.behavior import compare
from ...exact.structure.fault_columns import fault_space, with_pair
from ...exact.structure.kernel_rows import KernelRepresentation, kernel_representation
from ...exact.structure.signals import excitation_matrix, hankel, simulate
from ...exact.system.systems import ResidualSystem
from ..evidence.alternatives import comparison_certificate
from ..evidence.attacks import Aim, Attack, Block, Family, Floats, Point, Witness
from ..evidence.corpus import examine
from ..trust import structure_certificates as make
from .structure_attacks import on_strata
from .structure_families import ENTRY, Tables, determinant, feedthrough, free_family, seen, system_of
from .witnesses import Found, confirmed


def pair_attacks() -> Iterator[Attack]:
    """Yield the attacks on statements that are false; those that stand are attacked beside single systems."""
    tall = free_family(1, 2, 1)
    for target in ("theorem-1.n-samples", "theorem-1.n-samples-same-a-c"):
        yield from on_strata(target, "one state", tall, [feedthrough], _late_difference)
    yield from on_strata("theorem-3-ii.criterion-window-n", "one state", tall, [feedthrough], _other_behaviour)
    scalar = free_family(1, 1, 1)
    yield from on_strata("canonical-form.any-a-c", "feedback", tall, [feedthrough], _other_form)
    yield from on_strata("canonical-form.feedback", "feedback", scalar, [seen], _other_dynamics)
    yield _bad_pair()
    for target in ("assumption-4.excitation-at-s", "settle-2.excitation"):
        yield _excitation_at_s(target)
    yield _excitation_necessary()


def pair_family() -> Family:
    """Return a family of systems with n = 1, p = m = 2 and of P: Z is everything, b = e_1, a = (A; C), and P is 3 x 2, by columns."""
    system = free_family(1, 2, 2)
    words = f"{system.words}, and P of 3 x 2 entries for Z = K^3"
    return Family(words, (*system.box, *[ENTRY] * 6), lambda point: (system.at(point[:9]), [list(point[9:12]), list(point[12:15])]))


def driven_family(samples: int, *, idle: bool) -> Family:
    """Return a family with n = m = 1 and p = 2; F = 0 and x(0) = 0 where it is idle."""
    system = free_family(1, 2, 1)
    count = len(system.box)

    def at(point: Sequence[Any]) -> tuple[Tables, Any, list[Any]]:
        tables = system.at(point[:count])
        x0 = point[count]
        if idle:
            tables, x0 = Tables(tables.A, [[0 * tables.F[0][0]]], tables.C, tables.G), 0 * x0
        return tables, x0, list(point[count + 1 :])

    words = f"{system.words}{', but F = 0 and x(0) = 0' if idle else ', x(0) free'}, {samples} samples of v free"
    return Family(words, (*system.box, *[ENTRY] * (1 + samples)), at)


def _bad_pair() -> Attack:
    family = pair_family()

    def numbers(point: Any) -> list[Any]:
        """Return D(0; P) and D(1; P) - D(0; P): D is of degree one in q."""
        tables, P = family.at(point)
        column = [tables.A[0][0], tables.C[0][0], tables.C[1][0]]
        at_zero = determinant([*P, [-x for x in column]])
        at_one = determinant([*P, [1 - column[0], -column[1], -column[2]]])
        return [at_zero, at_one - at_zero]

    def decide(point: Point) -> Witness | None:
        tables, columns = family.at(point)
        P = Matrix.of([[str(Fraction(c[i])) for c in columns] for i in range(3)])
        system = system_of(tables)
        kernel = kernel_representation(system)
        d = examine("adversary", system)
        space = fault_space(kernel)
        if not (d.observable and d.left_invertible and rank(P) == 2 and space.dimension == 3):
            return None
        pair = kernel_representation(with_pair(space, P))
        certificates = [comparison_certificate(kernel, pair), make.left_invertible(kernel), make.fault_space(kernel, space)]
        return None if certificates[0]["kind"] == "behaviour-equality" else confirmed(f"{system}, P = {P}", point, certificates)

    def quantity(point: Floats) -> Floats:
        tables, P = family.at(point)
        scale = np.linalg.norm(P[0]) * np.linalg.norm(P[1]) * np.linalg.norm([tables.A[0][0], tables.C[0][0], tables.C[1][0]])
        return np.array(numbers(point), dtype=np.float64) / scale

    block = Block(lambda point: [Fraction(x) for x in numbers(point)], (9, 10, 11))
    measured = "D(0; P) and D(1; P) - D(0; P), against the lengths of the columns of P and of (A; C)"
    return Attack("theorem-3-ii.every-p", "D = 0", Aim.ZERO, measured, family, quantity, decide, blocks=(block,))


def _excitation_at_s(target: str) -> Attack:
    """Return an attack that looks for [X; V_1] of full row rank and [X; V_2], 3 x 3, singular."""
    family = driven_family(4, idle=False)

    def square(point: Any) -> list[list[Any]]:
        tables, x, v = family.at(point)
        states = [x]
        for value in v[:2]:
            states.append(tables.A[0][0] * states[-1] + tables.F[0][0] * value)
        return [states, v[:3], v[1:]]

    def quantity(point: Floats) -> float:
        matrix = np.array(square(point), dtype=np.float64)
        return float(np.linalg.det(matrix) / np.prod(np.linalg.norm(matrix, axis=1)))

    def fails(full: int, late: int, gap: int) -> bool:
        return full == 2 and gap != 1

    measured = "det [X; V_2], against Hadamard's bound"
    decide = _on_data(family, fails, 1)
    return Attack(
        target,
        "a singular [X; V_(s+1)]",
        Aim.STRATUM,
        measured,
        family,
        quantity,
        decide,
        exact=lambda point: Fraction(determinant(square(point))),
    )


def _excitation_necessary() -> Attack:
    """Return an attack that looks for a right gap while [X; V_2] is of rank 2 of 3: a state is never excited."""
    family = driven_family(6, idle=True)

    def quantity(point: Floats) -> float:
        tables, _, v = family.at(point)
        values = np.array([v[:-1], v[1:]], dtype=np.float64)
        return float(np.linalg.svd(values, compute_uv=False)[-1] * np.linalg.norm(tables.G) / np.linalg.norm(values))

    def fails(full: int, late: int, gap: int) -> bool:
        return late < 3 and gap == 1

    measured = "the least singular value of V_2 times the length of G, against the largest: the gap is 1 where it is not zero"
    return Attack("assumption-4.excitation-necessary", "an idle state", Aim.NONZERO, measured, family, quantity, _on_data(family, fails, 1))


def _on_data(family: Family, fails: Callable[[int, int, int], bool], s: int) -> Callable[[Point], Witness | None]:
    """Return a decision by `fails` of rank [X; V_s], rank [X; V_(s+1)] and rank R_(s+1) - rank R_s, for an observable system inverted with
    delay s at most."""

    def decide(point: Point) -> Witness | None:
        tables, x, v = family.at(point)
        system = system_of(tables)
        d = examine("adversary", system)
        if not (d.observable and d.left_invertible and d.delay_unknown_state is not None and d.delay_unknown_state <= s):
            return None
        x0, faults = Matrix.of([[str(Fraction(x))]]), Matrix.of([[str(Fraction(value))] for value in v])
        data = simulate(system, x0, faults)
        ranks = [rank(excitation_matrix(data, k)) for k in (s, s + 1)]
        gap = rank(hankel(data.residuals, s + 1)) - rank(hankel(data.residuals, s))
        if not fails(ranks[0], ranks[1], gap):
            return None
        certificates = [make.data_rank("excitation", system, x0, faults, k) for k in (s, s + 1)]
        certificates += [make.data_rank("residual-hankel", system, x0, faults, k) for k in (s, s + 1)]
        return confirmed(f"{system}, x(0) = {x}, v = {', '.join(map(str, v))}, s = {s}: rank gap {gap}", point, certificates)

    return decide


def _alternatives(system: ResidualSystem, window: int) -> Iterator[tuple[KernelRepresentation, KernelRepresentation]]:
    """Yield the system and a pair (Fhat P, Ghat P) at a window, for each P of small entries."""
    kernel = kernel_representation(system)
    space = fault_space(kernel, window)
    for entries in product((0, 1, -1), repeat=space.dimension * system.m):
        P = Matrix.of([list(entries[i * system.m : (i + 1) * system.m]) for i in range(space.dimension)], shape=(space.dimension, system.m))
        if rank(P) == system.m:
            yield kernel, kernel_representation(with_pair(space, P))


def _regular(system: ResidualSystem) -> bool:
    d = examine("adversary", system)
    return d.observable and d.controllable and d.left_invertible


def _late_difference(system: ResidualSystem) -> Found | None:
    """Find a system with the same (A, C) that agrees on n samples and differs later; both are observable, controllable and
    left-invertible."""
    if not _regular(system):
        return None
    for kernel, other in _alternatives(system, system.n):
        difference = compare(kernel, other).first_difference
        if difference is not None and difference > system.n and _regular(other.system):
            certificates = [make.window_equality(kernel, other, system.n), comparison_certificate(kernel, other)]
            return f"{system} and F' = {other.system.F}, G' = {other.system.G}", certificates
    return None


def _other_behaviour(system: ResidualSystem) -> Found | None:
    """Find a pair taken at s = n, of normal rank m, that is not equivalent."""
    if not _regular(system):
        return None
    for kernel, other in _alternatives(system, system.n):
        if other.normal_rank == system.m and compare(kernel, other).first_difference is not None:
            certificates = [comparison_certificate(kernel, other), make.left_invertible(other)]
            certificates.append(make.fault_space(kernel, fault_space(kernel, system.n)))
            return f"{system} with F' = {other.system.F}, G' = {other.system.G}", certificates
    return None


def _other_form(system: ResidualSystem) -> Found | None:
    """Find the same outputs made by other (A, C), with another Z."""
    return _by_feedback(system, lambda kernel, other: fault_space(kernel).basis != fault_space(other).basis)


def _other_dynamics(system: ResidualSystem) -> Found | None:
    """Find the same outputs made by an A with other eigenvalues."""
    return _by_feedback(system, lambda kernel, other: kernel.system.A != other.system.A) if system.n == 1 else None


def _by_feedback(system: ResidualSystem, differs: Callable[[KernelRepresentation, KernelRepresentation], bool]) -> Found | None:
    if not _regular(system):
        return None
    kernel = kernel_representation(system)
    for similar in (system, ResidualSystem(system.A, -system.F, -system.C, system.G)):
        for gain in (1, -1, 2):
            other = kernel_representation(with_feedback(similar, [[gain] * system.n] * system.m))
            certificates = [comparison_certificate(kernel, other)]
            if certificates[0]["kind"] == "behaviour-equality" and differs(kernel, other):
                certificates += [make.fault_space(one, fault_space(one)) for one in (kernel, other)]
                return f"{system} and {other.system}", certificates
    return None
