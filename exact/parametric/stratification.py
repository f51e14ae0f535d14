"""This is the rank profile of [O_s T_s] for every value of the entries of A, C, F, G, at small dimensions.

The residual system is x+ = A x + F v, r = C x + G v with n states, m faults, p outputs. Its rows (k, i), output i at time
k, are taken in the order of time, so one elimination gives the ranks of all windows at once: a row that depends on earlier
ones counts in no window. It is Silverman's structure algorithm [Si69] run on indeterminates: the latest faults are
eliminated first, so that what has been done for row (k, i) holds, one sample later, for row (k + 1, i) too, and only what
it left in v(0) and x(0) is new. An output row therefore ends in one of three ways:

    fault      a pivot in v(0): from this time on every later row of this output is independent as well
    state      a pivot in x(0): the output goes on, one sample later; at most n times, as x(0) has n entries
    relation   nothing is left: this row and every later row of this output depends on earlier rows

and no output is undecided after row n. The degrees of the relations are the left minimal indices [F75], the outputs with a
fault pivot count the normal rank.

    stratify            the case tree: a Stratification
    Indeterminates      the ring of the entries and the matrices A, C, F, G over it
    ReducedRow          a combination of output rows and what it is equal to modulo the equations of its stratum
    Stratum             a set of parameter values with one rank profile, and the rows that prove it
    Stratification      all strata
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

from ...base.errors import InvalidInput
from ...base.sheets import Shown
from ..algebra.validation import natural
from .case_tree import Branch, Cases, Congruence, Polynomial, Ring, UnitProduct, explore

LARGEST_DIMENSION = 9

Row = tuple[int, int]


@dataclass(frozen=True)
class Indeterminates:
    """ZZ[entries of A, C, F, G][q, ...] and the matrices, as tuples of rows; entry (i, j) of A is named a<i><j>, from 1."""

    n: int
    p: int
    m: int
    ring: Ring
    A: tuple[tuple[Polynomial, ...], ...]
    C: tuple[tuple[Polynomial, ...], ...]
    F: tuple[tuple[Polynomial, ...], ...]
    G: tuple[tuple[Polynomial, ...], ...]

    @property
    def parameters(self) -> int:
        """Number of entries; they are the leading generators of the ring, q is the next."""
        return (self.n + self.p) * (self.n + self.m)

    @property
    def q(self) -> Polynomial:
        """The indeterminate of the pencil [[q I - A, -F], [C, G]]."""
        return self.ring.gens[self.parameters]

    def window_row(self, row: Row, samples: int) -> list[Polynomial]:
        """Row (k, i) of [O_s T_s], s = samples, has n entries for x(0), then m for each of v(0), ..., v(s - 1)."""
        k, i = row
        zero = [self.ring.zero] * self.m
        state = list(self.C[i])
        faults = [list(self.G[i])]
        for _ in range(k):
            faults.insert(0, times(state, self.F, self.m, self.ring))
            state = times(state, self.A, self.n, self.ring)
        faults.extend(zero for _ in range(samples - k - 1))
        return state + [entry for block in faults for entry in block]


def indeterminates(n: int, p: int, m: int, more: Sequence[str] = ()) -> Indeterminates:
    """`more` names further generators, after q. Raises InvalidInput for dimensions that are no integers from 0 to 9."""
    for name, value in (("n", n), ("p", p), ("m", m)):
        natural(value, name, most=LARGEST_DIMENSION)
    shapes = {"a": (n, n), "c": (p, n), "f": (n, m), "g": (p, m)}
    names = [f"{letter}{i + 1}{j + 1}" for letter, (h, w) in shapes.items() for i in range(h) for j in range(w)]
    from sympy import ZZ  # here, where it is needed: it takes longer to load than most answers
    from sympy.polys.rings import ring as polynomial_ring

    ring, *generators = polynomial_ring([*names, "q", *more], ZZ)
    entries = iter(generators)
    a, c, f, g = (tuple(tuple(next(entries) for _ in range(w)) for _ in range(h)) for h, w in shapes.values())
    return Indeterminates(n, p, m, ring, a, c, f, g)


@dataclass(frozen=True)
class ReducedRow:
    """It states what a sum of coefficients[k, i] * row (k, i) of the window is modulo the equations of the stratum: (state | fault, 0, ...,
    0).

    The last of the rows combined is row (degree, output); its coefficient `leading` is a product of units. A fault row has a unit at
    fault[pivot] and zeros at the pivots of the fault rows before it, a state row has no fault part, a unit at state[pivot] and zeros at the
    pivots of the state rows before it; a relation is zero. `congruences` prove the equality, one a column of the window of degree + 1
    samples, all with one multiplier.
    """

    output: int
    degree: int
    kind: Literal["fault", "state", "relation"]
    coefficients: tuple[tuple[Row, Polynomial], ...]
    state: tuple[Polynomial, ...]
    fault: tuple[Polynomial, ...]
    pivot: int | None
    leading: UnitProduct
    pivot_value: UnitProduct | None
    congruences: tuple[Congruence, ...]

    @property
    def relation(self) -> tuple[Any, dict[Row, Any]]:
        """(pivot, coefficients) as sympy expressions: pivot * row (degree, output) = sum of coefficients * earlier rows.

        Raises ValueError for a row that is independent of the earlier ones.
        """
        if self.kind != "relation":
            raise ValueError(f"row ({self.degree}, {self.output}) is independent of the earlier rows")
        terms = dict(self.coefficients)
        pivot = terms.pop((self.degree, self.output))
        return pivot.as_expr(), {row: -coefficient.as_expr() for row, coefficient in terms.items()}


@dataclass(frozen=True)
class Stratum:
    """Its parameter values have one rank profile: all of `equations` vanish there and none of `inequations` does."""

    branch: Branch
    rows: tuple[ReducedRow, ...]

    @property
    def equations(self) -> tuple[Any, ...]:
        """These vanish on the stratum; they are sympy expressions."""
        return self.branch.vanishing

    @property
    def inequations(self) -> tuple[Any, ...]:
        """None of these vanishes on the stratum; they are sympy expressions."""
        return self.branch.nonvanishing

    @cached_property
    def ends(self) -> dict[int, ReducedRow]:
        """For each output this has the fault row or the relation with which its elimination ended."""
        return {row.output: row for row in self.rows if row.kind != "state"}

    @property
    def left_minimal_indices(self) -> tuple[int, ...]:
        """The degrees of the relations, ascending."""
        return tuple(sorted(row.degree for row in self.ends.values() if row.kind == "relation"))

    @property
    def normal_rank(self) -> int:
        """The number of outputs whose rows are independent for ever."""
        return sum(row.kind == "fault" for row in self.ends.values())

    def is_independent(self, row: Row) -> bool:
        """This tells whether row (k, i) is independent of the earlier rows."""
        end = self.ends[row[1]]
        return end.kind == "fault" or row[0] < end.degree

    def independent_rows(self, s: int) -> tuple[Row, ...]:
        """Return the rows (k, i) of [O_s T_s] that are independent of earlier ones, in the order of time."""
        return tuple((k, i) for k in range(s) for i in sorted(self.ends) if self.is_independent((k, i)))

    def window_rank(self, s: int) -> int:
        """Return rank [O_s T_s]."""
        return len(self.independent_rows(s))

    def gap(self, s: int) -> int:
        """Return rank [O_(s+1) T_(s+1)] - rank [O_s T_s]."""
        return self.window_rank(s + 1) - self.window_rank(s)

    def contains(self, values: Sequence[Any]) -> bool:
        """This tells whether exact parameter values, in the order of `Stratification.parameters`, lie here."""
        return self.branch.contains(values)


@dataclass(frozen=True, repr=False)
class Stratification(Shown):
    """Its strata do not overlap and cover all parameter values over every field of characteristic 0.

    `windows` is the number of samples up to which `verify_identities` expands every row; the strata do not depend on it.
    """

    entries: Indeterminates
    windows: int
    strata: tuple[Stratum, ...]

    @property
    def dimensions(self) -> tuple[int, int, int]:
        """The dimensions are (n, p, m)."""
        return self.entries.n, self.entries.p, self.entries.m

    @property
    def parameters(self) -> tuple[Any, ...]:
        """The entries of A, C, F, G, row by row, as sympy symbols."""
        return tuple(self.entries.ring.symbols[: self.entries.parameters])

    def locate(self, values: Sequence[Any]) -> Stratum:
        """The one stratum of exact parameter values; raises InvalidInput when their number is wrong."""
        if len(values) != self.entries.parameters:
            raise InvalidInput(f"values: got {len(values)}, expected {self.entries.parameters}, one a parameter")
        found = [stratum for stratum in self.strata if stratum.contains(values)]
        if len(found) != 1:
            raise ArithmeticError(f"{len(found)} strata contain {tuple(values)}; there must be one")
        return found[0]

    def cases(self) -> Cases[Stratum]:
        """The result has the strata as cases, for `faultspace.exact.parametric.case_tree.refine`."""
        return tuple((stratum.branch, stratum) for stratum in self.strata)

    @property
    def title(self) -> str:
        """This says of which dimensions the systems are, and how many strata they have."""
        return "n = {}, p = {}, m = {}: {} strata".format(*self.dimensions, len(self.strata))

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The pairs are the strata, each by its conditions, with its left minimal indices and normal rank."""
        for stratum in self.strata:
            conditions = [f"{f} = 0" for f in stratum.equations] + [f"{f} != 0" for f in stratum.inequations]
            yield ", ".join(conditions) or "everywhere", ""
            yield "left minimal indices", " ".join(map(str, stratum.left_minimal_indices)) or "none"
            yield "normal rank r", str(stratum.normal_rank)

    def to_json(self) -> dict[str, Any]:
        """The polynomials are texts."""
        return {
            "dimensions": dict(zip("npm", self.dimensions, strict=True)),
            "strata": [
                {
                    "equations": [str(f) for f in stratum.equations],
                    "inequations": [str(f) for f in stratum.inequations],
                    "left_minimal_indices": list(stratum.left_minimal_indices),
                    "normal_rank": stratum.normal_rank,
                }
                for stratum in self.strata
            ],
        }


