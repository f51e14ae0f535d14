"""Files that grow, and what happens to them: each story is written step by step, a step whenever the reader finds nothing new.

told     the samples of column b of a file in a story: a number, "-" for a missing sample, "anew" where the state is to be forgotten
"""

from __future__ import annotations

import io
import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from faultspace.base.errors import InvalidInput
from faultspace.numeric.data.following import LONGEST_LINE, Break, Followed, bounded
from faultspace.numeric.data.streams import RESTARTED, TableStream, seldom

Step = Callable[[Path], Any]


class _Over(Exception):
    """The story is over."""


def told(file: Path, steps: list[Step], monkeypatch: pytest.MonkeyPatch, heard: list[str] | None = None) -> list[Any]:
    left = list(steps)

    def sleep(_: float) -> None:
        if not left:
            raise _Over
        left.pop(0)(file)

    monkeypatch.setattr(time, "sleep", sleep)
    hear = ([] if heard is None else heard).append
    seen: list[Any] = []
    try:
        for row in TableStream(Followed(str(file), heard=hear), ["b"], str(file), heard=hear):
            seen.append("anew" if row is RESTARTED else "-" if not np.isfinite(row[0]) else int(row[0]))
    except _Over:
        pass
    return seen


def add(text: str | bytes) -> Step:
    def step(file: Path) -> None:
        with open(file, "ab") as stream:
            stream.write(text if isinstance(text, bytes) else text.encode())

    return step


def write(text: str) -> Step:
    return lambda file: file.write_text(text)


def rename(file: Path) -> None:
    os.replace(file, file.with_suffix(".1"))


def unlink(file: Path) -> None:
    file.unlink()


def nothing(_: Path) -> None:
    pass


def together(*steps: Step) -> Step:
    return lambda file: [step(file) for step in steps]


def rows(first: int, last: int) -> str:
    return "".join(f"0,{k}\n" for k in range(first, last))


def behind(text: str) -> Step:
    """Write into the file that has been renamed."""
    return lambda file: add(text)(file.with_suffix(".1"))


def padded(text: str) -> Step:
    """Cut the file to nothing, and write on where the logger stood, as one does that does not append."""

    def step(file: Path) -> None:
        size = file.stat().st_size
        with open(file, "r+b") as stream:
            stream.truncate(0)
            stream.seek(size)
            stream.write(text.encode())

    return step


def swap(text: str) -> Step:
    """Let the name be that of another file, through a link."""

    def step(file: Path) -> None:
        other = file.with_name(f"{len(list(file.parent.iterdir()))}.txt")
        other.write_text(text)
        link = file.with_suffix(".link")
        link.symlink_to(other)
        os.replace(file, file.with_suffix(".old"))
        os.replace(link, file)

    return step


HEAD = "a,b\n"
STORIES: dict[str, tuple[list[Step], list[Any]]] = {
    "renamed behind fifty rows": ([together(add(rows(3, 53)), rename, write(HEAD + rows(53, 55)))], list(range(1, 55))),
    "away for a while": ([rename, nothing, nothing, write(HEAD + rows(3, 5))], [1, 2, 3, 4]),
    "written to while it is away": (
        [rename, behind(rows(3, 5)), together(behind(rows(5, 6)), write(HEAD + rows(6, 8)))],
        list(range(1, 8)),
    ),
    "an empty one first": ([together(rename, write("")), behind(rows(3, 4)), write(HEAD + rows(4, 5))], [1, 2, 3, 4]),
    "goes on without names": ([together(rename, write(rows(3, 6)))], [1, 2, 3, 4, 5]),
    "other order and separator": ([together(rename, write("b;a\n3;0\n4;0\n"))], [1, 2, 3, 4]),
    "other columns": ([together(rename, write("c,d\n3,0\n4,0\n")), add(HEAD + rows(5, 6))], [1, 2, "-", "-", "-", 5]),
    "torn by a rotation": ([add("0,3"), together(rename, write(HEAD + rows(4, 5)))], [1, 2, 4]),
    "torn, then whole": ([add("0,3"), add("3\n")], [1, 2, 33]),
    "rewritten longer": ([write(HEAD + rows(7, 17))], [1, 2, "anew", *range(7, 17)]),
    "rewritten as long": ([write(HEAD + rows(7, 9)), add(rows(9, 10))], [1, 2, "anew", 7, 8, 9]),
    "cut": ([write(""), add(HEAD + rows(3, 4))], [1, 2, "anew", 3]),
    "cut, and written on where it was": ([padded(rows(3, 5))], [1, 2, "anew", "-", 4]),
    "deleted and made again": ([together(unlink, write(HEAD + rows(3, 5)))], [1, 2, "anew", 3, 4]),
    "deleted, and never made again": ([unlink, nothing], [1, 2]),
    "replaced by another": (
        [together(lambda f: f.with_suffix(".new").write_text(HEAD + rows(3, 5)), lambda f: os.replace(f.with_suffix(".new"), f))],
        [1, 2, "anew", 3, 4],
    ),
    "a link to the file of the day": ([swap(HEAD + rows(3, 5)), swap(HEAD + rows(5, 7))], [1, 2, 3, 4, 5, 6]),
    "a pipe for a while": ([together(rename, lambda f: os.mkfifo(f)), unlink, write(HEAD + rows(3, 5))], [1, 2, 3, 4]),
    "a folder for a while": ([together(rename, lambda f: f.mkdir()), lambda f: f.rmdir(), write(HEAD + rows(3, 5))], [1, 2, 3, 4]),
    "names again": ([add(HEAD + rows(3, 5)), add("# started\n\nb,a\n5,0\n")], [1, 2, 3, 4, 5]),
    "units": ([together(rename, write("a,b\nm,s\n" + rows(3, 5)))], [1, 2, 3, 4]),
    "lines of Windows": ([add("0,3\r\n\ufeff0,4\r\n")], [1, 2, 3, 4]),
    "no numbers": ([add('0,x\n0\n0,1,2\n0,1_0\n0,\uff11\n0,0x1\n"0,1\n0,inf\n0,\n'), add("0,3\n")], [1, 2, *"-------", "-", "-", 3]),
    "bytes": ([add(b"0,\xff\n0,\0\n\xff\xfe\n0,\xc3\n\0\0\0\n0,3\n")], [1, 2, *"-----", 3]),
    "a line without end": ([add(b"7" * (LONGEST_LINE + 9)), add(b"7" * LONGEST_LINE), add(b"\n0,3\n")], [1, 2, "-", 3]),
}


