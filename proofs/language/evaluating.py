"""The value of an expression on one system, by whatever knows the system's quantities.

    Knows           answers for a quantity, a windowed one, a function of a matrix
    Exactly         asks the exact functions about one system (`Subject`), and remembers what it was asked
    evaluate        the value of a Node: an int or inf, a tuple of ints, a bool
    exactly         Exactly about a system, a pair
    exact_matrix    the Matrix that a node is
    Asked           what a predicate of Python is given

An expression has no value where a list is too short, a divisor is zero, infinities cancel or shapes do not agree: `Undefined` says so, and
what guards against it. `and`, `or`, `implies` look at their second part only where the first leaves the answer open, so that they guard.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping, Sequence
from difflib import get_close_matches
from math import inf, isinf, isnan
from typing import Any, Protocol

from ...base.errors import shorten
from ...exact.algebra.embeddings import one_modulus, stable_there
from ...exact.algebra.fields import Field, PrimeField
from ...exact.algebra.matrices import Matrix, beside, rank, stacked
from ..quantities.cases import Case, Choice, ChoiceSubject, Known, Pair, PairSubject, Record, RecordSubject
from ..quantities.choices import OF_A_CHOICE
from ..quantities.pairs import OF_A_PAIR, OF_ONE_A_AND_C
from ..quantities.ranks import Wanted
from ..quantities.records import OF_A_RECORD
from ..quantities.registry import Quantity, Subject, quantities
from .affine import decisive
from .grammar import MATRICES, OF_A_MATRIX
from .nodes import LARGEST_POWER, LARGEST_SIDE, MOST_WINDOWS, Node, Undefined, variables

Bound = Mapping[str, int]
FARTHEST = 2**62  # beyond it an integer is refused
COMPARED = {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge, "==": operator.eq, "!=": operator.ne}
COMBINED: dict[str, Callable[[Matrix, Matrix], Matrix]] = {"matrix +": operator.add, "matrix -": operator.sub, "matrix @": operator.matmul}
COMPUTED: dict[str, Callable[..., float]] = {
    "negative": operator.neg, "abs": abs, "+": operator.add, "-": operator.sub, "*": operator.mul,
    "//": operator.floordiv, "%": operator.mod,
}  # fmt: skip


class Knows(Protocol):
    """Something that knows the quantities of a system, or of several."""

    @property
    def horizon(self) -> int:
        """The largest number of states, or of samples of a record: one sample later all that has a window is linear in it."""

    @property
    def own(self) -> Mapping[str, Quantity]:
        """The quantities of the whole that the claim is about, where that is not a system."""

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the systems."""

    def quantity(self, subject: str, name: str) -> Any:
        """Return the value of a quantity."""

    def windowed(self, subject: str, name: str, s: int) -> Any:
        """Return the value of a quantity at s samples."""

    def of_matrix(self, node: Node, bound: Bound) -> Any:
        """Return the value of a function of a matrix."""


