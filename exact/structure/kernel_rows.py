"""This is the kernel representation N(q) r = 0 of the output behaviour: one object that settles every window.

    KernelRow              one row N(q) = sum c_k q^k of degree mu, with its pivot output
    KernelRepresentation   the rows, ascending by degree; the image (prime, root) that proves them complete
    left minimal indices   the degrees mu of the rows; lag = the largest; normal rank r = p - number of rows
    horner_states          X_k = N_k C + X_(k+1) A, the one recursion behind the next two
    horner                 X_0 and N_k G + X_(k+1) F: all zero iff the row annihilates a system
    kernel_of              the representation of whatever is given: a system, or one of these
    column_conditions      the rows [X_(k+1), N_k]: what the row asks of a fault column [f; g]

Rows whose leading coefficients are triangular by their pivots, and which annihilate the system, bound every gap from above: gap(k) <= p
- #{mu <= k}. Ranks modulo a prime bound every window from below. Where the two meet, rank [O_s T_s] = s r + sum min(s, mu) for every s.

Over Q and Q(a): the shape of the rows comes from one elimination modulo a prime (`modular_rows`), their coefficients from one exact solve
(`relations`), and the exact Horner check has the last word. Over GF(p) the shape comes from the output-nulling recursion. Source: [F75],
[W91], [SB21].
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import lcm
from typing import Any

from flint import fmpz, fmpz_mat

from ...base.sheets import Shown, told
from ..algebra.fields import PrimeField
from ..algebra.matrices import Matrix, beside, stacked
from ..algebra.notation import polynomial, several
from ..algebra.validation import natural
from ..system.modular import Image, image
from ..system.systems import ResidualSystem, System, residual_of
from .modular_rows import rows_modulo
from .relations import coefficients_of, integer_relations, relations_over_prime_field
from .zero_output import ZeroOutputChain, zero_output_chain


@dataclass(frozen=True)
class KernelRow:
    """N(q) = c_0 + c_1 q + ... + c_mu q^mu: `coefficients` is (mu + 1) x p, row k holding c_k, coprime integers over Q."""

    pivot: int
    coefficients: Matrix

    @property
    def degree(self) -> int:
        """The degree is mu."""
        return self.coefficients.nrows - 1


@dataclass(frozen=True, repr=False)
class KernelRepresentation(Shown):
    """A minimal kernel representation N(q) r = 0 of the output behaviour of a system: all that its windows can tell.

    The system has p outputs. `rows` ascend by degree; each has `coefficients` of shape (mu + 1) x p and the output of its `pivot`. Their
    degrees are the left minimal indices, the largest is the `lag`, a number of samples, and p less their number is the normal rank;
    `rank(s)` is rank [O_s T_s] for every s. `image` is the system modulo a prime, with which the rows were shown to be all.
    `kernel_representation` makes it. Source: [F75], [W91]; [G25] Theorem 2 after [SB21] for the ranks. Raises nothing by itself.

    >>> from faultspace.exact import ResidualSystem, kernel_representation
    >>> kernel = kernel_representation(ResidualSystem.of([[0, 1], [0, 0]], [[0], [1]], [[1, 0], [0, 0]], [[0], [1]]))
    >>> kernel.left_minimal_indices, kernel.lag, kernel.normal_rank, [kernel.rank(s) for s in (1, 2, 3)]
    ((2,), 2, 1, [2, 4, 5])
    >>> kernel.rows[0].coefficients  # r_1(k+2) = r_2(k)
    [[0, -1], [0, 0], [1, 0]]
    """

    system: ResidualSystem
    rows: tuple[KernelRow, ...]
    image: Image

    @cached_property
    def left_minimal_indices(self) -> tuple[int, ...]:
        """The degrees of the rows, ascending."""
        return tuple(row.degree for row in self.rows)

    @property
    def normal_rank(self) -> int:
        """r, the normal rank of C (qI - A)^-1 F + G."""
        return self.system.p - len(self.rows)

    @property
    def lag(self) -> int:
        """The lag is the largest left minimal index, and 0 where there is none."""
        return max(self.left_minimal_indices, default=0)

    def gap(self, k: int) -> int:
        """Return rank [O_(k+1) T_(k+1)] - rank [O_k T_k] = p - #{mu <= k}. Raises InvalidInput unless k is an integer >= 0."""
        natural(k, "k")
        return self.system.p - sum(1 for mu in self.left_minimal_indices if mu <= k)

    def rank(self, s: int) -> int:
        """Return rank [O_s T_s] = s r + sum min(s, mu). Raises InvalidInput unless s is an integer >= 0."""
        natural(s, "s")
        return s * self.normal_rank + sum(min(s, mu) for mu in self.left_minimal_indices)

    def rows_within(self, window: int | None) -> tuple[KernelRow, ...]:
        """The rows of degree below `window` and their shifts span the left null space of [O_s T_s]; for None these are all rows.

        Raises InvalidInput for a window that is no integer >= 0.
        """
        if window is not None:
            natural(window, "window")
        return tuple(row for row in self.rows if window is None or row.degree < window)

    @property
    def title(self) -> str:
        """This says of which sizes the system is, and how large its lag is."""
        return f"{self.system.sizes}; lag {self.lag}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pairs are the integers that the rows give, and the rows."""
        yield "normal rank r", str(self.normal_rank)
        yield "left minimal indices", several(self.left_minimal_indices)
        yield "lag", str(self.lag)
        for row in self.rows:
            entries = [polynomial(column, self.system.field) for column in zip(*row.coefficients.elements(), strict=True)]
            yield "a row N(q) with N(q) r = 0", f"[ {',  '.join(entries)} ]"

    def to_json(self) -> dict[str, Any]:
        """Each row is the list [c_0, ..., c_mu] of its coefficients."""
        rows = [row.coefficients.to_json() for row in self.rows]
        return told(self, "normal_rank", "lag", "left_minimal_indices") | {"rows": rows}


