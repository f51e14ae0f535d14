"""Certificates over GF(p) and Q(a) as terms of Rocq: the same kinds as over Q, recomputed by the checks of theory/field_checks.

    FIELD_KINDS     kind -> what writes it
    finite_zeros    writes finite zeros, over Q too
    infinite_zeros  writes infinite zeros, over Q too
    system_of       a system of a statement, once the checker has looked at the prime; named: it as a definition
    terms_over      the terms of a statement over every field in which the numbers mean something

The theorem about a system over GF(p) is said of every field in which p is zero, that about one over Q(a) of every root of the minimal
polynomial in every field of characteristic 0: neither needs that p is a prime or that the polynomial is irreducible, which the checker
sees. There are no primes and hints in the terms. The lower bounds are words and combinations over the field itself, computed here
(`numbered.py`), whatever shows them in the certificate: the hints, the prime and the root are looked at by the checker alone.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ...exact.structure.kernel_rows import kernel_representation
from ...exact.system.systems import ResidualSystem
from ..trust import checker, checker_structure
from .numbered import Numbered, Numbers, Row, Rows, independent, inverse_at, transposed
from .terms import AT_FIRST, Terms, call, determines, index, indices, natural, naturals, sequence, window_of

Json = Any
Kernel = list[tuple[int, Rows]]
Definitions = Sequence[tuple[str, str, str]]


def terms_over(numbers: Numbers, definitions: Definitions, check: str, statement: str, lemma: str) -> Terms:
    """Return the terms of a statement over every field that the numbers mean something in."""
    named = tuple((name, numbers.of(kind), term) for name, kind, term in definitions)
    return Terms((numbers.definition, *named), check, f"{numbers.given} {statement}", numbers.proof.format(lemma=lemma))


def _window_ranks(s: Json, w: Json) -> Terms:
    system = system_of(s["system"], w)
    kernel = _kernel(system, w["kernel"]) if "kernel" in w else _exact_rows(system, w)
    r, etas, ranks = index(s["normal_rank"]), naturals(indices(s["left_minimal_indices"])), naturals(indices(s.get("window_ranks", [])))
    name, definitions = system.named("system"), [named("system", system), *_rows(system, kernel, w), _words("ws", system, system.n + 1)]
    formula = f"(forall s, \\rank (window {name} s) = s * {natural(r)} + \\sum_(eta <- {etas}) minn s eta)%N"
    return terms_over(
        system.numbers, definitions,
        call("has_window_ranks", *system.sizes, r, etas, ranks, "system rows Q ws"),
        f"{formula} /\\ [seq \\rank (window {name} s) | s <- iota 1 {natural(len(s.get('window_ranks', [])))}] = {ranks}",
        "has_window_ranks_sound",
    )  # fmt: skip


def _exact_rows(system: Numbered, w: Json) -> Kernel:
    """Return exact kernel rows in the place of those that a certificate has modulo its prime alone, which the checker looks at."""
    pivots, rows = system.read.field.kernel_rows(w["kernel_modulo"], system.p)
    system.read.spanned_modulo(pivots, rows, w)
    system.bounded(system.n + 1)
    found = kernel_representation(ResidualSystem(*map(transposed, (system.A, system.F, system.C, system.G))))
    return [(row.pivot, row.coefficients.elements()) for row in found.rows]


def _left_invertible(s: Json, w: Json) -> Terms:
    system = system_of(s["system"], w)
    if "point" in w:
        checker.require(system.read.pencil_rank(w) >= system.n + system.m, "the pencil has a smaller rank at that point")
    return terms_over(
        system.numbers, [named("system", system), _words("ws", system, system.n + 1)],
        call("is_left_invertible", *system.sizes, "system ws"),
        f"left_invertible {system.named('system')}",
        "is_left_invertible_sound",
    )  # fmt: skip


def _not_left_invertible(s: Json, w: Json) -> Terms:
    system = system_of(s["system"], w)
    xs, vs = (system.numbers.vectors(w[key][::-1], width) for key, width in (("state", system.n), ("fault", system.m)))
    definitions = [named("system", system), _table(system, "xs", [*xs, system.numbers.unit(system.n, -1)]), _table(system, "vs", vs)]
    return terms_over(
        system.numbers, definitions,
        call("is_not_left_invertible", *system.sizes, "system xs vs"),
        f"~ left_invertible {system.named('system')}",
        "is_not_left_invertible_sound",
    )  # fmt: skip


def _inclusion(s: Json, w: Json) -> Terms:
    inner, outer = system_of(s["inner"], w), system_of(s["outer"], w)
    a, b, kernel = inner.named("inner"), outer.named("outer"), _kernel(outer, w["kernel"])
    definitions = [named("inner", inner), named("outer", outer), *_rows(outer, kernel, w), _words("ws", outer, outer.n + 1)]
    return terms_over(
        outer.numbers, definitions,
        call("is_included", inner.n, inner.m, *outer.sizes, "inner outer rows Q ws"),
        f"(forall s r, word {a} s r -> word {b} s r) /\\ (forall r, behavior {a} r -> behavior {b} r)",
        "is_included_sound",
    )  # fmt: skip


def _equality(s: Json, w: Json) -> Terms:
    first, second = system_of(s["first"], w), system_of(s["second"], w)
    a, b, kernel, window = first.named("first"), second.named("second"), _kernel(first, w["kernel"]), None
    if "window" in s:
        window = window_of(s["window"])
        name, at, sound = "are_equal_on", [window], "are_equal_on_sound"
        statement = f"same_words {a} {b} {natural(window)}"
    else:
        name, at, sound = "are_equal", [], "are_equal_sound"
        statement = f"(forall s, same_words {a} {b} s) /\\ same_behavior {a} {b}"
        _hinted(second, w)
    words = [_words(ws, one, one.n + 1 if window is None else window) for ws, one in (("ws", first), ("ws'", second))]
    definitions = [named("first", first), named("second", second), *_rows(first, kernel, w), *words]
    check = call(name, first.n, first.m, *second.sizes, *at, "first second rows Q ws ws'")
    return terms_over(first.numbers, definitions, check, statement, sound)


def _difference(s: Json, w: Json) -> Terms:
    first, second, window = system_of(s["first"], w), system_of(s["second"], w), window_of(s["window"])
    (x,), vs = first.numbers.vectors([w["x0"]], first.n), first.numbers.vectors(w["v"], first.m)
    row = first.numbers.vectors(w["row"], first.p)
    definitions = [named("first", first), named("second", second), ("x", "seq V", first.numbers.vector(x))]
    return terms_over(
        first.numbers, [*definitions, _table(first, "vs", vs), _table(first, "c", row)],
        call("differ", first.n, first.m, *second.sizes, window, "first second x vs c"),
        f"exists2 r, word {first.named('first')} {natural(window)} r & ~ word {second.named('second')} {natural(window)} r",
        "differ_sound",
    )  # fmt: skip


def _fault_space(s: Json, w: Json) -> Terms:
    system, window = system_of(s["system"], w), None if s["window"] is None else window_of(s["window"])
    numbers, width = system.numbers, system.n + system.p
    kernel = _kernel(system, w["kernel"])
    counted = _counted(kernel, w, window)
    basis = numbers.vectors(s["basis"], width)
    pivots = [next((j for j, x in enumerate(row) if x != 0), width) for row in basis]
    beyond = max((len(row) - 1 for _, row in counted), default=0) if window is None else window
    found = numbers.pivoted(independent(numbers, _conditions(system, counted), width))
    check, sound = ("are_solutions_beyond", "are_solutions_beyond_sound") if window is None else ("are_solutions", "are_solutions_sound")
    at, shape = "s" if window is None else natural(window), f"{natural(len(basis))} {natural(width)}"
    space = f"spans_solutions {system.named('system')} {at} (matrix_of value {shape} basis)"
    words = _words("ws", system, system.n + 1 if window is None else window)
    return terms_over(
        numbers,
        [
            named("system", system), *_rows(system, kernel, w, window), words, _table(system, "basis", basis),
            ("combinations", "seq (nat * seq V)", found),
        ],
        call(check, *system.sizes, beyond, "system rows Q ws basis", naturals(pivots), "combinations"),
        f"forall s, ({natural(beyond)} < s)%N -> {space}" if window is None else space,
        sound,
    )  # fmt: skip


def _first_column_only(s: Json, w: Json) -> Terms:
    system, window = system_of(s["system"], w), window_of(s["window"])
    (z,) = system.numbers.vectors([s["column"]], system.n + system.p)
    kernel = _kernel(system, w["kernel"])
    name, f, g = system.named("system"), f"(vector_of value {natural(system.n)} first)", f"(vector_of value {natural(system.p)} rest)"
    parts = [(part, "seq V", system.numbers.vector(values)) for part, values in (("first", z[: system.n]), ("rest", z[system.n :]))]
    return terms_over(
        system.numbers, [named("system", system), *_rows(system, kernel, w, window), _words("ws", system, window), *parts],
        call("first_column_alone", *system.sizes, window, "system rows Q ws first rest"),
        f"word {name} {natural(window)} (output (with_faults {name} {f} {g}) 0 {AT_FIRST}) /\\ "
        f"~ solves {name} {natural(window)} {f} {g}",
        "first_column_alone_sound",
    )  # fmt: skip


def _inversion_delay(s: Json, w: Json) -> Terms:
    system, delay = system_of(s["system"], w), None if s["delay"] is None else index(s["delay"], checker.MAX_DIMENSION)
    known, numbers = {"known": "true", "unknown": "false"}[s["initial_state"]], system.numbers
    name, x, vs = system.named("system"), Row(), Rows()
    if delay != 0:
        (x,), vs = numbers.vectors([w["word"]["x0"]], system.n), numbers.vectors(w["word"]["v"], system.m)
    definitions = [named("system", system), ("x", "seq V", numbers.vector(x)), _table(system, "vs", vs)]
    if delay is None:
        statement = f"forall j, (j <= {natural(system.n)})%N -> ~ {determines(name, known, 'j')}"
        return terms_over(numbers, definitions, call("has_no_delay", *system.sizes, known, "system x vs"), statement, "has_no_delay_sound")
    p, least = system.p, natural(delay)
    inverse = numbers.vectors(w["inverse"] or [[]] * system.m, p * (delay + 1))
    rows = [[row[k * p : (k + 1) * p] for k in range(delay + 1)] for row in inverse]
    return terms_over(
        numbers, [*definitions, ("rows", "seq (seq (seq V))", sequence(map(numbers.table, rows)))],
        call("has_delay", *system.sizes, known, delay, "system rows x vs"),
        f"[/\\ ({least} <= {natural(system.n)})%N, {determines(name, known, least)} & "
        f"forall j, (j < {least})%N -> ~ {determines(name, known, 'j')}]",
        "has_delay_sound",
    )  # fmt: skip


def _matrix_rank(s: Json, w: Json) -> Terms:
    system, r, name = system_of(s["system"], w), index(s["rank"]), s["matrix"]
    checker.expect(type(name) is str and name in checker_structure.MATRICES, "matrix: unknown name")
    numbers, (n, m, p), meant = system.numbers, system.sizes, system.named("system")
    samples, given, sizes, data = window_of(s["window"]) if "window" in s else n, list[tuple[str, str, str]](), [n, m, p], ""
    system.bounded(samples)
    if name in ("observability", "toeplitz", "window"):
        rows = ([] if name == "toeplitz" else system.free(samples)) + ([] if name == "observability" else system.forced(samples))
        width, letter = samples * p, {"observability": "O", "toeplitz": "T", "window": "window"}[name]
        matrix = f"{letter} {meant} {natural(samples)}"
        sizes += [] if name == "observability" else [samples]
    elif name == "reachability":
        rows, block = Rows(), system.F
        for _ in range(n):
            rows, block = rows + block.elements(), block @ system.A
        width, matrix = n, f"reachability {meant}"
    else:
        (x,), vs = numbers.vectors([s["x0"]], n), numbers.vectors(s["v"], m)
        count = len(vs) - samples + 1
        checker.expect(count > 0, "window: more than there are samples")
        checker.charge(count * (n + samples * (m + p) + count) * 2000)
        states, outputs = system.trajectory(x, vs)
        given, data = [("x", "seq V", numbers.vector(x)), _table(system, "vs", vs)], "x vs"
        tail, wide = (outputs, p) if name == "residual-hankel" else (vs, m)
        rows, width = [[e for one in tail[i : i + samples] for e in one] for i in range(count)], samples * wide
        sizes += [count, samples]
        trajectory = f"(vector_of value {natural(n)} x) (signal_of value {natural(m)} vs)"
        matrix = f"hankel {natural(count)} {natural(samples)} (output {meant} {trajectory})"
        if name == "excitation":
            rows, width = [states[i] + row for i, row in enumerate(rows)], n + width
            matrix = f"excitation {meant} {trajectory} {natural(count)} {natural(samples)}"
    nulls = [(index(row["pivot"]), numbers.integral(row["row"], width)) for row in w["left_null"]]
    stem = {"residual-hankel": "hankel"}.get(name, name)
    found = numbers.pivoted(independent(numbers, rows, width))
    pivoted = [("nulls", "seq (nat * seq V)", numbers.pivoted(nulls)), ("combinations", "seq (nat * seq V)", found)]
    return terms_over(
        numbers, [named("system", system), *given, *pivoted],
        call(f"{stem}_has_rank", *sizes, r, "system", data, "nulls combinations"),
        f"\\rank ({matrix}) = {natural(r)}%N",
        f"{stem}_rank",
    )  # fmt: skip


def finite_zeros(s: Json, w: Json) -> Terms:
    """Write finite-zeros, over Q too: Q is Q(a) where a is the root 0 of q."""
    system, r = system_of(s["system"], w), index(s["normal_rank"])
    numbers, name, sizes = system.numbers, system.named("system"), (system.n + system.p, system.n + system.m)
    g = _polynomial(numbers, s["invariant_zero_polynomial"])
    diagonal = _diagonal(numbers, w, sizes)
    tables = [_polynomial_table(numbers, part, rows) for part, rows in _multipliers(numbers, w, sizes).items()]
    product = numbers.unit(1, 0)
    for f in diagonal:
        product = _convolved(numbers, product, f) if any(x != 0 for x in f) else product
    leading = next((x for x in reversed(product) if x != 0), product[0])
    minors = f"gcd_of_minors_of_order ({natural(system.n)} + {natural(r)}) (pencil {name}) (polynomial_of value g)"
    return terms_over(
        numbers,
        [
            named("system", system), ("g", "seq V", numbers.vector(g)), ("c", "V", numbers.number(leading)),
            _table(system, "d", diagonal), *tables,
        ],
        call("has_finite_zeros", *system.sizes, r, "system g c d U U' V V'"),
        f"[/\\ \\rank (transfer {name}) = {natural(r)}%N, {minors} & polynomial_of value g \\is monic]",
        "has_finite_zeros_sound",
    )  # fmt: skip


def infinite_zeros(s: Json, w: Json) -> Terms:
    """Write infinite-zeros, over Q too.

    The certificate has multipliers of the reversed pencil, [1 - t A, t C; - t F, t G] in the theory, which is the pencil at infinity,
    [1 - t A, C; - t F, G], with its last p columns times t. The form D of the one has n entries that do not vanish at t = 0, and V maps
    between the columns without t; so the other has the form D with all other entries over t, by the same U, and V with the rows of
    outputs times t and all other columns over t, for which V need only be divisible as it has to be.
    """
    system, orders = system_of(s["system"], w), indices(s["infinite_zero_orders"])
    numbers, name, sizes = system.numbers, system.named("system"), (system.n + system.p, system.n + system.m)
    diagonal, multipliers = _diagonal(numbers, w, sizes), _multipliers(numbers, w, sizes)
    later = [not (j < len(diagonal) and diagonal[j] and diagonal[j][0] != 0) for j in range(sizes[0])]
    outputs = [j >= system.n for j in range(sizes[0])]
    multipliers |= {"V": _shifted(numbers, multipliers["V"], outputs, later), "V'": _shifted(numbers, multipliers["V'"], later, outputs)}
    reduced = [f[1:] if late else f for f, late in zip(diagonal, later, strict=False)]
    r, written = natural(len(orders)), naturals(orders)
    minors = f"divides_minors_of_order ({natural(system.n)} + j) (pencil_at_infinity {name}) 'X^e"
    return terms_over(
        numbers,
        [
            named("system", system), _table(system, "d", reduced),
            *(_polynomial_table(numbers, part, rows) for part, rows in multipliers.items()),
        ],
        call("has_infinite_zeros", *system.sizes, written, "system d U U' V V'"),
        f"\\rank (transfer {name}) = {r}%N /\\ forall j e, (j <= {r})%N -> {minors} <-> (e <= sumn (take j {written}))%N",
        "has_infinite_zeros_sound",
    )  # fmt: skip


FIELD_KINDS: dict[str, Callable[[Json, Json], Terms]] = {
    "window-ranks": _window_ranks,
    "left-invertible": _left_invertible,
    "not-left-invertible": _not_left_invertible,
    "inversion-delay": _inversion_delay,
    "behaviour-inclusion": _inclusion,
    "behaviour-equality": _equality,
    "window-equality": _equality,
    "behaviour-difference": _difference,
    "fault-space": _fault_space,
    "first-column-only": _first_column_only,
    "matrix-rank": _matrix_rank,
    "finite-zeros": finite_zeros,
    "infinite-zeros": infinite_zeros,
}


# -- parts -------------------------------------------------------------------------------------------------------------


def system_of(data: Json, w: Json) -> Numbered:
    """Return a system of the statement. Raises what the checker says of the prime, its root, and of why the polynomial is irreducible."""
    system = Numbered(data)
    system.read.field.irreducible(w)
    if "prime" in w or "root" in w or system.read.field.prime:
        system.read.field.reduce(w)
    return system


def _kernel(system: Numbered, rows: Json) -> Kernel:
    """Return pivots and coefficients of kernel rows."""
    return [(index(row["pivot"]), [system.numbers.integral(c, system.p) for c in row["coefficients"]]) for row in rows]


def _counted(kernel: Kernel, w: Json, window: int | None) -> Kernel:
    """Return the rows that speak of a window: where there are hints, those of lower degree."""
    return [row for row in kernel if window is None or "point" not in w or len(row[1]) <= window]


def _hinted(system: Numbered, w: Json, window: int | None = None) -> None:
    """Has the checker look at hints, where rows annihilate the system modulo its prime: where they do not, Rocq sees it, but of the rows
    that are not counted."""
    checker.expect("point" in w or "mix" not in w, "mix goes with a point")
    if "point" in w and "kernel" in w:
        pivots, rows = system.read.field.kernel_rows(w["kernel"], system.p)
        residues = [system.read.field.residues(row) for row in rows]
        _, left = system.read.conditions(residues)
        if not left:
            system.read.minimal(pivots, residues, w)
        system.read.annihilated_by([row for row in rows if window is not None and len(row) > window])


def _rows(system: Numbered, kernel: Kernel, w: Json, window: int | None = None) -> Definitions:
    """Return the kernel rows that count and, where they come with hints, other pivots and what makes the leading coefficients there
    diagonal: then they need not be triangular by those that they have."""
    numbers, inverse, kernel = system.numbers, "None", _counted(kernel, w, window)
    _hinted(system, w, window)
    if "point" in w and "kernel" in w:
        found = inverse_at(numbers, [row[-1] if row else [] for _, row in kernel], system.p)
        if found is not None:
            kernel = [(pivot, row) for pivot, (_, row) in zip(found[0], kernel, strict=True)]
            inverse = f"Some {numbers.table(found[1])}"
    term = sequence(f"({natural(pivot)}%N, {numbers.table(row)})" for pivot, row in kernel)
    return ("rows", "seq (nat * seq (seq V))", term), ("Q", "option (seq (seq V))", inverse)


def _conditions(system: Numbered, kernel: Kernel) -> Rows:
    checker.charge(sum(len(row) for _, row in kernel) * (system.n + system.p + 1) ** 2 * 2000 * system.numbers.field.degree**2)
    return [condition for _, row in kernel for condition in system.conditions(row)]


def named(name: str, system: Numbered) -> tuple[str, str, str]:
    return name, f"listing ({system.numbers.name})", system.term


def _words(name: str, system: Numbered, samples: int) -> tuple[str, str, str]:
    return name, "seq (seq V * seq (seq V) * (nat * nat))", system.words(samples)


def _table(system: Numbered, name: str, rows: Rows) -> tuple[str, str, str]:
    return name, "seq (seq V)", system.numbers.table(rows)


def _polynomial(numbers: Numbers, f: Json) -> Row:
    """Return the coefficients of a POLY."""
    (row,) = numbers.vectors([f], len(checker.items(f, "a polynomial")))
    return row


def _polynomials(numbers: Numbers, value: Json, size: int) -> list[Rows]:
    """Return a square POLYMATRIX of that size."""
    rows = checker.items(value, "a matrix of polynomials", size, size)
    return [[_polynomial(numbers, f) for f in checker.items(row, "a row of polynomials", size, size)] for row in rows]


def _diagonal(numbers: Numbers, w: Json, sizes: tuple[int, int]) -> Rows:
    """Return the diagonal of the form of a pencil of that shape."""
    return [_polynomial(numbers, f) for f in checker.items(w["diagonal"], "diagonal", min(sizes), min(sizes))]


def _multipliers(numbers: Numbers, w: Json, sizes: tuple[int, int]) -> dict[str, list[Rows]]:
    """Return the transposed multipliers of a pencil of that shape, by their names in the theory."""
    keys = {"V": ("left", sizes[0]), "V'": ("left_inverse", sizes[0]), "U": ("right", sizes[1]), "U'": ("right_inverse", sizes[1])}
    return {part: [list(row) for row in zip(*_polynomials(numbers, w[key], size), strict=True)] for part, (key, size) in keys.items()}


def _polynomial_table(numbers: Numbers, name: str, rows: Sequence[Rows]) -> tuple[str, str, str]:
    return name, "seq (seq (seq V))", sequence(map(numbers.table, rows))


def _shifted(numbers: Numbers, table: Sequence[Rows], up: Sequence[bool], down: Sequence[bool]) -> list[Rows]:
    """Return polynomials, times t in the rows told and over t in the columns told. Rejected where a division leaves a rest."""
    found = []
    for row, raised in zip(table, up, strict=True):
        line = [[*numbers.unit(1, -1), *f] if raised else f for f in row]
        rests = (f[0] for f, lowered in zip(line, down, strict=True) if lowered and f)
        checker.require(not any(x != 0 for x in rests), "the left multiplier does not map columns without t to such columns")
        found.append([f[1:] if lowered else f for f, lowered in zip(line, down, strict=True)])
    return found


def _convolved(numbers: Numbers, f: Row, g: Row) -> Row:
    """Return the product of two polynomials."""
    checker.charge(2000 * len(f) * len(g) * numbers.field.degree**2)
    found = [numbers.field.element(0)] * (len(f) + len(g) - 1)
    for i, x in enumerate(f):
        for j, y in enumerate(g):
            found[i + j] = found[i + j] + x * y
    return found
