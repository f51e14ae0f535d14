"""Measured data from files: named columns of CSV, Parquet, NPZ and MAT files as inputs and outputs.

read_record     the chosen channels of a file
Record          y (N, p), u (N, n_u), the channels' names, the format
split_names     "a,b[:,1:3]" -> ["a", "b[:,1:3]"]: commas inside brackets do not separate
FORMATS         suffix -> format

A channel is chosen by its column's name. For matrices (NPZ, MAT, and text without a line of names, which is the matrix `data`): NAME is
all columns, NAME[:,j] or NAME[j] column j, NAME[:,i:j] several, NAME[i,:] row i, NAME[i,j] channel (i, j) of an array whose first of three
axes is time. Indices count from 0. The arrays are new; the file is only read. Everything wrong raises InvalidInput: what was got, what is
needed, what to try.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .exact.input_rules import InvalidInput, shown
from .failures import placed
from .text_tables import TextTable

Array = NDArray[np.float64]
Tell = Callable[[int, int], None]

FORMATS = {
    ".csv": "text", ".tsv": "text", ".txt": "text", ".dat": "text",
    ".parquet": "Parquet", ".pq": "Parquet", ".npz": "NPZ", ".mat": "MAT",
}  # fmt: skip
MOST_NAMED = 12
MATRIX = "data"
_SELECTOR = re.compile(r"^(?P<name>.+?)\[(?P<indices>[0-9:,\s]+)\]$")


@dataclass(frozen=True, eq=False)
class Record:
    """y (N, p) and u (N, n_u) in float64, all values finite; `outputs` and `inputs` name their columns; `format` is how they were read."""

    y: Array
    u: Array
    outputs: tuple[str, ...]
    inputs: tuple[str, ...]
    format: str


def split_names(given: Sequence[str]) -> list[str]:
    """The names in options that may each hold several, separated by commas outside brackets."""
    names = [name.strip() for text in given for name in re.split(r",(?![^\[\]]*\])", text)]
    return [name for name in names if name]


def read_record(path: str, *, inputs: Sequence[str], outputs: Sequence[str], tell: Tell | None = None) -> Record:
    """The record in the file at `path`; `tell` hears how much of how much has been read. Raises InvalidInput."""
    with placed(path):
        chosen = {"inputs": split_names(inputs), "outputs": split_names(outputs)}
        for option, names in chosen.items():
            if not names:
                raise InvalidInput(f"got no {option}, expected at least one channel: try --{option} NAME,NAME")
        columns, read_as = _columns(Path(path), [*chosen["inputs"], *chosen["outputs"]], tell or (lambda done, total: None))
        u_names, u = _gathered(chosen["inputs"], columns)
        y_names, y = _gathered(chosen["outputs"], columns)
        both = [name for name in u_names if name in y_names]
        if both:
            raise InvalidInput(f"got channel {shown(both[0])} as input and as output, expected it to be one of them")
        if len(u) != len(y):
            raise InvalidInput(f"got inputs of {len(u)} samples and outputs of {len(y)}, expected as many: cut them to those they share")
        return Record(y, u, tuple(y_names), tuple(u_names), read_as)


def _columns(path: Path, names: Sequence[str], tell: Tell) -> tuple[Mapping[str, Array], str]:
    """The arrays (N, k) by the selector that asked for them, and the format."""
    read_as = FORMATS.get(path.suffix.lower())
    if read_as is None:
        raise InvalidInput(f"got a file whose name ends in {shown(path.suffix)}, expected {', '.join(FORMATS)}: rename or convert it")
    try:
        with open(path, "rb"):
            pass
        reader = {"text": _text, "Parquet": _parquet, "NPZ": _npz, "MAT": _mat}[read_as]
        return reader(path, names, tell), read_as
    except (OSError, EOFError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise InvalidInput(f"cannot be read as {read_as} data ({reason[:1].lower()}{reason[1:]}), expected a data file") from None


def _gathered(names: Sequence[str], columns: Mapping[str, Array]) -> tuple[list[str], Array]:
    """The channels' names and their values side by side."""
    labels: list[str] = []
    parts = []
    for name in names:
        part = columns[name]
        labels += [name] if part.shape[1] == 1 else _labels(name, part.shape[1])
        parts.append(part)
        _finite(name, part)
    twice = [label for i, label in enumerate(labels) if label in labels[:i]]
    if twice:
        raise InvalidInput(f"got channel {shown(twice[0])} twice, expected every channel once")
    lengths = {len(part) for part in parts}
    if len(lengths) > 1:
        sizes = ", ".join(f"{name} {len(part)}" for name, part in zip(names, parts, strict=True))
        raise InvalidInput(f"got channels of unequal length ({sizes}), expected as many samples of each: cut them to those they share")
    return labels, np.ascontiguousarray(np.hstack(parts))


