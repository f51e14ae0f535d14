"""Run `faultspace limit`, which computes exactly what subspace identification converges to for an experiment."""

from __future__ import annotations

from collections.abc import Sequence

from ..base.errors import in_file
from ..base.progress import Progress
from ..exact.limits.moesp import limit
from .file_by_file import FileAnswer, answer_each
from .reading_files import read_experiment


def run(names: Sequence[str], *, as_json: bool, floats_exactly: bool) -> int:
    """Answer one file after the other, and return the largest exit code."""

    def answer(name: str, _: Progress) -> FileAnswer:
        experiment = read_experiment(name, floats_exactly=floats_exactly)
        with in_file(name):
            found = limit(experiment)
        return FileAnswer(experiment.sizes, found)

    return answer_each(names, "taking {} to the limit", answer, as_json=as_json)
