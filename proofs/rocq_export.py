"""A certificate as a file of Rocq: its system, statement and witness as terms, the checks of rocq/Check*.v recomputed by the kernel.

    COVERED      kind -> what writes it
    exported     the terms of a certificate; raises NotCovered, checker.Rejected (there is no such prime), checker.Malformed
    written      a file with the theorems about the concrete systems, proved by computation
    Terms        definitions, check (a boolean), statement (a proposition), lemma (that the one implies the other)

Systems are written with transposed matrices (signals are rows in the theory), as integers over one common denominator. Two things in the
terms are not in the certificate: words whose outputs are independent modulo its prime, which show the lower bounds that `checker.py` finds
by elimination, and combinations of demands likewise. What is computed here is believed by nobody: Rocq sees whether it serves.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import lcm
from typing import Any

from flint import nmod_mat

from . import checker

Json = Any
Integers = list[list[int]]
MODULES = (
    "Vocabulary",
    "CertificatesVocabulary",
    "Lists",
    "ListedSystems",
    "CheckRows",
    "CheckRanks",
    "CheckBehaviors",
    "Solutions",
    "CheckSolutions",
    "CheckInversion",
    "Stacks",
    "Excitation",
    "TableRank",
    "CheckMatrices",
)
HEAD = f"""From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import {" ".join(MODULES)}.
Import GRing.Theory.
Local Open Scope ring_scope.
"""


class NotCovered(Exception):
    """The checks in Rocq do not speak of this kind or this field."""


@dataclass(frozen=True)
class Terms:
    """What a file of Rocq says about one certificate. `definitions`: (name, type, term), numbers in them are integers."""

    definitions: tuple[tuple[str, str, str], ...]
    check: str
    statement: str
    lemma: str

    def opening(self) -> str:
        """The definitions."""
        lines = [f"Definition {name} : {kind} := {term}." for name, kind, term in self.definitions]
        return "\n".join(["Local Open Scope Z_scope.", *lines, "Local Close Scope Z_scope."])

    def theorem(self) -> str:
        """All of it, proved by computation."""
        return f"""{self.opening()}