def _labels(selector: str, count: int) -> list[str]:
    """The channels that a selector of several stands for: its last range replaced by each number."""
    match = _SELECTOR.match(selector)
    name, indices = (match["name"], match["indices"].split(",")) if match else (selector, [":", ":"])
    place = max(i for i, index in enumerate(indices) if ":" in index)
    start = indices[place].partition(":")[0].strip()
    first = int(start) if start else 0
    return [f"{name}[{','.join([*indices[:place], str(first + j), *indices[place + 1:]])}]" for j in range(count)]


def _finite(name: str, values: Array) -> None:
    if np.isfinite(np.sum(values)):
        return
    wrong = np.argwhere(~np.isfinite(values))
    if len(wrong):
        k, j = (int(number) for number in wrong[0])
        what = "no number (NaN or empty)" if np.isnan(values[k, j]) else "infinite"
        count = "" if len(wrong) == 1 else f" and {len(wrong) - 1} more"
        raise InvalidInput(
            f"channel {shown(name)} is {what} at sample {k} (counted from 0){count}, expected finite numbers: cut the record before or "
            "after, or fill the samples in"
        )


def _missing(name: str, there: Sequence[str], what: str) -> InvalidInput:
    if not there:
        return InvalidInput(f"got no {what} at all, expected {shown(name)}")
    listed = ", ".join(there[:MOST_NAMED]) + (f", ... ({len(there)} in all)" if len(there) > MOST_NAMED else "")
    near = [other for other in there if other.lower().strip() == name.lower().strip()]
    advice = f"; did you mean {shown(near[0])}?" if near else ""
    return InvalidInput(f"there is no {what} {shown(name)}, expected one of: {listed}{advice}")


def _text(path: Path, names: Sequence[str], tell: Tell) -> Mapping[str, Array]:
    table = TextTable.opened(path)
    wanted: dict[str, list[int]] = {}
    for name in names:
        if table.names is not None:
            if name not in table.names:
                raise _missing(name, table.names, f"column (separated by {table.separator_name})")
            wanted[name] = [table.names.index(name)]
        else:
            # The first line of values tells the width: a selector on it tells the columns.
            stand_in = np.tile(np.arange(table.width), (2, 1))
            picked = _picked({MATRIX: stand_in}, name, "matrix; the file has no line of names, so its columns are")
            if not np.array_equal(picked[0], picked[-1]):
                raise InvalidInput(f"got {shown(name)}, expected columns {MATRIX}[:,j] of a file without a line of names")
            wanted[name] = [int(j) for j in picked[0]]
    places = sorted({place for group in wanted.values() for place in group})
    values = table.values(places, tell)
    return {name: values[:, [places.index(place) for place in group]] for name, group in wanted.items()}


def _parquet(path: Path, names: Sequence[str], tell: Tell) -> Mapping[str, Array]:
    try:
        parquet: Any = import_module("pyarrow.parquet")
        arrow: Any = import_module("pyarrow")
    except ImportError:
        advice = "pip install 'faultspace[parquet]', or write the data as CSV or NPZ"
        raise InvalidInput(f"got a Parquet file, which needs pyarrow: {advice}") from None
    try:
        with parquet.ParquetFile(path) as file:
            there = list(file.schema_arrow.names)
            for name in names:
                if name not in there:
                    raise _missing(name, there, "column")
                kind = file.schema_arrow.field(name).type
                if not (arrow.types.is_integer(kind) or arrow.types.is_floating(kind) or arrow.types.is_boolean(kind)):
                    raise InvalidInput(f"column {shown(name)} holds values of type {kind}, expected numbers")
            groups = []
            for number in range(file.num_row_groups):
                table = file.read_row_group(number, columns=sorted(set(names)))
                columns = [table.column(name).cast(arrow.float64()).to_numpy() for name in names]
                groups.append(np.column_stack([np.asarray(column, dtype=np.float64) for column in columns]))
                tell(number + 1, file.num_row_groups)
    except arrow.ArrowException as error:
        raise InvalidInput(f"cannot be read as Parquet data ({error}), expected a Parquet file") from None
    values = np.concatenate([np.zeros((0, len(names))), *groups])
    _some(len(values))
    return {name: values[:, [j]] for j, name in enumerate(names)}


def _npz(path: Path, names: Sequence[str], tell: Tell) -> Mapping[str, Array]:
    try:
        with np.load(path, allow_pickle=False) as file:
            if not hasattr(file, "files"):
                raise InvalidInput("got a single array under the name of an archive, expected an NPZ file: write it with numpy.savez")
            arrays = _Lazily(file.files, file.__getitem__)
            return {name: _signal(_picked(arrays, name, "array"), name) for name in names}
    except ValueError as error:
        if isinstance(error, InvalidInput):
            raise
        advice = "expected arrays of numbers as numpy.savez writes them"
        raise InvalidInput(f"cannot be read as NPZ data ({_first_line(error)}), {advice}") from None
    except Exception as error:  # zipfile.BadZipFile, zlib.error: damaged archives
        if isinstance(error, (InvalidInput, OSError, EOFError, MemoryError)):
            raise
        raise InvalidInput(f"cannot be read as NPZ data ({_first_line(error)}), expected a file as numpy.savez writes it") from None


