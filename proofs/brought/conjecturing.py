"""Bounds that nobody has claimed yet, and sharper ones than those that somebody has.

conjecture        bounds on a quantity by others: what `fs.conjecture` is
sharpen           bounds in the place of a claim's, over each of its fields
default_columns   what bounds are sought by where nothing is named: of systems all integer quantities and the ranks of A, F, C, G;
                  of other kinds those of USUAL

The values that quantities of two systems take together are many more than those of one: with all quantities of both, a box of pairs has
more sets of values than a machine holds. What two systems share, since they have the same A and C or as many outputs, is named once. Ranks
of data are taken at 1 sample and at n + 1, from which on those of systems are settled.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import isinf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...base.errors import InvalidInput, shorten
from ...base.progress import Progress, silent
from ...base.threads import one_thread
from ..boxes.box import Box
from ..language.evaluating import Asked
from ..language.grammar import OF_A_MATRIX
from ..language.linear import linear, words
from ..language.nodes import Node
from ..language.vocabularies import CHOICE, ONE_A_AND_C, PAIR, RECORD, SYSTEM, VOCABULARIES
from ..quantities.cases import Case
from ..quantities.elimination import Integers
from ..quantities.registry import Kind, quantities
from .bounds import ABOVE, BELOW, Fit, Fitted, Form, Grammar, fit
from .claims import Claim, about_what, expression, make_claim
from .conjectures import Bound, Conjectures, Evidence, Sharpened, Sharper
from .deciding import certified
from .known_bounds import known_as
from .sparse_systems import Found, withstand
from .tables import Row, Table, tabulate
from .theorems import proof_of

MOST = 10**9
MOST_COLUMNS, MOST_TERMS, LARGEST_COEFFICIENT, LARGEST_CONSTANT, MOST_EQUAL = 40, 3, 3, 9, 5
SIGNS = {ABOVE: "<=", BELOW: ">="}
SIZES = ("n", "m", "p")
RANKS = ("rank(A)", "rank(F)", "rank(C)", "rank(G)")
USUAL = {
    PAIR: ("p", "first_difference", *(f"{one}.{name}" for one in ("first", "second") for name in ("n", "m", "lag", "normal_rank", "n_z"))),
    ONE_A_AND_C: (
        *("n", "p", "first_difference", "first.observability_index"),
        *(f"{one}.{name}" for one in ("first", "second") for name in ("m", "lag", "normal_rank", "n_z")),
    ),
    CHOICE: (
        *("n", "m", "p", "k", "first_difference", "rank(P)", "observability_index"),
        *(before + name for before in ("", "chosen.") for name in ("lag", "normal_rank", "n_z")),
    ),
    RECORD: (
        *("n", "p", "nu", "N", "rank(B)", "rank(D)"),
        *(f"inputs.{name}" for name in ("lag", "normal_rank", "observability_index", "uncontrollable_dimension")),
        *(f"{name}({s})" for name in ("u_rank", "x_rank", "w_rank", "y_rank") for s in ("1", "n + 1")),
    ),
}


@dataclass(frozen=True)
class _Columns:
    """The columns of a table that are finite on all its rows: `values` (rows, columns), by name; `left_out` are the others."""

    names: tuple[str, ...]
    values: Integers
    left_out: Mapping[str, Case]


@one_thread()
def conjecture(
    target: str,
    *,
    hypotheses: Sequence[str | Callable[[Asked], bool]] = (),
    by: Sequence[str] | None = None,
    field: str = "Q",
    box: Mapping[str, Any] | None = None,
    about: str = SYSTEM,
    terms: int | None = None,
    largest: int = Grammar.largest,
    constant: int = Grammar.constant,
    most: int = MOST,
    jobs: int = 1,
    on_progress: Progress | None = None,
) -> Conjectures:
    """Seek the sharpest bounds on a quantity of systems x(k+1) = A x + F v, r = C x + G v by other quantities, under hypotheses.

    What is answered is refuted by no system of the box, no known one, no direct sum of two that stand for others, none of those that are
    drawn, and none of 90000 sparse ones (fewer where drawing takes 30 s), and attained by a system of the box; none is implied by the
    others, and wherever a bound of this form is attained in the box, one that is answered is, forms that equal the target everywhere, which
    are told apart, left aside. The next sharper ones come with the smallest system that refutes them, and its certificates. A bound that
    follows from theorems of Rocq names them; else none of this is a proof. Source: [F75], [VD79] for the ranks that the quantities are
    found by.

    Parameters
    ----------
    target : str
        An expression of the language of `docs/your-claims.md`.
    hypotheses : list of str or callable
    by : list of str, optional
        What the bounds are made of; all integer quantities and the ranks of A (n x n), F (n x m), C (p x n), G (p x m) where it is not
        given.
    terms, largest, constant : int
        A bound is a sum of at most `terms` of them with coefficients from -`largest` to `largest`, one of which may be the larger (below:
        the smaller) of two, and a constant from -`constant` to `constant`; `terms` is 3 by default, and 2 where the bounds are about more
        than one system.
    field, box, about, most, jobs, on_progress
        As for `claim`, with one field.

    Returns
    -------
    Conjectures

    Raises
    ------
    InvalidInput
        For what is no expression, for an empty box, where the target is infinite or an expression has no value on a system, or a case of
        another kind, which is named, and for numbers out of range.

    Examples
    --------
    >>> import faultspace as fs
    >>> found = fs.conjecture("delay_known", hypotheses=["left_invertible"], by=["n", "rank(G)"], box={"total": 4})
    >>> [one.text for one in found.above], found.above[0].sharper[0].text
    (['delay_known <= n'], 'delay_known <= n - 1')
    """
    started = time.perf_counter()
    about = about_what(about)
    node = _integer(target, "target", about)
    names = default_columns(node, about) if by is None else _listed(by)
    grammar = Grammar(
        _number(_terms(about) if terms is None else terms, "terms", 1, MOST_TERMS),
        _number(largest, "largest", 1, LARGEST_COEFFICIENT),
        _number(constant, "constant", 0, LARGEST_CONSTANT),
    )
    given: dict[str, Any] = {"about": about, "conclusion": f"({node.text}) == 0", "hypotheses": list(hypotheses), "fields": [field]}
    claim = make_claim("conjecture", given | ({} if box is None else {"box": box}))
    columns = list({one.text: one for one in (_integer(text, f"by[{k}]", about) for k, text in enumerate(names))}.values())
    progress = on_progress or silent
    table = _table(claim, field, [node, *columns], most, jobs, progress)

    def seek() -> tuple[tuple[_Columns, dict[str, Fit]], list[Node]]:
        _must_be_finite(table, node, "target")
        finite = _columns(table, [_named(one) for one in columns], 1)
        fits = {side: _fit(table, finite, grammar, side) for side in (ABOVE, BELOW)}
        texts = [_told(node, finite, one, side) for side, found in fits.items() for one in found.kept]
        return (finite, fits), [_word(text, claim) for text in [*texts, *_equal(node, finite, fits.values())]]

    finite, fits = _withstood(claim, table, [node, *columns], seek, progress)
    bounds = {side: tuple(_bounds(claim, table, node, finite, found.kept, side)) for side, found in fits.items()}
    return Conjectures(
        target=node.text,
        about=about,
        field=field,
        hypotheses=tuple(one.words for one in claim.hypotheses),
        by=finite.names,
        left_out=finite.left_out,
        above=bounds[ABOVE],
        below=bounds[BELOW],
        equal=tuple(_equal(node, finite, fits.values()))[:MOST_EQUAL],
        grammar={side: grammar.words(side) for side in (ABOVE, BELOW)},
        tried=_evidence(table),
        seconds=time.perf_counter() - started,
    )


def sharpen(claim: Claim, *, most: int = MOST, jobs: int = 1, progress: Progress = silent) -> list[Sharpened]:
    """Return the bounds in the place of the claim's over each of its fields. Raises InvalidInput where it is no bound on an integer."""
    return [_sharpened(claim, field, most, jobs, progress) for field in claim.boxes]


