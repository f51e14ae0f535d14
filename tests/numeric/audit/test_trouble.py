"""Every kind of trouble is what it says, by slow routes that do not share its making; the default set is that of its fingerprint."""

from __future__ import annotations

import json
from collections.abc import Callable
from fractions import Fraction
from importlib.resources import files
from itertools import combinations, pairwise
from typing import Any

import numpy as np
import pytest
import sympy
from sympy.polys.matrices import DomainMatrix

from faultspace.exact.algebra.matrices import Matrix, beside, rank, stacked
from faultspace.exact.structure.record import analyze
from faultspace.exact.structure.signals import data_fault_space, hankel
from faultspace.exact.system.systems import ResidualSystem
from faultspace.numeric.audit import reference
from faultspace.numeric.audit.checks.trouble import of_trouble
from faultspace.numeric.audit.making.kinds_of_trouble import COUNT, KINDS, SPACE, STRUCTURE, Kind
from faultspace.numeric.audit.making.trouble_vectors import eigenvalue_bounds, made, unbounded, zero_bounds
from faultspace.numeric.audit.subjects.opening import InProcess
from faultspace.numeric.audit.vectors.fault_vectors import in_channel_units, samples_that_settle
from faultspace.numeric.audit.vectors.rationals import floats, fractions, matrix
from faultspace.numeric.audit.vectors.shipped_vectors import shipped
from faultspace.numeric.audit.vectors.trouble import SEED, VERSION, Trouble, default_troubles, document, fingerprint
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.study.conditioning import ModelError
from tests.thorough import every

SHIPPED = json.loads(files("faultspace.numeric.audit.vectors").joinpath("data/trouble.json").read_text("utf-8"))
TROUBLES = {one.kind: one for one in default_troubles()}
STRUCTURES = [one.structure for one in TROUBLES.values() if one.structure]


def system_of(trouble: Trouble) -> ResidualSystem:
    """Return the one system that all vectors of a kind are of; of a kind with a model alone its inputs stand for the faults."""
    if trouble.structure:
        return trouble.structure.system
    if trouble.faults:
        return trouble.faults.system
    model = trouble.model
    assert model is not None
    return ResidualSystem(model.A, model.B, model.C, model.D)


@pytest.mark.parametrize("seed", [3, 4, 8])
def test_a_draw_without_bounds_is_drawn_again(seed: int) -> None:
    """Its first draw has zeros that rounding may put anywhere."""
    (kind,) = (one for one in KINDS if one.slug == "small-units")
    first, found = unbounded(kind, seed).structure, made(kind, seed).structure
    assert first is not None and found is not None
    with pytest.raises(ArithmeticError, match="anywhere"):
        zero_bounds(first.system, first.zeros, first.normal_rank)
    assert first.system != found.system and 0 < max(found.zero_bounds) < 1


def test_drawing_again_gives_the_same_fingerprint() -> None:
    """All that the fingerprint covers is exact: bounds, which it leaves out, are not made here."""
    again = document([unbounded(kind, SEED) for kind in KINDS], SEED)
    assert (again["version"], again["seed"]) == (VERSION, SEED)
    assert again["sha256"] == SHIPPED["sha256"] == fingerprint(SHIPPED)


def test_the_fingerprint_sees_any_change_but_bounds() -> None:
    changed = json.loads(json.dumps(SHIPPED))
    changed["vectors"][0]["faults"]["bounds"]["residual"] = 1.0
    assert fingerprint(changed) == SHIPPED["sha256"]
    changed["vectors"][0]["faults"]["v"][3][0] = "11"
    assert fingerprint(changed) != SHIPPED["sha256"]


@pytest.mark.parametrize("kind", KINDS[:: every(3)], ids=lambda kind: kind.slug)
def test_bounds_are_made_again(kind: Kind) -> None:
    """Within a half: they inherit the machine's arithmetic in their last digits."""
    again, kept = made(kind, SEED).to_json(), TROUBLES[kind.slug].to_json()
    for part in ("structure", "model", "faults"):
        if kept[part] is not None:
            _same(again[part]["bounds"], kept[part]["bounds"])


def _same(made_now: Any, kept: Any) -> None:
    if isinstance(kept, dict):
        assert made_now.keys() == kept.keys()
        for key in kept:
            _same(made_now[key], kept[key])
    elif isinstance(kept, list):
        assert len(made_now) == len(kept)
        for one, other in zip(made_now, kept, strict=True):
            _same(one, other)
    else:
        assert made_now == kept or made_now == pytest.approx(kept, rel=0.5)


@pytest.mark.parametrize("kind", KINDS[:: every()], ids=lambda kind: kind.slug)
def test_another_seed_draws_other_vectors_and_the_reference_passes_them(kind: Kind) -> None:
    other = made(kind, 7)
    assert other.to_json() != TROUBLES[kind.slug].to_json() or kind.slug == "pure-noise"
    subject = InProcess(reference)
    failed = [one for one in map(subject.perform, of_trouble(other)) if one.failed]
    assert failed == []