def stratify(n: int, p: int, m: int, windows: int | None = None) -> Stratification:
    """Divide all A (n x n), C (p x n), F (n x m), G (p x m) into strata on which the ranks of all windows are constant.

    The strata do not overlap and cover all values over every field of characteristic 0. Source: [Si69], whose algorithm is run on
    indeterminates; [F75] for the indices.

    Parameters
    ----------
    n, p, m : int
        Numbers of states, outputs and faults.
    windows : int, optional
        The number of samples up to which identities are expanded later; n + 3 by default.

    Returns
    -------
    Stratification
        Each stratum is given by equations and inequations in the entries and comes with the rows that prove its ranks.

    Raises
    ------
    InvalidInput
        For a dimension outside 0..9 and windows below 1.
    NonlinearCondition
        Where a condition is linear in no entry, which was not seen up to n = 2.

    Examples
    --------
    >>> from faultspace.exact import stratify
    >>> found = stratify(1, 1, 0)
    >>> [(stratum.equations, stratum.inequations, stratum.left_minimal_indices) for stratum in found.strata]
    [((), (c11,), (1,)), ((c11,), (), (0,))]
    """
    entries = indeterminates(n, p, m)
    windows = n + 3 if windows is None else natural(windows, "windows", least=1)
    root = Branch(entries.ring, entries.parameters)
    cases = explore(root, lambda branch: eliminate(entries, branch))
    strata = tuple(Stratum(branch, tuple(certified(entries, branch, work) for work in rows)) for branch, rows in cases)
    return Stratification(entries, windows, strata)


