"""Run `faultspace limit`, which computes exactly what subspace identification converges to for an experiment.

run          the command's body
"""

from __future__ import annotations

from collections.abc import Sequence

from ..base.errors import in_file, quote_path
from ..base.progress import working
from ..exact.limits.moesp import limit
from .file_by_file import FileAnswer, answer_each
from .reading_files import read_experiment


def run(names: Sequence[str], *, as_json: bool, floats_exactly: bool) -> int:
    """Answer one file after the other, and return the largest exit code."""

    def answer(name: str) -> FileAnswer:
        experiment = read_experiment(name, floats_exactly=floats_exactly)
        with in_file(name), working(f"taking {quote_path(name)} to the limit"):
            found = limit(experiment)
        return FileAnswer(experiment.sizes, found)

    return answer_each(names, answer, as_json=as_json)
