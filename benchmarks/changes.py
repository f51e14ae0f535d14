"""This measures what `identify --healthy-until K` says of each kind of change: how often rightly, how soon, and how often of nothing.

    OPENBLAS_NUM_THREADS=1 python benchmarks/changes.py CASES [--records 100] [--tables 200] [--minutes 40] [--seed 1]
                                                       [--setting middle] [--table] [--markdown]

CASES is a file to which each case is written as it comes; the same command goes on with it, and ends with the tables of all that is there
(`--table`: shows them and measures nothing). Cases come in rounds of one record of every line, so that all lines have as many wherever
a run was stopped; `--minutes` are CPU minutes. The random numbers of a case are those of its seed, setting, line and number, and of
nothing else. The records are those of `changes_records.py`; settings: `short` has 5 outputs, 1 input, 160 healthy samples and 240 after,
`middle` 3, 2, 300 and 300, `usual` 3, 2, 600 and 900. The order, 3, is stated.

    right       the row of this kind and channel is seen (of a step that of mean or drift; of white and coloured noise that of growth;
                of a stuck sensor that of lost variance or of freezing), or one fault is counted
    other       something else is seen, or another number is counted
    undecided   nothing is seen, and no 0 is said
    zero        a bold 0, which is wrong
    n_v wrong   a number of faults is said that is neither 1 nor 0
    cause       right: the sensor or actuator is named alone; wrong: another one is, without it, or it is excluded; open: none is named,
                or several
    n_z         records with an n_z that the observability indices of the model's (A, C) forbid
    onset       found: one begins at the true sample or later, or its interval holds it; held: the interval does; delay: the median,
                in samples, of the first of these; early: records with one wholly before
    cpu         seconds a record, `identify` alone

Without a change the table has an alarm where any row is seen, which its level, 0.01, bounds; "n_v > 0" are records in which a fault is
counted. `--tables` are the records of which only the table is made, as `identify` makes it: the count of faults takes most of the time.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # run from a clone, installed or not

from benchmarks.changes_records import KINDS, SETTINGS, Drawn, record
from benchmarks.kept_cases import Cases, interval
from faultspace.numeric import Identification, Isolation, ShiftIsolation, arx_reduction, changes_since_healthy, identify, residual
from faultspace.numeric.method.space.largest import largest_fault_space

SIZES = (3.0, 10.0, 30.0)
LOOPS = (False, True)
RIGHT = {
    "step": ("mean shift", "drift"),
    "white fault": ("growth of variance",),
    "coloured fault": ("growth of variance",),
    "stuck": ("loss of variance", "freezing"),
}
OUTCOMES = ("right", "other", "undecided", "zero")


def told(kind: str, drawn: Drawn) -> dict[str, Any]:
    """Return what `identify` tells of a record."""
    start = time.process_time()
    answer = identify(drawn.y, drawn.u, order=3, healthy=drawn.healthy)
    values: dict[str, Any] = {"seconds": round(time.process_time() - start, 3), "n_v": answer.n_v}
    seen = answer.changes.seen if answer.changes else ()
    values |= {"rows": [f"{row.kind} {row.channel}" for row in seen], "possible": list(answer.possible), "reason": answer.reason[:300]}
    values["outcome"] = _outcome(kind, answer, drawn.channel)
    space, model = answer.fault_space, answer.model
    values["n_z"] = None
    if space is not None and space.n_v is not None and model is not None:
        most = largest_fault_space(model.A, model.C, space.n_v)
        values |= {"n_z": space.n_z, "decided": space.decided, "allowed": space.n_v <= space.n_z <= most}
    for name, found in (("space", answer.isolation), ("shift", answer.shift_isolation)):
        if found is not None:
            values[f"{name} cause"] = _cause(found, drawn.channel)
            values[f"{name} chances"] = [cause.p_value for cause in found.causes]
    onsets = answer.onset.onsets if answer.onset else ()
    values["onsets"] = [(one.sample, *one.interval) for one in onsets]
    values["begins"] = drawn.begins
    return values


def _outcome(kind: str, answer: Identification, channel: str | None) -> str:
    """Return one of the OUTCOMES."""
    if answer.n_v == 0:
        return "zero"
    rows = answer.changes.seen if answer.changes else ()
    row = any(row.kind in RIGHT.get(kind, (kind,)) and row.channel == channel for row in rows)
    if answer.n_v == 1 or (row and answer.n_v is None):
        return "right"
    return "other" if answer.at_least else "undecided"


def _cause(found: Isolation | ShiftIsolation, channel: str | None) -> str:
    """Return right, wrong or open."""
    named = [cause.channel for cause in found.causes if cause.answer == "consistent"]
    excluded = [cause.channel for cause in found.causes if cause.answer == "excluded"]
    if named == [channel]:
        return "right"
    return "wrong" if channel in excluded or (named and channel not in named) else "open"


def alarms(drawn: Drawn) -> dict[str, Any]:
    """Return the rows that are seen in the table that `identify` makes."""
    start, healthy = time.process_time(), drawn.healthy
    found = arx_reduction(drawn.y[:healthy], drawn.u[:healthy], order=3)
    r = residual(drawn.y, drawn.u, found, x0=found.x0).r
    rows = changes_since_healthy(r, drawn.y, drawn.u, healthy=healthy, model=found).seen
    return {"rows": [f"{row.kind} {row.channel}" for row in rows], "seconds": round(time.process_time() - start, 3)}


def lines() -> Iterator[tuple[str, float, bool]]:
    """Yield kind, size and feedback of every line."""
    for kind in ("none", *KINDS):
        for size in SIZES if kind != "none" else (0.0,):
            for loop in LOOPS:
                yield kind, size, loop


def measured(cases: Cases, arguments: argparse.Namespace) -> None:
    """Measure what is not there yet, in rounds."""
    cases.begin()
    setting = SETTINGS[arguments.setting]
    places = [*lines(), *(("table", 0.0, loop) for loop in LOOPS)]
    for k in range(max(arguments.records, arguments.tables)):
        for kind, size, loop in places:
            most = arguments.tables if kind == "table" else arguments.records
            key = f"{arguments.setting}, {kind}, {size:g}, {'loop' if loop else 'open'}, {arguments.seed}, {k}"
            if k >= most or key in cases.found:
                continue
            if time.process_time() > 60.0 * arguments.minutes:
                return
            place = ("none", *KINDS, "table").index(kind)
            random = np.random.default_rng((arguments.seed, list(SETTINGS).index(arguments.setting), place, int(size), loop, k))
            drawn = record("none" if kind == "table" else kind, size, setting, random, loop)
            values = alarms(drawn) if kind == "table" else told(kind, drawn)
            cases.add(key, {"setting": arguments.setting, "kind": kind, "size": size, "loop": loop, **values})


def _onset(case: dict[str, Any]) -> tuple[bool, bool, int | None, bool]:
    """Return whether an onset is found, whether its interval holds the true sample, the delay, and whether one is wholly before."""
    begins = case["begins"]
    early = any(last < begins for _, _, last in case["onsets"])
    later = [one for one in case["onsets"] if one[2] >= begins]
    if not later:
        return False, False, None, early
    sample, first, last = later[0]
    return True, first <= begins <= last, sample - begins, early


def cells(cases: Sequence[dict[str, Any]]) -> list[str]:
    """Return the cells of one line."""
    outcomes = Counter(case["outcome"] for case in cases)
    causes = [Counter(case.get(f"{name} cause") for case in cases) for name in ("space", "shift")]
    forbidden = sum(not case.get("allowed", True) for case in cases)
    wrong = sum(case["n_v"] not in (None, 0, 1) for case in cases)
    onsets = [_onset(case) for case in cases]
    delays = [delay for _, _, delay, _ in onsets if delay is not None]
    low, high = interval(outcomes["right"], len(cases))
    return [
        *(str(len(cases)), *(str(outcomes[word]) for word in OUTCOMES), f"{100 * low:.0f} to {100 * high:.0f} %", str(wrong)),
        *(" / ".join(str(found[word]) for word in ("right", "wrong", "open")) for found in causes),
        str(forbidden),
        *(str(len(delays)), str(sum(held for _, held, _, _ in onsets)), f"{np.median(delays):g}" if delays else ""),
        *(str(sum(before for *_, before in onsets)), f"{np.mean([case['seconds'] for case in cases]):.2f}"),
    ]


def show(cases: Cases, markdown: bool) -> None:
    """Print the tables of all that is there."""
    begin, between, end = ("| ", " | ", " |") if markdown else ("", "  ", "")

    def line(*texts: object) -> None:
        print(begin + between.join(f"{text!s:<10}" for text in texts) + end)

    for name, (p, n_u, healthy, after) in SETTINGS.items():
        here = [case for case in cases.found.values() if case["setting"] == name]
        if not here:
            continue
        print(f"\n{name}: {p} outputs, {n_u} inputs, {healthy} healthy samples and {after} after\n")
        line("no change", "feedback", "records", "alarms", "95 %", "rows", "n_v > 0", "onsets", "cpu")
        if markdown:
            line(*["---"] * 9)
        for kind in ("table", "none"):
            for loop in LOOPS:
                some = [case for case in here if case["kind"] == kind and case["loop"] == loop]
                if not some:
                    continue
                hits = sum(bool(case["rows"]) for case in some)
                low, high = interval(hits, len(some))
                rows = Counter(row.rsplit(" ", 1)[0] for case in some for row in case["rows"])
                told_rows = ", ".join(f"{count} {row}" for row, count in rows.items()) or "none"
                counted = sum(bool(case["n_v"]) for case in some) if kind == "none" else ""
                onsets = sum(bool(case["onsets"]) for case in some) if kind == "none" else ""
                chance = f"{100 * low:.2g} to {100 * high:.2g} %"
                seconds = f"{np.mean([case['seconds'] for case in some]):.2f}"
                what = "the table alone" if kind == "table" else "identify"
                line(what, "yes" if loop else "no", len(some), hits, chance, told_rows, counted, onsets, seconds)
        head = (
            "change",
            "sigma",
            "feedback",
            "records",
            *OUTCOMES,
            "right, 95 %",
            "n_v wrong",
            "by space",
            "by shift",
            "n_z",
            "onset",
            "held",
            "delay",
        )
        print()
        line(*head, "early", "cpu")
        if markdown:
            line(*["---"] * (len(head) + 2))
        faulty = [case for case in here if case["kind"] in KINDS]
        for kind, size, loop in lines():
            some = [case for case in faulty if (case["kind"], case["size"], case["loop"]) == (kind, size, loop)]
            if some:
                line(kind, f"{size:g}", "yes" if loop else "no", *cells(some))
        for kind in KINDS:
            some = [case for case in faulty if case["kind"] == kind]
            if some:
                line(kind, "all", "both", *cells(some))
        if faulty:
            line("all", "all", "both", *cells(faulty))


def main() -> None:
    """Measure what is not there yet, and print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("cases", type=Path, metavar="CASES", help="file of cases, one a line; a run goes on with it")
    parser.add_argument("--records", type=int, default=100, help="of each line, through identify")
    parser.add_argument("--tables", type=int, default=200, help="records without a change of which only the table is made")
    parser.add_argument("--minutes", type=float, default=float("inf"), help="CPU minutes after which this run stops")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--setting", choices=list(SETTINGS), default="middle")
    parser.add_argument("--table", action="store_true", help="show what is there, and measure nothing")
    parser.add_argument("--markdown", action="store_true", help="print tables in Markdown")
    arguments = parser.parse_args()
    cases = Cases(arguments.cases)
    if not arguments.table:
        measured(cases, arguments)
    show(cases, arguments.markdown)


if __name__ == "__main__":
    main()