def _mat(path: Path, names: Sequence[str], tell: Tell) -> Mapping[str, Array]:
    from scipy.io import loadmat, whosmat
    from scipy.io.matlab import MatReadError

    try:
        there = [name for name, _, _ in whosmat(path)]
        arrays = _Lazily(there, lambda name: loadmat(path, variable_names=[name])[name])
        return {name: _signal(_picked(arrays, name, "variable"), name) for name in names}
    except NotImplementedError:
        raise InvalidInput("got a MAT file of version 7.3 (HDF5), expected version 7 or older: save it with the option '-v7'") from None
    except (MatReadError, ValueError, TypeError, KeyError, IndexError) as error:
        if isinstance(error, InvalidInput):
            raise
        raise InvalidInput(f"cannot be read as MAT data ({_first_line(error)}), expected a MAT file of version 7 or older") from None


class _Lazily(Mapping[str, Any]):
    """Arrays by name, each read when asked for and then kept."""

    def __init__(self, names: Sequence[str], read: Callable[[str], Any]) -> None:
        self._names, self._read = list(names), read
        self._kept: dict[str, Any] = {}

    def __getitem__(self, name: str) -> Any:
        if name not in self._kept:
            self._kept[name] = self._read(name)
        return self._kept[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


def _picked(arrays: Mapping[str, Any], selector: str, what: str) -> Any:
    """What the selector stands for: an array itself, or NAME[...] of one."""
    there = list(arrays)
    if selector in there:
        return arrays[selector]
    match = _SELECTOR.match(selector)
    if match is None or match["name"] not in there:
        raise _missing(match["name"] if match else selector, there, what)
    array = np.asarray(arrays[match["name"]])
    parts = [part.strip() for part in match["indices"].split(",")]
    try:
        index = tuple(int(part) if ":" not in part else _range(part) for part in parts)
    except (ValueError, TypeError):
        raise InvalidInput(f"got {shown(selector)}, expected NAME[:,j] with j an integer counted from 0 or a range i:j") from None
    name, shape = match["name"], " x ".join(map(str, array.shape))
    if len(index) == array.ndim - 1 and not (len(index) == 1 and isinstance(index[0], slice)):
        index = (slice(None), *index)  # the axis not spoken of is time
    if len(index) != array.ndim:
        pattern = ",".join([":", *"j" * (array.ndim - 1)])
        raise InvalidInput(f"got {shown(selector)} of a {shape} array, expected {array.ndim} indices, as in {name}[{pattern}]")
    try:
        picked = array[index]
    except IndexError:
        raise InvalidInput(f"got {shown(selector)}, but {name} is {shape}: indices count from 0") from None
    if picked.ndim == 0:
        advice = f"{name}[:,{parts[-1]}] is column {parts[-1]}"
        raise InvalidInput(f"got {shown(selector)}, one number of a {shape} array; expected a channel: {advice}")
    return picked


def _range(text: str) -> slice:
    first, last = (int(number) if number.strip() else None for number in text.split(":"))
    return slice(first, last)


def _signal(values: Any, name: str) -> Array:
    """Values as (N, k): a vector is one channel, whichever way it lies."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiub":
        hint = "its real and imaginary part as two channels" if array.dtype.kind == "c" else "a plain array of numbers"
        raise InvalidInput(f"{shown(name)} holds values of type {array.dtype}, expected {hint}")
    if array.ndim == 2 and 1 in array.shape:
        array = array.reshape(-1)
    if array.ndim == 1:
        array = array[:, np.newaxis]
    if array.ndim != 2:
        shape = " x ".join(map(str, array.shape))
        raise InvalidInput(f"{shown(name)} is {shape}, expected one channel or (samples, channels): choose with NAME[:,j] or NAME[i,j]")
    _some(len(array))
    if array.shape[1] > len(array):
        rows, columns = array.shape
        advice = f"{name}[i,:] is row i" if "[" not in name else "write it transposed"
        looks = f"{rows} samples of {columns} channels and looks transposed"
        raise InvalidInput(f"{shown(name)} has {looks}, expected a row a sample: {advice}")
    return array.astype(np.float64)


def _some(samples: int) -> None:
    if samples == 0:
        raise InvalidInput("got no samples, expected a record of many")


def _first_line(error: Exception) -> str:
    return (str(error).strip().splitlines() or [type(error).__name__])[0]
