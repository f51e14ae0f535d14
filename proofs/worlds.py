"""`python -m faultspace.proofs.worlds`: every system over GF(2) of stated dimensions, with what the ledger says of single systems.

    READINGS     the checks of the ledger that ask for single systems alone, and stand
    units        a world in parts: the systems of one (n, p, m) over one class of pairs (A, F)
    examined     what becomes of a unit: its orbits certified, each reading tried on all of them
    covered      the table: how much of each (n, p, m) was gone through, against 2^((n+p)(n+m)) and Burnside's number of orbits
    cost         what all of it takes, by what the orbits of a part took

A unit that is finished is a line of the file of `--out`; the same command goes on where it was stopped. `--scheduler` has the units done
by the workers of a Dask cluster. Exit code 0: no counterexample; 1: there is one, or a certificate was refused; 2: bad input; 130: stopped.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import product
from pathlib import Path
from typing import Any

import joblib

from ..base.errors import InvalidData, InvalidInput, quote_path
from ..base.kept_lines import KeptLines, keeping_lines
from ..base.messages import say
from ..base.progress import silent, working
from ..base.tasks import Died, as_they_come, shared
from .deciding import Check
from .evidence.corpus import CORPUS, examine
from .evidence.material import Folder
from .evidence.orbits_by_stages import LARGEST, orbit_count, orbits_over, pairs
from .verdict.verdicts import Verdict
from .verdict.workbench import Workbench, all_accepted

FORMAT = "faultspace-worlds/1"
NONE_MEETS = "no system of the corpus meets the hypotheses"
READINGS = (
    "language.theorem-2--pencil-zeros-minimal", "language.theorem-2--pencil-zeros", "language.assumption-4--n-known",
    "language.assumption-4--n-unknown", "language.assumption-4--lag", "language.proposition-3--n-alone",
    "language.proposition-3--lag-exactly", "language.proposition-3--normal-rank", "language.problem-11--window-n-plus-1",
    "language.problem-11--lag-plus-1", "language.problem-11--dimension", "zero_feedthrough.exactly_when",
    "language.trajectory-recovered--state-known", "language.trajectory-recovered--no-finite-zeros",
    "trajectory_recovered.zero_feedthrough_signal", "language.objection-3--gap-without-controllability",
    "language.objection-3--ranks-without-minimality", "window_ranks.ranks", "language.window-ranks--indices", "window_ranks.solutions",
    "language.window-ranks--limit", "language.sharp-windows--gap",
)  # fmt: skip

Dimensions = tuple[int, int, int]
Unit = tuple[int, int, int, int]
Found = dict[str, Any]
_TYPES: dict[str, tuple[type, ...]] = {
    **dict.fromkeys(("n", "p", "m", "pair", "orbits", "systems", "accepted"), (int,)), "seconds": (int, float), "failing": (list,)
}  # fmt: skip


def units(n: int, p: int, m: int) -> Iterator[Unit]:
    """Yield the units with at most n states, p outputs and m faults as n, p, m and the number of a pair (A, F), the smallest first."""
    dimensions = product(range(n + 1), range(p + 1), range(m + 1))
    for one in sorted(dimensions, key=lambda d: ((d[0] + d[1]) * (d[0] + d[2]), d)):
        for place in range(len(pairs(one[0], one[2]))):
            yield (*one, place)


def examined(unit: Unit) -> Found:
    """Return the line of a unit: orbits, systems, accepted certificates, seconds of one processor, and what fails, in words.

    Raises nothing that a certificate is refused for; that is told as a failure.
    """
    n, p, m, place = unit
    started = time.process_time()
    found: Found = {"n": n, "p": p, "m": m, "pair": place, "orbits": 0, "systems": 0, "accepted": 0, "failing": []}
    bench = Workbench("quick", 1, silent, Folder(Path()))
    try:
        evidence = [examine(f"systems over GF(2), n={n} p={p} m={m}", one.system, one.size) for one in orbits_over(pairs(n, m)[place], p)]
    except Exception as error:  # a certificate that is refused is a finding, and the other units go on
        return found | {"failing": [f"{type(error).__name__}: {error}"], "seconds": round(time.process_time() - started, 2)}
    bench.put_answers(CORPUS, evidence)
    for name in READINGS:
        outcome = Check(name).done(bench)
        if outcome.verdict != Verdict.CERTIFIED and outcome.evidence != NONE_MEETS:
            found["failing"].append(f"{name}: {outcome.verdict}, {outcome.evidence}")
    sums = {"orbits": len(evidence), "systems": sum(e.weight for e in evidence), "accepted": len(all_accepted(evidence))}
    return found | sums | {"seconds": round(time.process_time() - started, 2)}


def covered(lines: Iterable[Found]) -> str:
    """Return the table of what was gone through, a row for each (n, p, m)."""
    sums: dict[tuple[int, int, int], dict[str, float]] = defaultdict(lambda: defaultdict(float))
    for line in lines:
        for key in ("orbits", "systems", "accepted", "seconds"):
            sums[line["n"], line["p"], line["m"]][key] += line[key]
    rows: list[tuple[str, ...]] = [("n", "p", "m", "orbits", "of", "systems", "of 2^", "part", "certificates", "CPU s")]
    for (n, p, m), row in sorted(sums.items()):
        bits, part = (n + p) * (n + m), row["systems"] / 2 ** ((n + p) * (n + m))
        numbers = (int(row["orbits"]), orbit_count(n, p, m), int(row["systems"]), bits)
        rows.append((*map(str, (n, p, m, *numbers)), f"{part:.4g}", str(int(row["accepted"])), f"{row['seconds']:.1f}"))
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    return "\n".join("  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True)) for row in rows)


def cost(lines: Iterable[Found], dimensions: Iterable[Dimensions]) -> str:
    """Return in words what the orbits of these (n, p, m) take of one processor.

    An orbit is said to take what those of its row took, and where a row has none yet, what the slowest row took: rows are sorted by size,
    and the largest ones are those that a part may miss. Nothing is said where nothing was gone through.
    """
    orbits: Counter[Dimensions] = Counter()
    seconds: dict[Dimensions, float] = defaultdict(float)
    longest = 0.0
    for line in lines:
        row = line["n"], line["p"], line["m"]
        orbits[row] += line["orbits"]
        seconds[row] += line["seconds"]
        longest = max(longest, line["seconds"])
    rates = {row: seconds[row] / count for row, count in orbits.items() if count}
    if not rates:
        return "no orbit was gone through"
    every = {row: orbit_count(*row) for row in dimensions}
    gone, there = sum(orbits.values()), sum(every.values())
    took = f"{gone} of {there} orbits took {sum(seconds.values()):.0f} s of one processor, the longest unit {longest:.0f} s"
    if gone == there:
        return took
    whole = sum(count * rates.get(row, max(rates.values())) for row, count in every.items())
    return f"{took}; all of them would take about {whole:.0f} s ({whole / 3600:.1f} hours), by what those of each row took"


def main(arguments: Sequence[str] | None = None) -> int:
    """Go through the world that the arguments choose, print the table, and return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m faultspace.proofs.worlds", description="Every system over GF(2) of some dimensions.")
    for name, most, what in (("n", 3, "states"), ("p", 3, "outputs"), ("m", 2, "faults")):
        parser.add_argument(f"--{name}", type=int, default=most, help=f"the most {what} ({most})")
    parser.add_argument(
        "--out", type=Path, metavar="FILE", required=True, help="finished units, a line of JSON each; what it has is not done again"
    )
    parser.add_argument("--part", type=int, default=1, metavar="K", help="only every Kth unit, to measure what all would take (1)")
    parser.add_argument("--jobs", type=int, default=0, help="processes (one for each core)")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="work on the Dask cluster with this scheduler instead")
    given = parser.parse_args(arguments)
    if min(given.n, given.p, given.m, given.jobs) < 0 or given.part < 1 or given.n + given.m > LARGEST:
        parser.error(
            f"got n={given.n} p={given.p} m={given.m} part={given.part} jobs={given.jobs}, expected none below 0 and n + m <= {LARGEST}"
        )
    if given.scheduler and given.jobs:
        parser.error("--jobs and --scheduler exclude each other: the cluster decides how many work")
    everything = list(units(given.n, given.p, given.m))
    chosen = everything[:: given.part]
    try:
        with shared(given.scheduler), keeping_lines(given.out, FORMAT, _good, "--out") as kept:
            finished = {_unit(line): dict(line) for line in kept.lines}
            waiting = [unit for unit in chosen if unit not in finished]
            told = len(chosen) - len(waiting)
            for unit, line in _run(waiting, kept, given.jobs or joblib.cpu_count(), given.scheduler):
                finished[unit] = line
    except InvalidInput as error:
        parser.error(str(error))
    except KeyboardInterrupt:
        say(f"stopped; {given.out} has what is finished, and the same command goes on from there")
        return 130
    mine = [finished[unit] for unit in chosen]
    print(covered(mine))
    print(cost(mine, dict.fromkeys(unit[:3] for unit in everything)))
    if told:
        print(f"{told} of {len(mine)} units were gone through by an earlier run, as {quote_path(str(given.out))} tells it")
    failing = [words for line in mine for words in line["failing"]]
    print("\n".join(failing) if failing else f"no counterexample to any of {len(READINGS)} readings")
    return 1 if failing else 0


