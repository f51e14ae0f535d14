"""Say what channels a file has, to someone who has not chosen inputs and outputs yet, and what a choice looks like.

nothing_chosen   the refusal of a file whose inputs or outputs were not named, with its channels and a command to try
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Callable, Sequence

from ...base.errors import InvalidInput
from ...base.sheets import counted
from .clocks import time_name
from .selectors import MOST_NAMED, Missing, quoted

NOBODYS = "\0"  # no file has a channel of this name
ACTING = re.compile(r"(x?mv|u|in|inputs?|cmd|command|valve|heater|pump|voltage)[ _.\-\[(]*\d*.?", re.IGNORECASE)
"""Names that inputs often have: a guess, which is told as an example only."""


def nothing_chosen(path: str, inputs: Sequence[str], outputs: Sequence[str], read: Callable[[Sequence[str]], object]) -> InvalidInput:
    """Return the refusal; `read` opens the file for channels of these names, and raises Missing for one that it has not."""
    there: tuple[str, ...] = ()
    columns = True
    try:
        read([NOBODYS])
    except Missing as found:
        there, columns = found.there, found.columns
    lacking = " and ".join(f"no {option}" for option, names in (("inputs", inputs), ("outputs", outputs)) if not names)
    clock = time_name(there)
    free = [name for name in there if name not in {*inputs, *outputs, clock}]
    listed = ", ".join([*map(quoted, free[:MOST_NAMED]), *([f"... ({len(free)} in all)"] if len(free) > MOST_NAMED else [])])
    told = f"left are {listed}" if inputs or outputs else f"the file has {listed}"
    time = f", and times in {clock}" if clock else ""
    if len(free) == 1 and not columns:
        told, free = f"there is one matrix, {free[0]}, with columns {free[0]}[:,j] counted from 0", [f"{free[0]}[:,0]", f"{free[0]}[:,1:]"]
    if len(free) + len(inputs) + len(outputs) < 2 or not free:
        what = f"{told}{time}" if free else f"no channel is left of {counted(len(there), 'channel')}"
        return InvalidInput(f"got {lacking}, and {what}; a model needs an input, which acts on the plant, and an output, which is measured")
    u, y = _example(free, list(inputs), list(outputs))
    command = f"faultspace identify {shlex.quote(path)} --inputs {shlex.quote(u)} --outputs {shlex.quote(y)} --out answer"
    return InvalidInput(f"got {lacking}, expected what acts on the plant and what is measured; {told}{time}: choose, as in {command}")


def _example(free: list[str], inputs: list[str], outputs: list[str]) -> tuple[str, str]:
    """Return a choice out of the free channels: those named, the rest for the others, by their names where neither is named."""
    if not inputs and not outputs:
        inputs = [name for name in free if ACTING.fullmatch(name.strip())]
        inputs = inputs if 0 < len(inputs) < len(free) else free[:1]
    outputs = outputs or [name for name in free if name not in inputs]
    inputs = inputs or [name for name in free if name not in outputs]
    return ",".join(map(quoted, inputs[:MOST_NAMED])), ",".join(map(quoted, outputs[:MOST_NAMED]))