@pytest.mark.parametrize("story", STORIES)
def test_nothing_is_lost_nor_made_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, story: str) -> None:
    steps, expected = STORIES[story]
    file = tmp_path / "log.csv"
    file.write_text(HEAD + rows(1, 3))
    seen = told(file, steps, monkeypatch)
    assert seen == expected


def test_a_watch_that_ends_anywhere_goes_on_where_it_was(tmp_path: Path) -> None:
    """After each line in turn: the samples before and behind are those without the end, wherever comments and names stand."""
    file = tmp_path / "log.csv"
    file.write_text("# log\n\na,b\n0,1\n\n0,2\na,b\n0,3\nx\n0,4\n")

    def samples(after: dict[str, Any] | None) -> Any:
        followed = Followed(str(file), idle=0.0, after=after)
        return followed, TableStream(followed, ["b"], str(file), after=followed.begins.line)

    whole = [row[0] for row in samples(None)[1]]
    for count in range(len(whole) + 1):
        followed, table = samples(None)
        place, first = followed.place, []
        for row in table:
            first.append(row[0])
            place = followed.place
            if len(first) == count:
                break
        again = samples(followed.mark(place) if count else None)[1]
        assert np.array_equal([*first[:count], *(row[0] for row in again)], whole, equal_nan=True) and again.bad <= 1
    mark, heard = followed.mark(place), list[str]()
    file.write_text("a,b\n" + rows(11, 40))
    assert Followed(str(file), after=mark, heard=heard.append).begins.line == 0 and "is not the file that was watched" in heard[0]
    headless = TableStream([b"0,5\n", b"0,6\n"], ["b"], "x", head="a,b")
    assert [row[0] for row in headless if row is not None] == [5.0, 6.0]
    with pytest.raises(InvalidInput, match="there is no column 'b'"):
        list(TableStream([b"c,d\n", b"0,6\n"], ["b"], "x", head="a,b"))


def test_a_rewriting_between_two_saves_is_no_place_of_the_new_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "log.csv"
    file.write_text(HEAD + rows(1, 3))
    followed = Followed(str(file), idle=0.5)
    lines, place = iter(followed), followed.place
    for _ in range(3):
        next(lines)
        place = followed.place
    together(rename, write(HEAD + rows(3, 9)))(file)
    assert next(lines) is Break.rotated and followed.mark(place)["line"] == 0
    assert Followed(str(file), after=followed.mark(place)).begins.line == 0


def test_lines_of_a_stream_are_bounded_and_have_an_end() -> None:
    class Endless(io.RawIOBase):
        """It gives the same byte until `left` is none, and never a line; what is asked of it at once is `most`."""

        left, most = 5 * LONGEST_LINE, 0

        def readable(self) -> bool:
            return True

        def readinto(self, buffer: Any) -> int:
            size = min(len(buffer), self.left)
            buffer[:size] = b"7" * size
            self.left -= size
            return size

    heard: list[str] = []
    assert list(bounded(io.BufferedReader(Endless()), heard.append)) == [] and "the last line has no end" in heard[0]
    long = b"7" * (2 * LONGEST_LINE)
    assert [len(line) for line in bounded(io.BytesIO(b"1\n" + long + b"\n2\n3"), heard.append)] == [2, LONGEST_LINE, 2]
    assert [count for count in range(1, 20) if seldom(count)] == [1, 2, 4, 8, 16]


def test_what_is_told_of_lines_and_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file, heard = tmp_path / "log.csv", list[str]()
    file.write_text(HEAD + rows(1, 3))
    told(file, [add("x\n" * 5), rename, nothing, lambda f: f.mkdir(), nothing], monkeypatch, heard)
    ends = ["missing sample, 1 so far", "missing sample, 2 so far", "missing sample, 4 so far", "no such file or directory; waiting for it"]
    assert [line.endswith(end) for line, end in zip(heard, [*ends, "is a directory; waiting for it"], strict=True)] == [True] * 5
    assert "line 4 has 1 field separated by comma, expected 2 as in the first line; it counts" in heard[0]
