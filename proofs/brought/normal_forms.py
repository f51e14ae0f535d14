"""Expressions in a normal form, in which two ways to say the same are the same: what is asked of sums of products.

    AtMostZero     a sum is at most 0
    Finite         an atom is not infinite
    Opaque         a comparison of which nothing is known but its two sides
    Either, Both   one of some formulas, all of them
    Each           a formula for every window, or, where `some`, for one
    formula        what a Node says, or what its negation says, with no negation left in it

Words are replaced by what they mean (the table of `docs/your-claims.md`): left_invertible by normal_rank = m, observable by
unobservable_dimension = 0, zeta by finite_zeros + infinite_zeros, gap(s) by rank_OT(s + 1) - rank_OT(s), nullity(X) by columns less rank,
is_zero(X) by rank(X) = 0. An integer a is less than b where a + 1 <= b. Infinity is no number: a comparison of two atoms that may be
infinite, or with one on both of its sides, stays as it is (inf < inf + 1 is false).
An expression that has no value on a system is given one here; what is derived is therefore true wherever the expression has a value.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from math import isinf

from ..language.grammar import OF_A_MATRIX
from ..language.nodes import Node
from ..quantities.registry import Kind, quantities
from .sums import Atom, Sum, number, of_atom


class Unknown(Exception):
    """The expression holds something of which no normal form is known: a predicate of Python, a quantity of two systems."""


Env = Mapping[str, Sum]


# -- formulas ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class AtMostZero:
    """It says that `total` is at most 0."""

    total: Sum


@dataclass(frozen=True)
class Finite:
    """The atom is not infinite; where not `so`, it is."""

    atom: Atom
    so: bool = True


@dataclass(frozen=True)
class Opaque:
    """left < right where `strict`, else left <= right; both may be infinite."""

    left: Sum
    right: Sum
    strict: bool


@dataclass(frozen=True)
class Named:
    """A word that the normal form does not look into, or, where not `so`, its negation."""

    text: str
    so: bool = True


@dataclass(frozen=True)
class Either:
    """One of these holds; none does where there are none."""

    parts: tuple[Formula, ...]


@dataclass(frozen=True)
class Both:
    """All of these hold."""

    parts: tuple[Formula, ...]


@dataclass(frozen=True)
class Each:
    """`body`, or its negation where not `so`, holds for every window from `lower` to `upper` (None: without end), or for `some` window.

    `env` has what the other windows that stand in it are.
    """

    some: bool
    variable: str
    lower: Sum
    upper: Sum | None
    body: Node
    so: bool
    env: tuple[tuple[str, Sum], ...]

    def at(self, window: Sum) -> Formula:
        """Return what is said of this window."""
        return formula(self.body, self.so, {**dict(self.env), self.variable: window})

    def bounds(self, window: Sum) -> tuple[Formula, ...]:
        """Return that the window lies between the ends."""
        found: tuple[Formula, ...] = (AtMostZero(self.lower - window),)
        return found if self.upper is None else (*found, AtMostZero(window - self.upper))


Formula = AtMostZero | Finite | Opaque | Named | Either | Both | Each
TRUE, FALSE = Both(()), Either(())


def negated(one: Formula) -> Formula:
    """Return the negation."""
    match one:
        case AtMostZero(total):
            return AtMostZero(number(1) - total)
        case Finite(atom, so):
            return Finite(atom, not so)
        case Opaque(left, right, strict):
            return Opaque(right, left, not strict)
        case Named(text, so):
            return Named(text, not so)
        case Either(parts):
            return Both(tuple(map(negated, parts)))
        case Both(parts):
            return Either(tuple(map(negated, parts)))
    return Each(not one.some, one.variable, one.lower, one.upper, one.body, not one.so, one.env)


def formula(node: Node, so: bool = True, env: Env | None = None) -> Formula:
    """Return what the node says, or its negation where not `so`. Raises Unknown."""
    env = env or {}
    match node.op:
        case "constant":
            return TRUE if node.value == so else FALSE
        case "not":
            return formula(node.args[0], not so, env)
        case "and" | "or":
            parts = tuple(formula(part, so, env) for part in node.args)
            return Both(parts) if (node.op == "and") == so else Either(parts)
        case "implies":
            first, second = formula(node.args[0], not so, env), formula(node.args[1], so, env)
            return Either((first, second)) if so else Both((first, second))
        case "iff":
            left, right = node.args
            here, there = (formula(left, True, env), formula(left, False, env)), (formula(right, True, env), formula(right, False, env))
            if so:
                return Both((Either((here[1], there[0])), Either((there[1], here[0]))))
            return Either((Both((here[0], there[1])), Both((there[0], here[1]))))
        case "compare":
            pairs = zip(node.args, node.value, node.args[1:], strict=False)
            parts = tuple(_compared(left, sign, right, so, env) for left, sign, right in pairs)
            return parts[0] if len(parts) == 1 else Both(parts) if so else Either(parts)
        case "all" | "any":
            ends = [total(part, env) for part in node.args[:-1]]
            upper = ends[1] if len(ends) == 2 else None
            return Each((node.op == "any") == so, node.value, ends[0], upper, node.args[-1], so, tuple(sorted(env.items())))
        case "quantity":
            return _word(node.value, so)
        case "is_zero":
            rank = of_atom(Atom(f"rank({matrix(node.args[0], env)})"))
            return AtMostZero(rank) if so else AtMostZero(number(1) - rank)
        case "nilpotent" | "schur_stable":
            return Named(f"{node.op}({matrix(node.args[0], env)})", so)
    raise Unknown(node.text)


def _word(value: tuple[str, str], so: bool) -> Formula:
    subject, name = value
    if subject:
        raise Unknown(f"{subject}.{name}")
    known = quantities().get(name)
    if known is not None and known.parts:
        parts = tuple(_word(("", one), so) for one in known.parts)
        return Both(parts) if so else Either(parts)
    return Named(name, so) if known is None or known.balance is None else _equal(*balance(known.balance), so)


def balance(sides: tuple[str, str]) -> tuple[Sum, Sum]:
    """Return the two sides by which a word or the length of a list is told."""
    left, right = (_quantity(one) if one else number(0) for one in sides)
    return left, right


def _compared(left: Node, sign: str, right: Node, so: bool, env: Env) -> Formula:
    if left.kind == Kind.LIST:
        same = " = ".join(sorted((_list(left), _list(right))))
        return Named(same, so == (sign == "=="))
    first, second = total(left, env), total(right, env)
    if sign in ("==", "!="):
        return _equal(first, second, so == (sign == "=="))
    if not so:
        sign = {"<": ">=", "<=": ">", ">": "<=", ">=": "<"}[sign]
    if sign in (">", ">="):
        first, second = second, first
    return _at_most(first, second, sign in ("<", ">"))


def _equal(left: Sum, right: Sum, so: bool) -> Formula:
    parts = sorted((_at_most(left, right, not so), _at_most(right, left, not so)), key=str)  # a == b is b == a
    return Both(tuple(parts)) if so else Either(tuple(parts))


def _at_most(left: Sum, right: Sum, strict: bool) -> Formula:
    """Return left <= right, or left < right where `strict`."""
    first, second = _infinite(left), _infinite(right)
    if INFINITY in first | second:
        return _against_infinity(left, right, strict)
    if (first and second) or len(first | second) > 1:
        return Opaque(left, right, strict)
    return AtMostZero(left - right + number(int(strict)))


def _against_infinity(left: Sum, right: Sum, strict: bool) -> Formula:
    """Return what is said of the other side where one side is inf, alone."""
    infinity = of_atom(INFINITY)
    if left == infinity and right == infinity:
        return FALSE if strict else TRUE
    if right == infinity:  # x < inf, x <= inf
        found = _infinite(left)
        if not strict or not found:
            return TRUE
        atom = _alone(left, found)
        return Opaque(left, right, strict) if atom is None else Finite(atom)
    if left == infinity:  # inf < x, inf <= x
        found = _infinite(right)
        if strict or not found:
            return FALSE
        atom = _alone(right, found)
        return Opaque(left, right, strict) if atom is None else Finite(atom, so=False)
    return Opaque(left, right, strict)


def _alone(one: Sum, infinite: frozenset[Atom]) -> Atom | None:
    """Return the atom that may be infinite, where it stands alone in a product, once and with a positive multiple."""
    products = [(product, times) for product, times in one.terms if infinite & set(product)]
    if len(products) == 1 and len(products[0][0]) == 1 and products[0][1] > 0:
        return products[0][0][0]
    return None


def _infinite(one: Sum) -> frozenset[Atom]:
    return frozenset(atom for atom in one.atoms if not atom.finite)


# -- integers ----------------------------------------------------------------------------------------------------------

INFINITY = Atom("inf", finite=False)
SIZES = ("n", "m", "p")
SIDES = {"A": ("n", "n"), "F": ("n", "m"), "C": ("p", "n"), "G": ("p", "m")}


def _quantity(name: str) -> Sum:
    known = quantities().get(name)
    if known is not None and known.parts:
        return sum(map(_quantity, known.parts), number(0))
    return of_atom(Atom(name, known is not None and not known.infinite))


def windowed(name: str, argument: Sum) -> Sum:
    """Return a function with a window at a number of samples."""
    if name == "gap":
        return windowed("rank_OT", argument + number(1)) - windowed("rank_OT", argument)
    if name in ("rank_O", "rank_T", "rank_OT") and not argument.terms:
        return number(0)
    if name == "solutions" and not argument.terms:
        return _quantity("n") + _quantity("p")
    if name == "rank_O" and argument == _quantity("n"):
        return _quantity("n") - _quantity("unobservable_dimension")
    return of_atom(Atom(f"{name}({argument})", name in quantities(), argument))


def total(node: Node, env: Env | None = None) -> Sum:
    """Return an integer as a sum. Raises Unknown."""
    env = env or {}
    match node.op:
        case "constant":
            return of_atom(INFINITY) if isinf(node.value) else number(int(node.value))
        case "variable":
            return env[node.value]
        case "negative":
            return total(node.args[0], env).times(-1)
        case "+" | "-" | "*":
            left, right = (total(part, env) for part in node.args)
            return left + right if node.op == "+" else left - right if node.op == "-" else left * right
        case "//" | "%":
            return of_atom(Atom(f"({total(node.args[0], env)}) {node.op} ({total(node.args[1], env)})"))
        case "abs":
            inside = total(node.args[0], env)
            return of_atom(Atom(f"abs({inside})", finite=not _infinite(inside)))
        case "quantity" if not node.value[0]:
            return _quantity(node.value[1])
        case "windowed" if not node.value[0]:
            return windowed(node.value[1], total(node.args[0], env))
        case "item":
            return _item(node, env)
        case "min" | "max" | "sum" | "len":
            return _gathered(node, env)
        case "rank":
            return of_atom(Atom(f"rank({matrix(node.args[0], env)})"))
        case "nullity":
            return sides(node.args[0], env)[1] - of_atom(Atom(f"rank({matrix(node.args[0], env)})"))
        case "rows" | "columns":
            return sides(node.args[0], env)[node.op == "columns"]
        case "least":
            ends = ", ".join(str(total(part, env)) for part in node.args[:-1])
            body = formula(node.args[-1], True, {**env, node.value: of_atom(Atom(f"window {len(env)}"))})
            return of_atom(Atom(f"least({ends}; {body})", finite=False))
    raise Unknown(node.text)


def _list(node: Node) -> str:
    if node.op != "quantity" or node.value[0]:
        raise Unknown(node.text)
    return str(node.value[1])


def _item(node: Node, env: Env) -> Sum:
    name, index = _list(node.args[0]), total(node.args[1], env)
    if name == "left_minimal_indices" and index == number(-1):
        return _quantity("lag")
    return of_atom(Atom(f"{name}[{index}]", name in quantities()))


def _gathered(node: Node, env: Env) -> Sum:
    if node.args[0].kind != Kind.LIST:
        parts = sorted({total(part, env) for part in node.args}, key=str)
        if len(parts) == 1:
            return parts[0]
        if any(map(_may_fall, parts)):
            raise Unknown(node.text)
        finite = [not _infinite(part) for part in parts]
        return of_atom(Atom(f"{node.op}({', '.join(map(str, parts))})", finite=all(finite) if node.op == "max" else any(finite)))
    name = _list(node.args[0])
    match node.op:
        case "len" if (known := quantities().get(name)) is not None and known.balance is not None:
            more, less = balance(known.balance)
            return more - less
        case "sum" if name == "infinite_zero_orders":
            return _quantity("infinite_zeros")
        case "max" if name == "left_minimal_indices":
            return _quantity("lag")
    return of_atom(Atom(f"{node.op}({name})", name in quantities()))


def _may_fall(one: Sum) -> bool:
    """Return whether the sum may be -inf. The only infinity that an atom stands for is the one above all numbers."""
    return any(len(product) > 1 or times < 0 for product, times in one.terms if not all(atom.finite for atom in product))


def parts_of_extremes(nodes: Iterable[Node], env: Env) -> Iterator[tuple[str, Sum, Sum]]:
    """Yield ("max" or "min", it, one of its parts) for each that stands in the nodes where the windows of `env` are known."""
    for node in nodes:
        for part in node.args:
            yield from parts_of_extremes([part], env)
        if node.op in ("min", "max") and node.args[0].kind != Kind.LIST:
            try:
                whole = total(node, env)
                for part in node.args:
                    yield node.op, whole, total(part, env)
            except (Unknown, KeyError):
                continue


# -- matrices ----------------------------------------------------------------------------------------------------------


def matrix(node: Node, env: Env) -> str:
    """Return one name for a matrix and its transposed, which have the same rank."""
    return min(_matrix(node, env, False), _matrix(node, env, True))


def _matrix(node: Node, env: Env, turned: bool) -> str:
    match node.op:
        case "matrix" if not node.value[0]:
            return str(node.value[1]) + ("'" if turned else "")
        case "transpose":
            return _matrix(node.args[0], env, not turned)
        case "negative":
            return f"-({_matrix(node.args[0], env, turned)})"
        case "matrix +":
            return f"({' + '.join(sorted(_matrix(part, env, turned) for part in node.args))})"
        case "matrix -":
            first, second = (_matrix(part, env, turned) for part in node.args)
            return f"({first} - {second})"
        case "matrix @":
            factors = [_matrix(part, env, turned) for part in node.args]
            return " @ ".join(reversed(factors) if turned else factors)
        case "I":
            return f"I({total(node.args[0], env)})"
        case "zeros":
            sizes = [str(total(part, env)) for part in node.args]
            return f"zeros({', '.join(reversed(sizes) if turned else sizes)})"
        case "power":
            return f"power({_matrix(node.args[0], env, turned)}, {total(node.args[1], env)})"
        case "hstack" | "vstack":
            flat = (node.op == "hstack") != turned
            return f"{'hstack' if flat else 'vstack'}({', '.join(_matrix(part, env, turned) for part in node.args)})"
    raise Unknown(node.text)


def sides(node: Node, env: Env) -> tuple[Sum, Sum]:
    """Return the numbers of rows and columns of a matrix."""
    match node.op:
        case "matrix" if not node.value[0]:
            rows, columns = SIDES[node.value[1]]
            return _quantity(rows), _quantity(columns)
        case "I":
            side = total(node.args[0], env)
            return side, side
        case "zeros":
            return total(node.args[0], env), total(node.args[1], env)
    parts = [sides(part, env) for part in node.args if part.kind == Kind.MATRIX]
    match node.op:
        case "transpose":
            return parts[0][1], parts[0][0]
        case "matrix @":
            return parts[0][0], parts[1][1]
        case "hstack":
            return parts[0][0], _added(part[1] for part in parts)
        case "vstack":
            return _added(part[0] for part in parts), parts[0][1]
    return parts[0]


def is_count(side: Sum) -> bool:
    """Return whether a number of rows or columns is seen to be none below 0: that of I(lag - n) is not, and may have no value."""
    return all(times > 0 and all(atom.text in SIZES for atom in product) for product, times in side.terms)


def _added(sums: Iterable[Sum]) -> Sum:
    found = number(0)
    for one in sums:
        found = found + one
    return found


def matrices(nodes: Iterable[Node]) -> Iterator[Node]:
    """Yield the matrices of which a rank is asked, without those whose size depends on a window."""
    for node in nodes:
        yield from matrices(node.args)
        if node.op in OF_A_MATRIX:
            yield node.args[0]