# -- what is planted is there --------------------------------------------------------------------------------------------------------


def _zeros(slug: str) -> list[complex]:
    vector = TROUBLES[slug].structure
    assert vector is not None
    return list(vector.zeros)


PLANTED: dict[str, Callable[[list[complex]], bool]] = {
    "zeros-none": lambda z: z == [],
    "zeros-complex": lambda z: len(z) == 3 and sum(abs(one.imag) > 0 for one in z) == 2,
    "zeros-repeated": lambda z: len(z) == 2 and z[0] == z[1],
    "zeros-repeated-apart": lambda z: len(z) == 2 and z[0] == z[1],
    "zeros-at-0": lambda z: z == [0],
    "zeros-at-1": lambda z: z == [1],
    "zeros-on-the-circle": lambda z: len(z) == 2 and all(abs(abs(one) - 1) < 1e-15 and one.imag for one in z),
    "zeros-outside": lambda z: len(z) == 1 and abs(z[0]) > 1,
    "zeros-large": lambda z: len(z) == 2 and max(map(abs, z)) >= 256 and min(map(abs, z)) < 1,
    "zeros-at-infinity": lambda z: len(z) == 3,
    "square-complex": lambda z: len(z) == 4,
    "square-repeated": lambda z: len(z) == 3 and len(set(z)) == 2,
    "rank-drops-at-0": lambda z: set(z) == {0},
    "rank-drops-at-1": lambda z: set(z) == {1},
    "rank-drops-at-0-and-1": lambda z: set(z) == {0, 1},
}


@pytest.mark.parametrize("slug", PLANTED)
def test_the_zeros_are_those_planted(slug: str) -> None:
    assert PLANTED[slug](_zeros(slug)), _zeros(slug)


def _poles(slug: str) -> Any:
    return sympy.Matrix([[sympy.Rational(str(x)) for x in row] for row in fractions(system_of(TROUBLES[slug]).A)])


def test_the_poles_are_those_planted() -> None:
    half, seven_eighths = sympy.Rational(1, 2), sympy.Rational(7, 8)

    def eigenspace(slug: str, value: Any) -> tuple[int, int]:
        """Return the algebraic and the geometric multiplicity."""
        A = _poles(slug)
        return A.eigenvals().get(value, 0), A.shape[0] - (A - value * sympy.eye(A.shape[0])).rank()

    assert eigenspace("poles-at-0", 0)[1] == 1 and eigenspace("poles-at-1", 1)[1] == 1
    times, vectors = eigenspace("poles-defective", half)
    assert times >= 2 and vectors < times
    assert eigenspace("poles-repeated", seven_eighths) == (2, 2)
    nilpotent = _poles("poles-nilpotent")
    assert (nilpotent**3).is_zero_matrix and not (nilpotent**2).is_zero_matrix
    for slug in ("poles-unstable", "poles-unstable-pair"):
        assert max(abs(one) for one in np.linalg.eigvals(floats(system_of(TROUBLES[slug]).A))) > 1


def test_the_sizes_and_modes_are_those_that_the_kinds_name() -> None:
    found = {slug: system_of(one) for slug, one in TROUBLES.items()}
    assert (found["order-12"].n, found["order-0"].n, found["no-fault"].m) == (12, 0, 0)
    assert (found["no-fault-in-one-output"].p, found["no-fault-in-one-output"].m) == (1, 0)
    assert (found["six-by-six"].m, found["six-by-six"].p, found["square-D"].m) == (6, 6, found["square-D"].p)
    assert max(one.n for one in found.values()) == 12 and max(one.p for one in found.values()) == 6
    known = {slug: analyze(one) for slug, one in found.items()}
    assert not known["zeros-uncontrollable"].controllable and not known["zeros-unobservable"].observable
    assert known["delays"].infinite_zero_orders == (2, 4) and known["zeros-at-infinity"].infinite_zero_orders == (1,)
    assert known["long-lag"].kernel.lag == 8 and known["one-long-among-short"].kernel.left_minimal_indices == (1, 6)
    assert not known["rank-deficient"].left_invertible and not known["more-faults-than-outputs"].left_invertible
    assert not analyze(found["zeros-unobservable"]).observable
    sizes = {slug: [max(abs(x) for x in column) for column in zip(*fractions(one.G), strict=True)] for slug, one in found.items()}
    assert min(sizes["small-D"]) < Fraction(1, 500) and max(sizes["large-D"]) > 500
    columns = [floats(stacked(one.F, one.G)) for one in (found["nearly-parallel-faults"], found["zeros-none"])]
    assert np.linalg.cond(columns[0]) > 1e4 > 1e2 > np.linalg.cond(columns[1])