@dataclass(frozen=True)
class Horner:
    """What is left of a row at a system is `at_state`, 1 x n for x(0), and `at_fault`, (mu + 1) x m, row k for v(k)."""

    at_state: Matrix
    at_fault: Matrix

    def vanishes(self) -> bool:
        """This tells whether the row annihilates the system."""
        return self.at_state.is_zero() and self.at_fault.is_zero()


def horner_states(coefficients: Matrix, A: Matrix, C: Matrix) -> tuple[Matrix, ...]:
    """Return X_0, ..., X_(mu+1), each 1 x n, with X_k = N_k C + X_(k+1) A and X_(mu+1) = 0."""
    states = [Matrix.zero(A.field, 1, A.nrows)]
    for k in reversed(range(coefficients.nrows)):
        states.append(coefficients.rows([k]) @ C + states[-1] @ A)
    return tuple(reversed(states))


def horner(coefficients: Matrix, system: ResidualSystem) -> Horner:
    """Return the row with these (mu + 1) x p coefficients times [O_(mu+1) T_(mu+1)] of a system, which is not built."""
    first, *later = horner_states(coefficients, system.A, system.C)
    return Horner(first, coefficients @ system.G + stacked(*later) @ system.F)


def column_conditions(coefficients: Matrix, A: Matrix, C: Matrix) -> Matrix:
    """Return (mu + 1) x (n + p), row k = [X_(k+1), N_k]: a fault column z = [f; g] is annihilated iff every row kills it."""
    return beside(stacked(*horner_states(coefficients, A, C)[1:]), coefficients)


def annihilates(row: KernelRow, system: ResidualSystem) -> bool:
    """This tells whether every output of the system satisfies N(q) r = 0."""
    return horner(row.coefficients, system).vanishes()