def _sharpened(claim: Claim, field: str, most: int, jobs: int, progress: Progress) -> Sharpened:
    started = time.perf_counter()
    target, side, other, strict = _bound_of(claim)
    own = [name for name in linear(other).multiples if name != target.text]
    names = list(dict.fromkeys([*own, *default_columns(target, claim.about)]))
    columns = [_integer(one, f"claim.{claim.id}.conclusion", claim.about) for one in names]
    table, grammar = _table(claim, field, [target, other, *columns], most, jobs, progress), Grammar(_terms(claim.about))

    def seek() -> tuple[tuple[_Columns, _Columns, Fit, Fit, Bound | None, Case | None], list[Node]]:
        _must_be_finite(table, target, f"claim.{claim.id}.conclusion")
        finite = _columns(table, [_named(one) for one in columns], 2)
        bound, refuting = _own(claim, table, target, other, side, strict) if table.rows else (None, None)
        kept = [k for k, name in enumerate(finite.names) if name in {_named(one) for one in columns[: len(own)]}]
        narrow = _Columns(tuple(finite.names[k] for k in kept), finite.values[:, kept], {})
        ours, others = _fit(table, narrow, grammar, side), _fit(table, finite, grammar, side)
        texts = [_told(target, where, one, side) for where, fitted in ((narrow, ours), (finite, others)) for one in fitted.kept]
        texts += [bound.text] if bound else []
        return (finite, narrow, ours, others, bound, refuting), [_word(text, claim) for text in texts]

    finite, narrow, ours, others, bound, refuting = _withstood(claim, table, [target, other, *columns], seek, progress)
    in_words = tuple(_bounds(claim, table, target, narrow, ours.kept, side))
    told = {one.text for one in in_words}
    return Sharpened(
        id=claim.id,
        about=claim.about,
        field=field,
        conclusion=claim.conclusion.text,
        hypotheses=tuple(one.words for one in claim.hypotheses),
        counterexample=refuting,
        own=bound,
        words=in_words,
        others=tuple(one for one in _bounds(claim, table, target, finite, others.kept, side) if one.text not in told),
        left_out=finite.left_out,
        grammar=grammar.words(side),
        tried=_evidence(table),
        seconds=time.perf_counter() - started,
    )


