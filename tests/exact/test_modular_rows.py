"""Kernel rows modulo a prime: the faults that outputs tell are eliminated first, and what comes out is what the slow ways find."""

from __future__ import annotations

from random import Random

import pytest
from flint import nmod_mat

from faultspace.exact.algebra.fields import PrimeField
from faultspace.exact.algebra.matrices import Matrix, rank
from faultspace.exact.structure.kernel_rows import _leads as leads_of_chain
from faultspace.exact.structure.modular_rows import pencil_rank_at, placed, rows_modulo
from faultspace.exact.structure.zero_output import zero_output_chain
from faultspace.exact.system.systems import ResidualSystem
from faultspace.exact.system.windows import window_matrix

PRIME = 2**27 - 39
SIZES = [(0, 0, 0), (0, 2, 2), (0, 0, 3), (2, 0, 0), (1, 1, 0), (3, 0, 2), (1, 1, 1), (2, 2, 1), (3, 1, 4), (4, 2, 3), (5, 3, 3), (6, 2, 5)]


def random_system(rng: Random, n: int, m: int, p: int) -> ResidualSystem:
    """Return a system with many zeros over a prime field, its G of any rank."""
    few = 0.2 + 0.8 * rng.random()

    def block(height: int, width: int, density: float) -> Matrix:
        rows = [[rng.randint(-3, 3) if rng.random() < density else 0 for _ in range(width)] for _ in range(height)]
        return Matrix.of(rows, PrimeField(PRIME), shape=(height, width))

    return ResidualSystem(block(n, n, few), block(n, m, few), block(p, n, few), block(p, m, rng.choice((0.0, 0.3, few))))


@pytest.mark.parametrize("sizes", SIZES)
def test_leads_are_those_of_the_recursion_and_rows_vanish_on_the_window(sizes: tuple[int, int, int]) -> None:
    rng = Random(str(sizes))
    for _ in range(40):
        system = random_system(rng, *sizes)
        found = rows_modulo(system)
        assert found is not None
        assert list(found.leads) == leads_of_chain(zero_output_chain(system), system.p)
        assert pencil_rank_at(system, found.point) == system.n + system.p - len(found.leads)
        for row, (mu, output) in zip(found.rows, found.leads, strict=True):
            assert len(row) == mu + 1 and row[-1][output] == 1 and not any(row[-1][output + 1 :])
            flat = Matrix.of([[x for c in row for x in c]], system.field)
            assert (flat @ window_matrix(system, mu + 1)).is_zero()
        states = placed(found.states, system.n, PRIME)
        assert states.rank() == sum(found.degrees)  # the checker asks for that


def test_both_ends_are_met_with_and_without_faults_that_outputs_do_not_tell() -> None:
    rng, points = Random(3), set[bool]()
    for _ in range(60):
        found = rows_modulo(random_system(rng, 4, 2, 4))
        assert found is not None
        points.add(found.point == "infinity")
    assert points == {True, False}


@pytest.mark.parametrize("sizes", SIZES)
def test_the_rank_of_the_pencil_is_that_of_the_matrix_also_at_an_eigenvalue(sizes: tuple[int, int, int]) -> None:
    rng = Random(str(sizes))
    for _ in range(20):
        system, n = random_system(rng, *sizes), sizes[0]
        for point in (0, 1, rng.randrange(PRIME)):
            shift = Matrix.identity(system.field, n).flint * point
            shifted = Matrix(system.field, n, n, system.A.flint - shift)
            rows = [[*a, *f] for a, f in zip(shifted.elements(), system.F.elements(), strict=True)]
            rows += [[*c, *g] for c, g in zip(system.C.elements(), system.G.elements(), strict=True)]
            built = Matrix.from_elements(system.field, n + system.p, n + system.m, rows)
            assert pencil_rank_at(system, point) == rank(built)
        assert pencil_rank_at(system, "infinity") == n + rank(system.G)


def test_matrices_are_placed_one_above_the_other() -> None:
    parts = [nmod_mat(1, 2, [1, 2], 7), nmod_mat(0, 2, 7), nmod_mat(2, 2, [3, 4, 5, 6], 7)]
    assert placed(parts, 2, 7) == nmod_mat(3, 2, [1, 2, 3, 4, 5, 6], 7)
    assert (placed([], 3, 7).nrows(), placed([], 3, 7).ncols()) == (0, 3)
