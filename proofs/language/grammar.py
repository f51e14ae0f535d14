"""This reads the text of an expression: Python's grammar, by `ast`, against a closed list. Nothing is evaluated by Python.

    read           the Node of a text of a given kind, for claims with a given vocabulary

Raises InvalidInput with the column, what was got, and the nearest name where there is one. What the functions take is in SIGNATURES.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from difflib import get_close_matches

from ...base.errors import InvalidInput, shorten
from ..quantities.registry import Kind, Quantity, quantities
from .affine import check_unbounded
from .nodes import DEEPEST, LARGEST_INTEGER, LONGEST, MOST_PARTS, Node
from .vocabularies import ABOUT_A_SYSTEM, VOCABULARIES, Vocabulary

INTEGER, LIST, WORD, MATRIX = Kind.INTEGER, Kind.LIST, Kind.WORD, Kind.MATRIX
# what a function takes, and what it gives; `min`, `max`, `sum`, `len`, `hstack` and `vstack` have rules of their own
SIGNATURES: dict[str, tuple[tuple[Kind, ...], Kind]] = {
    "implies": ((WORD, WORD), WORD),
    "iff": ((WORD, WORD), WORD),
    "abs": ((INTEGER,), INTEGER),
    "rank": ((MATRIX,), INTEGER),
    "nullity": ((MATRIX,), INTEGER),
    "rows": ((MATRIX,), INTEGER),
    "columns": ((MATRIX,), INTEGER),
    "is_zero": ((MATRIX,), WORD),
    "nilpotent": ((MATRIX,), WORD),
    "schur_stable": ((MATRIX,), WORD),
    "I": ((INTEGER,), MATRIX),
    "zeros": ((INTEGER, INTEGER), MATRIX),
    "power": ((MATRIX, INTEGER), MATRIX),
}
OF_A_MATRIX = ("rank", "nullity", "rows", "columns", "is_zero", "nilpotent", "schur_stable")
MATRICES = ("A", "F", "C", "G")
OTHERS = ("min", "max", "sum", "len", "hstack", "vstack", "all", "any", "least", "windows", "inf")
ARITHMETIC = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.FloorDiv: "//", ast.Mod: "%", ast.MatMult: "@"}
COMPARISONS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!="}


def read(text: str, kind: Kind = WORD, vocabulary: Vocabulary = ABOUT_A_SYSTEM) -> Node:
    """Return the expression. Raises InvalidInput where the text is too long, is none, uses what is no name, or is of another kind."""
    if len(text) > LONGEST:
        raise InvalidInput(f"got {len(text)} characters, expected at most {LONGEST}")
    text = " ".join(text.split())  # a text of several lines is one expression
    if not text.isascii():  # Python takes other letters that look alike for these
        place = next(i for i, letter in enumerate(text) if not letter.isascii())
        raise InvalidInput(f"column {place + 1}: got {shorten(text[place])}, expected letters, digits and signs of ASCII")
    try:
        tree = ast.parse(text, mode="eval")
    except SyntaxError as error:
        hint = "; == compares" if re.search(r"[^=<>!]=[^=]", text) else ""
        raise InvalidInput(f"column {error.offset or 1}: got {shorten(text)}, expected an expression ({error.msg}){hint}") from None
    except (RecursionError, MemoryError, ValueError):
        raise InvalidInput(f"got {shorten(text)}, expected an expression of at most {DEEPEST} levels") from None
    reader = _Reader(text, vocabulary)
    return reader.expect(reader.node(tree.body, 0), kind, tree.body)


def _about_others(subject: str) -> str:
    """Return what claims are about in which this is the name of a system; "" where there is none."""
    return next((about for about, one in VOCABULARIES.items() if subject in one.subjects), "")


class _Reader:
    """It turns nodes of `ast` into ours, and complains with the place."""

    def __init__(self, text: str, vocabulary: Vocabulary) -> None:
        self.text = text
        self.vocabulary = vocabulary
        self.bound: list[str] = []
        self.parts = 0

    def bad(self, tree: ast.AST, message: str) -> InvalidInput:
        return InvalidInput(f"column {getattr(tree, 'col_offset', 0) + 1}: {message}")

    def words(self, tree: ast.AST) -> str:
        return ast.get_source_segment(self.text, tree) or ast.unparse(tree)

    def unknown(self, tree: ast.AST, name: str, known: list[str]) -> InvalidInput:
        if name in self.vocabulary.names():
            raise self.bad(tree, f"got {shorten(self.words(tree))}, expected {name} alone: it belongs to none of the systems")
        elsewhere = [about for about, one in VOCABULARIES.items() if name in one.names()]
        if elsewhere:
            raise self.bad(
                tree, f"got {name}, a word of claims about a {elsewhere[0]}, expected one of those about a {self.vocabulary.about}"
            )
        near = get_close_matches(name, [*known, *self.bound], 1, 0.5)
        return self.bad(tree, f"got {shorten(name)}, which is no name of the language" + (f"; the nearest is {near[0]}" if near else ""))

    def make(self, tree: ast.AST, op: str, kind: Kind, args: tuple[Node, ...] = (), value: object = None) -> Node:
        return Node(op, kind, args, value, self.words(tree), getattr(tree, "col_offset", 0) + 1)

    def expect(self, node: Node, kind: Kind, tree: ast.AST) -> Node:
        if node.kind != kind:
            raise self.bad(tree, f"got {shorten(node.text)}, which is {node.kind}, expected {kind}")
        return node

    def node(self, tree: ast.AST, depth: int) -> Node:
        self.parts += 1
        if self.parts > MOST_PARTS or depth > DEEPEST:
            raise self.bad(tree, f"got an expression of more than {MOST_PARTS} parts or {DEEPEST} levels, expected a smaller one")
        match tree:
            case ast.Constant(value=bool() as value):
                return self.make(tree, "constant", WORD, value=value)
            case ast.Constant(value=int() as value):
                if value > LARGEST_INTEGER:
                    raise self.bad(tree, f"got {shorten(value)}, expected integers up to {LARGEST_INTEGER}")
                return self.make(tree, "constant", INTEGER, value=value)
            case ast.Name(id=name):
                return self.name(tree, name)
            case ast.Attribute(value=ast.Name(id=subject), attr=name) if subject in self.vocabulary.subjects:
                return self.of_subject(tree, subject, name)
            case ast.Attribute(value=inner, attr="T"):
                return self.make(tree, "transpose", MATRIX, (self.expect(self.node(inner, depth + 1), MATRIX, inner),))
            case ast.Attribute(value=ast.Name(id=subject)) if elsewhere := _about_others(subject):
                of = f"a word of claims about a {elsewhere}"
                raise self.bad(tree, f"got {shorten(self.words(tree))}, {of}, expected one of those about a {self.vocabulary.about}")
            case ast.Attribute():
                raise self.bad(tree, f"got {shorten(self.words(tree))}, expected .T of a matrix{self._subjects(tree)}")
            case ast.UnaryOp(op=ast.Not(), operand=inner):
                return self.make(tree, "not", WORD, (self.expect(self.node(inner, depth + 1), WORD, inner),))
            case ast.UnaryOp(op=ast.USub(), operand=inner):
                part = self.node(inner, depth + 1)
                if part.kind not in (INTEGER, MATRIX):
                    raise self.bad(tree, f"got - before {shorten(part.text)}, which is {part.kind}, expected an integer or a matrix")
                return self.make(tree, "negative", part.kind, (part,))
            case ast.BoolOp(op=op, values=values):
                parts = tuple(self.expect(self.node(one, depth + 1), WORD, one) for one in values)
                return self.make(tree, "and" if isinstance(op, ast.And) else "or", WORD, parts)
            case ast.BinOp(left=left, op=op, right=right) if type(op) in ARITHMETIC:
                return self.arithmetic(tree, ARITHMETIC[type(op)], self.node(left, depth + 1), self.node(right, depth + 1))
            case ast.Compare():
                return self.comparison(tree, depth)
            case ast.Subscript(value=inner, slice=index):
                parts = (
                    self.expect(self.node(inner, depth + 1), LIST, inner),
                    self.expect(self.node(index, depth + 1), INTEGER, index),
                )
                return self.make(tree, "item", INTEGER, parts)
            case ast.Call(keywords=[], func=ast.Name(id=name), args=args):
                return self.call(tree, name, args, depth)
            case ast.Call(keywords=[], func=ast.Attribute(value=ast.Name(id=subject), attr=name), args=args) if (
                subject in self.vocabulary.subjects
            ):
                return self.windowed(tree, subject, name, args, depth, quantities())
            case ast.Call(keywords=[], func=ast.Attribute() as function) if any(self.vocabulary.subjects):
                raise self.bad(tree, f"got {shorten(self.words(tree))}, expected the name of a function{self._subjects(function)}")
            case ast.Constant(value=float()):
                raise self.bad(tree, f"got {shorten(self.words(tree))}, expected an integer; multiply the comparison by the denominators")
            case ast.BinOp(op=ast.Div() | ast.Pow()):
                hint = "; // rounds down" if isinstance(tree.op, ast.Div) else "; power(A, k) is that of a matrix"
                raise self.bad(tree, f"got {shorten(self.words(tree))}, expected one of {' '.join(ARITHMETIC.values())}{hint}")
            case _:
                known = "quantities, integers, comparisons, and, or, not, implies(a, b)"
                raise self.bad(tree, f"got {shorten(self.words(tree))}, which the language has no words for, expected {known}")

    def _subjects(self, tree: ast.Attribute) -> str:
        named = [one for one in self.vocabulary.subjects if one]
        near = get_close_matches(self.words(tree.value), named, 1, 0.5)
        hint = f"; the nearest is {near[0]}.{tree.attr}" if near else ""
        return f", or a name after {' or '.join(f'{one}.' for one in named)}{hint}" if named else ""

    def name(self, tree: ast.AST, name: str) -> Node:
        if name in self.bound:
            return self.make(tree, "variable", INTEGER, value=name)
        if name == "inf":
            return self.make(tree, "constant", INTEGER, value=float("inf"))
        if name in self.vocabulary.own:
            return self.quantity(tree, self.vocabulary.own[name], "")
        if ("", name) in self.vocabulary.sides or ("" in self.vocabulary.subjects and name in quantities()):
            return self.of_subject(tree, "", name)
        behind = [f"{one}.{name}" for one in self.vocabulary.subjects if one and name in self.vocabulary.after(one)]
        if behind:
            raise self.bad(tree, f"got {name} alone, expected {' or '.join(behind)}")
        if name in self.vocabulary.subjects:
            raise self.bad(tree, f"got {name} alone, expected a quantity of it, such as {name}.lag")
        if name in SIGNATURES or name in OTHERS:
            raise self.bad(tree, f"got {name} alone, expected {name}(...)")
        raise self.unknown(tree, name, self.known())

    def known(self) -> list[str]:
        return [*self.vocabulary.names(), *SIGNATURES, *OTHERS]

    def of_subject(self, tree: ast.AST, subject: str, name: str) -> Node:
        if (subject, name) in self.vocabulary.sides:
            return self.make(tree, "matrix", MATRIX, value=(subject, name))
        if name not in quantities():
            raise self.unknown(tree, name, self.vocabulary.after(subject))
        return self.quantity(tree, quantities()[name], subject)

    def quantity(self, tree: ast.AST, found: Quantity, subject: str) -> Node:
        if found.windowed:
            raise self.bad(tree, f"got {found.name} alone, expected {found.name}(s), s a number of samples")
        return self.make(tree, "quantity", found.kind, value=(subject, found.name))

    def arithmetic(self, tree: ast.AST, op: str, left: Node, right: Node) -> Node:
        if op == "@" or (op in "+-" and MATRIX in (left.kind, right.kind)):
            for part in (left, right):
                if part.kind != MATRIX:
                    raise self.bad(tree, f"got {shorten(part.text)} beside {op}, which is {part.kind}, expected a matrix")
            return self.make(tree, f"matrix {op}", MATRIX, (left, right))
        for part in (left, right):
            if part.kind != INTEGER:
                raise self.bad(tree, f"got {shorten(part.text)} beside {op}, which is {part.kind}, expected an integer")
        return self.make(tree, op, INTEGER, (left, right))

    def comparison(self, tree: ast.Compare, depth: int) -> Node:
        parts = tuple(self.node(one, depth + 1) for one in (tree.left, *tree.comparators))
        ops = []
        for op in tree.ops:
            if type(op) not in COMPARISONS:
                raise self.bad(tree, f"got {shorten(self.words(tree))}, expected one of {' '.join(COMPARISONS.values())}")
            ops.append(COMPARISONS[type(op)])
        for left, sign, right in zip(parts, ops, parts[1:], strict=False):
            lists = left.kind == right.kind == LIST and sign in ("==", "!=")
            if not lists and not left.kind == right.kind == INTEGER:
                hint = "; iff(a, b) compares words" if WORD in (left.kind, right.kind) else ""
                hint = "; is_zero(X - Y) compares matrices" if MATRIX in (left.kind, right.kind) else hint
                got = f"{left.kind} {sign} {right.kind}"
                raise self.bad(tree, f"got {shorten(self.words(tree))}, which is {got}, expected two integers, or == of two lists{hint}")
        return self.make(tree, "compare", WORD, parts, tuple(ops))

    def call(self, tree: ast.Call, name: str, args: list[ast.expr], depth: int) -> Node:
        if name in ("all", "any", "least"):
            return self.quantified(tree, name, args, depth)
        windowed = {one: q for one, q in {**quantities(), **self.vocabulary.own}.items() if q.windowed}
        if name in windowed and (name in self.vocabulary.own or "" in self.vocabulary.subjects):
            return self.windowed(tree, "", name, args, depth, windowed)
        if name in ("min", "max", "sum", "len", "hstack", "vstack"):
            return self.gathered(tree, name, tuple(self.node(one, depth + 1) for one in args))
        if name not in SIGNATURES:
            if name in self.vocabulary.names():
                raise self.bad(tree, f"got {shorten(self.words(tree))}, but {name} is no function")
            if name in windowed:
                behind = " or ".join(f"{one}.{name}(s)" for one in self.vocabulary.subjects)
                raise self.bad(tree, f"got {shorten(self.words(tree))}, expected {behind}")
            raise self.unknown(tree, name, [*SIGNATURES, *windowed, *OTHERS])
        kinds, kind = SIGNATURES[name]
        if len(args) != len(kinds):
            raise self.bad(tree, f"got {len(args)} arguments of {name}, expected {len(kinds)}")
        parts = tuple(self.expect(self.node(one, depth + 1), wanted, one) for one, wanted in zip(args, kinds, strict=True))
        return self.make(tree, name, kind, parts)

    def gathered(self, tree: ast.Call, name: str, parts: tuple[Node, ...]) -> Node:
        kinds = {part.kind for part in parts}
        if name in ("hstack", "vstack"):
            if kinds != {MATRIX}:
                raise self.bad(tree, f"got {shorten(self.words(tree))}, expected matrices")
            return self.make(tree, name, MATRIX, parts)
        one_list = len(parts) == 1 and kinds == {LIST}
        if not one_list and (name in ("sum", "len") or kinds != {INTEGER}):
            wanted = "a list" if name in ("sum", "len") else "a list, or integers"
            raise self.bad(tree, f"got {shorten(self.words(tree))}, expected {wanted}")
        return self.make(tree, name, INTEGER, parts)

    def windowed(self, tree: ast.Call, subject: str, name: str, args: list[ast.expr], depth: int, known: Mapping[str, Quantity]) -> Node:
        if name not in known or not known[name].windowed:
            if name in known:
                raise self.bad(tree, f"got {shorten(self.words(tree))}, but {name} is no function")
            raise self.unknown(tree, name, [one for one, q in known.items() if q.windowed])
        if len(args) != 1:
            raise self.bad(tree, f"got {len(args)} arguments of {name}, expected one number of samples")
        part = self.expect(self.node(args[0], depth + 1), INTEGER, args[0])
        return self.make(tree, "windowed", known[name].kind, (part,), (subject, name))

    def quantified(self, tree: ast.Call, name: str, args: list[ast.expr], depth: int) -> Node:
        """Read all(E for s in windows(a, b)), any(...), least(s for s in windows(a, b) if E); a node's last part is E."""
        form = f"{name}(s for s in windows(a, b) if E)" if name == "least" else f"{name}(E for s in windows(a, b))"
        match args:
            case [
                ast.GeneratorExp(
                    elt=body,
                    generators=[
                        ast.comprehension(
                            target=ast.Name(id=variable),
                            iter=ast.Call(func=ast.Name(id="windows"), args=[lower, *rest], keywords=[]),
                            ifs=conditions,
                            is_async=0,
                        )
                    ],
                )
            ] if len(rest) <= 1 and len(conditions) == (name == "least"):
                pass
            case _:
                raise self.bad(tree, f"got {shorten(self.words(tree))}, expected {form}")
        if name == "least":
            if not isinstance(body, ast.Name) or body.id != variable:
                raise self.bad(tree, f"got {shorten(self.words(tree))}, expected {form}")
            body = conditions[0]
        if variable in self.bound or variable in self.known() or variable in quantities() or variable in MATRICES:
            raise self.bad(tree, f"got {variable} as the name of a window, which is taken, expected another one")
        ends = tuple(self.expect(self.node(one, depth + 1), INTEGER, one) for one in (lower, *rest))
        self.bound.append(variable)
        inner = self.expect(self.node(body, depth + 1), WORD, body)
        self.bound.pop()
        if not rest:
            check_unbounded(inner, variable)
        return self.make(tree, name, INTEGER if name == "least" else WORD, (*ends, inner), variable)