# -- truth by slow routes ---------------------------------------------------------------------------------------------------------------


def _pencil(system: ResidualSystem, z: Fraction) -> Matrix:
    n = system.n
    A = [[(z if i == j else 0) - x for j, x in enumerate(row)] for i, row in enumerate(fractions(system.A))]
    F = [[-x for x in row] for row in fractions(system.F)]
    return stacked(beside(matrix(A, n), matrix(F, system.m)), beside(system.C, system.G))


@pytest.mark.parametrize("vector", STRUCTURES, ids=lambda vector: vector.slug)
def test_the_normal_rank_is_the_largest_at_points(vector: Any) -> None:
    ranks = [rank(_pencil(vector.system, z)) - vector.system.n for z in map(Fraction, range(-8, 9))]
    assert max(ranks) == vector.normal_rank
    for zero in (0, 1):  # a rank that is lost at these points is that of a zero there, where there is one fault as well as two
        if vector.left_invertible:
            assert (ranks[zero + 8] < vector.normal_rank) == any(z == zero for z in vector.zeros)


@pytest.mark.parametrize("vector", STRUCTURES, ids=lambda vector: vector.slug)
def test_infinite_zeros_by_ranks_of_toeplitz_matrices(vector: Any) -> None:
    """#{order <= k} = rank T_(k+1) - rank T_k [VD79]."""
    system, n = vector.system, vector.system.n
    parameters, state = [system.G], system.F
    for _ in range(n):
        parameters.append(system.C @ state)
        state = system.A @ state
    ranks = [0]
    for size in range(1, n + 2):
        blank = Matrix.zero(system.field, system.p, system.m)
        ranks.append(rank(stacked(*(beside(*(parameters[i - j] if i >= j else blank for j in range(size))) for i in range(size)))))
    steps = [b - a for a, b in pairwise(ranks)]
    due = [sum(order <= k for order in vector.infinite_zero_orders) for k in range(n + 1)]
    assert steps == due


SMALL_ONES = [one for one in STRUCTURES if one.left_invertible and one.system.n + one.system.m <= 6]


@pytest.mark.parametrize("vector", SMALL_ONES, ids=lambda vector: vector.slug)
def test_zeros_are_the_roots_of_the_gcd_of_all_minors(vector: Any) -> None:
    """The determinantal divisor of full size, by expansion of every minor."""
    system, z = vector.system, sympy.Symbol("z")
    n, m, p = system.n, system.m, system.p
    at_0, slope = fractions(_pencil(system, Fraction(0))), n
    entries = [[sympy.Rational(str(x)) + (z if i == j and i < slope else 0) for j, x in enumerate(row)] for i, row in enumerate(at_0)]
    divisor = sympy.Poly(0, z)
    for rows in combinations(range(n + p), n + m):
        minor = DomainMatrix.from_Matrix(sympy.Matrix([entries[i] for i in rows])).charpoly()[-1]
        divisor = sympy.gcd(divisor, sympy.Poly(sympy.sympify(str(minor)), z))
    assert divisor.degree() == len(vector.zeros)
    for root in set(vector.zeros):
        times = vector.zeros.count(root)
        *lost, kept = (abs(complex(divisor.monic().diff((z, k)).eval(root))) for k in range(times + 1))
        assert max(lost) < 1e-9 * max(1, abs(root)) ** divisor.degree() and kept > 1e-6


FAULTS = [one for one in TROUBLES.values() if one.faults]


@pytest.mark.parametrize("trouble", FAULTS[:: every()], ids=lambda one: one.kind)
def test_ranks_gaps_and_spaces_of_records(trouble: Trouble) -> None:
    """Ranks are exact, gaps enclose what a float SVD sees, the data alone show the space, and the count where it is due."""
    vector = trouble.faults
    assert vector is not None and vector.clear
    scaled = in_channel_units(vector.r)
    for s, (due, (least, largest)) in enumerate(zip(vector.ranks, vector.gaps, strict=True), start=1):
        values = np.linalg.svd(floats(hankel(scaled, s)), compute_uv=False)
        assert rank(hankel(vector.r, s)) == due
        assert values[0] <= largest * (1 + 1e-6) and least <= values[due - 1] * (1 + 1e-6) and values[due - 1] * 0.99 < least
    if SPACE in trouble.asks:
        seen = data_fault_space(vector.r, vector.system.A, vector.system.C, vector.system.n + 1)
        assert rank(stacked(seen, vector.space.transposed())) == seen.nrows == vector.space.ncols
    if COUNT in trouble.asks:
        assert vector.v.nrows >= samples_that_settle(vector.system.p, vector.lag)
        assert vector.ranks[-1] - vector.ranks[-2] == vector.n_v