Lemma checked : {self.check} = true.
Proof. vm_cast_no_check (erefl true). Qed.
Theorem certified : {self.statement}.
Proof. exact: ({self.lemma} checked). Qed.
"""


class Listed:
    """A SYSTEM over Q with matrices transposed and multiplied by their common denominator."""

    def __init__(self, data: Json) -> None:
        system = checker.System(data)
        if system.field.key != "Q":
            raise NotCovered("the checks in Rocq are over the rational numbers only")
        self.sizes = self.n, self.m, self.p = system.n, system.m, system.p
        blocks = (system.A, system.F, system.C, system.G)
        self.den = lcm(*(block.den for block in blocks))
        self.A, self.F, self.C, self.G = (
            [[row[j] * (self.den // block.den) for row in block.rows] for j in range(block.nc)] for block in blocks
        )

    @cached_property
    def term(self) -> str:
        """As a term of type listed."""
        return f"Listed {whole(self.den)} {' '.join(map(table, (self.A, self.F, self.C, self.G)))}"

    def named(self, name: str) -> str:
        """The system in the theory that the list of that name means."""
        return f"(meant {self.n} {self.m} {self.p} {name})"

    def response(self, state: list[int], fault: list[int], samples: int, prime: int) -> list[int]:
        """Outputs modulo the prime, one after the other, of a state and a fault at time 0."""
        found = list[int]()
        for _ in range(samples):
            found += added(times(state, self.C, self.p), times(fault, self.G, self.p), prime)
            state, fault = added(times(state, self.A, self.n), times(fault, self.F, self.n), prime), [0] * self.m
        return found

    def trajectory(self, state: list[int], faults: Integers, prime: int) -> tuple[Integers, Integers, Integers]:
        """States, faults and outputs of the integer system modulo the prime, the k-th fault times the k-th power of the denominator."""
        states, weighted, outputs = [state], Integers(), Integers()
        for k, fault in enumerate(faults):
            weighted.append([self.den**k * x for x in fault])
            outputs.append(added(times(states[-1], self.C, self.p), times(weighted[-1], self.G, self.p), prime))
            states.append(added(times(states[-1], self.A, self.n), times(weighted[-1], self.F, self.n), prime))
        return states, weighted, outputs

    def words(self, samples: int, prime: int) -> str:
        """A basis of the words modulo the prime, reduced: initial state, faults, sample and output of the leading one."""
        n, m, p = self.n, self.m, self.p
        rows = [self.response(unit(n, i), [0] * m, samples, prime) for i in range(n)]
        for i in range(m):
            from_rest = self.response([0] * n, unit(m, i), samples, prime)
            rows += [[0] * (p * j) + from_rest[: p * (samples - j)] for j in range(samples)]
        found = []
        for pivot, u in independent(rows, samples * p, prime):
            faults = [[u[n + i * samples + j] for i in range(m)] for j in range(samples)]
            found.append(f"(({vector(u[:n])}, {table(faults)}), ({pivot // p}%N, {pivot % p}%N))")
        return sequence(found)

    def demands(self, row: Integers) -> Integers:
        """The condition rows [X_(k+1), c_k] of a kernel row, times powers of the denominator."""
        state, found, weight = [0] * self.n, Integers(), 1
        for c in reversed(row):
            scaled = [weight * x for x in c]
            found.append(state + scaled)
            state = [sum(a * x for a, x in zip(rc + ra, scaled + state, strict=True)) for rc, ra in zip(self.C, self.A, strict=True)]
            weight *= self.den
        return found[::-1]


def exported(certificate: Json) -> Terms:
    """The terms of a well-formed certificate, accepted by the checker or not."""
    write = COVERED.get(certificate["kind"])
    if write is None:
        raise NotCovered(f"the checks in Rocq do not speak of the kind {certificate['kind']}")
    try:
        return write(certificate["statement"], certificate["witness"])
    except (KeyError, TypeError, ValueError, IndexError, AttributeError) as error:
        raise checker.Malformed(f"the certificate does not parse: {error}") from None


def written(terms: Sequence[Terms]) -> str:
    """A file with all theorems, which ends by asking what they rest on."""
    parts = [f"Module C{i}.\n{t.theorem()}End C{i}.\n" for i, t in enumerate(terms)]
    names = ", ".join(f"C{i}.certified" for i in range(len(terms)))
    return f"{HEAD}{''.join(parts)}Definition certified := ({names or 'I'}).\nPrint Assumptions certified.\n"


# -- the kinds ---------------------------------------------------------------------------------------------------------


def _window_ranks(s: Json, w: Json) -> Terms:
    system, prime, rows = Listed(s["system"]), _prime(w), _rows(w["kernel"])
    r, etas, ranks = s["normal_rank"], naturals(s["left_minimal_indices"]), naturals(s.get("window_ranks", []))
    name = system.named("system")
    formula = f"(forall s, \\rank (window {name} s) = s * {r} + \\sum_(eta <- {etas}) minn s eta)%N"
    return Terms(
        (_named("system", system), _modulus(prime), ("rows", "seq kernel_row", rows), _words("ws", system, system.n + 1, prime)),
        call("check_window_ranks", *system.sizes, r, etas, ranks, "l system rows ws"),
        f"{formula} /\\ [seq \\rank (window {name} s) | s <- iota 1 {len(s.get('window_ranks', []))}] = {ranks}",
        "window_ranks_sound",
    )


def _left_invertible(s: Json, w: Json) -> Terms:
    system, prime = Listed(s["system"]), _prime(w)
    return Terms(
        (_named("system", system), _modulus(prime), _words("ws", system, system.n + 1, prime)),
        call("check_left_invertible", *system.sizes, "l system ws"),
        f"left_invertible {system.named('system')}",
        "left_invertible_sound",
    )


def _not_left_invertible(s: Json, w: Json) -> Terms:
    system = Listed(s["system"])
    scale = lcm(*(checker.rational(x, "witness")[1] for part in (w["state"], w["fault"]) for one in part for x in one))
    xs, vs = ([_scaled(one, scale * system.den**k) for k, one in enumerate(reversed(w[key]))] for key in ("state", "fault"))
    return Terms(
        (_named("system", system), ("xs", "seq vector", table([*xs, [0] * system.n])), ("vs", "seq vector", table(vs))),
        call("check_not_left_invertible", *system.sizes, "system xs vs"),
        f"~ left_invertible {system.named('system')}",
        "not_left_invertible_sound",
    )


def _inclusion(s: Json, w: Json) -> Terms:
    inner, outer, prime = Listed(s["inner"]), Listed(s["outer"]), _prime(w)
    a, b = inner.named("inner"), outer.named("outer")
    return Terms(
        (
            _named("inner", inner),
            _named("outer", outer),
            _modulus(prime),
            ("rows", "seq kernel_row", _rows(w["kernel"])),
            _words("ws", outer, outer.n + 1, prime),
        ),
        call("check_inclusion", inner.n, inner.m, *outer.sizes, "l inner outer rows ws"),
        f"(forall s r, word {a} s r -> word {b} s r) /\\ (forall r, behavior {a} r -> behavior {b} r)",
        "inclusion_sound",
    )


def _equality(s: Json, w: Json) -> Terms:
    first, second, prime = Listed(s["first"]), Listed(s["second"]), _prime(w)
    a, b, window = first.named("first"), second.named("second"), s.get("window")
    shape = first.n, first.m, *second.sizes
    definitions = (
        _named("first", first),
        _named("second", second),
        _modulus(prime),
        ("rows", "seq kernel_row", _rows(w["kernel"])),
        _words("ws", first, first.n + 1 if window is None else window, prime),
        _words("ws'", second, second.n + 1 if window is None else window, prime),
    )
    if window is None:
        statement = f"(forall s r, word {a} s r <-> word {b} s r) /\\ (forall r, behavior {a} r <-> behavior {b} r)"
        return Terms(definitions, call("check_equality", *shape, "l first second rows ws ws'"), statement, "equality_sound")
    statement = f"forall r, word {a} {window} r <-> word {b} {window} r"
    check = call("check_window_equality", *shape, window, "l first second rows ws ws'")
    return Terms(definitions, check, statement, "window_equality_sound")


def _difference(s: Json, w: Json) -> Terms:
    first, second, window = Listed(s["first"]), Listed(s["second"]), s["window"]
    x0, v = _integral_word(first, w)
    return Terms(
        (
            _named("first", first),
            _named("second", second),
            ("x", "vector", vector(x0)),
            ("vs", "seq vector", table(v)),
            ("c", "seq vector", table(_cleared(w["row"])[0])),
        ),
        call("check_difference", first.n, first.m, *second.sizes, window, "first second x vs c"),
        f"exists2 r, word {first.named('first')} {window} r & ~ word {second.named('second')} {window} r",
        "difference_sound",
    )


def _fault_space(s: Json, w: Json) -> Terms:
    system, prime, window = Listed(s["system"]), _prime(w), s["window"]
    width = system.n + system.p
    kernel = [[[int(x) for x in c] for c in row["coefficients"]] for row in w["kernel"]]
    basis, d = _cleared(s["basis"])
    pivots = [next((j for j, x in enumerate(row) if x), width) for row in basis]
    demands = [demand for row in kernel for demand in system.demands(row)]
    combinations = pivoted(independent(demands, width, prime))
    beyond = max((len(row) - 1 for row in kernel), default=0) if window is None else window
    check = "check_limit" if window is None else "check_solutions"
    space = f"spans_solutions {system.named('system')} {'s' if window is None else window} (fraction d {len(basis)} {width} basis)"
    return Terms(
        (
            _named("system", system),
            _modulus(prime),
            ("rows", "seq kernel_row", _rows(w["kernel"])),
            _words("ws", system, system.n + 1 if window is None else window, prime),
            ("d", "Z", whole(d)),
            ("basis", "table", table(basis)),
            ("combinations", "seq (nat * vector)", combinations),
        ),
        call(check, *system.sizes, beyond, "l system rows ws d basis", naturals(pivots), "combinations"),
        f"forall s, ({beyond} < s)%N -> {space}" if window is None else space,
        "limit_sound" if window is None else "solutions_sound",
    )


def _first_column_only(s: Json, w: Json) -> Terms:
    system, prime, window = Listed(s["system"]), _prime(w), s["window"]
    (z,), d = _cleared([s["column"]])
    name, f, g = system.named("system"), f"(recorded d {system.n} f)", f"(recorded d {system.p} g)"
    response = f"output (with_faults {name} {f} {g}) 0 (impulse _)"
    return Terms(
        (
            _named("system", system),
            _modulus(prime),
            ("rows", "seq kernel_row", _rows(w["kernel"])),
            _words("ws", system, window, prime),
            ("d", "Z", whole(d)),
            ("f", "vector", vector(z[: system.n])),
            ("g", "vector", vector(z[system.n :])),
        ),
        call("check_first_column", *system.sizes, window, "l system rows ws d f g"),
        f"word {name} {window} ({response}) /\\ ~ solves {name} {window} {f} {g}",
        "first_column_sound",
    )


def _inversion_delay(s: Json, w: Json) -> Terms:
    system, delay = Listed(s["system"]), s["delay"]
    known = {"known": "true", "unknown": "false"}[s["initial_state"]]
    name = system.named("system")
    x0, v = _integral_word(system, w["word"]) if delay != 0 else ([], [])
    definitions = _named("system", system), ("x", "vector", vector(x0)), ("vs", "seq vector", table(v))
    if delay is None:
        statement = f"forall j, (j <= {system.n})%N -> ~ determines {name} {known} j"
        return Terms(definitions, call("check_no_delay", *system.sizes, known, "system x vs"), statement, "no_delay_sound")
    rows = []
    for given in w["inverse"] or [[]] * system.m:
        (row,), scale = _cleared([given])
        rows.append(f"({whole(scale)}, {table(row[k * system.p : (k + 1) * system.p] for k in range(delay + 1))})")
    return Terms(
        (*definitions, ("rows", "seq (Z * seq vector)", sequence(rows))),
        call("check_delay", *system.sizes, known, delay, "system rows x vs"),
        f"[/\\ ({delay} <= {system.n})%N, determines {name} {known} {delay} & forall j, (j < {delay})%N -> ~ determines {name} {known} j]",
        "delay_sound",
    )


def _matrix_rank(s: Json, w: Json) -> Terms:
    system, prime, r, name = Listed(s["system"]), _prime(w), s["rank"], s["matrix"]
    n, m, p = system.sizes
    samples, e, given = s.get("window", n), system.den, list[tuple[str, str, str]]()
    meant, data, sizes = system.named("system"), "", [n, m, p, samples, r]
    if name in ("observability", "toeplitz", "window"):
        rows = [] if name == "toeplitz" else [system.response(unit(n, i), [0] * m, samples, prime) for i in range(n)]
        if name != "observability":
            from_rest = [system.response([0] * n, unit(m, i), samples, prime) for i in range(m)]
            rows += [[0] * (p * j) + response[: p * (samples - j)] for j in range(samples) for response in from_rest]
        width, weights = samples * p, [e ** (samples - 1 - k) for k in range(samples) for _ in range(p)]
        matrix = f"{ {'observability': 'O', 'toeplitz': 'T', 'window': 'window'}[name] } {meant} {samples}"
    elif name == "reachability":
        blocks = [system.F]
        while len(blocks) < n:
            blocks.append([added(times(row, system.A, n), [0] * n, prime) for row in blocks[-1]])
        rows = [row for block in blocks[:n] for row in block]
        width, weights, matrix = n, [1] * n, f"reachability {meant}"
    else:
        (x0, *v), d = _cleared([s["x0"], *s["v"]])
        count = len(v) - samples + 1
        states, faults, outputs = system.trajectory(x0, v, prime)
        given += [("d", "Z", whole(d)), ("x", "vector", vector(x0)), ("vs", "seq vector", table(v))]
        sizes, data = [n, m, p, count, samples, r], "d x vs"
        trajectory = f"(recorded d {n} x) (fun k => recorded d {m} (nth [::] vs k))"
        tail, wide = (outputs, p) if name == "residual-hankel" else (faults, m)
        rows = [[x for one in tail[i : i + samples] for x in one] for i in range(count)]
        width, weights = samples * wide, [e ** (samples - 1 - k) for k in range(samples) for _ in range(wide)]
        matrix = f"hankel {count} {samples} (output {meant} {trajectory})"
        if name == "excitation":
            rows = [states[i] + row for i, row in enumerate(rows)]
            width, weights = n + width, [e ** max(samples - 1, 0)] * n + weights
            matrix = f"excitation {meant} {trajectory} {count} {samples}"
    if name in ("observability", "reachability"):
        sizes = [n, m, p, r]
    lemma = {"residual-hankel": "hankel"}.get(name, name)
    nulls = [(row["pivot"], [int(x) * weight for x, weight in zip(row["row"], weights, strict=True)]) for row in w["left_null"]]
    return Terms(
        (
            _named("system", system),
            _modulus(prime),
            *given,
            ("nulls", "seq (nat * vector)", pivoted(nulls)),
            ("combinations", "seq (nat * vector)", pivoted(independent(rows, width, prime))),
        ),
        call(f"check_{lemma}", *sizes, "l system", data, "nulls combinations"),
        f"\\rank ({matrix}) = {r}%N",
        f"{lemma}_sound",
    )


COVERED: dict[str, Callable[[Json, Json], Terms]] = {
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
}


# -- parts -------------------------------------------------------------------------------------------------------------


def _prime(w: Json) -> int:
    prime = int(w["prime"])
    checker.require(checker.is_prime(prime), f"{prime} is not a prime")
    return prime


def _rows(kernel: Json) -> str:
    return sequence(f"({row['pivot']}%N, {table([[int(x) for x in c] for c in row['coefficients']])})" for row in kernel)


def _named(name: str, system: Listed) -> tuple[str, str, str]:
    return name, "listed", system.term


def _words(name: str, system: Listed, samples: int, prime: int) -> tuple[str, str, str]:
    return name, "seq sampled_word", system.words(samples, prime)


def _modulus(prime: int) -> tuple[str, str, str]:
    return "l", "Z", whole(prime)


def _scaled(values: Json, factor: int) -> list[int]:
    """RATIONALs times a factor that all denominators divide."""
    return [top * factor // bottom for top, bottom in (checker.rational(x, "a number") for x in values)]


def _cleared(rows: Json) -> tuple[Integers, int]:
    """Rows of RATIONALs as integers over their common denominator."""
    den = lcm(*(checker.rational(x, "a number")[1] for row in rows for x in row))
    return [_scaled(row, den) for row in rows], den


def _integral_word(system: Listed, word: Json) -> tuple[list[int], Integers]:
    """A word of the integer system: v(k) times the k-th power of its denominator, all of it times what clears the fractions."""
    _, scale = _cleared([word["x0"], *word["v"]])
    return _scaled(word["x0"], scale), [_scaled(v, scale * system.den**k) for k, v in enumerate(word["v"])]


def independent(rows: Integers, width: int, prime: int) -> list[tuple[int, list[int]]]:
    """Reduced row echelon form modulo a prime, first `width` columns: pivots, and the combinations of the rows that lead there."""
    if not rows or not width:
        return []
    height = len(rows)
    augmented = nmod_mat(height, width + height, [x % prime for i, row in enumerate(rows) for x in row + unit(height, i)], prime)
    form, _ = augmented.rref()
    found = []
    for i in range(height):
        line = [int(form[i, j]) for j in range(width + height)]
        pivot = next((j for j in range(width) if line[j]), None)
        if pivot is not None:
            found.append((pivot, line[width:]))
    return found


def unit(size: int, i: int) -> list[int]:
    """A row of the identity."""
    return [int(i == j) for j in range(size)]


def times(x: list[int], M: Integers, width: int) -> list[int]:
    """A row times a matrix."""
    return [sum(a * row[j] for a, row in zip(x, M, strict=True)) for j in range(width)]


def added(u: Iterable[int], v: Iterable[int], prime: int) -> list[int]:
    """The sum modulo the prime."""
    return [(a + b) % prime for a, b in zip(u, v, strict=True)]


def whole(number: int) -> str:
    """An integer as a term, where integers are expected."""
    return str(number) if number >= 0 else f"({number})"


def sequence(terms: Iterable[str]) -> str:
    """A list of terms."""
    inside = "; ".join(terms)
    return f"[:: {inside}]" if inside else "[::]"


def vector(entries: Iterable[int]) -> str:
    """A list of integers as a term."""
    return sequence(map(whole, entries))


def table(rows: Iterable[Iterable[int]]) -> str:
    """A list of lists of integers as a term."""
    return sequence(map(vector, rows))


def call(function: str, *arguments: int | str) -> str:
    """A function and its arguments, numbers being natural ones."""
    return " ".join([function, *(f"{one}%N" if isinstance(one, int) else one for one in arguments)])


def pivoted(vectors: Iterable[tuple[int, list[int]]]) -> str:
    """A list of pivots with their vectors as a term."""
    return sequence(f"({pivot}%N, {vector(u)})" for pivot, u in vectors)


def naturals(numbers: Iterable[int]) -> str:
    """A list of natural numbers as a term."""
    return sequence(f"{number}%N" for number in numbers)
