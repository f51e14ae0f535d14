"""problem-11: the maximal solution of N_s T_s = 0, N_s a basis of the left null space, is a basis (Fhat, Ghat) with n_z columns."""

from __future__ import annotations

from itertools import product

from ...exact.algebra.matrices import Matrix
from ...exact.structure.kernel_rows import column_conditions
from ...exact.system.systems import ResidualSystem
from ..boxes.box import Box, in_order
from ..evidence.kept_kernels import kernel_once
from ..trust import structure_certificates as make
from ..verdict.verdicts import Outcome, Verdict
from ..verdict.workbench import Workbench, counterexample

BOX = Box(n=(1, 2), m=(1, 2), p=(1, 2), total=4)


def first_block_column(bench: Workbench) -> Outcome:
    """Is it enough that N_s annihilates the first block column of T_s(z)? The smallest system and column that say no."""
    for system in in_order(BOX, "observable and left_invertible"):
        kernel = kernel_once(system)
        window = kernel.lag + 1
        rows = kernel.rows_within(window)
        for entries in product((-1, 0, 1), repeat=system.n + system.p):
            z = Matrix.of([[x] for x in entries])
            if _first_column_vanishes(system, z, window) and not all(
                (column_conditions(r.coefficients, system.A, system.C) @ z).is_zero() for r in rows
            ):
                words = f"{system}, z = {list(entries)}, s = {window}"
                return counterexample(words, f"{BOX}, s = lag + 1", [make.first_column_only(kernel, window, z), make.window_ranks(kernel)])
    return Outcome(Verdict.ERROR, "no counterexample in the box")


def _first_column_vanishes(system: ResidualSystem, z: Matrix, window: int) -> bool:
    """Return whether every left null row of [O_s T_s] annihilates (g, C f, C A f, ...)."""
    x, outputs = z.rows(range(system.n)), [z.rows(range(system.n, system.n + system.p))]
    for _ in range(window - 1):
        outputs.append(system.C @ x)
        x = system.A @ x
    for row in kernel_once(system).rows_within(window):
        for shift in range(window - row.degree):
            values = [row.coefficients.rows([k]) @ outputs[k + shift] for k in range(row.degree + 1)]
            if not sum(values[1:], values[0]).is_zero():
                return False
    return True