def test_the_count_is_due_on_no_record_too_short_to_tell() -> None:
    """Of the first vectors the same holds, in all their views."""
    for one in shipped("faults"):
        for view in (one, *one.views.values()):
            assert view.v.nrows >= samples_that_settle(view.system.p, view.lag), (one.slug, view.view.slug)


@pytest.mark.parametrize("trouble", [one for one in TROUBLES.values() if one.model], ids=lambda one: one.kind)
def test_models_are_the_same_system_and_say_something(trouble: Trouble) -> None:
    vector = trouble.model
    assert vector is not None and vector.asked("characteristic_polynomial")
    system = system_of(trouble)
    assert (vector.A, vector.B, vector.C, vector.D) == (system.A, system.F, system.C, system.G)
    state, A, B, C, D, u = floats(vector.x0).ravel(), *(floats(getattr(vector, name)) for name in "ABCDu")
    for k, due in enumerate(floats(vector.y)):
        assert np.allclose(C @ state + D @ u[k], due, rtol=1e-6, atol=1e-6 * np.abs(due).max())
        state = A @ state + B @ u[k]


# -- bounds -----------------------------------------------------------------------------------------------------------------------------


def test_a_repeated_zero_has_the_root_of_the_bound_of_a_simple_one() -> None:
    """Of a chain of length k the bound goes with the kth root of rounding; of two chains of length one it does not."""
    bounds = {slug: max(TROUBLES[slug].structure.zero_bounds) for slug in ("zeros-repeated", "zeros-repeated-apart", "zeros-at-1")}  # type: ignore[union-attr]
    assert 1e-8 < bounds["zeros-repeated"] < 1e-5
    assert max(bounds["zeros-repeated-apart"], bounds["zeros-at-1"]) < 1e-11


@pytest.mark.parametrize("length", [1, 2, 3])
def test_the_bound_of_a_chain_in_closed_form(length: int) -> None:
    """Of a Jordan block moved by d in its corner the eigenvalues are the kth roots of d, and none moves further to first order."""
    J = np.diag([0.5] * length) + np.diag([1.0] * (length - 1), 1)
    (bound,) = {*eigenvalue_bounds(J, 1e-12, [0.5] * length)}
    assert 1e-12 ** (1 / length) <= bound < 2 * 1e-12 ** (1 / length)


def test_of_a_nilpotent_system_the_first_order_is_not_all() -> None:
    """Markov parameters of A moved by d stay within their bounds, also those in which the first order vanishes."""
    A, B, C = np.diag([1.0, 1.0], 1), np.array([[0.0], [0.0], [1.0]]), np.array([[1.0, 0.0, 0.0]])
    moved = 1e-6
    error = ModelError(StateSpaceModel(A, B, C, np.zeros((1, 1))), np.ones(1), np.ones(1), moved, moved, 0.0, 0.0, 0.0)
    corner = np.zeros((3, 3))
    corner[2, 0] = moved
    powers = [np.linalg.matrix_power(A + corner, k) - np.linalg.matrix_power(A, k) for k in range(12)]
    off = np.array([abs((C @ power @ B).item()) for power in powers])
    assert off[8] == pytest.approx(moved**2, rel=0.01, abs=0.0) and np.all(off <= error.markov(13)[1:, 0, 0])


def test_rounding_moves_no_zero_beyond_its_bound() -> None:
    """The pencil of a square system moved by a few units in every entry, many times: what a backward stable program may find."""
    rng = np.random.default_rng(1)
    for slug in ("square-repeated", "square-complex", "rank-drops-at-0"):
        vector = TROUBLES[slug].structure
        assert vector is not None
        A, F, C, G = (floats(M) for M in (vector.system.A, vector.system.F, vector.system.C, vector.system.G))
        size = 2.0**-52 * max(float(np.linalg.norm(M)) for M in (A, F, C, G))
        largest = 0.0
        for _ in range(100):
            a, f, c, g = (M + size * rng.uniform(-1, 1, M.shape) for M in (A, F, C, G))
            off = np.abs(np.linalg.eigvals(a - f @ np.linalg.solve(g, c))[:, np.newaxis] - np.array(vector.zeros))
            largest = max(largest, float(np.max(off.min(axis=1) / np.array(vector.zero_bounds)[off.argmin(axis=1)])))
        assert 1e-4 < largest <= 1, slug
    assert zero_bounds(STRUCTURES[0].system, [], STRUCTURES[0].normal_rank) == []


def test_every_kind_concerns_something_and_is_said_in_words() -> None:
    assert len(KINDS) == len({kind.slug for kind in KINDS}) >= 40 and all(kind.what and kind.asks for kind in KINDS)
    assert [one.kind for one in default_troubles()] == [kind.slug for kind in KINDS]
    assert sum(STRUCTURE in kind.asks for kind in KINDS) >= 35
