"""The card of a claim: what is said, the verdict in a sentence, what goes wrong in numbers, what is true instead, and why to believe it.

Card     one claim's card, from which terminal, report, site and JSON are made
card     from a claim as a run has decided it
with_cards   what a report is in JSON, each claim with its card
values   the numbers that the certificates of a refuted reading state, by the names that the sentences of cards.toml use
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from fractions import Fraction
from typing import Any

from ...base.sheets import counted
from ...exact.algebra.matrices import Matrix, beside, rank, right_null_space
from ...exact.system.systems import ResidualSystem, read_system, residual_of
from ...exact.system.windows import window_matrix
from ..trust.structure_certificates import Certificate
from .ledger import sentences
from .verdicts import ClaimResult, ReadingResult, Report, Verdict

MOST_NAMED = 3  # theorems that a card names
UNCHECKED = "The theorems behind this were not checked in this run."
Put = Callable[[str, Any], None]
Believed = Mapping[str, str | None] | None  # of a Report


@dataclass(frozen=True)
class Wrong:
    """What goes wrong in a reading: `system` is the counterexample, `sentence` says with its numbers what it does.

    `matrices` are its matrices by name, as rows of texts, and `others` those in which a second system differs.
    """

    reading: str
    system: str
    sentence: str
    matrices: Mapping[str, list[list[str]]]
    others: Mapping[str, list[list[str]]]


@dataclass(frozen=True)
class Card:
    """One claim: `group` is paper, review or ours, `place` is where it stands, `said` its words, `verdict` a sentence, `level` a Verdict.

    `wrong` has a counterexample of each reading that matters, `instead` what is true in its place ("" where the claim is), `why` the
    reasons to believe it, a sentence each.
    """

    id: str
    group: str
    place: str
    said: str
    level: str
    verdict: str
    wrong: tuple[Wrong, ...]
    instead: str
    why: tuple[str, ...]

    def to_json(self) -> dict[str, Any]:
        """Return the object in `verify --json`."""
        return asdict(self) | {"wrong": [asdict(one) for one in self.wrong], "why": list(self.why)}


def card(result: ClaimResult, believed: Believed = None) -> Card:
    """Return the card of a claim; `believed` names the programs that checked theorems.

    Its sentences are withheld where a verdict is not the expected one: then it says which.
    """
    claim = result.claim
    words = sentences().get(claim.id) or {"verdict": f"{result.verdict.meaning}.", "instead": ""}
    if result.as_expected:
        named = {one.reading.id: one for one in result.readings}
        shown = [(named[name], sentence) for name, sentence in words.get("wrong", {}).items()]
        wrong = tuple(_wrong(one, sentence) for one, sentence in shown if one.outcome.certificates)
        unchecked = any(one.locks for one in result.readings) and not any(one.machine_checked for one in result.readings)
        verdict, instead = f"{words['verdict']} {UNCHECKED}" if unchecked else words["verdict"], words["instead"]
    else:
        others = [one for one in result.readings if not one.as_expected]
        different = [f"{one.reading.id} is {one.outcome.verdict}, {one.expected} expected" for one in others]
        different = different or [f"the claim is {result.verdict}, {result.expected} expected"]
        verdict, instead, wrong = f"NOT as expected: {'; '.join(different)}.", "", ()
    why = tuple(_reasons(result, believed))
    return Card(claim.id, claim.group, claim.reference, claim.statement, str(result.verdict), verdict, wrong, instead, why)


def with_cards(report: Report) -> dict[str, Any]:
    """Return what the report is in JSON, with the `card` of each claim."""
    found = report.to_json()
    for said, result in zip(found["claims"], report.claims, strict=True):
        said["card"] = card(result, report.believed).to_json()
    return found


def _wrong(result: ReadingResult, sentence: str) -> Wrong:
    certificates = result.outcome.certificates
    said = certificates[0]["statement"]
    system, second = _subject(said), said.get("second", {})
    matrices = {name: _entries(system[name]) for name in "ABCDFG" if name in system}
    others = {name: _entries(second[name]) for name in "ACFG" if name in second and second[name] != system[name]}
    words = ", ".join(f"{name} = {_text(rows)}" for name, rows in matrices.items())
    also = "; and with " + ", ".join(f"{name} = {_text(rows)}" for name, rows in others.items()) if others else ""
    sizes = f"; s = {system['s']}, past = {system['past']}" if "s" in system else ""
    field = " over Q(a)" if "field" in system else ""
    return Wrong(result.reading.id, f"{words}{field}{sizes}{also}", sentence.format(**values(certificates)), matrices, others)


def _subject(statement: Mapping[str, Any]) -> Mapping[str, Any]:
    found: Mapping[str, Any] = next(statement[name] for name in ("experiment", "system", "first") if name in statement)
    return found


def _text(rows: Sequence[Sequence[Any]]) -> str:
    """Return a matrix on one line, a number alone where it has one entry, and its columns with a prime where it is one column."""
    entries = _entries(rows)
    if len(entries) == 1 and len(entries[0]) == 1:
        return entries[0][0]
    if entries and all(len(row) == 1 for row in entries):
        return f"({', '.join(row[0] for row in entries)})'"
    return f"[{'; '.join(' '.join(row) for row in entries)}]"


def _entries(rows: Sequence[Sequence[Any]]) -> list[list[str]]:
    return [[_entry(x) for x in row] for row in rows]


def _entry(x: Any) -> str:
    if not isinstance(x, list):
        return str(x)
    powers = ["", "a", *(f"a^{k}" for k in range(2, len(x)))]
    terms = [power if c == "1" and power else f"{c} {power}".rstrip() for c, power in zip(map(str, x), powers, strict=False) if c != "0"]
    return " + ".join(terms) or "0"


def values(certificates: Sequence[Certificate]) -> dict[str, Any]:
    """Return the numbers by name; of what is stated twice, of a second system, the name ends in `_second`."""
    found: dict[str, Any] = {}

    def put(name: str, value: Any) -> None:
        found.setdefault(f"{name}_second" if name in found else name, value)

    for one in certificates:
        statement = one["statement"]
        if one["kind"] in _STATED:
            _STATED[one["kind"]](statement, put)
        system = _subject(statement)
        found.setdefault("n", len(system["A"]))
        found.setdefault("m", len(system["F"][0]) if system["F"] else 0)
    for name, make in _DERIVED.items():
        if set(name.split()) <= set(found):
            found |= make(found)
    if len(certificates) and "system" in certificates[0]["statement"]:
        found |= _without_outputs(_residual(certificates[0]["statement"]["system"]))
    return found


def _residual(system: Mapping[str, Any]) -> ResidualSystem:
    return residual_of(read_system(system))


def _input_limit(said: Mapping[str, Any], put: Put) -> None:
    if said["regression"] == "true-AC":
        for name in "BD":
            put(f"{name}_found", _text(said[name]))
            put(name, _text(said["experiment"][name]))


def _moesp_limit(said: Mapping[str, Any], put: Put) -> None:
    suffix = "" if said["instruments"] == "past-inputs" else "_outputs"
    for name in ("limit_rank", "observability_rank", "joint_rank"):
        put(f"{name}{suffix}", said[name])
    if "den" in said["experiment"]["u_filter"]:
        terms = [(Fraction(c), f"u(k-{k})" if k else "u(k)") for k, c in enumerate(said["experiment"]["u_filter"]["den"])]
        put("u_equation", " + ".join(name if c == 1 else f"{c} {name}" for c, name in terms if c).replace("+ -", "- ") + " = e(k)")


def _matrix_rank(said: Mapping[str, Any], put: Put) -> None:
    if said["matrix"] == "excitation":
        put("s_data", said["window"])
        put("excited", said["rank"])
    elif said["matrix"] == "residual-hankel":
        put("hankel", said["rank"])
    else:
        put(said["matrix"], said["rank"])


def _fault_space(said: Mapping[str, Any], put: Put) -> None:
    put("columns_limit" if said["window"] is None else "columns_window", len(said["basis"]))
    put("basis", "; ".join(f"({', '.join(map(_entry, one))})" for one in said["basis"]))
    if said["window"] is None and said["basis"]:
        below = Matrix.of([one[len(said["system"]["A"]) :] for one in said["basis"]], _residual(said["system"]).field)
        put("columns_zero", len(said["basis"]) - rank(below))


def _difference(said: Mapping[str, Any], put: Put) -> None:
    first, second = _residual(said["first"]), _residual(said["second"])
    words, others = window_matrix(first, said["window"]), window_matrix(second, said["window"])
    alone = next(k for k in range(words.ncols) if rank(beside(others, words.columns([k]))) > rank(others))
    word, p = words.columns([alone]).to_json(), first.p
    put("window_differ", said["window"])
    put("word", ", ".join(_text(word[k : k + p]) for k in range(0, len(word), p)))


def _window_ranks(said: Mapping[str, Any], put: Put) -> None:
    put("ranks", said["window_ranks"])


def _bad_pair(said: Mapping[str, Any], put: Put) -> None:
    put("F_bad", _text(said["system"]["F"]))
    put("G_bad", _text(said["system"]["G"]))


_STATED: Mapping[str, Callable[[Mapping[str, Any], Put], None]] = {
    "input-limit": _input_limit,
    "moesp-limit": _moesp_limit,
    "matrix-rank": _matrix_rank,
    "fault-space": _fault_space,
    "behaviour-difference": _difference,
    "window-equality": lambda said, put: put("window_equal", said["window"]),
    "window-ranks": _window_ranks,
    "finite-zeros": lambda said, put: put("finite", len(said["invariant_zero_polynomial"]) - 1),
    "inversion-delay": lambda said, put: put("delay", said["delay"]),
    "not-left-invertible": _bad_pair,
}


def _low(found: Mapping[str, Any]) -> dict[str, Any]:
    """Return the first window that max(l, n - 1) allows, with the two ranks whose difference is the gap."""
    s = max(found["delay"], found["n"] - 1, 1)
    low, following = found["ranks"][s - 1 : s + 1]
    return {"s_low": s, "rank_low": low, "rank_next": following, "gap_low": following - low}


def _formula(found: Mapping[str, Any]) -> dict[str, Any]:
    """Return what the rank formula gives for s = n with the finite zeros alone, and the rank."""
    s = max(found["n"], 1)
    return {"s": s, "formula": found["n"] + s * found["m"] - found["finite"], "rank": found["ranks"][s - 1]}


_DERIVED: Mapping[str, Callable[[Mapping[str, Any]], dict[str, Any]]] = {
    "delay ranks": _low,
    "finite ranks": _formula,
    "hankel hankel_second": lambda found: {"hankel_low": found["hankel"], "hankel_next": found["hankel_second"]},
}


def _without_outputs(system: ResidualSystem) -> dict[str, Any]:
    """Return a first state and first fault after which the state is 0 and no output was other than 0; {} where there are none."""
    pair = right_null_space(Matrix.of([*beside(system.A, system.F).to_json(), *beside(system.C, system.G).to_json()], system.field))
    if not pair.ncols:
        return {}
    one = pair.columns([0]).to_json()
    return {"x0": _text(one[: system.n]), "v0": _text(one[system.n :])}


def _reasons(result: ClaimResult, believed: Believed) -> list[str]:
    """Return why to believe the verdicts: theorems, certificates, and where only no counterexample was found."""
    readings = result.readings
    names = list(dict.fromkeys(name for one in readings for name in one.locks))
    checked = any(one.machine_checked for one in readings)
    reasons = []
    if names:
        more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
        by = f" {believed['version']} ({believed['coqc']})" if believed else ""
        how = f"that Rocq{by} has checked, without axioms" if checked else "that Rocq checks with --rocq; in this run it has not"
        reasons.append(f"{counted(len(names), 'theorem')} {how}: {', '.join(names[:MOST_NAMED])}{more} (proofs/theory/headlines).")
    accepted = len({one for reading in readings for one in reading.outcome.all_decided})
    if accepted:
        command = f"faultspace verify --claim {result.claim.id} --out RUN && faultspace check RUN/*-*.json"
        reasons.append(f"{counted(accepted, 'certificate')} accepted by the checker in this run. To check those of the readings: {command}")
    tried = [one.reading.id for one in readings if one.outcome.verdict == Verdict.CERTIFIED]
    if tried:
        reasons.append(f"No counterexample was found, or an example is there, which is no proof for all systems: {', '.join(tried)}.")
    return reasons


def hold(result: ClaimResult) -> str:
    """Return how many readings of a claim hold."""
    refuted = sum(one.outcome.verdict == Verdict.REFUTED for one in result.readings)
    return f"readings that hold: {len(result.readings) - refuted} of {len(result.readings)}"
