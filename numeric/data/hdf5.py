"""This reads the variables of a MAT file of version 7.3, which is HDF5, by h5py where it is installed.

MATLAB writes arrays in its own order, columns first, so that HDF5 has their axes the other way around: they are turned back here. What is
no array of numbers (structures, cells, text) is left out. HDF5 can have its numbers in other files of whoever reads it, by links, virtual
datasets and external storage: a file that does so is refused, and none of these is opened.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import psutil
from numpy.typing import NDArray

from ...base.errors import InvalidInput, shorten
from .damage import from_library, unpacks_to

KINDS = "fiub"
HARD = 0  # the type of a link to what is in the file itself: H5L_TYPE_HARD
EXPECTED = "a MAT file as MATLAB saves it"


class _Variables(Mapping[str, Any]):
    """The mapping gives the arrays of an open HDF5 file by name."""

    def __init__(self, file: Any) -> None:
        self._file = file
        with from_library("HDF5", EXPECTED):
            elsewhere = next((name for name in file if _leads_away(file, name)), None)
        if elsewhere is not None:
            raise InvalidInput(f"got {shorten(elsewhere)}, whose numbers may be in another file, expected {EXPECTED}")
        with from_library("HDF5", EXPECTED):
            self._names = [name for name, there in file.items() if getattr(there, "dtype", None) is not None and there.dtype.kind in KINDS]

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name not in self._names:
            raise KeyError(name)
        with from_library("HDF5", EXPECTED):
            there = self._file[name]
            size = there.size * there.dtype.itemsize
        # What nobody wrote takes no room in the file: only the memory that there is bounds such an array.
        unpacks_to(size, size, psutil.virtual_memory().available, "memory")
        with from_library("HDF5", EXPECTED):
            return np.asarray(there[()]).T

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


def _leads_away(file: Any, name: str) -> bool:
    """Say whether what has this name is a link, which may lead through another file, or a dataset that is stored in others."""
    if file.id.links.get_info(name.encode("utf-8", "surrogateescape")).type != HARD:
        return True
    there = file[name]
    return bool(getattr(there, "is_virtual", False) or getattr(there, "external", None))


def hdf5_arrays(path: Path, stack: ExitStack) -> Mapping[str, Any]:
    """Return the numeric variables of a MAT file of version 7.3, open until the stack closes. Raises InvalidInput without h5py, and for
    what is no HDF5."""
    try:
        h5py: Any = import_module("h5py")
    except ImportError:
        advice = "pip install 'faultspace[mat73]', or save it in MATLAB with the option '-v7'"
        raise InvalidInput(f"got a MAT file of version 7.3 (HDF5), which needs h5py: {advice}") from None
    try:
        with from_library("HDF5", EXPECTED):
            file = stack.enter_context(h5py.File(path, "r"))
    except OSError as error:
        raise InvalidInput(f"cannot be read as HDF5 ({error}), expected {EXPECTED}") from None
    return _Variables(file)
