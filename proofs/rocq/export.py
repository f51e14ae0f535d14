"""A certificate as a file of Rocq: its system, statement and witness as terms, the checks of theory/checks recomputed by the kernel.

    COVERED      the kinds that there are
    exported     the terms of a certificate that the checker has verified just now; raises NotCovered, checker.Rejected, checker.Malformed
    translated   the same of one that is well formed, whatever the checker would say of it: tests see that Rocq, too, finds it false
    written      a file with the theorems about the concrete systems, proved by computation; FILE is its name

No string of a certificate reaches the file. Every number goes through the checker's own parser (`checker.rational`, `checker.index`) to an
integer of Python, and what writes integers (`terms.py`) takes nothing else. The checker's meter bounds the work.

Each kind is written once, of systems as either room of the theory has them: over Q as integers over one common denominator, with lower
bounds modulo the prime of the certificate (`listed.py`); over GF(p) and Q(a) as numbers of the field (`numbered.py`). Over all of them in
the second way: zeros (`export_zeros.py`), lines (`export_lines.py`), stability and limits (`export_limits.py`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ..trust import checker, checker_structure
from .export_limits import LIMIT_KINDS
from .export_lines import left_invertible_line
from .export_zeros import finite_zeros, infinite_zeros
from .listed import Listed, NotCovered
from .numbered import Numbered, system_of
from .terms import AT_FIRST, Definition, Listing, Rows, Terms, determines, index, indices, natural, naturals, window_of

Json = Any
Read = Callable[[Json, Json], Listed | Numbered]  # a system and the witness
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
    kind, rational = certificate["kind"], _over_rationals(certificate["statement"])
    if kind not in COVERED or (kind in OF_EXPERIMENTS and not rational):
        raise NotCovered(f"the checks in Rocq do not speak of the kind {checker.shorten(kind)}")
    checker.begin()
    try:
        if kind in ALIKE:
            terms = ALIKE[kind](certificate["statement"], certificate["witness"])
        else:
            terms = KINDS[kind](Listed if rational else system_of, certificate["statement"], certificate["witness"])
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


def _window_ranks(read: Read, s: Json, w: Json) -> Terms:
    system = read(s["system"], w)
    check, shown = system.of_all_windows()
    r, etas, ranks = index(s["normal_rank"]), naturals(indices(s["left_minimal_indices"])), naturals(indices(s.get("window_ranks", [])))
    name = system.named("system")
    formula = f"(forall s, \\rank (window {name} s) = s * {natural(r)} + \\sum_(eta <- {etas}) minn s eta)%N"
    return system.terms(
        check,
        (*system.sizes, r, etas, ranks),
        (*system.modulus(), system.definition("system"), *shown),
        f"{formula} /\\ [seq \\rank (window {name} s) | s <- iota 1 {natural(len(s.get('window_ranks', [])))}] = {ranks}",
    )


def _left_invertible(read: Read, s: Json, w: Json) -> Terms:
    system = read(s["system"], w)
    check, shown = system.of_full_rank()
    definitions = *system.modulus(), system.definition("system"), *shown
    return system.terms(check, system.sizes, definitions, f"left_invertible {system.named('system')}")


def _not_left_invertible(read: Read, s: Json, w: Json) -> Terms:
    system = read(s["system"], w)
    xs, vs = system.silent()
    definitions = system.definition("system"), _table(system, "xs", [*xs, system.unit(system.n, -1)]), _table(system, "vs", vs)
    return system.terms("not_left_invertible", system.sizes, definitions, f"~ left_invertible {system.named('system')}")


def _inclusion(read: Read, s: Json, w: Json) -> Terms:
    inner, outer = read(s["inner"], w), read(s["outer"], w)
    a, b, kernel = inner.named("inner"), outer.named("outer"), outer.kernel(w["kernel"])
    systems = inner.definition("inner"), outer.definition("outer")
    return outer.terms(
        "inclusion",
        (inner.n, inner.m, *outer.sizes),
        (*outer.modulus(), *systems, *outer.rows(kernel), outer.lower("", kernel)),
        f"(forall s r, word {a} s r -> word {b} s r) /\\ (forall r, behavior {a} r -> behavior {b} r)",
    )


def _equality(read: Read, s: Json, w: Json) -> Terms:
    first, second = read(s["first"], w), read(s["second"], w)
    a, b, kernel = first.named("first"), second.named("second"), first.kernel(w["kernel"])
    shape = first.n, first.m, *second.sizes
    shared = [*first.modulus(), first.definition("first"), second.definition("second"), *first.rows(kernel)]
    if "window" not in s:
        second.hinted()
        lower = first.lower("", kernel), second.lower("'", kernel)
        return first.terms("equality", shape, [*shared, *lower], f"(forall s, same_words {a} {b} s) /\\ same_behavior {a} {b}")
    window = window_of(s["window"])
    words = [(ws, "seq sampled_word", one.words(window)) for ws, one in (("ws", first), ("ws'", second))]
    return first.terms("window_equality", (*shape, window), [*shared, *words], f"same_words {a} {b} {natural(window)}")


def _difference(read: Read, s: Json, w: Json) -> Terms:
    first, second, window = read(s["first"], w), read(s["second"], w), window_of(s["window"])
    x, vs = first.word(w["x0"], w["v"])
    systems, row = (first.definition("first"), second.definition("second")), first.multiple(w["row"], first.p)
    return first.terms(
        "difference",
        (first.n, first.m, *second.sizes, window),
        (*systems, _vector(first, "x", x), _table(first, "vs", vs), _table(first, "c", row)),
        f"exists2 r, word {first.named('first')} {natural(window)} r & ~ word {second.named('second')} {natural(window)} r",
    )


def _fault_space(read: Read, s: Json, w: Json) -> Terms:
    system, window = read(s["system"], w), None if s["window"] is None else window_of(s["window"])
    width, kernel = system.n + system.p, system.kernel(w["kernel"])
    counted = system.counted(kernel, window)
    denominator, basis = system.scaled(s["basis"], width)
    pivots = [next((j for j, x in enumerate(row) if x != 0), width) for row in basis]
    beyond = max((len(row) - 1 for _, row in counted), default=0) if window is None else window
    conditions = system.conditions(counted, beyond)
    at, meant = "s" if window is None else natural(window), f"({system.matrix_of} {natural(len(basis))} {natural(width)} basis)"
    space = f"spans_solutions {system.named('system')} {at} {meant}"
    return system.terms(
        "limit" if window is None else "solutions",
        (*system.sizes, beyond),
        (
            *system.modulus(),
            system.definition("system"),
            *system.rows(kernel, window),
            system.lower("", kernel, window),
            *denominator,
            _table(system, "basis", basis),
            ("pivots", "seq nat", naturals(pivots)),
            _combinations(system, conditions, width),
        ),
        f"forall s, ({natural(beyond)} < s)%N -> {space}" if window is None else space,
    )


def _first_column_only(read: Read, s: Json, w: Json) -> Terms:
    system, window = read(s["system"], w), window_of(s["window"])
    n, p, kernel = system.n, system.p, system.kernel(w["kernel"])
    denominator, (z,) = system.scaled([s["column"]], n + p)
    name, f, g = system.named("system"), f"({system.vector_of} {natural(n)} first)", f"({system.vector_of} {natural(p)} rest)"
    shown = *system.rows(kernel, window), system.lower("", kernel, window), *denominator
    return system.terms(
        "first_column",
        (*system.sizes, window),
        (*system.modulus(), system.definition("system"), *shown, _vector(system, "first", z[:n]), _vector(system, "rest", z[n:])),
        f"word {name} {natural(window)} (output (with_faults {name} {f} {g}) 0 {AT_FIRST}) /\\ ~ solves {name} {natural(window)} {f} {g}",
    )


def _inversion_delay(read: Read, s: Json, w: Json) -> Terms:
    system, delay = read(s["system"], w), None if s["delay"] is None else index(s["delay"], checker.MAX_DIMENSION)
    known, name = {"known": "true", "unknown": "false"}[s["initial_state"]], system.named("system")
    x, vs = system.word(w["word"]["x0"], w["word"]["v"]) if delay != 0 else ([], [])
    word = _vector(system, "x", x), _table(system, "vs", vs)
    if delay is None:
        none = f"forall j, (j <= {natural(system.n)})%N -> ~ {determines(name, known, 'j')}"
        return system.terms("no_delay", (*system.sizes, known), (system.definition("system"), *word), none)
    rows, least = system.inverses(w["inverse"] or [[]] * system.m, delay), natural(delay)
    return system.terms(
        "delay",
        (*system.sizes, known, delay),
        (system.definition("system"), rows, *word),
        f"[/\\ ({least} <= {natural(system.n)})%N, {determines(name, known, least)} & "
        f"forall j, (j < {least})%N -> ~ {determines(name, known, 'j')}]",
    )


def _matrix_rank(read: Read, s: Json, w: Json) -> Terms:
    system, r, name = read(s["system"], w), index(s["rank"]), s["matrix"]
    checker.expect(type(name) is str and name in checker_structure.MATRICES, "matrix: unknown name")
    (n, m, p), meant = system.sizes, system.named("system")
    samples = window_of(s["window"]) if "window" in s else n
    system.bounded(samples)
    given, sizes, before, wide = list[Definition](), [n, m, p], 0, p
    if name in ("observability", "toeplitz", "window"):
        rows = ([] if name == "toeplitz" else system.free(samples)) + ([] if name == "observability" else system.forced(samples))
        letter = {"observability": "O", "toeplitz": "T", "window": "window"}[name]
        matrix, sizes = f"{letter} {meant} {natural(samples)}", sizes if name == "observability" else [*sizes, samples]
    elif name == "reachability":
        rows, matrix, before, samples = system.reached(), f"reachability {meant}", n, 0
    else:
        denominator, x, vs = system.signal(s["x0"], s["v"])
        count = len(vs) - samples + 1
        checker.expect(count > 0, "window: more than there are samples")
        system.hankel_bounded(count, samples)
        states, faults, outputs = system.trajectory(x, vs)
        given, sizes = [*denominator, _vector(system, "x", x), _table(system, "vs", vs)], [*sizes, count, samples]
        trajectory = f"({system.vector_of} {natural(n)} x) ({system.signal_of.format(m=natural(m))})"
        tail, wide = (outputs, p) if name == "residual-hankel" else (faults, m)
        rows = [[e for one in tail[i : i + samples] for e in one] for i in range(count)]
        matrix = f"hankel {natural(count)} {natural(samples)} (output {meant} {trajectory})"
        if name == "excitation":
            rows, before = [states[i] + row for i, row in enumerate(rows)], n
            matrix = f"excitation {meant} {trajectory} {natural(count)} {natural(samples)}"
    nulls = system.nulls(w["left_null"], before, samples, wide)
    shown = ("nulls", "seq (nat * vector)", system.pivoted(nulls)), _combinations(system, rows, before + samples * wide)
    return system.terms(
        name.removeprefix("residual-"),
        (*sizes, r),
        (*system.modulus(), system.definition("system"), *given, *shown),
        f"\\rank ({matrix}) = {natural(r)}%N",
    )


KINDS: dict[str, Callable[[Read, Json, Json], Terms]] = {
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
# Over every field alike: over Q, too, they are of numbers of a field.
ALIKE: dict[str, Callable[[Json, Json], Terms]] = {
    "finite-zeros": finite_zeros,
    "infinite-zeros": infinite_zeros,
    "left-invertible-line": left_invertible_line,
    **LIMIT_KINDS,
}
COVERED = {*KINDS, *ALIKE}
OF_EXPERIMENTS = ("moesp-limit", "input-limit")  # covered over Q alone


# -- parts -------------------------------------------------------------------------------------------------------------


def _vector(system: Listing, name: str, row: list[Any]) -> Definition:
    return name, "vector", system.vector(row)


def _table(system: Listing, name: str, rows: Rows) -> Definition:
    return name, "seq vector", system.table(rows)


def _combinations(system: Listing, rows: Rows, width: int) -> Definition:
    return "combinations", "seq (nat * vector)", system.pivoted(system.independent(rows, width))
