"""What docs/ has from the ledger: the table of the claims with their readings, that of the hypotheses, that of the attacks on them, and the
picture of the README; and the table of the quantities that claims of your own can speak of.

    TABLES     the page -> the function that makes the rows of its table
    filled     the page with these rows between its two marks
    picture    claims.svg: a line a claim, its verdict told by a colour and a sentence
    fill       writes them anew, as `python docs/make.py` does

A test compares what these functions give with what is in the folder.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping
from itertools import groupby
from operator import itemgetter
from pathlib import Path

from faultspace.proofs.adversary.results import COUNTEREXAMPLE, AttackRecord, refuting, stored
from faultspace.proofs.evidence.attacks import Aim
from faultspace.proofs.hypotheses import ablations
from faultspace.proofs.quantities.choices import OF_A_CHOICE
from faultspace.proofs.quantities.pairs import OF_ONE_A_AND_C
from faultspace.proofs.quantities.records import OF_A_RECORD
from faultspace.proofs.quantities.registry import Kind, Quantity, quantities
from faultspace.proofs.verdict.ledger import Claim, expected_without, load, sentences
from faultspace.proofs.verdict.picture import Line, draw
from faultspace.proofs.verdict.review_points import review
from faultspace.proofs.verdict.verdicts import Verdict, of_readings

DOCS = Path(__file__).parents[1]
BEGIN, END = "<!-- docs/make.py makes what stands here -->", "<!-- as far as here -->"


def claims_table() -> list[str]:
    """The table of claims.md has a row for each reading."""
    rows = ["| claim | verdict | read as | verdict on the reading |", "|---|---|---|---|"]
    for claim in load():
        for i, reading in enumerate(claim.readings):
            first = f"| **{claim.id}** | {verdict(claim)} " if i == 0 else "| | "
            mark = "ours: " if reading.repair else ""
            met = f" *If: {'; '.join(reading.hypotheses)}.*" if reading.hypotheses else ""
            rows.append(f"{first}| {mark}{reading.statement}{met} | {reading.proved} |")
    return rows


def hypotheses_table() -> list[str]:
    """Return the table of hypotheses.md, a row an ablation: what the ledger expects, PROVED where it names theorems that say so."""
    heads = "claim", "conclusion", "needed", "not needed: PROVED", "no counterexample found", "follows from the others"
    rows = [f"| {' | '.join(heads)} |", "|---" * len(heads) + "|"]
    expected = expected_without()
    for ablation in ablations():
        cells: dict[str, list[str]] = {"REFUTED": [], "PROVED": [], "CERTIFIED": [], "IMPLIED": []}
        for name, entry in expected[ablation.name].items():
            proved = entry == "CERTIFIED" and ablation.theorems_without((name,))
            cells["PROVED" if proved else entry].append(name)
        rows.append(f"| {ablation.claim} | {ablation.conclusion} | {' | '.join('; '.join(names) for names in cells.values())} |")
    return rows


def verdict(claim: Claim) -> Verdict:
    """Return the verdict that the ledger expects of a claim where there is Rocq."""
    return of_readings([(one, Verdict(one.proved)) for one in claim.readings], in_parts=claim.in_parts)


def picture() -> str:
    """An SVG of the claims with the verdicts that the ledger expects where there is Rocq."""
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams |= {"svg.hashsalt": "faultspace", "svg.fonttype": "none", "font.family": "sans-serif"}
    lines = [Line(claim.id, claim.group, str(verdict(claim)), sentences()[claim.id]["verdict"]) for claim in load()]
    stream = io.StringIO()
    draw(lines).figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    return stream.getvalue()


def attacks_table() -> list[str]:
    """Return the tables of adversary.md from the stored results: what attacks found, a row a statement, and what nothing was found on, a
    row an attack."""
    found = ["| refuted | found by |", "|---|---|"]
    none = ["| stands | attacked by | tried | how near |", "|---|---|---|---|"]
    for target, records in groupby(sorted(stored(), key=itemgetter("target")), key=itemgetter("target")):
        names = {one["attack"].removeprefix(f"{target} by "): one for one in records}
        refuted = [
            name if one["outcome"] == COUNTEREXAMPLE else f"{name} (a {one['outcome']})" for name, one in names.items() if refuting(one)
        ]
        found += [f"| {target} | {'; '.join(refuted)} |"] if refuted else []
        none += [f"| {target} | {name} | {tried(one)} | {nearest(one)} |" for name, one in names.items() if not refuting(one)]
    return [*found, "", *none]


def tried(record: AttackRecord) -> str:
    """The words say how much an attack tried, and when."""
    return f"{record['starts']} starts, {record['evaluations']} values, {record['decided']} points, {record['date']}"


def nearest(record: AttackRecord) -> str:
    """Return the least value, or the largest where any value but zero refutes; where exact points of a zero set were decided, of what."""
    if record["aim"] == Aim.STRATUM:
        return f"decided where {record['measured'].partition(',')[0]} vanishes"
    return f"{record['nearest']:.1e}: {record['measured']}"


def quantities_table() -> list[str]:
    """Return the tables of your-claims.md, a row a quantity: of a system, then of a pair, a choice, a record."""
    pair = "A claim about a pair has these words, too, beside those of `first` and `second` (`n` where both have the same A and C):"
    word = "[choice](glossary.md#choice-of-a-pair)"
    choice = f"A claim about a {word} has these words, too, beside those of the system and of `chosen`, and the matrix `P`:"
    record = "A claim about a record has these words, too, beside those of the system and of `inputs`, and `B`, `D`, `u` (N x nu) and `x0`:"
    return [
        *_quantities_table(quantities()),
        *("", pair, "", *_quantities_table(OF_ONE_A_AND_C)),
        *("", choice, "", *_quantities_table(OF_A_CHOICE)),
        *("", record, "", *_quantities_table(OF_A_RECORD)),
    ]


def review_table() -> list[str]:
    """The table of review.md has a row for each point of the review, in its order."""
    rows = ["| the review says | what is true | claims |", "|---|---|---|"]
    for section, points in groupby(review(), key=lambda point: point.section):
        rows.append(f"| **{section}** | | |")
        rows += [f"| {point.says} | {point.true} | {', '.join(point.cards)} |".replace("|  |", "| |") for point in points]
    return rows


def _quantities_table(listed: Mapping[str, Quantity]) -> list[str]:
    rows = ["| name | what it is | meaning | borne by certificates |", "|---|---|---|---|"]
    for name, one in sorted(listed.items(), key=lambda item: (item[1].windowed, list(Kind).index(item[1].kind), item[0])):
        borne = (
            "no: computed" if one.certificates is None else "where true" if name == "stable" else "read off" if name in READ_OFF else "yes"
        )
        meaning = one.meaning.replace("|", r"\|")
        kind = ("a function of s" if one.windowed else str(one.kind)) + (", where there is a circle" if one.circle else "")
        rows.append(f"| `{name}{'(s)' if one.windowed else ''}` | {kind} | {meaning} | {borne} |")
    return rows


READ_OFF = ("n", "m", "p", "k", "N", "nu")
TABLES: dict[str, Callable[[], list[str]]] = {
    "adversary.md": attacks_table,
    "claims.md": claims_table,
    "hypotheses.md": hypotheses_table,
    "review.md": review_table,
    "your-claims.md": quantities_table,
}


def filled(page: str, rows: list[str]) -> str:
    """The page with these rows between its two marks. Raises ValueError where it does not have them."""
    before, rest = page.split(BEGIN)
    _, after = rest.split(END)
    return "\n".join([before + BEGIN, "", *rows, "", END + after])


def fill() -> None:
    """Write the tables into their pages, and the picture."""
    for name, rows in TABLES.items():
        page = DOCS / name
        page.write_text(filled(page.read_text("utf-8"), rows()), "utf-8")
    (DOCS / "claims.svg").write_text(picture(), "utf-8")