class Exactly:
    """The exact functions, asked about one system, or about several by their names; `own` are quantities of the whole.

    `asked` keeps what was asked and answered, in order: (subject, name, samples) -> value; `matrices` what was asked of matrices: the
    text -> the function, the matrix, the value.
    """

    def __init__(self, subjects: Mapping[str, Subject], own: Mapping[str, Quantity] | None = None, whole: Any = None) -> None:
        self.subjects = subjects
        self.own = own or {}
        self.whole = whole
        self.asked: dict[tuple[str, str, int | None], Any] = {}
        self.matrices: dict[str, tuple[str, Matrix, Any]] = {}

    @property
    def horizon(self) -> int:
        samples = self.whole.u.nrows if isinstance(self.whole, RecordSubject) else 0
        return max(samples, *(one.system.n for one in self.subjects.values()))

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(self.subjects)

    def quantity(self, subject: str, name: str) -> Any:
        return self._ask(subject, name, None)

    def windowed(self, subject: str, name: str, s: int) -> Any:
        return self._ask(subject, name, s)

    def _ask(self, subject: str, name: str, s: int | None) -> Any:
        key = subject, name, s
        if key not in self.asked:
            given, found = self.found(subject, name)
            if found.circle:
                check_circle(name, given.system.field)
            self.asked[key] = found.exact(given) if s is None else found.exact(given, s)
        return self.asked[key]

    def found(self, subject: str, name: str) -> tuple[Any, Quantity]:
        """Return what a quantity is one of, and the quantity."""
        if not subject and name in self.own:
            return self.whole, self.own[name]
        return self.subjects[subject], quantities()[name]

    def matrix(self, subject: str, name: str) -> Matrix:
        """Return A, F, C or G of a system, or a matrix of the whole."""
        whole = {} if subject or self.whole is None else self.whole.matrices
        found: Matrix = whole[name] if name in whole else getattr(self.subjects[subject].system, name)
        return found

    def of_matrix(self, node: Node, bound: Bound) -> Any:
        built = exact_matrix(node.args[0], self, bound)
        if node.op in ("nilpotent", "schur_stable") and built.nrows != built.ncols:
            raise Undefined(f"got {node.text} of a matrix {built.nrows} x {built.ncols}, expected a square one")
        match node.op:
            case "rank":
                found: Any = rank(built)
            case "nullity":
                found = built.ncols - rank(built)
            case "rows":
                found = built.nrows
            case "columns":
                found = built.ncols
            case "is_zero":
                found = built.is_zero()
            case "nilpotent":
                found = _power(built, built.nrows).is_zero()
            case _:
                check_circle(node.text, built.field)
                found = stable_there(built)
        at = ", ".join(f"{name} = {bound[name]}" for name in sorted(variables(node)))
        self.matrices[node.text + (f" at {at}" if at else "")] = (node.op, built, found)
        return found


def check_circle(text: str, field: Field) -> None:
    """Raise Undefined where what lies inside the unit circle has no one answer."""
    if not one_modulus(field):
        root = "" if isinstance(field, PrimeField) else ", or this field with one of its real roots"
        raise Undefined(f"got {text} over {field}, expected a system over Q{root}: it asks what lies inside the unit circle")


def exactly(case: Case, known: Known | None = None) -> Exactly:
    """Return what knows a case; `known` is what is known of it already."""
    if isinstance(case, Pair):
        pair = known if isinstance(known, PairSubject) else PairSubject(Subject(case.first), Subject(case.second))
        return Exactly(pair.subjects, OF_ONE_A_AND_C if case.one_A_and_C else OF_A_PAIR, pair)
    if isinstance(case, Choice):
        choice = known if isinstance(known, ChoiceSubject) else ChoiceSubject(Subject(case.system), case.P)
        return Exactly(choice.subjects, OF_A_CHOICE, choice)
    if isinstance(case, Record):
        record = known if isinstance(known, RecordSubject) else RecordSubject(Subject(case.system.residual), case)
        return Exactly(record.subjects, OF_A_RECORD, record)
    return Exactly({"": known if isinstance(known, Subject) else Subject(case)})


def evaluate(node: Node, knows: Knows, bound: Bound | None = None) -> Any:
    """Return the value; `bound` has the windows that quantifiers above have bound. Raises Undefined where there is none."""
    bound = bound or {}

    def of(part: Node) -> Any:
        return evaluate(part, knows, bound)

    match node.op:
        case "constant":
            return node.value
        case "python":
            return predicate_holds(node, knows)
        case "variable":
            return bound[node.value]
        case "quantity":
            subject, name = node.value
            return knows.quantity(subject, name)
        case "windowed":
            subject, name = node.value
            return knows.windowed(subject, name, _samples(of(node.args[0]), node))
        case "item":
            return _item(of(node.args[0]), of(node.args[1]), node)
        case "compare":
            return _compare(node, of)
        case "not":
            return not of(node.args[0])
        case "and":
            return all(of(part) for part in node.args)
        case "or":
            return any(of(part) for part in node.args)
        case "implies":
            return not of(node.args[0]) or of(node.args[1])
        case "iff":
            return of(node.args[0]) == of(node.args[1])
        case "all" | "any" | "least":
            return _quantified(node, knows, bound)
        case op if op in OF_A_MATRIX:
            return knows.of_matrix(node, bound)
        case "min" | "max" | "sum" | "len":
            return _gathered(node, of)
    return _number(node, [of(part) for part in node.args])