def _bound_of(claim: Claim) -> tuple[Node, str, Node, int]:
    """Return target (the single quantity, if there is one), side and bound of a conclusion that is a bound, and 1 where it is strict."""
    node = claim.conclusion
    if node.op != "compare" or len(node.args) != 2 or node.value[0] not in ("<=", "<", ">=", ">") or node.args[0].kind != Kind.INTEGER:
        expected = "a bound to sharpen, two integers with <=, <, >= or > between"
        expected += "; what is before the bound in implies(...) can stand among the hypotheses" if node.op == "implies" else ""
        raise InvalidInput(f"claim.{claim.id}.conclusion: got {shorten(node.text)}, expected {expected}")
    left, right = node.args
    above, strict = node.value[0] in ("<=", "<"), len(node.value[0]) == 1
    if left.op not in ("quantity", "windowed") and right.op in ("quantity", "windowed"):
        left, right, above = right, left, not above
    return left, ABOVE if above else BELOW, right, int(strict)


def _own(claim: Claim, table: Table, target: Node, other: Node, side: str, strict: int) -> tuple[Bound | None, Case | None]:
    """Return the claim's bound with the least constant, if some constant will do, and the first system that refutes the claim."""
    sign = 1 if side == ABOVE else -1
    gaps = [sign * (row.values[0] - row.values[1]) for row in table.rows]
    refuting = next((row.case for row, gap in zip(table.rows, gaps, strict=True) if gap > -strict), None)
    largest = max(gaps)
    if isinf(largest):
        return None, refuting
    attained: NDArray[np.bool_] = np.array([gap == largest for gap in gaps], dtype=bool)
    whole = linear(other)
    constant = whole.constant + sign * int(largest)
    before = f"{target.text} {SIGNS[side]} "
    told = before + words(whole.multiples.items(), constant)
    sharper = _refuted(claim, before + words(whole.multiples.items(), constant - sign), table.rows, attained)
    first = next(row for row, here in zip(table.rows, attained, strict=True) if here)
    systems = _systems(table, attained)
    return Bound(told, first.case, systems, (sharper,), _known(claim, told), _nouns(table), _proved(claim, told)), refuting


