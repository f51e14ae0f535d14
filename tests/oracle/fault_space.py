"""This is problem (11), by its definition: the columns z = [f; g] with N_s T_s(z) = 0.

N_s is a basis of the left null space of [O_s T_s]; T_s(z) is the Toeplitz matrix of (A, f, C, g), all of its s block
columns.

    fault_space(system, s)          the solutions at window s: rows [f; g]' of the reduced row echelon form, dim x (n+p)
    fault_space_limit(system)       the solutions at every window beyond all left minimal indices
    annihilated_columns(system, z, s)   for each block column of T_s(z), whether N_s annihilates it
"""

from __future__ import annotations

from collections.abc import Sequence

from .fields import Element
from .linear import Matrix, column_of, left_null_space, matrix, null_space, rref, unit_vector
from .systems import System
from .windows import toeplitz, window_matrix


def with_fault_column(system: System, z: Matrix) -> System:
    """The result is the system (A, f, C, g) whose only fault column is z = [f; g], (n+p) x 1."""
    f = matrix(system.field, system.n, 1, z.rows[: system.n])
    g = matrix(system.field, system.p, 1, z.rows[system.n :])
    return System(system.field, system.A, f, system.C, g)


def fault_space(system: System, s: int) -> Matrix:
    """The result is the reduced row echelon basis of { z : N_s T_s(z) = 0 }; z enters linearly, so the unit vectors tell all."""
    annihilator = left_null_space(window_matrix(system, s))
    size = system.n + system.p
    images = []
    for i in range(size):
        column_system = with_fault_column(system, unit_vector(system.field, size, i))
        images.append((annihilator @ toeplitz(column_system, s)).entries())
    conditions = matrix(system.field, size, annihilator.height * s, images).T
    return rref(null_space(conditions))[0]


def fault_space_limit(system: System) -> Matrix:
    """These are the solutions for every window beyond all left minimal indices: none exceeds n, so window n + 2 is beyond."""
    return fault_space(system, system.n + 2)


def annihilated_columns(system: System, z: Sequence[Element], s: int) -> list[bool]:
    """For each of the s block columns of T_s(z) this tells whether N_s annihilates it."""
    annihilator = left_null_space(window_matrix(system, s))
    product = annihilator @ toeplitz(with_fault_column(system, column_of(system.field, z)), s)
    return [product.column(j).is_zero() for j in range(s)]
