"""How questions and answers cross between the audit and the process of an adapter: values as JSON, arrays with their bytes.

packed     a value as JSON has it: an array keeps its type, its order in memory, its strides, and whether it may be written to
unpacked   that value again. Nothing that was sent is run, and nothing that is no value is made: what cannot cross is `Unread`
"""

from __future__ import annotations

import ctypes
import math
from base64 import b64decode, b64encode
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from fractions import Fraction
from types import SimpleNamespace
from typing import Any

import numpy as np

from ....base.errors import shorten
from ..adapter import ZeroStructure

NUMBERS = "biufc"  # the kinds of numpy's types that are numbers
LARGEST = 64 << 20  # bytes of an array, which may be told in few words
_STRUCTURE = tuple(one.name for one in fields(ZeroStructure))


@dataclass(frozen=True)
class Unread:
    """It stands for an answer that is no value; to use it as one fails as it would have failed itself."""

    words: str

    def __repr__(self) -> str:
        return self.words


def packed(value: Any) -> Any:
    """Return what `json` writes, for any value; attributes are read of those alone that a ZeroStructure has."""
    if value is None or type(value) in (bool, int, float, str):
        return value
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, np.ndarray):
        return {"array": _array(value)} if value.dtype.kind in NUMBERS else {"objects": [value.shape, packed(value.ravel().tolist())]}
    if any(hasattr(value, name) for name in _STRUCTURE):
        return {"structure": {name: packed(getattr(value, name)) for name in _STRUCTURE if hasattr(value, name)}}
    match value:
        case Mapping():
            return {"mapping": [[str(key), packed(one)] for key, one in value.items()]}
        case list():
            return [packed(one) for one in value]
        case str():
            return str(value)
        case complex():
            return {"complex": [value.real, value.imag]}
        case Fraction():
            return {"fraction": [value.numerator, value.denominator]}
    return _otherwise(value)


def _otherwise(value: Any) -> Any:
    """Return the numbers of whatever else holds some, in the way in which numpy and Python would take them."""
    try:
        if hasattr(value, "__array__"):
            return packed(np.asarray(value, dtype=np.float64))
        if isinstance(value, Iterable):
            return {"tuple": [packed(one) for one in value]}
        return float(value)
    except Exception:
        return {"unread": shorten(value)}


def _array(value: Any) -> list[Any]:
    plain = np.asarray(value)
    if plain.flags.c_contiguous:
        return [plain.dtype.str, plain.shape, None, 0, value.flags.writeable, b64encode(plain.tobytes()).decode()]
    low, high = np.lib.array_utils.byte_bounds(plain)
    memory = b64encode(ctypes.string_at(low, high - low)).decode()
    return [plain.dtype.str, plain.shape, plain.strides, plain.ctypes.data - low, value.flags.writeable, memory]


def unpacked(sent: Any) -> Any:
    """Return the value that was packed. Raises ValueError, TypeError or KeyError for anything that `packed` does not give."""
    if isinstance(sent, list):
        return [unpacked(one) for one in sent]
    if not isinstance(sent, dict):
        return sent
    ((kind, inner),) = sent.items()
    match kind:
        case "array":
            return _read(*inner)
        case "objects":
            shape, entries = inner
            found = np.empty(len(entries), dtype=object)
            found[:] = unpacked(entries)
            return found.reshape(shape)
        case "structure":
            return SimpleNamespace(**{name: unpacked(inner[name]) for name in _STRUCTURE if name in inner})
        case "mapping":
            return {str(key): unpacked(one) for key, one in inner}
        case "tuple":
            return tuple(unpacked(one) for one in inner)
        case "complex":
            return complex(*inner)
        case "fraction":
            return Fraction(*inner)
        case "unread":
            return Unread(str(inner))
    raise ValueError(f"got {shorten(kind)}, no kind of value")


def _read(kind: str, shape: list[int], strides: list[int] | None, offset: int, writeable: bool, memory: str) -> Any:
    number = np.dtype(kind)
    if number.kind not in NUMBERS or math.prod(shape) * number.itemsize > LARGEST:
        raise ValueError(f"got an array of {math.prod(shape)} entries of {shorten(kind)}, expected numbers of at most {LARGEST} bytes")
    store = np.frombuffer(b64decode(memory), dtype=np.uint8).copy()
    found = np.ndarray(shape, number, store.data, offset, None if strides is None else tuple(strides))
    if strides is None:
        found = found.copy()
    found.flags.writeable = writeable
    return found
