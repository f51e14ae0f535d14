"""Run `faultspace compare`, which decides whether two systems make the same outputs and shows a word that separates them if not."""

from __future__ import annotations

import sys

from rich.text import Text

from ..base.errors import in_file, quote_path
from ..base.messages import say
from ..base.progress import working
from ..exact.structure.behavior import MOST_SAMPLES, compare
from .consoles import answers, paragraph, print_json
from .failures import ANSWERED, NOT_AS_EXPECTED
from .reading_files import read_system


def run(names: tuple[str, str], *, as_json: bool, expected: str | None, word: bool, floats_exactly: bool) -> int:
    """Compare the systems in two files; `expected` is "equivalent", "different" or None."""
    systems = [read_system(name, floats_exactly=floats_exactly).residual for name in names]
    both = " and ".join(map(quote_path, names))
    with in_file(both), working(f"comparing {both}"):
        found = compare(*systems)
    if as_json:
        print_json({name: value for name, value in found.to_json().items() if word or name != "word"})
    else:
        first, second = map(quote_path, names)
        title, *rest = found.lines(first, second, samples=sys.maxsize if word else MOST_SAMPLES)
        console = answers()
        paragraph(console, Text(title, style="green" if found.equivalent else "yellow"))
        for line in rest:
            paragraph(console, line)
    verdict = "equivalent" if found.equivalent else "different"
    if expected not in (None, verdict):
        say(f"{both}: got {verdict}, expected {expected}")
        return NOT_AS_EXPECTED
    return ANSWERED
