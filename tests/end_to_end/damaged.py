"""These are files of every kind that a command reads, and what can happen to them: bits, bytes, cuts, repeats, hostile words and numbers.

SOUND        the name of each file -> its bytes; the kind is in the suffix, and in the word before the first dash
damaged      such bytes with one to three harms, drawn
arguments    a command line that reads such a file, drawn where there are several
HARMS        what is done, each a function of the source of chance and the bytes
"""

from __future__ import annotations

import io
import json
import random
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import scipy.io

from faultspace.numeric.method.model.models import StateSpaceModel
from tests.end_to_end.commands import EXAMPLES, ROOT

WORDS = [
    b"NaN", b"inf", b"-inf", b"1e400", b"1e-320", b"9" * 400, b"\xff\xfe", b"\0", b'"', b"'", b"[[[[", b"1e12", b"-1", b"", b"0x10", b"1/0",
    b",", b"\n", b"\r", b"\x1b[31m", b"A" * 5000, b"y" * 200_000, b"{", b"}", b"null", b"true", b"1_000", b"\xc3\xa9", b"(" * 300,
]  # fmt: skip
NUMBERS = [b"1e300", b"1e-300", b"5e-324", b"0", b"-5", b"123456789012345678901234567890", *WORDS[:7]]
LENGTHS = [1, 2, 4, 8, 64, 1024]
NUMBER = re.compile(rb"-?\d+(\.\d+)?(e-?\d+)?")


@cache
def sound() -> dict[str, bytes]:
    """Return one file of each kind: tables, arrays, records of MATLAB, systems, experiments, certificates and claims."""
    source = np.random.default_rng(1)
    u = source.standard_normal((60, 1))
    y = np.hstack([np.convolve(u[:, 0], [1, 0.5, 0.25])[:60, None], np.cumsum(u, axis=0) * 0.1]) + 0.1 * source.standard_normal((60, 2))
    t = np.arange(60) * 0.1
    lines = [f"{t[k]},{u[k, 0]},{y[k, 0]},{y[k, 1]}" for k in range(60)]
    table = "\n".join(["time,u1,y1,y2", *lines]) + "\n"
    named = {"u": u, "y": y, "time": t}
    made = {
        "table.csv": table.encode(),
        "tabs.tsv": table.replace(",", "\t").encode(),
        "wide.csv": table.encode("utf-16"),
        "bare.txt": "\n".join(line.partition(",")[2].replace(",", " ") for line in lines).encode(),
        "array.npy": _written(np.save, np.hstack([u, y])),
        "arrays.npz": _written(lambda stream, kept: np.savez(stream, **kept), named),
        "packed.npz": _written(lambda stream, kept: np.savez_compressed(stream, **kept), named),
        "five.mat": _written(scipy.io.savemat, named),
        "packed.mat": _written(lambda stream, kept: scipy.io.savemat(stream, kept, do_compression=True), named),
        "four.mat": _written(lambda stream, kept: scipy.io.savemat(stream, kept, format="4"), named),
        "system-zeros.json": EXAMPLES.joinpath("zeros.json").read_bytes(),
        "system-paper.json": EXAMPLES.joinpath("paper.json").read_bytes(),
        "experiment.json": EXAMPLES.joinpath("independent-fault.json").read_bytes(),
        "model.json": json.dumps(_model().to_json()).encode(),
        "claims.toml": EXAMPLES.joinpath("claims.toml").read_bytes().replace(b"windows(n - 1)", b"windows(max(n - 1, 0))"),
    }
    kinds: dict[str, Path] = {}
    for path in sorted((ROOT / "proofs" / "certificates").glob("*-*.json"), key=lambda one: one.stat().st_size, reverse=True):
        kinds[path.name.rsplit("-", 1)[0]] = path  # the smallest of each kind
    return made | {f"certificate-{kind}.json": path.read_bytes() for kind, path in kinds.items()} | _of_extras(named)


def _model() -> StateSpaceModel:
    """Return a model of two states, one input and two outputs."""
    return StateSpaceModel(np.diag([0.5, 0.3]), np.ones((2, 1)), np.eye(2), np.zeros((2, 1)))