def _bounds(claim: Claim, table: Table, target: Node, columns: _Columns, kept: Sequence[Fitted], side: str) -> Iterator[Bound]:
    sign = 1 if side == ABOVE else -1
    targets = _targets(table)
    natural: NDArray[np.bool_] = np.all(columns.values >= 0, axis=0)
    for one in kept:
        sharper = [(Form(one.form.terms), one.constant - sign)]
        for k, term in enumerate(one.form.terms):
            if natural[list(term.columns)].all():
                smaller = replace(term, coefficient=term.coefficient - sign)
                terms = tuple(smaller if place == k else other for place, other in enumerate(one.form.terms))
                sharper.append((Form(tuple(other for other in terms if other.coefficient)), one.constant))
        told = _told(target, columns, one, side)
        listed = []
        for form, constant in sharper:
            gaps: Integers = sign * (targets - form.on(columns.values) - constant)
            text = f"{target.text} {SIGNS[side]} {form.words(columns.names, constant)}"
            listed.append(_refuted(claim, text, table.rows, gaps > 0))
        first = next(row for row, here in zip(table.rows, one.attained, strict=True) if here)
        systems = _systems(table, one.attained)
        yield Bound(told, first.case, systems, tuple(listed), _known(claim, told), _nouns(table), _proved(claim, told))


def _told(target: Node, columns: _Columns, one: Fitted, side: str) -> str:
    return f"{target.text} {SIGNS[side]} {one.form.words(columns.names, one.constant)}"


def _equal(target: Node, columns: _Columns, fits: Iterable[Fit]) -> list[str]:
    """Return the simplest of the sums that the target equals, above and below."""
    texts = []
    for found in fits:
        least = min((one.cost for one in found.equal), default=0)
        texts += [f"{target.text} == {one.form.words(columns.names, one.constant)}" for one in found.equal if one.cost == least]
    return list(dict.fromkeys(texts))


def _withstood(
    claim: Claim, table: Table, nodes: Sequence[Node], seek: Callable[[], tuple[Found, list[Node]]], progress: Progress
) -> Found:
    """Return what is found once sparse systems have attacked it, where the claim is about systems."""
    if claim.about != SYSTEM or not table.rows:
        return seek()[0]
    return withstand(table, [one.that for one in claim.hypotheses], nodes, seek, progress)


def _proved(claim: Claim, text: str) -> tuple[str, ...]:
    """Return the theorems that a bound on systems follows from."""
    if claim.about != SYSTEM:
        return ()
    proof = proof_of([one.that for one in claim.hypotheses], _word(text, claim))
    return () if proof is None else tuple(proof.theorems)


def _refuted(claim: Claim, text: str, rows: Sequence[Row], failing: NDArray[np.bool_]) -> Sharper:
    """Return the text of a bound and what refutes it, decided anew by exact functions, or None."""
    first = next((row for row, here in zip(rows, failing, strict=True) if here), None)
    if first is None:
        return Sharper(text, None)
    asked = replace(claim, conclusion=_word(text, claim))
    return Sharper(text, certified(asked, first.case, smallest=first.in_box))


def _known(claim: Claim, text: str) -> tuple[str, ...]:
    return known_as(_word(text, claim), [one.that.text for one in claim.hypotheses], claim.about)