@dataclass(frozen=True)
class _Working:
    """A row during the elimination: `parts` are its state part, its fault part and its coefficients."""

    row: Row
    state: list[Polynomial]
    fault: list[Polynomial]
    coefficients: dict[Row, Polynomial]
    kind: Literal["fault", "state", "relation"] = "relation"
    pivot: int | None = None


def eliminate(entries: Indeterminates, branch: Branch) -> list[_Working]:
    """The reduced rows on the branch, in the order of time; raises Undecided when the branch must be split."""
    done: list[_Working] = []
    going: dict[int, _Working] = {}
    one = entries.ring.one
    for k in range(entries.n + 1):
        for i in range(entries.p):
            if k == 0:
                work = _Working((0, i), list(entries.C[i]), list(entries.G[i]), {(0, i): one})
            elif i in going:
                work = _one_sample_later(entries, going.pop(i))
            else:
                continue
            work = _tidy(branch, work)
            for kind in ("fault", "state"):
                for earlier in done:
                    if earlier.kind == kind:
                        work = _tidy(branch, _cleared(work, earlier))
                pivot = next((c for c, f in enumerate(_part(work, kind)) if not branch.is_zero(f)), None)
                if pivot is not None:
                    work = _Working(work.row, work.state, work.fault, work.coefficients, kind, pivot)
                    break
            done.append(work)
            if work.kind == "state":
                going[i] = work
    if going:
        raise ArithmeticError(f"outputs {sorted(going)} have more state pivots than there are states")
    return done


