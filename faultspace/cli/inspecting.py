"""`faultspace inspect`: everything the exact branch knows about a system.

run          the command's body
FLOATS       what must be known of answers about floats
"""

from __future__ import annotations

from collections.abc import Sequence

from ..base.errors import in_file
from ..base.messages import say
from ..base.progress import Progress
from ..exact.structure.record import analyze
from .file_by_file import FileAnswer, answer_each
from .reading_files import read_system

FLOATS = (
    "--floats-exactly takes every float for the dyadic rational that it is; floats that were measured or estimated have, exactly, no zeros "
    "and indices as equal as they can be: that this is found here confirms nothing about the plant"
)


def run(names: Sequence[str], *, as_json: bool, floats_exactly: bool) -> int:
    """Inspects one file after the other. The largest exit code."""

    def answer(name: str, on_progress: Progress) -> FileAnswer:
        system = read_system(name, floats_exactly=floats_exactly)
        with in_file(name):
            found = analyze(system.residual, on_progress=on_progress)
        if floats_exactly:
            say(FLOATS)
        return FileAnswer(system.sizes, found)

    return answer_each(names, "inspecting {}", answer, as_json=as_json)