def _run(waiting: Sequence[Unit], kept: KeptLines, jobs: int, scheduler: str | None) -> Iterator[tuple[Unit, Found]]:
    """Yield each unit with its line, which the file has by then."""
    if not waiting:
        return
    shares = [orbit_count(*unit[:3]) / len(pairs(unit[0], unit[2])) for unit in waiting]
    with working("going through the world") as tell:
        started, done, total = time.monotonic(), 0.0, sum(shares)
        for number, (k, line) in enumerate(as_they_come(examined, [(unit,) for unit in waiting], count=jobs, cluster=scheduler), 1):
            unit = waiting[k]
            if isinstance(line, Died):
                named = f"n={unit[0]} p={unit[1]} m={unit[2]} pair {unit[3]}"
                raise InvalidData(f"the unit {named} came to no end: {line.reason}; try fewer processes at a time, or more memory")
            kept.note(**line)
            yield unit, line
            done += shares[k]
            left = (time.monotonic() - started) * (total - done) / done
            tell(f"going through units of n={unit[0]} p={unit[1]} m={unit[2]}", number, len(waiting), left)


def _good(line: Mapping[str, Any]) -> bool:
    return all(type(line[key]) in types for key, types in _TYPES.items())


def _unit(line: Mapping[str, Any]) -> Unit:
    return line["n"], line["p"], line["m"], line["pair"]


if __name__ == "__main__":
    sys.exit(main())
