"""A certificate as a file of Rocq: its system, statement and witness as terms, the checks of theory/checks recomputed by the kernel.

    COVERED      kind -> what writes it
    exported     the terms of a certificate that the checker has verified just now; raises NotCovered, checker.Rejected, checker.Malformed
    translated   the same of one that is well formed, whatever the checker would say of it: tests see that Rocq, too, finds it false
    written      a file with the theorems about the concrete systems, proved by computation; FILE is its name

No string of a certificate reaches the file. Every number goes through the checker's own parser (`checker.rational`, `checker.index`) to an
integer of Python, and what writes integers (`terms.py`) takes nothing else. The checker's meter bounds the work.

Here are the kinds over Q; those over GF(p) and Q(a) are in export_fields.py. Systems are written with transposed matrices (signals
are rows in the theory), as integers over one common denominator. Two things in the terms are not in the certificate: words whose outputs
are independent modulo its prime, which show the lower bounds that `checker.py` finds by elimination, or three minors, where it does so at
a point; and combinations of demands likewise. `listed.py` computes them. Where window ranks have "nulling", of
which Rocq knows nothing, exact rows are found and stand in the place of the witness.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from operator import mul
from typing import Any

from ...exact.structure.kernel_rows import kernel_representation
from ...exact.system.systems import read_system
from ..trust import checker, checker_structure
from ..trust.kernel_witnesses import kernel_witness
from .export_fields import FIELD_KINDS, finite_zeros, infinite_zeros
from .export_limits import LIMIT_KINDS, schur_stable
from .export_lines import left_invertible_line
from .listed import Integers, Listed, NotCovered, added, independent, times, unit
from .terms import AT_FIRST, Terms, call, determines, index, indices, natural, naturals, pivoted, sequence, table, vector, whole, window_of

Json = Any
Kernel = list[tuple[int, Integers]]
MAX_TEXT = 2**20
MODULES = (
    "Vocabulary", "CertificatesVocabulary", "Lists", "ListedSystems", "CheckRows", "CheckRanks", "CheckBehaviors", "Solutions",
    "CheckSolutions", "CheckInversion", "Stacks", "Excitation", "TableRank", "CheckMatrices", "NumbersVocabulary", "FieldArithmetic",
    "FieldBehaviors", "FieldSolutions", "FieldInversion", "FieldMatrices", "FieldZeros", "FieldInfiniteZeros",
    "FieldLines", "ExperimentsVocabulary", "Stability", "FieldLimits", "FieldInputs",
)  # fmt: skip
# What is stated is read by the words of the vocabularies alone, which the locks hold. Only then come the files that prove it, since
# one of these could have another meaning for a word. One could have a module C0, too: so at the end, what is to be proved has its whole
# name, from that of the file on, which Rocq lets nothing hide that is loaded later.
FILE = "Certified.v"
HEAD = f"""From Coq Require Import ZArith.
From mathcomp Require Import all_ssreflect all_algebra.
From faultspace Require Import {" ".join(name for name in MODULES if name.endswith("Vocabulary"))}.
Import GRing.Theory.
Local Open Scope ring_scope.
"""
PROOFS = f"From faultspace Require Import {' '.join(MODULES)}.\n"


def exported(certificate: Json) -> Terms:
    """Return the terms of a certificate, once the checker has verified it. Raises what `verify` raises, and NotCovered."""
    checker.verify(certificate)
    try:
        return translated(certificate)
    except checker.Rejected as error:  # the certificate is right, and writing it out is more than its own meter allows
        raise NotCovered(f"it is too large to be written for Rocq: {error}") from None


def translated(certificate: Json) -> Terms:
    """Return the terms of a certificate whose numbers parse, verified or not. Raises checker.Malformed, checker.Rejected, NotCovered."""
    kinds = COVERED if _over_rationals(certificate["statement"]) else OVER_FIELDS
    write = kinds.get(certificate["kind"])
    if write is None:
        raise NotCovered(f"the checks in Rocq do not speak of the kind {checker.shorten(certificate['kind'])}")
    checker.begin()
    try:
        terms = write(certificate["statement"], certificate["witness"])
    except (KeyError, TypeError, ValueError, IndexError, AttributeError) as error:
        raise checker.Malformed(f"the certificate does not parse: {ascii(str(error))[:80]}") from None
    if sum(len(term) for _, _, term in terms.definitions) > MAX_TEXT:
        raise NotCovered(f"the terms for Rocq are longer than {MAX_TEXT} characters")
    return terms


def _over_rationals(statement: Json) -> bool:
    """Say whether no system of a statement names another field."""
    about = [statement[key] for key in checker.SUBJECTS if key in statement] if type(statement) is dict else []
    return all(type(one) is not dict or one.get("field", "Q") == "Q" for one in about)


def written(terms: Sequence[Terms]) -> str:
    """Return a file with all theorems, which ends by asking what they rest on."""
    claims = "".join(f"Module C{i}.\n{t.claimed()}End C{i}.\n" for i, t in enumerate(terms))
    proofs = "".join(f"Module P{i}.\nImport C{i}.\n{t.proof()}End P{i}.\n" for i, t in enumerate(terms))
    names = ", ".join(f"P{i}.certified : {FILE.removesuffix('.v')}.C{i}.said" for i in range(len(terms)))
    return f"{HEAD}{claims}{PROOFS}{proofs}Definition certified := ({names or 'I'}).\nPrint Assumptions certified.\n"


# -- the kinds ---------------------------------------------------------------------------------------------------------


def _window_ranks(s: Json, w: Json) -> Terms:
    if "nulling" in w:  # of which Rocq knows nothing: exact rows prove the same, and whoever finds them is not believed
        w = kernel_witness(kernel_representation(read_system(s["system"])))
    system, prime, exact = Listed(s["system"]), _prime(w), "kernel" in w
    kernel = _kernel(w["kernel" if exact else "kernel_modulo"])
    r, etas, ranks = index(s["normal_rank"]), naturals(indices(s["left_minimal_indices"])), naturals(indices(s.get("window_ranks", [])))
    name = system.named("system")
    formula = f"(forall s, \\rank (window {name} s) = s * {natural(r)} + \\sum_(eta <- {etas}) minn s eta)%N"
    lower = _lower("lower", system, kernel, w, prime) if exact else ("lower", "hints", system.hints(kernel, w["point"], prime))
    suffix = "" if exact else "_modulo"
    return Terms(
        (_named("system", system), _modulus(prime), _rows(kernel), lower),
        call(f"check_window_ranks{suffix}", *system.sizes, r, etas, ranks, "l system rows lower"),
        f"{formula} /\\ [seq \\rank (window {name} s) | s <- iota 1 {natural(len(s.get('window_ranks', [])))}] = {ranks}",
        f"window_ranks{suffix}_sound",
    )


def _left_invertible(s: Json, w: Json) -> Terms:
    system, prime = Listed(s["system"]), _prime(w)
    statement = f"left_invertible {system.named('system')}"
    if "point" in w:
        point, minor = system.pencil_minor(w["point"], prime)
        return Terms(
            (_named("system", system), _modulus(prime), ("q", "option Z", point)),
            call("check_left_invertible_at", *system.sizes, f"l system q {minor}"),
            statement,
            "left_invertible_at_sound",
        )
    return Terms(
        (_named("system", system), _modulus(prime), _words("ws", system, system.n + 1, prime)),
        call("check_left_invertible", *system.sizes, "l system ws"),
        statement,
        "left_invertible_sound",
    )


def _not_left_invertible(s: Json, w: Json) -> Terms:
    system = Listed(s["system"])
    scale = checker.common_denominator(checker.rational(x, "witness")[1] for part in (w["state"], w["fault"]) for one in part for x in one)
    xs, vs = ([_scaled(one, scale * system.den**k) for k, one in enumerate(reversed(w[key]))] for key in ("state", "fault"))
    return Terms(
        (_named("system", system), ("xs", "seq vector", table([*xs, [0] * system.n])), ("vs", "seq vector", table(vs))),
        call("check_not_left_invertible", *system.sizes, "system xs vs"),
        f"~ left_invertible {system.named('system')}",
        "not_left_invertible_sound",
    )


def _inclusion(s: Json, w: Json) -> Terms:
    inner, outer, prime = Listed(s["inner"]), Listed(s["outer"]), _prime(w)
    a, b, kernel = inner.named("inner"), outer.named("outer"), _kernel(w["kernel"])
    return Terms(
        (_named("inner", inner), _named("outer", outer), _modulus(prime), _rows(kernel), _lower("lower", outer, kernel, w, prime)),
        call("check_inclusion", inner.n, inner.m, *outer.sizes, "l inner outer rows lower"),
        f"(forall s r, word {a} s r -> word {b} s r) /\\ (forall r, behavior {a} r -> behavior {b} r)",
        "inclusion_sound",
    )


def _equality(s: Json, w: Json) -> Terms:
    first, second, prime = Listed(s["first"]), Listed(s["second"]), _prime(w)
    a, b, kernel = first.named("first"), second.named("second"), _kernel(w["kernel"])
    shape, definitions = (
        (first.n, first.m, *second.sizes),
        (_named("first", first), _named("second", second), _modulus(prime), _rows(kernel)),
    )
    if "window" not in s:
        lower = (_lower("lower", first, kernel, w, prime), _lower("lower'", second, kernel, w, prime))
        statement = f"(forall s, same_words {a} {b} s) /\\ same_behavior {a} {b}"
        check = call("check_equality", *shape, "l first second rows lower lower'")
        return Terms((*definitions, *lower), check, statement, "equality_sound")
    window = window_of(s["window"])
    words = (_words("ws", first, window, prime), _words("ws'", second, window, prime))
    statement = f"same_words {a} {b} {natural(window)}"
    check = call("check_window_equality", *shape, window, "l first second rows ws ws'")
    return Terms((*definitions, *words), check, statement, "window_equality_sound")


def _difference(s: Json, w: Json) -> Terms:
    first, second, window = Listed(s["first"]), Listed(s["second"]), window_of(s["window"])
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
        f"exists2 r, word {first.named('first')} {natural(window)} r & ~ word {second.named('second')} {natural(window)} r",
        "difference_sound",
    )


def _fault_space(s: Json, w: Json) -> Terms:
    system, prime, window = Listed(s["system"]), _prime(w), None if s["window"] is None else window_of(s["window"])
    width = system.n + system.p
    given = _kernel(w["kernel"])
    kernel = [row for _, row in given if window is None or "point" not in w or len(row) <= window]
    basis, d = _cleared(s["basis"])
    pivots = [next((j for j, x in enumerate(row) if x), width) for row in basis]
    beyond = max((len(row) - 1 for row in kernel), default=0) if window is None else window
    checker.charge(200 * sum(map(len, kernel)) * (width + 1) ** 2 * (1 + beyond * system.den.bit_length() // 60))
    demands = [demand for row in kernel for demand in system.demands(row)]
    checker.charge(len(demands) * (width + len(demands)) * (100 + 2 * width), 100 * len(demands) * (width + len(demands)))
    combinations = pivoted(independent(demands, width, prime))
    check = "check_limit" if window is None else "check_solutions"
    at, shape = "s" if window is None else natural(window), f"{natural(len(basis))} {natural(width)}"
    space = f"spans_solutions {system.named('system')} {at} (fraction d {shape} basis)"
    return Terms(
        (
            _named("system", system),
            _modulus(prime),
            _rows(given),
            _lower("lower", system, given, w, prime, window),
            ("d", "Z", whole(d)),
            ("basis", "table", table(basis)),
            ("combinations", "seq (nat * vector)", combinations),
        ),
        call(check, *system.sizes, beyond, "l system rows lower d basis", naturals(pivots), "combinations"),
        f"forall s, ({natural(beyond)} < s)%N -> {space}" if window is None else space,
        "limit_sound" if window is None else "solutions_sound",
    )


def _first_column_only(s: Json, w: Json) -> Terms:
    system, prime, window = Listed(s["system"]), _prime(w), window_of(s["window"])
    (z,), d = _cleared([s["column"]])
    kernel = _kernel(w["kernel"])
    name, f, g = system.named("system"), f"(recorded d {natural(system.n)} f)", f"(recorded d {natural(system.p)} g)"
    response = f"output (with_faults {name} {f} {g}) 0 {AT_FIRST}"
    return Terms(
        (
            _named("system", system),
            _modulus(prime),
            _rows(kernel),
            _lower("lower", system, kernel, w, prime, window),
            ("d", "Z", whole(d)),
            ("f", "vector", vector(z[: system.n])),
            ("g", "vector", vector(z[system.n :])),
        ),
        call("check_first_column", *system.sizes, window, "l system rows lower d f g"),
        f"word {name} {natural(window)} ({response}) /\\ ~ solves {name} {natural(window)} {f} {g}",
        "first_column_sound",
    )


def _inversion_delay(s: Json, w: Json) -> Terms:
    system, delay = Listed(s["system"]), None if s["delay"] is None else index(s["delay"], checker.MAX_DIMENSION)
    known = {"known": "true", "unknown": "false"}[s["initial_state"]]
    name = system.named("system")
    x0, v = _integral_word(system, w["word"]) if delay != 0 else ([], [])
    definitions = _named("system", system), ("x", "vector", vector(x0)), ("vs", "seq vector", table(v))
    if delay is None:
        statement = f"forall j, (j <= {natural(system.n)})%N -> ~ {determines(name, known, 'j')}"
        return Terms(definitions, call("check_no_delay", *system.sizes, known, "system x vs"), statement, "no_delay_sound")
    rows, least = [], natural(delay)
    for given in w["inverse"] or [[]] * system.m:
        (row,), scale = _cleared([given])
        rows.append(f"({whole(scale)}, {table(row[k * system.p : (k + 1) * system.p] for k in range(delay + 1))})")
    return Terms(
        (*definitions, ("rows", "seq (Z * seq vector)", sequence(rows))),
        call("check_delay", *system.sizes, known, delay, "system rows x vs"),
        f"[/\\ ({least} <= {natural(system.n)})%N, {determines(name, known, least)} & "
        f"forall j, (j < {least})%N -> ~ {determines(name, known, 'j')}]",
        "delay_sound",
    )


def _matrix_rank(s: Json, w: Json) -> Terms:
    system, prime, r, name = Listed(s["system"]), _prime(w), index(s["rank"]), s["matrix"]
    checker.expect(type(name) is str and name in checker_structure.MATRICES, "matrix: unknown name")
    n, m, p = system.sizes
    samples, e, given = window_of(s["window"]) if "window" in s else n, system.den, list[tuple[str, str, str]]()
    system.bounded(samples)
    meant, data, sizes = system.named("system"), "", [n, m, p, samples, r]
    if name in ("observability", "toeplitz", "window"):
        rows = [] if name == "toeplitz" else [system.response(unit(n, i), [0] * m, samples, prime) for i in range(n)]
        if name != "observability":
            from_rest = [system.response([0] * n, unit(m, i), samples, prime) for i in range(m)]
            rows += [[0] * (p * j) + response[: p * (samples - j)] for j in range(samples) for response in from_rest]
        width, weights = samples * p, [e ** (samples - 1 - k) for k in range(samples) for _ in range(p)]
        matrix = f"{ {'observability': 'O', 'toeplitz': 'T', 'window': 'window'}[name] } {meant} {natural(samples)}"
    elif name == "reachability":
        blocks = [system.F]
        while len(blocks) < n:
            blocks.append([added(times(row, system.A, n), [0] * n, prime) for row in blocks[-1]])
        rows = [row for block in blocks[:n] for row in block]
        width, weights, matrix = n, [1] * n, f"reachability {meant}"
    else:
        (x0, *v), d = _cleared([s["x0"], *s["v"]])
        count = len(v) - samples + 1
        checker.expect(count > 0, "window: more than there are samples")
        checker.charge(len(v) * ((n + m + p + 1) ** 2 * 100 + len(v) * e.bit_length() ** 2 // 100))
        checker.charge(count * (n + samples * (m + p) + count) * (200 + 2 * count), 100 * count * (n + samples * (m + p) + count))
        states, faults, outputs = system.trajectory(x0, v, prime)
        given += [("d", "Z", whole(d)), ("x", "vector", vector(x0)), ("vs", "seq vector", table(v))]
        sizes, data = [n, m, p, count, samples, r], "d x vs"
        trajectory = f"(recorded d {natural(n)} x) (fun k => recorded d {natural(m)} (nth [::] vs k))"
        tail, wide = (outputs, p) if name == "residual-hankel" else (faults, m)
        rows = [[x for one in tail[i : i + samples] for x in one] for i in range(count)]
        width, weights = samples * wide, [e ** (samples - 1 - k) for k in range(samples) for _ in range(wide)]
        matrix = f"hankel {natural(count)} {natural(samples)} (output {meant} {trajectory})"
        if name == "excitation":
            rows = [states[i] + row for i, row in enumerate(rows)]
            width, weights = n + width, [e ** max(samples - 1, 0)] * n + weights
            matrix = f"excitation {meant} {trajectory} {natural(count)} {natural(samples)}"
    if name in ("observability", "reachability"):
        sizes = [n, m, p, r]
    lemma = {"residual-hankel": "hankel"}.get(name, name)
    checker.charge(len(weights) * (samples * e.bit_length()) ** 2 // 1000, len(weights) * samples * e.bit_length() // 8)
    nulls = [(index(row["pivot"]), list(map(mul, _integers(row["row"]), weights))) for row in w["left_null"]]
    return Terms(
        (
            _named("system", system),
            _modulus(prime),
            *given,
            ("nulls", "seq (nat * vector)", pivoted(nulls)),
            ("combinations", "seq (nat * vector)", pivoted(independent(rows, width, prime))),
        ),
        call(f"check_{lemma}", *sizes, "l system", data, "nulls combinations"),
        f"\\rank ({matrix}) = {natural(r)}%N",
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
    "finite-zeros": finite_zeros,
    "infinite-zeros": infinite_zeros,
    "left-invertible-line": left_invertible_line,
    **LIMIT_KINDS,
}
OVER_FIELDS = {**FIELD_KINDS, "schur-stable": schur_stable, "left-invertible-line": left_invertible_line}


# -- parts -------------------------------------------------------------------------------------------------------------


def _prime(w: Json) -> int:
    prime = index(w["prime"], checker.MAX_PRIME)
    checker.require(checker.is_prime(prime), f"{prime} is not a prime")
    return prime


def _integers(values: Json) -> list[int]:
    return [checker.rational(value, "a number", integral=True)[0] for value in values]


def _kernel(rows: Json) -> Kernel:
    """Return pivots and coefficients of kernel rows."""
    return [(index(row["pivot"]), [_integers(c) for c in row["coefficients"]]) for row in rows]


def _rows(kernel: Kernel) -> tuple[str, str, str]:
    return "rows", "seq kernel_row", sequence(f"({natural(pivot)}%N, {table(row)})" for pivot, row in kernel)


def _lower(name: str, system: Listed, kernel: Kernel, w: Json, prime: int, window: int | None = None) -> tuple[str, str, str]:
    """Return what shows a lower bound: the hints of the witness, or words, of one more sample than there are states or of a window."""
    if "point" in w:
        return name, "evidence", f"inr ({system.hints(kernel, w['point'], prime)})"
    return name, "evidence", f"inl {system.words(system.n + 1 if window is None else window, prime)}"


def _named(name: str, system: Listed) -> tuple[str, str, str]:
    return name, "listed", system.term


def _words(name: str, system: Listed, samples: int, prime: int) -> tuple[str, str, str]:
    return name, "seq sampled_word", system.words(samples, prime)


def _modulus(prime: int) -> tuple[str, str, str]:
    return "l", "Z", whole(prime)


def _scaled(values: Json, factor: int) -> list[int]:
    """Return RATIONALs times a factor that all denominators divide."""
    checker.charge(len(values) * (200 + factor.bit_length() ** 2 // 500), len(values) * factor.bit_length() // 4)
    return [top * factor // bottom for top, bottom in (checker.rational(x, "a number") for x in values)]


def _cleared(rows: Json) -> tuple[Integers, int]:
    """Return rows of RATIONALs as integers over their common denominator."""
    den = checker.common_denominator(checker.rational(x, "a number")[1] for row in rows for x in row)
    return [_scaled(row, den) for row in rows], den


def _integral_word(system: Listed, word: Json) -> tuple[list[int], Integers]:
    """Return a word of the integer system: v(k) times the k-th power of its denominator, all times what clears fractions."""
    _, scale = _cleared([word["x0"], *word["v"]])
    checker.charge((len(word["v"]) ** 3 + 1) * system.den.bit_length() ** 2 // 2000)
    return _scaled(word["x0"], scale), [_scaled(v, scale * system.den**k) for k, v in enumerate(word["v"])]
