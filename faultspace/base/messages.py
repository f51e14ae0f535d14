"""What is said on standard error, one line at a time."""

from __future__ import annotations

import os
import sys
import textwrap
from contextlib import suppress

from .others_text import printable

LONGEST_LINE = 1200


def say(message: str) -> None:
    """Print one line on standard error, whatever the message holds, on a terminal broken between words; a long one lacks its middle."""
    line = printable(" ".join(message.split()))
    if len(line) > LONGEST_LINE:
        line = f"{line[: LONGEST_LINE // 2]} ... {line[-LONGEST_LINE // 2 :]}"
    line = f"faultspace: {line}"
    with suppress(OSError):
        if sys.stderr.isatty() and (columns := _columns()):
            line = textwrap.fill(line, max(columns, 20), subsequent_indent="    ", break_on_hyphens=False)
        print(line, file=sys.stderr, flush=True)


def _columns() -> int:
    """Return how wide the terminal of standard error is; 0 where nobody knows."""
    try:
        return int(os.environ.get("COLUMNS") or 0) or os.get_terminal_size(sys.stderr.fileno()).columns
    except (OSError, ValueError):
        return 0