def predicate_holds(node: Node, knows: Knows) -> bool:
    """Return what a Python predicate says of a system. Raises Undefined where it raises, and where it returns no bool."""
    try:
        found = node.value(Asked(knows))
    except (Wanted, Undefined):
        raise
    except Exception as error:
        raise Undefined(f"{node.text} raised {type(error).__name__}: {error}") from None
    if not isinstance(found, bool):
        raise Undefined(f"{node.text} returned {shorten(found)}, expected True or False")
    return found


class Asked:
    """What a Python predicate is given: the quantities by their names, `s.lag`, `s.rank_OT(3)`, `s.first.lag`. It has no matrices."""

    def __init__(self, knows: Knows, subject: str = "") -> None:
        self._knows = knows
        self._subject = subject

    def __getattr__(self, name: str) -> Any:
        knows, subject = self._knows, self._subject
        if not subject and name and name in knows.names:
            return Asked(knows, name)
        known = {**(quantities() if subject in knows.names else {}), **({} if subject else knows.own)}
        if name not in known:
            hint = "; matrices stand in text alone" if name in MATRICES else ""
            near = get_close_matches(name, [*known, *(() if subject else filter(None, knows.names))], 1, 0.5)
            raise AttributeError(f"got {name}, which is no quantity" + (f"; the nearest is {near[0]}" if near and not hint else hint))
        if known[name].windowed:
            return lambda s: knows.windowed(subject, name, s)
        return knows.quantity(subject, name)


def exact_matrix(node: Node, knows: Exactly, bound: Bound) -> Matrix:
    """Return the matrix that an expression is. Raises Undefined where shapes do not agree, or are too large."""

    def of(part: Node) -> Matrix:
        return exact_matrix(part, knows, bound)

    field = next(iter(knows.subjects.values())).system.field
    match node.op:
        case "matrix":
            return knows.matrix(*node.value)
        case "I":
            return Matrix.identity(field, side(evaluate(node.args[0], knows, bound), node))
        case "zeros":
            return Matrix.zero(field, *(side(evaluate(part, knows, bound), node) for part in node.args))
        case "transpose":
            return of(node.args[0]).transposed()
        case "negative":
            return -of(node.args[0])
        case "power":
            base = of(node.args[0])
            if base.nrows != base.ncols:
                raise Undefined(f"got {node.text} of a matrix {base.nrows} x {base.ncols}, expected a square one")
            return _power(base, exponent(evaluate(node.args[1], knows, bound), node))
    parts = [of(part) for part in node.args]
    check_shapes(node, [part.shape for part in parts])
    match node.op:
        case "hstack":
            return beside(*parts)
        case "vstack":
            return stacked(*parts)
    return COMBINED[node.op](*parts)


def check_shapes(node: Node, shapes: list[tuple[int, int]]) -> None:
    """Raise Undefined unless matrices of these shapes can be combined as the node does."""
    rows, columns = {shape[0] for shape in shapes}, {shape[1] for shape in shapes}
    match node.op:
        case "matrix @":
            good = shapes[0][1] == shapes[1][0]
        case "hstack":
            good = len(rows) == 1
        case "vstack":
            good = len(columns) == 1
        case _:
            good = len(rows) == len(columns) == 1
    if not good:
        told = " and ".join(f"{a} x {b}" for a, b in shapes)
        raise Undefined(f"got {node.text} of matrices {told}, expected shapes that agree")


def side(found: float, node: Node) -> int:
    """Return the number as a side of a matrix."""
    if not 0 <= found <= LARGEST_SIDE:
        raise Undefined(f"got {found} as a size in {node.text}, expected 0 to {LARGEST_SIDE}")
    return int(found)


def exponent(found: float, node: Node) -> int:
    """Return the number as the exponent of a power."""
    if not 0 <= found <= LARGEST_POWER:
        raise Undefined(f"got {found} as the exponent in {node.text}, expected 0 to {LARGEST_POWER}")
    return int(found)


