"""Statements and locks: the readings of the ledger, the theorems and their locks side by side, in Markdown.

page    the table, and below it every word of ours that the statements use
"""

from __future__ import annotations

from collections.abc import Sequence

from faultspace.proofs.rocq.locks import Lock, Locks
from faultspace.proofs.verdict.ledger import Claim


def page(locks: Locks, claims: Sequence[Claim]) -> str:
    """Return the table of readings, theorems and locks, and below it the words, in Markdown."""
    lines = [
        "# What is claimed, what is proved, and the locks of the statements",
        "",
        "This page is made of `ledger.toml` and of `locks.json`, which a test compares with the sources. To the left",
        "stands what the ledger claims, in the middle the theorem that Rocq has checked (of a refuted reading, its counterexample), to the",
        "right its lock: the SHA-256 of the statement and of all that the vocabularies it imports say, whose words stand below and in",
        "`locks.json`.",
        "`faultspace verify` compares them with the sources.",
        "",
        "| reading | in words | theorem | SHA-256 |",
        "|---|---|---|---|",
    ]
    named = set[str]()
    for claim in claims:
        for reading in claim.readings:
            met = f" If: {'; '.join(reading.hypotheses)}." if reading.hypotheses else ""
            first = f"{claim.id}: {reading.id}", f"{_cell(reading.statement + met)} ({reading.proved})"
            for name in reading.theorems:
                named.add(name)
                if name in locks.theorems:
                    lines.append(_row(*first, locks.theorems[name]))
                    first = "", "and"
    for name in sorted({*locks.theorems} - named):
        lines.append(_row("", "what others rest on, or part of a reading", locks.theorems[name]))
    lines += ["", "## The words", "", "Each as its vocabulary defines it, with the variables of its section.", ""]
    lines += ["| word | definition |", "|---|---|"]
    lines += [f"| `{key}` | {_code(text)} |" for key, text in locks.words.items()]
    lines += ["", "## What else the locks hold", ""]
    lines += [f"- `{file}` opens with {_code(text)}" for file, text in locks.openings.items()]
    lines += [f"- {_code(one)}" for one in locks.far]
    return "\n".join(lines) + "\n"


def _row(reading: str, words: str, lock: Lock) -> str:
    return f"| {reading} | {words} | {_code(lock.statement)} | `{lock.sha256}` |"


def _code(text: str) -> str:
    """Writes a text as code in a cell of a table, where a bar would end it."""
    mark = "``" if "`" in text else "`"
    pad = " " if "`" in text else ""
    return mark + pad + text.replace("|", "\\|") + pad + mark


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")