def _of_extras(named: dict[str, np.ndarray]) -> dict[str, bytes]:
    """Return the files of kinds whose library is there: Parquet, and MAT files of version 7.3."""
    made = {}
    try:
        import pyarrow
        import pyarrow.parquet

        columns = {"time": named["time"], "u1": named["u"][:, 0], "y1": named["y"][:, 0], "y2": named["y"][:, 1]}
        made["columns.parquet"] = _written(lambda stream, kept: pyarrow.parquet.write_table(pyarrow.table(kept), stream), columns)
    except ImportError:
        pass
    try:
        import h5py

        stream = io.BytesIO()
        with h5py.File(stream, "w", userblock_size=512) as file:
            for name in ("u", "y"):
                file[name] = named[name].T
        head = b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM"
        made["seven.mat"] = head + stream.getvalue()[len(head) :]
    except ImportError:
        pass
    return made


def _written(write: Callable[..., object], what: object) -> bytes:
    stream = io.BytesIO()
    write(stream, what)
    return stream.getvalue()


def _place(source: random.Random, content: bytes) -> tuple[int, int]:
    first = source.randrange(len(content))
    return first, min(len(content), first + source.choice(LENGTHS))


def _bit(source: random.Random, content: bytes) -> bytes:
    place = source.randrange(len(content))
    return content[:place] + bytes([content[place] ^ 1 << source.randrange(8)]) + content[place + 1 :]


def _early_byte(source: random.Random, content: bytes) -> bytes:
    place = source.randrange(min(len(content), 128))
    return content[:place] + bytes([source.randrange(256)]) + content[place + 1 :]


def _cut(source: random.Random, content: bytes) -> bytes:
    return content[: source.randrange(len(content))]


def _at_a_place(source: random.Random, content: bytes) -> bytes:
    """Delete, repeat or overwrite some bytes, or put a word before them or in their place."""
    first, last = _place(source, content)
    before, there, after = content[:first], content[first:last], content[last:]
    word, noise = source.choice(WORDS), source.randbytes(last - first)
    return before + source.choice([b"", there * 2, word + there, word, noise]) + after


def _number(source: random.Random, content: bytes) -> bytes:
    numbers = list(NUMBER.finditer(content))
    if not numbers:
        return content
    one = source.choice(numbers)
    return content[: one.start()] + source.choice(NUMBERS) + content[one.end() :]


HARMS = (_bit, _early_byte, _cut, *[_at_a_place] * 5, _number)


def damaged(source: random.Random, content: bytes) -> bytes:
    """Return the bytes with one to three harms."""
    for _ in range(source.randint(1, 3)):
        if content:
            content = source.choice(HARMS)(source, content)
    return content


def arguments(source: random.Random, name: str, path: Path, out: Path) -> list[str]:
    """Return a command line that reads the file at `path`, which was made of SOUND's file of this name; `out` is a folder to write into."""
    kind, suffix = name.partition("-")[0], name.rpartition(".")[2]
    if kind == "system":
        return source.choice(
            [
                ["inspect", str(path), "--json"],
                ["inspect", str(path), "--floats-exactly"],
                ["compare", str(path), "example:zeros"],
                ["claim", "example:claims", "--explain", str(path)],
            ]
        )
    if name == "model.json":
        stream = path.with_name("stream.csv")
        stream.write_bytes(sound()["table.csv"])
        chosen = ["--inputs", "u1", "--outputs", "y1,y2"]
        return ["monitor", str(path), *chosen, "--healthy-until", "40", "--window", "2", "--follow", str(stream), "--idle", "0.01"]
    if kind == "certificate":
        return ["check", str(path), "--json"]
    if name == "experiment.json":
        return ["limit", str(path), "--json"]
    if name == "claims.toml":
        return ["claim", str(path), "--most", "50", "--no-ablation"]
    channels = {"npy": ("data[:,0]", "data[:,1:3]"), "txt": ("data[:,0]", "data[:,1:3]"), "npz": ("u", "y"), "mat": ("u", "y")}
    u, y = channels.get(suffix, ("u1", "y1,y2"))
    chosen = ["--inputs", u, "--outputs", y, "--out", str(out)]
    known = source.choice([[], ["--gaps"], ["--healthy-until", "30"], ["--order", "2"], ["--healthy", str(path)]])
    return ["identify", str(path), *(chosen if source.random() < 0.8 else []), *known]
