"""Certified material that many claims read: made once a run, several kinds of it at once, on all cores.

Material    a kind: the items that it is made of, what is made of one, and how many of them are a task
Wanted      raised where material is asked for that is not there yet, and is not to be made here
made        the material of several kinds
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from joblib import Parallel, delayed

from ...base.progress import Progress


@dataclass(frozen=True)
class Material:
    """A kind of certified material, with `stage` as the words of its progress.

    `items(bench)` are what it is made of, which may be other material, and `make(item)` is what comes of one. Both are functions of a
    module, as they go to other processes. A task has `together` items: they share what is kept about a system that stands in many.
    """

    name: str
    stage: str
    items: Callable[[Any], Iterable[Any]]
    make: Callable[[Any], list[Any]]
    together: int


class Wanted(BaseException):
    """These kinds are to be made first; no error, so that what turns errors into verdicts lets it pass."""

    def __init__(self, *kinds: Material) -> None:
        super().__init__(*kinds)
        self.kinds = kinds


Made = tuple[Any, ...] | Exception


def made(kinds: Sequence[Material], bench: Any, jobs: int, progress: Progress) -> dict[str, Made]:
    """Return what is made of each kind, by its name; where that failed, the first error, which is for whoever asks for this kind."""
    found: dict[str, Made] = {kind.name: () for kind in kinds}
    tasks: list[tuple[Material, Sequence[Any]]] = []
    for kind in kinds:
        try:
            items = list(kind.items(bench))
        except Exception as error:
            found[kind.name] = error
            continue
        tasks += [(kind, items[start : start + kind.together]) for start in range(0, len(items), kind.together)]
    parts: dict[str, list[Any]] = {kind.name: [] for kind in kinds}
    done, total = 0, sum(len(batch) for _, batch in tasks)
    stream = Parallel(n_jobs=jobs, return_as="generator")(delayed(_made_of)(kind.make, batch) for kind, batch in tasks)
    for (kind, batch), answer in zip(tasks, stream, strict=True):
        if isinstance(answer, Exception):
            found[kind.name] = answer
        else:
            parts[kind.name] += answer
        done += len(batch)
        progress(kind.stage, done, total)
    return {name: tuple(parts[name]) if before == () else before for name, before in found.items()}


def _made_of(make: Callable[[Any], list[Any]], batch: Sequence[Any]) -> list[Any] | Exception:
    try:
        return [one for item in batch for one in make(item)]
    except Exception as error:  # whatever it is, what rests on this kind did not finish, and the rest goes on
        return error
