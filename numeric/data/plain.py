"""Numbers, arrays and records as JSON has them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

import numpy as np


def plain(value: Any) -> Any:
    """Return what JSON has: null for None and for what is not finite, [real, imaginary] for complex numbers, lists for arrays and tuples,
    and what `to_json` gives for a record."""
    if value is None or isinstance(value, bool | int | str):
        return value
    if hasattr(value, "to_json"):
        return value.to_json()
    if isinstance(value, Mapping):
        return {key: plain(entry) for key, entry in value.items()}
    if np.ndim(value):
        return [plain(entry) for entry in value]
    if np.iscomplexobj(value):
        return [plain(value.real), plain(value.imag)]
    if isinstance(value, np.bool_ | np.integer):
        return value.item()
    return float(value) if np.isfinite(value) else None


def by_name(record: Any, *names: str) -> dict[str, Any]:
    """Return these fields and properties of a record in JSON, each under its name; all fields where none is named."""
    return {name: plain(getattr(record, name)) for name in names or [field.name for field in fields(record)]}