def _table(claim: Claim, field: str, nodes: Sequence[Node], most: int, jobs: int, progress: Progress) -> Table:
    for name, value in (("most", most), ("jobs", jobs)):
        _number(value, name, 1, MOST)
    box: Box = claim.boxes[field]
    return tabulate(box, [one.that for one in claim.hypotheses], nodes, most=most, jobs=jobs, progress=progress)


def _must_be_finite(table: Table, target: Node, where: str) -> None:
    found = next((row for row in table.rows if isinf(row.values[0])), None)
    if found is not None:
        raise InvalidInput(
            f"{where}: got {shorten(target.text)}, which is inf on {found.case}, expected one that is finite under the hypotheses; "
            f'the hypothesis "{target.text} < inf" makes it so'
        )


def _columns(table: Table, names: Sequence[str], begin: int) -> _Columns:
    """Return the columns of the table from number `begin` on, whose names these are."""
    kept, left_out = [], {}
    for k, name in enumerate(names):
        infinite = next((row for row in table.rows if isinf(row.values[begin + k])), None)
        if infinite is None:
            kept.append(k)
        else:
            left_out[name] = infinite.case
    values = np.array([[row.values[begin + k] for k in kept] for row in table.rows], dtype=np.int64).reshape(len(table.rows), len(kept))
    return _Columns(tuple(names[k] for k in kept), values, left_out)


def _fit(table: Table, columns: _Columns, grammar: Grammar, side: str) -> Fit:
    in_box = np.array([row.in_box for row in table.rows], dtype=bool)
    return fit(_targets(table), columns.values, in_box, grammar, side)


def _terms(about: str) -> int:
    """Return how many quantities a bound has by default: fewer where there are those of two systems, which are twice as many."""
    return Grammar.terms if about == SYSTEM else Grammar.terms - 1


def _nouns(table: Table) -> tuple[str, str]:
    return table.box.one, table.box.noun


def _targets(table: Table) -> Integers:
    return np.array([row.values[0] for row in table.rows], dtype=np.int64)


def _systems(table: Table, attained: NDArray[np.bool_]) -> int:
    return sum(row.systems for row, here in zip(table.rows, attained, strict=True) if here)


def _evidence(table: Table) -> Evidence:
    counts = {name: getattr(table, name) for name in Evidence.__dataclass_fields__ if name not in ("box", "rows", "of")}
    return Evidence(box=str(table.box), rows=len(table.rows), of=table.box.noun, **counts)


def _word(text: str, claim: Claim) -> Node:
    return expression(text, "bound", vocabulary=VOCABULARIES[claim.about])


def _integer(text: object, where: str, about: str) -> Node:
    if not isinstance(text, str):
        raise InvalidInput(f"{where}: got {shorten(text)}, expected an expression as a string")
    return expression(text, where, Kind.INTEGER, VOCABULARIES[about])


def _listed(by: object) -> list[str]:
    if isinstance(by, str) or not isinstance(by, Sequence) or not 1 <= len(by) <= MOST_COLUMNS:
        raise InvalidInput(f"by: got {shorten(by)}, expected a list of 1 to {MOST_COLUMNS} expressions")
    return list(by)


def _named(node: Node) -> str:
    """Return the text of a column, which stands in a sum."""
    return (
        node.text
        if node.op in ("constant", "quantity", "windowed", "item", "abs", "min", "max", "sum", "len", *OF_A_MATRIX)
        else f"({node.text})"
    )


def _number(value: object, name: str, least: int, most: int) -> int:
    if type(value) is not int or not least <= value <= most:
        raise InvalidInput(f"{name}: got {shorten(value)}, expected an integer from {least} to {most}")
    return value


def default_columns(target: Node, about: str = SYSTEM) -> list[str]:
    """Return them, but for what the target is a sum of; sizes stay."""
    of_systems = (*sorted(one.name for one in quantities().values() if one.kind == Kind.INTEGER and not one.windowed), *RANKS)
    inside = set(linear(target).multiples)
    return [name for name in USUAL.get(about, of_systems) if name not in inside or (name in SIZES and name != target.text)]