def _power(base: Matrix, k: int) -> Matrix:
    found = Matrix.identity(base.field, base.nrows)
    for _ in range(k):
        found = found @ base
    return found


def _samples(found: float, node: Node) -> int:
    if not 0 <= found <= FARTHEST:
        hint = "; guard it with implies(CONDITION, ...), or begin its windows at max(..., 0)" if found < 0 else ""
        raise Undefined(f"got {found} as the number of samples in {node.text}, expected an integer >= 0{hint}")
    return int(found)


def _item(values: tuple[int, ...], index: float, node: Node) -> int:
    if isinf(index):
        raise Undefined(f"got the index {index} in {node.text}, expected a finite one; guard it with implies(CONDITION, ...)")
    if not -len(values) <= index < len(values):
        least = index if index >= 0 else -index - 1
        length = f"len({node.args[0].text})"
        raise Undefined(f"got {node.text} of a list of {len(values)}; guard it with {length}, as in implies({length} > {least:g}, ...)")
    return values[int(index)]


def _compare(node: Node, of: Callable[[Node], Any]) -> bool:
    left = of(node.args[0])
    for op, part in zip(node.value, node.args[1:], strict=True):
        right = of(part)
        if not COMPARED[op](left, right):
            return False
        left = right
    return True


def _gathered(node: Node, of: Callable[[Node], Any]) -> Any:
    values = [of(part) for part in node.args]
    if isinstance(values[0], tuple):
        values = list(values[0])
    match node.op:
        case "len":
            return len(values)
        case "sum":
            return sum(values)
    if not values:
        length = f"len({node.args[0].text})"
        raise Undefined(f"got {node.text} of an empty list; guard it with {length}, as in implies({length} > 0, ...)")
    return min(values) if node.op == "min" else max(values)


def _number(node: Node, values: list[Any]) -> float:
    if node.op in ("//", "%") and (values[1] == 0 or isinf(values[0]) or isinf(values[1])):
        text = f"{node.text} = {values[0]} {node.op} {values[1]}"
        raise Undefined(f"got {text}; guard it against a divisor 0 and inf, with implies(CONDITION, ...)")
    found = COMPUTED[node.op](*values)
    if isnan(found) or (not isinf(found) and abs(found) > FARTHEST):
        raise Undefined(
            f"got {node.text} of {' and '.join(map(str, values))}, expected an integer below 2^62 or "
            "inf; guard it with implies(CONDITION, ...)"
        )
    return found if isinf(found) else int(found)


def least_deciding(node: Node, knows: Knows, bound: Bound) -> int | None:
    """Return the least window at which the body of an `all` fails, or that of an `any` or a `least` holds; None where there is none."""
    windows, at = _windows(node, knows, bound)
    return next((s for s in windows if at(s) == (node.op != "all")), None)


def _quantified(node: Node, knows: Knows, bound: Bound) -> Any:
    windows, at = _windows(node, knows, bound)
    if node.op == "least":
        return next((s for s in windows if at(s)), inf)
    return all(map(at, windows)) if node.op == "all" else any(map(at, windows))


def _windows(node: Node, knows: Knows, bound: Bound) -> tuple[Sequence[int], Callable[[int], bool]]:
    """Return the windows that decide a quantifier, ascending, and what its body is at each."""
    start, body = _end(evaluate(node.args[0], knows, bound), node), node.args[-1]

    def at(s: int) -> bool:
        return bool(evaluate(body, knows, {**bound, node.value: s}))

    if len(node.args) == 3:
        stop = _end(evaluate(node.args[1], knows, bound), node)
        if stop - start > MOST_WINDOWS:
            raise Undefined(f"got windows from {start} to {stop}, expected at most {MOST_WINDOWS}")
        return range(start, stop + 1), at

    def value(part: Node, s: int | None) -> float:
        found: float = evaluate(part, knows, bound if s is None else {**bound, node.value: s})
        return found

    return decisive(body, node.value, start, knows.horizon, value), at


def _end(found: float, node: Node) -> int:
    if isinf(found):
        raise Undefined(
            f"got windows that begin or end at {found} in {shorten(node.text)}; guard it with implies(CONDITION, ...), or leave the end out"
        )
    return int(found)