def _part(work: _Working, kind: str) -> list[Polynomial]:
    return work.fault if kind == "fault" else work.state


def _one_sample_later(entries: Indeterminates, work: _Working) -> _Working:
    """c x(1) is c A x(0) + c F v(0); the row had nothing in its faults."""
    state = times(work.state, entries.A, entries.n, entries.ring)
    fault = times(work.state, entries.F, entries.m, entries.ring)
    coefficients = {(k + 1, i): f for (k, i), f in work.coefficients.items()}
    return _Working((work.row[0] + 1, work.row[1]), state, fault, coefficients)


def _cleared(work: _Working, earlier: _Working) -> _Working:
    """Return a combination of the row and an earlier one that has nothing at the pivot of the latter."""
    assert earlier.pivot is not None
    entry = _part(work, earlier.kind)[earlier.pivot]
    if not entry:
        return work
    scale = _part(earlier, earlier.kind)[earlier.pivot]
    rows = sorted(work.coefficients.keys() | earlier.coefficients.keys())
    return _Working(
        work.row,
        [scale * x - entry * y for x, y in zip(work.state, earlier.state, strict=True)],
        [scale * x - entry * y for x, y in zip(work.fault, earlier.fault, strict=True)],
        {row: scale * work.coefficients.get(row, 0) - entry * earlier.coefficients.get(row, 0) for row in rows},
    )


def _tidy(branch: Branch, work: _Working) -> _Working:
    """Return the row modulo the equations, divided by what units divide all of it."""
    rows = sorted(work.coefficients)
    vector = [*work.state, *work.fault, *(work.coefficients[row] for row in rows)]
    vector = branch.without_units(branch.joint_reduce(vector))
    n, width = len(work.state), len(work.state) + len(work.fault)
    coefficients = {row: f for row, f in zip(rows, vector[width:], strict=True) if f}
    return _Working(work.row, vector[:n], vector[n:width], coefficients, work.kind, work.pivot)


def certified(entries: Indeterminates, branch: Branch, work: _Working) -> ReducedRow:
    """Return the row with the congruences that prove it, found by dividing the whole combination by the equations."""
    degree, output = work.row
    difference = combined(entries, work.coefficients.items(), degree + 1)
    for column, f in enumerate([*work.state, *work.fault]):
        difference[column] -= f
    _, congruences = branch.joint_congruence(difference)
    if any(congruence.remainder for congruence in congruences):
        raise ArithmeticError(f"the combination of rows for {work.row} is not what the elimination made of it")
    pivot_value = None if work.pivot is None else branch.unit_product(_part(work, work.kind)[work.pivot])
    return ReducedRow(
        output=output,
        degree=degree,
        kind=work.kind,
        coefficients=tuple(sorted(work.coefficients.items(), key=lambda pair: pair[0])),
        state=tuple(work.state),
        fault=tuple(work.fault),
        pivot=work.pivot,
        leading=branch.unit_product(work.coefficients[work.row]),
        pivot_value=pivot_value,
        congruences=tuple(congruences),
    )


def combined(entries: Indeterminates, coefficients: Iterable[tuple[Row, Polynomial]], samples: int) -> list[Polynomial]:
    """Return sum of coefficients * rows of the window of so many samples."""
    total = [entries.ring.zero] * (entries.n + samples * entries.m)
    for row, coefficient in coefficients:
        total = [x + coefficient * y for x, y in zip(total, entries.window_row(row, samples), strict=True)]
    return total


def times(row: Sequence[Polynomial], matrix: Sequence[Sequence[Polynomial]], width: int, ring: Ring) -> list[Polynomial]:
    """Return the row vector times the matrix."""
    return [sum((x * line[j] for x, line in zip(row, matrix, strict=True)), ring.zero) for j in range(width)]
