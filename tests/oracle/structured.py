"""Random systems, plain and of known structure, from any `random.Random`: the same seed gives the same system.

A system of planted structure is a sum of elementary ones, each with one Kronecker block of its pencil,

    left index eta        eta states, one output, no fault: a chain of states read at its end
    right index eps       eps states, one fault, no output: a chain of states driven at its start
    infinite order delta  delta states between one fault and one output: a delay; a feedthrough for delta = 0
    finite zeros          states without faults and outputs: their eigenvalues

scrambled by what changes no structure: bases of states, faults and outputs, x-feedback v + Kx and output injection.

    Structure(left, right, infinite, roots)      its n, m, p, normal_rank, zero_polynomial(field)
    random_structure(rng, n, p, m)               any structure of these dimensions
    planted_system(rng, field, structure)        SYSTEM with that structure
    random_system(rng, field, n, p, m)           SYSTEM: dense, sparse, degenerate or planted
    random_pair(rng, field, n, p, m)             two SYSTEMs, often equivalent or one within the other
    similar(rng, system), fed_back(rng, system)  System -> System with the same behaviour

`field` is a FIELD of the format throughout.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from random import Random

from . import polynomials
from .fields import Element, Field, Json, NumberField, PrimeField, parse_field
from .linear import Matrix, above, beside, identity, matrix, solve, zeros
from .systems import System, parse_system, write_system


@dataclass(frozen=True)
class Structure:
    """It has left and right minimal indices, infinite zero orders (one per unit of normal rank) and integer finite zeros."""

    left: tuple[int, ...]
    right: tuple[int, ...]
    infinite: tuple[int, ...]
    roots: tuple[int, ...]

    @property
    def n(self) -> int:
        return sum(self.left) + sum(self.right) + sum(self.infinite) + len(self.roots)

    @property
    def p(self) -> int:
        return len(self.left) + len(self.infinite)

    @property
    def m(self) -> int:
        return len(self.right) + len(self.infinite)

    @property
    def normal_rank(self) -> int:
        return len(self.infinite)

    def zero_polynomial(self, field: Field) -> polynomials.Polynomial:
        """The result is the product of q - root."""
        product: polynomials.Polynomial = [field.one]
        for root in self.roots:
            product = polynomials.multiply(product, [field.integer(-root), field.one])
        return product


def random_structure(rng: Random, n: int, p: int, m: int) -> Structure:
    """The structure has n states, p outputs and m faults: n is dealt out among the blocks at random."""
    r = rng.randint(0, min(p, m))
    counts = [0] * (p - r + m - r + r)
    roots = 0
    for _ in range(n):
        slot = rng.randint(0, len(counts))
        if slot == len(counts):
            roots += 1
        else:
            counts[slot] += 1
    return Structure(
        tuple(sorted(counts[: p - r])),
        tuple(sorted(counts[p - r : p - r + m - r])),
        tuple(sorted(counts[p - r + m - r :])),
        tuple(rng.randint(-2, 2) for _ in range(roots)),
    )


def planted_system(rng: Random, field: Json, structure: Structure) -> Json:
    """The result is a SYSTEM whose pencil has that structure."""
    over = parse_field(field)
    system = _empty(over)
    for eta in structure.left:
        system = _sum(system, _chain(over, eta, driven=False, read=True))
    for eps in structure.right:
        system = _sum(system, _chain(over, eps, driven=True, read=False))
    for delta in structure.infinite:
        system = _sum(system, _chain(over, delta, driven=True, read=True))
    return write_system(_scrambled(rng, _sum(system, _free_states(rng, over, structure.roots))))


def random_system(rng: Random, field: Json, n: int, p: int, m: int) -> Json:
    """The result is a SYSTEM of n states, p outputs and m faults; degenerate as often as not."""
    kind = rng.randrange(5)
    if kind == 0:
        return planted_system(rng, field, random_structure(rng, n, p, m))
    system = _entrywise(rng, parse_field(field), n, p, m)
    if kind == 1:
        system = _with_nulled_states(rng, system)
    if kind == 2:
        system = _with_repetitions(rng, system)
    if kind == 3:
        system = _with_zero_block(rng, system)
    return write_system(system)


def random_pair(rng: Random, field: Json, n: int, p: int, m: int) -> tuple[Json, Json]:
    """The two SYSTEMs are over the same field, with the same number of outputs."""
    first = parse_system(random_system(rng, field, n, p, m))
    variants: list[Callable[[Random, System], System]] = [
        similar,
        fed_back,
        _with_fewer_faults,
        _with_another_entry,
        _unrelated,
    ]
    return write_system(first), write_system(rng.choice(variants)(rng, first))


def similar(rng: Random, system: System) -> System:
    """The result is the same system in other coordinates of state and fault."""
    basis, inverse = _invertible(rng, system.field, system.n)
    faults, _ = _invertible(rng, system.field, system.m)
    return System(system.field, basis @ system.A @ inverse, basis @ system.F @ faults, system.C @ inverse, system.G @ faults)


def fed_back(rng: Random, system: System) -> System:
    """The result is (A + FK, F, C + GK, G): the same behaviour, since v ranges over everything."""
    gain = _random_matrix(rng, system.field, system.m, system.n, 0.6)
    return System(system.field, system.A + system.F @ gain, system.F, system.C + system.G @ gain, system.G)


def random_element(rng: Random, field: Field, density: float) -> Element:
    """The element is zero with probability 1 - density, else small, and may be zero then, too."""
    if rng.random() >= density:
        return field.zero
    if isinstance(field, PrimeField):
        return field.integer(rng.randrange(field.prime))
    if isinstance(field, NumberField):
        degree = len(field.modulus) - 1
        parts = [_small_rational(rng) if rng.random() < 0.5 else Fraction(0) for _ in range(degree)]
        return field.parse([str(x) for x in parts])
    return _small_rational(rng)


def _small_rational(rng: Random) -> Fraction:
    return Fraction(rng.randint(-3, 3), rng.choice((1, 1, 1, 2, 3)))


def _random_matrix(rng: Random, field: Field, height: int, width: int, density: float) -> Matrix:
    return matrix(field, height, width, [[random_element(rng, field, density) for _ in range(width)] for _ in range(height)])


def _invertible(rng: Random, field: Field, size: int) -> tuple[Matrix, Matrix]:
    """The result is a random invertible matrix and its inverse: a permuted product of unit triangular ones with small entries."""
    lower = [[field.integer(rng.randint(-1, 1) if j < i else int(i == j)) for j in range(size)] for i in range(size)]
    upper = [[field.integer(rng.randint(-1, 1) if j > i else int(i == j)) for j in range(size)] for i in range(size)]
    rng.shuffle(lower)
    product = matrix(field, size, size, lower) @ matrix(field, size, size, upper)
    inverse = solve(product, identity(field, size))
    if inverse is None:
        raise ArithmeticError("a product of invertible matrices is singular")
    return product, inverse


def _entrywise(rng: Random, field: Field, n: int, p: int, m: int) -> System:
    density = rng.choice((0.3, 0.6, 1.0))
    return System(
        field,
        _random_matrix(rng, field, n, n, density),
        _random_matrix(rng, field, n, m, density),
        _random_matrix(rng, field, p, n, density),
        _random_matrix(rng, field, p, m, rng.choice((0.0, density))),
    )


def _with_nulled_states(rng: Random, system: System) -> System:
    """An output-nulling subspace is planted and hidden: with v = -Kx the first k states stay among themselves, unseen."""
    n, field = system.n, system.field
    k = rng.randint(0, n)
    gain = _random_matrix(rng, field, system.m, k, 0.6)
    forced = system.F @ gain
    top = _random_matrix(rng, field, k, k, 0.6)
    left = above(top, matrix(field, n - k, k, forced.rows[k:]))
    a = beside(left, system.A.columns(k, n))
    c = beside(system.G @ gain, system.C.columns(k, n))
    return similar(rng, System(field, a, system.F, c, system.G))


def _with_repetitions(rng: Random, system: System) -> System:
    """The result is the first fault column and the first output row once more in place of the last ones."""
    f, g, c = system.F, system.G, system.C
    if system.m and rng.random() < 0.7:
        f, g = beside(f.columns(0, system.m - 1), f.column(0)), beside(g.columns(0, system.m - 1), g.column(0))
    if system.p and rng.random() < 0.7:
        c = beside(c.T.columns(0, system.p - 1), c.T.column(0)).T
        g = beside(g.T.columns(0, system.p - 1), g.T.column(0)).T
    return System(system.field, system.A, f, c, g)


def _with_zero_block(rng: Random, system: System) -> System:
    blocks = [system.A, system.F, system.C, system.G]
    i = rng.randrange(4)
    blocks[i] = zeros(system.field, blocks[i].height, blocks[i].width)
    return System(system.field, *blocks)


def _with_fewer_faults(rng: Random, system: System) -> System:
    kept = rng.randint(0, system.m)
    return System(system.field, system.A, system.F.columns(0, kept), system.C, system.G.columns(0, kept))


def _with_another_entry(rng: Random, system: System) -> System:
    if not system.n or not system.m:
        return system
    rows = [list(row) for row in system.F.rows]
    rows[rng.randrange(system.n)][rng.randrange(system.m)] = random_element(rng, system.field, 1.0)
    return System(system.field, system.A, matrix(system.field, system.n, system.m, rows), system.C, system.G)


def _unrelated(rng: Random, system: System) -> System:
    return _entrywise(rng, system.field, rng.randint(0, 2), system.p, rng.randint(0, 2))


def _empty(field: Field) -> System:
    nothing = zeros(field, 0, 0)
    return System(field, nothing, nothing, nothing, nothing)


def _chain(field: Field, length: int, *, driven: bool, read: bool) -> System:
    """The chain has `length` states in a row, x_i(k+1) = x_(i+1)(k)."""
    a = [[field.integer(int(j == i + 1)) for j in range(length)] for i in range(length)]
    m, p = int(driven), int(read)
    last = [[field.integer(int(i == length - 1))] * m for i in range(length)]
    first = [[field.integer(int(j == 0)) for j in range(length)]] * p
    through = [[field.integer(int(length == 0))] * m] * p
    return System(
        field,
        matrix(field, length, length, a),
        matrix(field, length, m, last),
        matrix(field, p, length, first),
        matrix(field, p, m, through),
    )


def _free_states(rng: Random, field: Field, roots: tuple[int, ...]) -> System:
    size = len(roots)
    a = [[field.integer(root if i == j else rng.randint(-1, 1) if j > i else 0) for j in range(size)] for i, root in enumerate(roots)]
    return System(field, matrix(field, size, size, a), zeros(field, size, 0), zeros(field, 0, size), zeros(field, 0, 0))


def _sum(first: System, second: System) -> System:
    """The result has both systems side by side, with the faults and the outputs of both."""

    def diagonal(a: Matrix, b: Matrix) -> Matrix:
        return above(beside(a, zeros(a.field, a.height, b.width)), beside(zeros(a.field, b.height, a.width), b))

    return System(
        first.field,
        diagonal(first.A, second.A),
        diagonal(first.F, second.F),
        diagonal(first.C, second.C),
        diagonal(first.G, second.G),
    )


def _scrambled(rng: Random, system: System) -> System:
    fed = fed_back(rng, system)
    injection = _random_matrix(rng, system.field, system.n, system.p, 0.4)
    injected = System(system.field, fed.A + injection @ fed.C, fed.F + injection @ fed.G, fed.C, fed.G)
    outputs, _ = _invertible(rng, system.field, system.p)
    moved = similar(rng, injected)
    return System(system.field, moved.A, moved.F, outputs @ moved.C, outputs @ moved.G)