def kernel_representation(system: System) -> KernelRepresentation:
    """Return the minimal kernel representation of the output behaviour of a system, for every system over every field.

    Over Q and Q(a) the shape of the rows comes from a prime, their coefficients from one exact solve by p-adic lifting [D82], and an exact
    check has the last word. Source: [F75], [W91].

    Parameters
    ----------
    system : System
        Of p outputs; B and D play no part.

    Returns
    -------
    KernelRepresentation

    Raises
    ------
    InvalidInput
        For what is no system.
    ArithmeticError
        If no prime fits, which the bound on misleading primes excludes.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, kernel_representation
    >>> kernel_representation(ResidualSystem.of([["1/2"]], [[]], [[1]], [[]], m=0)).rows[0].coefficients  # 2 r(k+1) = r(k)
    [[-1], [2]]
    """
    residual = residual_of(system)
    picture, tried = image(residual), 1
    while (rows := _rows(residual, picture)) is None:  # an unlucky prime, one of finitely many: ask the next
        if tried > _misleading_primes(residual):
            raise ArithmeticError(f"no kernel rows fit at any of {tried} primes")
        picture, tried = image(residual, largest=picture.prime - 1), tried + 1
    return KernelRepresentation(residual, rows, picture)


def kernel_of(given: System | KernelRepresentation, where: str = "system") -> KernelRepresentation:
    """Return the kernel representation that is given, or that of a System. Raises InvalidInput for anything else."""
    return given if isinstance(given, KernelRepresentation) else kernel_representation(residual_of(given, where))


def _misleading_primes(system: ResidualSystem) -> int:
    """This says how many primes of 29 bits or more can mislead: each divides one of n + 1 minors of windows, whose bits are bounded
    generously.
    """
    scalars = [x for name in "AFCG" for x in getattr(system, name).flint.entries()]
    if isinstance(system.field, PrimeField):
        return 0
    entry = sum(int(x.p).bit_length() + int(x.q).bit_length() for x in scalars) + 32
    size = system.field.degree * (system.n + (system.n + 1) * system.m) + 1
    return (system.n + 1) * size * (system.n + 2) * entry // 29


def _rows(system: ResidualSystem, picture: Image) -> tuple[KernelRow, ...] | None:
    """Return the rows whose shape the image shows, or None when the exact check refutes that shape, or shows none."""
    field = system.field
    if isinstance(field, PrimeField):
        leads = _leads(zero_output_chain(system), system.p)
        tables = relations_over_prime_field(system, leads)
        return tuple(KernelRow(pivot, Matrix.of(c, field)) for (_, pivot), c in zip(leads, tables, strict=True))
    shape = rows_modulo(picture.system)
    relations = None if shape is None else integer_relations(system, shape.leads, picture.prime)
    if shape is None or relations is None or not _all_annihilate(relations, system):
        return None
    return tuple(KernelRow(output, coefficients_of(relation, system)) for (_, output), relation in zip(shape.leads, relations, strict=True))


def _all_annihilate(relations: Sequence[list[list[fmpz]]], system: ResidualSystem) -> bool:
    """This tells whether rows of integer coordinates annihilate the system: Horner's recursion, all rows at once, over one denominator."""
    split = [getattr(system, name).flint.numer_denom() for name in "AFCG"]
    common = fmpz(lcm(*(int(bottom) for _, bottom in split)))
    A, F, C, G = (top * (common // bottom) for top, bottom in split)
    width, factor = system.p * system.field.degree, fmpz(1)
    state = fmpz_mat(len(relations), A.nrows())
    for k in reversed(range(max(map(len, relations), default=0))):
        rows = [relation[k] if k < len(relation) else [0] * width for relation in relations]
        coefficient = fmpz_mat(len(relations), width, [x * factor for row in rows for x in row])
        if not (coefficient * G + state * F).is_zero():
            return False
        state, factor = coefficient * C + state * A, factor * common
    return bool(state.is_zero())


def _leads(chain: ZeroOutputChain, p: int) -> list[tuple[int, int]]:
    """Return (mu, output) for every output that depends, from sample mu on, on earlier ones; ascending."""
    leads: list[tuple[int, int]] = []
    seen: set[int] = set()
    for k, profile in enumerate(chain.profiles):
        fresh = sorted(set(range(p)) - set(profile) - seen)
        seen.update(fresh)
        leads.extend((k, output) for output in fresh)
    return leads
