"""Print what a claim comes down to: its card, and all claims in a sentence each.

card_lines       a card in lines of at most WIDTH columns
print_card       the card of a claim
print_sentences  a sentence for each claim, those of the paper first, then the review's, then ours; what is not as expected before them
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence
from functools import partial

from rich.console import Console
from rich.text import Text

from ..proofs.verdict.cards import Believed, Card, card, hold
from ..proofs.verdict.picture import GROUPS
from ..proofs.verdict.verdicts import ClaimResult, Verdict
from .consoles import paragraph

WIDTH = 100
STYLES = {
    Verdict.PROVED: "bold green",
    Verdict.IDENTITY: "green",
    Verdict.CERTIFIED: "green",
    Verdict.REFUTED: "yellow",
    Verdict.AMENDED: "magenta",
    Verdict.ERROR: "bold red",
}


def card_lines(shown: Card, readings: str, width: int = WIDTH) -> Iterator[str]:
    """Yield the lines of a card, of at most `width` columns; `readings` says how many of them hold."""
    wrapped = partial(_wrapped, width=width)
    said = "We state" if shown.group == "ours" else "As the review states it"
    yield from wrapped(f"{shown.id} ({shown.place})", "")
    yield from wrapped(f"{said}: {shown.said}", "  ")
    yield from wrapped(f"{shown.verdict} [{shown.level}]", "Verdict:     ")
    for wrong in shown.wrong:
        yield from wrapped(wrong.sentence, "In numbers:  ")
        yield from wrapped(f"in {wrong.system} ({wrong.reading})", " " * 13)
    if shown.instead:
        yield from wrapped(shown.instead, "True is:     ")
    for number, why in enumerate(shown.why):
        yield from wrapped(why, " " * 13 if number else "Believe it:  ")
    yield from wrapped(f"{readings}; all, with hypotheses: faultspace verify --claim {shown.id} -v", "More:        ")


def _wrapped(text: str, label: str, width: int) -> list[str]:
    """Return the text behind its label, broken between words."""
    return textwrap.wrap(text, width, initial_indent=label, subsequent_indent=" " * len(label), break_on_hyphens=False)


def print_card(console: Console, result: ClaimResult, believed: Believed) -> None:
    """Print the card of a claim."""
    for line in card_lines(card(result, believed), hold(result), min(WIDTH, console.width)):
        style = "bold" if line.startswith(result.claim.id) else STYLES[result.verdict] if line.startswith("Verdict:") else ""
        console.print(Text(line, style=style), soft_wrap=True)
    console.print()


def print_sentences(console: Console, claims: Sequence[ClaimResult]) -> None:
    """Print a sentence for each claim, in groups."""
    cards = [(card(result), result) for result in claims]
    for group, title in GROUPS.items():
        of_group = sorted(((one, result) for one, result in cards if one.group == group), key=lambda pair: pair[1].as_expected)
        if of_group:
            paragraph(console, Text(title, style="bold"))
        for one, result in of_group:
            style = STYLES[result.verdict] if result.as_expected else "bold red"
            paragraph(console, one.verdict, Text.assemble("  ", (f"{one.id}: ", style)))
