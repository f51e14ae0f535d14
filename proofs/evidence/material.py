"""Certified material that many claims read: made once a run, several kinds of it at once, on all cores.

Material    a kind: the items that it is made of, what is made of one, and how many of them are a task
Wanted      raised where material is asked for that is not there yet, and is not to be made here
made        the material of several kinds, in bytes: who makes it sends them, and who reads it loads them, once for the kinds made together
loaded      the material itself
Folder      where material stands that was made, for the processes of this machine
Carried     the same for machines that share no files: it goes along with the tasks that asked for it
"""

from __future__ import annotations

import pickle
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from uuid import uuid4

from ...base.progress import Progress
from ...base.tasks import ordered, processes
from .once_a_run import in_run


@dataclass(frozen=True)
class Material:
    """A kind of certified material, with `stage` as the words of its progress.

    `items(bench)` are what it is made of, which may be other material, and `make(item)` is what comes of one, a list where that may be
    several. Both are functions of a module, as they go to other processes. A task has `together` items: they share what is kept about a
    system that stands in many.
    """

    name: str
    stage: str
    items: Callable[[Any], Iterable[Any]]
    make: Callable[[Any], Any]
    together: int


class Wanted(BaseException):
    """These kinds are to be made first; no error, so that what turns errors into verdicts lets it pass."""

    def __init__(self, *kinds: Material) -> None:
        super().__init__(*kinds)
        self.kinds = kinds


Made = tuple[Any, ...] | Exception


@dataclass(frozen=True)
class Packed:
    """Material of the kinds with these names, which were made together: what was made of each batch of items, in bytes."""

    names: tuple[str, ...]
    batches: tuple[bytes, ...]


def made(kinds: Sequence[Material], bench: Any, jobs: int, progress: Progress, run: str) -> list[Packed]:
    """Return what is made of the kinds in the run of that name, which `loaded` reads; each kind is in one of them.

    Kinds that are made of the same items are made of each batch of them together, so that what is found out about an item serves them all.
    """
    in_run(run)
    alike: dict[Callable[[Any], Iterable[Any]], list[Material]] = {}
    for kind in kinds:
        alike.setdefault(kind.items, []).append(kind)
    batches: list[list[bytes]] = [[] for _ in alike]
    tasks: list[tuple[int, list[Material], Sequence[Any]]] = []
    for k, (items_of, some) in enumerate(alike.items()):
        try:
            items = list(items_of(bench))
        except Exception as error:
            batches[k].append(_in_bytes([error] * len(some)))
            continue
        tasks += [(k, some, items[start : start + some[0].together]) for start in range(0, len(items), some[0].together)]
    done, total = 0, sum(len(batch) for _, _, batch in tasks)
    stream = ordered(_made_of, [(run, [kind.make for kind in some], batch) for _, some, batch in tasks], count=processes(jobs))
    for (k, some, batch), answers in zip(tasks, stream, strict=True):
        batches[k].append(answers)
        done += len(batch)
        progress(some[0].stage, done, total)
    return [Packed(tuple(kind.name for kind in some), tuple(batches[k])) for k, some in enumerate(alike.values())]


def loaded(packed: Packed) -> dict[str, Made]:
    """Return what was made of each kind, by its name; where that failed, the first error, which is for whoever asks for this kind."""
    parts: list[list[Any]] = [[] for _ in packed.names]
    errors: dict[str, Exception] = {}
    for batch in packed.batches:
        for name, part, answer in zip(packed.names, parts, pickle.loads(batch), strict=True):
            if isinstance(answer, Exception):
                errors.setdefault(name, answer)
            else:
                part += answer
    return {name: errors.get(name, tuple(part)) for name, part in zip(packed.names, parts, strict=True)}


class Folder:
    """A shelf: material by the name of a kind, in the files of a folder. `run` names the run that it belongs to."""

    def __init__(self, path: Path) -> None:
        self.path, self.run = path, str(path)

    def __contains__(self, name: str) -> bool:
        return (self.path / name).exists()

    def __getitem__(self, name: str) -> Packed:
        found: Packed = pickle.loads((self.path / (self.path / name).read_text("utf-8")).read_bytes())
        return found

    def put(self, packed: Packed) -> None:
        """Put it there once, with the name of its file under the name of each kind."""
        file = f"{packed.names[0]}.pickle"
        (self.path / file).write_bytes(_in_bytes(packed))
        for name in packed.names:
            (self.path / name).write_text(file, "utf-8")

    def part(self, names: Iterable[str]) -> Folder:
        """Return what a task takes along that needs these: the place alone, where it finds them."""
        return self


class Carried:
    """A shelf that holds the material itself."""

    def __init__(self, run: str | None = None, held: dict[str, Packed] | None = None) -> None:
        self.run, self.held = run or uuid4().hex, {} if held is None else held
        self._parts: dict[frozenset[str], Carried] = {}

    def __contains__(self, name: str) -> bool:
        return name in self.held

    def __getitem__(self, name: str) -> Packed:
        return self.held[name]

    def put(self, packed: Packed) -> None:
        """Hold it, under the name of each kind."""
        self.held |= dict.fromkeys(packed.names, packed)

    def part(self, names: Iterable[str]) -> Carried:
        """Return a shelf with these alone; tasks that need the same take the same one, so that it is sent once."""
        chosen = frozenset(names)
        if chosen not in self._parts:
            self._parts[chosen] = Carried(self.run, {name: self.held[name] for name in sorted(chosen)})
        return self._parts[chosen]


Shelf = Folder | Carried


def _made_of(run: str, makes: Sequence[Callable[[Any], Any]], batch: Sequence[Any]) -> bytes:
    in_run(run)
    return _in_bytes([_made_one_way(make, batch) for make in makes])


def _in_bytes(found: object) -> bytes:
    return pickle.dumps(found, pickle.HIGHEST_PROTOCOL)


def _made_one_way(make: Callable[[Any], Any], batch: Sequence[Any]) -> list[Any] | Exception:
    try:
        found = [make(item) for item in batch]
        return [one for made in found for one in (made if isinstance(made, list) else [made])]
    except Exception as error:  # whatever it is, what rests on this kind did not finish, and the rest goes on
        return error
