"""Whether a claim follows from theorems, by rules that are few.

    Theorem      a statement of the language that Rocq has proved, with the names of its theorems
    derived      the names of the theorems that a claim follows from, or None

The rules, on the normal forms of `normal_forms.py`, are these:

- what is assumed may be used, and so may what the words mean: counts are 0 or more, a rank is at most the numbers of rows and of columns;
- a theorem may be used, at a window too: what holds for every s >= a holds at a number of samples that is shown to be a or more;
- of some things one of which holds, the one holds of which all others are refuted (so conclusions are drawn from hypotheses);
- all parts of `and`, one part of `or` with the others denied, every window by a new one of which its ends alone are known;
- an inequality follows where a sum of multiples, none negative, of inequalities that are known says so: the multiples are sought by a
  linear program (HiGHS, by scipy) and believed where they are right in exact arithmetic;
- an atom is finite where it is at most a sum of finite ones; what may be infinite is not calculated with before it is known to be finite.

A claim that these do not derive may well be true. What they derive holds wherever the claim has a value. The theorems are Rocq's; that the
claim follows is this file's word, which is attacked by changing claims at random in `tests/proofs/test_derived_claims.py`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np

from ..language.nodes import Node
from ..quantities.registry import Kind, quantities
from .normal_forms import (
    FALSE,
    INFINITY,
    AtMostZero,
    Both,
    Each,
    Either,
    Finite,
    Formula,
    Named,
    Opaque,
    Unknown,
    balance,
    formula,
    is_count,
    matrices,
    negated,
    parts_of_extremes,
    sides,
    total,
)
from .sums import Atom, Product, Sum, number, of_atom

Sources = frozenset[str]
NONE: Sources = frozenset()
DEEPEST, MOST_FACTS, MOST_PROGRAMS, LARGEST_DENOMINATOR = 6, 4000, 4000, 1000  # more than ten times what our examples need
INFEASIBLE, HALF, NEARLY = 2, 0.5, 1e-6  # linprog's word; how a number is told from the next integer; how far a point may miss


@dataclass(frozen=True)
class Theorem:
    """`conclusion` holds where the hypotheses do, for every system over every field; `names` are those of theory/headlines that say so."""

    names: tuple[str, ...]
    hypotheses: tuple[Node, ...]
    conclusion: Node


@dataclass
class _Known:
    """What is known, each with the theorems that it rests on."""

    totals: dict[Sum, Sources] = field(default_factory=dict)  # each is at most 0
    finite: dict[Atom, Sources] = field(default_factory=dict)
    others: dict[Formula, Sources] = field(default_factory=dict)  # Opaque, Named, and atoms that are infinite
    clauses: list[tuple[Either, Sources]] = field(default_factory=list)
    each: list[tuple[Each, Sources]] = field(default_factory=list)
    windows: dict[Sum, None] = field(default_factory=dict)  # numbers of samples at which something stands
    impossible: Sources | None = None  # what is known contradicts itself, by these theorems
    fresh: int = 0
    points: list[_Point] = field(default_factory=list)
    asked: list[int] = field(default_factory=lambda: [0])  # linear programs solved, in all copies together
    usable: tuple[tuple[int, ...], list[tuple[Sum, Sources]]] = ((), [])

    def copy(self) -> _Known:
        return _Known(
            dict(self.totals), dict(self.finite), dict(self.others), list(self.clauses), list(self.each), dict(self.windows),
            self.impossible, self.fresh, [_Point(one.values) for one in self.points],
            asked=self.asked,
        )  # fmt: skip


def derived(hypotheses: Sequence[Node], conclusion: Node, theorems: Sequence[Theorem]) -> tuple[str, ...] | None:
    """Return the names of the theorems by which the conclusion follows from the hypotheses, () where none is needed.

    None is returned where it is not seen to follow, which says nothing: the rules above are few.
    """
    nodes = [*hypotheses, conclusion]
    try:
        assumed, wanted = [formula(one) for one in hypotheses], formula(conclusion)
        known = _Known()
        for one in theorems:
            premises = tuple(formula(each, so=False) for each in one.hypotheses)
            for part in _parts(formula(one.conclusion)):
                _add(known, Either((*premises, part)) if premises else part, frozenset(one.names))
        for fact in _meanings(nodes):
            _add(known, fact, NONE)
        for fact in assumed:
            _add(known, fact, NONE)
        _look_for_windows(known, [*assumed, wanted])
        _saturate(known)
        found = _prove(wanted, known, 0)
    except (Unknown, KeyError, RecursionError, _TooMuch):
        return None
    return None if found is None else tuple(sorted(found))


class _TooMuch(Exception):
    """More facts came together than are worth looking at."""


def _parts(one: Formula) -> Iterator[Formula]:
    if isinstance(one, Both):
        for part in one.parts:
            yield from _parts(part)
    else:
        yield one


def _meanings(nodes: Sequence[Node]) -> Iterator[Formula]:
    """Yield what the words mean that the claim uses, and those that stand in theorems."""
    zero = number(0)
    for known in quantities().values():
        if known.kind == Kind.INTEGER and not (known.windowed or known.parts):
            yield AtMostZero(zero - of_atom(Atom(known.name, finite=not known.infinite)))
        for bound in known.at_most:
            yield AtMostZero(of_atom(Atom(known.name)) - of_atom(Atom(bound)))
        if known.kind == Kind.LIST and known.balance is not None:
            listed = Node("quantity", Kind.LIST, (), ("", known.name), "", 0)
            more, less = balance(known.balance)
            yield AtMostZero(zero - of_atom(Atom(f"sum({known.name})")))
            empty = AtMostZero(total(Node("sum", Kind.INTEGER, (listed,), None, "", 0)))
            yield Either((AtMostZero(number(1) - more + less), empty))
    yield Finite(INFINITY, so=False)
    for one in matrices(nodes):
        try:
            rank = total(Node("rank", one.kind, (one,), None, "", 0))
            both = sides(one, {})
        except (Unknown, KeyError):
            continue
        below = tuple(AtMostZero(number(1) + side) for side in both if not is_count(side))  # a matrix of such a size has no rank
        yield AtMostZero(zero - rank)
        for side in both:
            yield Either((*below, AtMostZero(rank - side))) if below else AtMostZero(rank - side)
    for name, whole, part in parts_of_extremes(nodes, {}):
        smaller, larger = (part, whole) if name == "max" else (whole, part)
        if smaller != larger:
            infinite = [atom for atom in (smaller - larger).atoms if not atom.finite]
            yield AtMostZero(smaller - larger) if len(infinite) < 2 else Opaque(smaller, larger, strict=False)


def _add(known: _Known, one: Formula, why: Sources) -> None:
    """Take note of a formula that is known."""
    match one:
        case Both(parts):
            for part in parts:
                _add(known, part, why)
        case AtMostZero(what):
            if not what.atoms:
                if what.constant > 0:
                    known.impossible = why if known.impossible is None else known.impossible
            else:
                known.totals.setdefault(what, why)
        case Finite(atom, so):
            if so:
                known.finite.setdefault(atom, why)
            else:
                known.others.setdefault(one, why)
        case Opaque() | Named():
            known.others.setdefault(one, why)
        case Either(parts):
            if not parts:
                known.impossible = why if known.impossible is None else known.impossible
            elif len(parts) == 1:
                _add(known, parts[0], why)
            else:
                known.clauses.append((one, why))
        case Each():
            if one.some:  # such a window is given a name
                window = _new_window(known)
                for part in (*one.bounds(window), one.at(window)):
                    _add(known, part, why)
            else:
                known.each.append((one, why))
    if len(known.totals) + len(known.clauses) > MOST_FACTS:
        raise _TooMuch


def _new_window(known: _Known) -> Sum:
    known.fresh += 1
    window = of_atom(Atom(f"some window {known.fresh}"))
    for k in (-1, 0, 1):
        known.windows[window + number(k)] = None
    return window


def _look_for_windows(known: _Known, formulas: Iterable[Formula]) -> None:
    """Note the numbers of samples that stand in formulas: theorems about every window are looked at there, and one sample before."""
    for one in formulas:
        match one:
            case AtMostZero(what):
                sums = [what]
            case Opaque(left, right, _):
                sums = [left, right]
            case Either(parts) | Both(parts):
                _look_for_windows(known, parts)
                continue
            case Each():  # its windows are met when it is used
                continue
            case _:
                continue
        for argument in (atom.argument for what in sums for atom in what.atoms):
            if argument is not None:
                known.windows |= {argument + number(k): None for k in (-1, 0)}


def _saturate(known: _Known) -> None:
    """Draw conclusions until nothing new comes."""
    used: set[tuple[Each, Sum]] = set()
    grown = True
    while grown and known.impossible is None:
        grown = False
        for one, why in list(known.each):
            for window in list(known.windows):
                if (one, window) not in used:
                    used.add((one, window))
                    outside = tuple(negated(bound) for bound in one.bounds(window))
                    said = one.at(window)
                    for part in _parts(said):
                        _add(known, Either((*outside, part)), why)
                    grown = True
        grown |= _find_finite(known)
        left = []
        clauses, known.clauses = known.clauses, []
        for clause, why in clauses:
            state = _look_at(clause, why, known)
            if state is None:
                left.append((clause, why))
            else:
                grown |= bool(state)
        known.clauses += left


def _look_at(clause: Either, why: Sources, known: _Known) -> bool | None:
    """Add the part that is left of a clause where all others are refuted; None where more than one is left, else whether it is new."""
    remaining, sources = [], why
    for part in clause.parts:
        refuted = _refuted(part, known)
        if refuted is None:
            remaining.append(part)
            if len(remaining) > 1:
                return None
        else:
            sources |= refuted
    before = _size(known)
    _add(known, remaining[0] if remaining else FALSE, sources)
    return _size(known) > before or known.impossible is not None


def _size(known: _Known) -> int:
    return len(known.totals) + len(known.finite) + len(known.others) + len(known.clauses) + len(known.each)


def _refuted(one: Formula, known: _Known) -> Sources | None:
    """Return why the negation holds, in one step; None where that is not seen."""
    if isinstance(one, Both):
        return next((found for part in one.parts if (found := _refuted(part, known)) is not None), None)
    return _seen(negated(one), known)


def _seen(one: Formula, known: _Known) -> Sources | None:
    """Return why a formula holds, by what is known and a linear program alone."""
    if known.impossible is not None:
        return known.impossible
    match one:
        case Both(parts):
            each = [_seen(part, known) for part in parts]
            return None if None in each else NONE.union(*(why for why in each if why is not None))
        case Either(parts):
            return next((found for part in parts if (found := _seen(part, known)) is not None), None)
        case AtMostZero(what):
            return _by_sums(what, known)
        case Finite(atom, True):
            return NONE if atom.finite else known.finite.get(atom)
        case Opaque(left, right, strict):
            if one in known.others:
                return known.others[one]
            if not strict and (stronger := known.others.get(Opaque(left, right, strict=True))) is not None:
                return stronger
            return _by_sums(left - right + number(int(strict)), known, (left, right))
    return known.others.get(one)


def _by_sums(what: Sum, known: _Known, both: Sequence[Sum] = ()) -> Sources | None:
    """Return why what <= 0, where every atom in it (and in `both`) is known to be finite, or infinite atoms can only help."""
    why: Sources = NONE
    for atom in what.atoms.union(*(one.atoms for one in both)):
        if atom.finite:
            continue
        if atom not in known.finite:
            return None
        why |= known.finite[atom]
    found = _combined(what, known)
    return None if found is None else why | found


def _find_finite(known: _Known) -> bool:
    """Note the atoms that are at most a sum of finite ones."""
    found = False
    pairs = list(known.totals.items())
    for one, reason in known.others.items():  # inf <= inf + n says nothing of n, so that the larger side must be finite
        if isinstance(one, Opaque) and not any(_open(atom, known) for atom in one.right.atoms):
            pairs.append((one.left - one.right, reason))
    for what, why in pairs:
        infinite = {product: times for product, times in what.terms if any(_open(atom, known) for atom in product)}
        if infinite and all(len(product) == 1 and times > 0 for product, times in infinite.items()):
            here = why.union(*(known.finite[atom] for atom in what.atoms if atom in known.finite))
            for product in infinite:
                if product[0] != INFINITY:
                    known.finite[product[0]] = here
                    found = True
    return found


def _open(atom: Atom, known: _Known) -> bool:
    return not atom.finite and atom not in known.finite


def _combined(what: Sum, known: _Known) -> Sources | None:
    """Return the theorems behind a sum of known inequalities, times numbers >= 0, that says what <= 0; None where none is found.

    `what` is an integer, so that less than 1 is enough. Numbers that meet all that is known, and yet make it 1, are kept: they spare the
    linear program where they make the next question 1, too.
    """
    if not what.atoms:
        return NONE if what.constant <= 0 else None
    rows = _usable(known)
    if any(point.at(what) > HALF and point.meets(rows) for point in known.points):
        return None
    known.asked[0] += 1
    if known.asked[0] > MOST_PROGRAMS:
        raise _TooMuch
    products: dict[Product, int] = {}
    for one in (what, *(one for one, _ in rows)):
        for product, _ in one.terms:
            if product:
                products.setdefault(product, len(products))
    table, constants = np.zeros((len(rows) + 1, len(products))), np.zeros(len(rows) + 1)
    for k, one in enumerate((*(one for one, _ in rows), what)):
        for product, times in one.terms:
            if product:
                table[k, products[product]] = times
            else:
                constants[k] = -times
    constants[-1] += 1
    from scipy.optimize import linprog  # here and below: `verify` decides its claims without, and each of its processes would load it

    found = linprog(-table[-1], A_ub=table, b_ub=constants, bounds=(None, None), method="highs")
    if found.status == INFEASIBLE:
        known.impossible = _contradiction(rows)
        return known.impossible
    if not found.success:
        return None
    if float(table[-1] @ found.x) > constants[-1] - HALF:
        known.points.insert(0, _Point(dict(zip(products, map(float, found.x), strict=True))))
        return None
    multiples = [Fraction(-float(x)).limit_denominator(LARGEST_DENOMINATOR) for x in found.ineqlin.marginals[:-1]]
    left = _less(what, multiples, rows)
    if any(x < 0 for x in multiples) or any(x for product, x in left.items() if product) or left.get((), Fraction(0)) >= 1:
        return None
    return NONE.union(*(why for times, (_, why) in zip(multiples, rows, strict=True) if times))


def _usable(known: _Known) -> list[tuple[Sum, Sources]]:
    """Return the sums that are at most 0 and in which every atom is known to be finite."""
    size = len(known.totals), len(known.finite), len(known.others)
    if known.usable[0] != size:
        rows = []
        for one, why in known.totals.items():
            if not any(_open(atom, known) for atom in one.atoms):
                rows.append((one, why.union(*(known.finite[atom] for atom in one.atoms if not atom.finite))))
        for other, why in known.others.items():
            if isinstance(other, Opaque):
                atoms = other.left.atoms | other.right.atoms
                if not any(_open(atom, known) for atom in atoms):
                    here = why.union(*(known.finite[atom] for atom in atoms if not atom.finite))
                    rows.append((other.left - other.right + number(int(other.strict)), here))
        known.usable = size, rows
    return known.usable[1]


@dataclass
class _Point:
    """Numbers for products of atoms, 0 for the others; `met` is a list of sums that they make at most 0."""

    values: dict[Product, float]
    met: list[tuple[Sum, Sources]] = field(default_factory=list)

    def at(self, what: Sum) -> float:
        return sum(times * (self.values.get(product, 0.0) if product else 1.0) for product, times in what.terms)

    def meets(self, rows: list[tuple[Sum, Sources]]) -> bool:
        if self.met is not rows:
            if any(self.at(one) > NEARLY for one, _ in rows):
                return False
            self.met = rows
        return True


def _less(what: Sum, multiples: Sequence[Fraction], rows: Sequence[tuple[Sum, Sources]]) -> dict[Product, Fraction]:
    """Return `what` less these multiples of the rows."""
    left = {product: Fraction(times) for product, times in what.terms}
    for times, (one, _) in zip(multiples, rows, strict=True):
        if times:
            for product, each in one.terms:
                left[product] = left.get(product, Fraction(0)) - times * each
    return left


def _contradiction(rows: Sequence[tuple[Sum, Sources]]) -> Sources | None:
    """Return the theorems behind multiples of the rows whose sum is a positive number; None where they are not found."""
    products: dict[Product, int] = {(): 0}
    for one, _ in rows:
        for product, _ in one.terms:
            products.setdefault(product, len(products))
    table = np.zeros((len(products), len(rows)))
    for k, (one, _) in enumerate(rows):
        for product, times in one.terms:
            table[products[product], k] = times
    target = np.zeros(len(products))
    target[0] = 1.0
    from scipy.optimize import linprog

    found = linprog(np.ones(len(rows)), A_eq=table, b_eq=target, bounds=(0, None), method="highs")
    if not found.success:
        return None
    multiples = [Fraction(float(x)).limit_denominator(LARGEST_DENOMINATOR) for x in found.x]
    left = _less(number(0), multiples, rows)
    if any(x < 0 for x in multiples) or any(x for product, x in left.items() if product) or left.get((), Fraction(0)) >= 0:
        return None
    return NONE.union(*(why for times, (_, why) in zip(multiples, rows, strict=True) if times))


def _prove(wanted: Formula, known: _Known, depth: int) -> Sources | None:
    """Return the theorems by which a formula follows; None where it is not seen to."""
    if (found := _seen(wanted, known)) is not None:
        return found
    if depth >= DEEPEST:
        return None
    match wanted:
        case Both(parts):
            sources = NONE
            for part in parts:
                here = _prove(part, known, depth + 1)
                if here is None:
                    return None
                sources |= here
            return sources
        case Either(parts):
            for k in reversed(range(len(parts))):  # the conclusion of an implication stands last
                denied = [negated(part) for i, part in enumerate(parts) if i != k]
                if (here := _prove_under(denied, parts[k], known, depth)) is not None:
                    return here
        case AtMostZero(what):
            infinite = [(product, times) for product, times in what.terms if any(_open(atom, known) for atom in product)]
            if len(infinite) == 1 and len(infinite[0][0]) == 1 and infinite[0][1] < 0:  # where the atom is infinite, this holds
                return _prove_under([Finite(infinite[0][0][0])], wanted, known, depth)
        case Each() if not wanted.some:
            inside = known.copy()
            window = _new_window(inside)
            return _prove_under(list(wanted.bounds(window)), wanted.at(window), inside, depth)
        case Each():
            for window in known.windows:
                if (here := _prove(Both((*wanted.bounds(window), wanted.at(window))), known, depth + 1)) is not None:
                    return here
    return None


def _prove_under(assumed: Sequence[Formula], wanted: Formula, known: _Known, depth: int) -> Sources | None:
    here = known.copy()
    for one in assumed:
        _add(here, one, NONE)
    _look_for_windows(here, [*assumed, wanted])
    _saturate(here)
    return _prove(wanted, here, depth + 1)
