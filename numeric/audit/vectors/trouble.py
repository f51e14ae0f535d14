"""A kind of trouble as vectors: the same system as a question of structure, of a model and of a residual, as far as it concerns each.

    Trouble             the kind, what is hard about it, the functions that it concerns, and the vectors
    default_troubles    those of the default seed, which come with the package
    VERSION, SEED       of the default set
    fingerprint         SHA-256 of all in a document of vectors that is exact

The file trouble.json has systems, signals, answers and bounds; records follow from them by simulation. Bounds come from floating point and
differ between machines in their last digits, so that the fingerprint leaves them out: all that it covers is the same everywhere.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from .fault_vectors import FaultVector
from .rationals import ROUNDING
from .shipped_vectors import FORMAT, IdentificationVector, StructureVector

VERSION = 4
SEED = 0


@dataclass(frozen=True, eq=False)
class Trouble:
    """`kind` names what is hard, `what` says it; `asks` are the functions it concerns. A vector is None where none of them needs it."""

    kind: str
    what: str
    asks: tuple[str, ...]
    structure: StructureVector | None
    model: IdentificationVector | None
    faults: FaultVector | None

    def to_json(self) -> dict[str, Any]:
        """The document is JSON-ready; outputs, residuals and answers of models are not spelt out."""
        return {
            "slug": self.kind,
            "what": self.what,
            "asks": list(self.asks),
            "structure": self.structure.to_json() if self.structure else None,
            "model": _model(self.model) if self.model else None,
            "faults": _faults(self.faults) if self.faults else None,
        }

    @staticmethod
    def from_json(data: Mapping[str, Any]) -> Trouble:
        """This reads the vectors that `to_json` wrote; records are computed again."""
        structure, model, faults = (data[name] for name in ("structure", "model", "faults"))
        return Trouble(
            data["slug"],
            data["what"],
            tuple(data["asks"]),
            StructureVector.from_json(structure) if structure else None,
            IdentificationVector.from_json({**model, "parts": []}) if model else None,
            FaultVector.from_json({**faults, "views": []}) if faults else None,
        )


def _model(vector: IdentificationVector) -> dict[str, Any]:
    matrices = {name: getattr(vector, name).to_json() for name in ("A", "B", "C", "D", "x0", "u")}
    return {"slug": vector.slug, "order": vector.order, "block_rows": vector.block_rows, **matrices, "bounds": dict(vector.bounds)}


def _faults(vector: FaultVector) -> dict[str, Any]:
    return {name: value for name, value in vector.to_json().items() if name not in ("r", "views")}


def document(troubles: Sequence[Trouble], seed: int) -> dict[str, Any]:
    """Return the file of these vectors."""
    head = {"format": FORMAT, "kind": "trouble", "rounding": ROUNDING, "version": VERSION, "seed": seed}
    whole = {**head, "vectors": [one.to_json() for one in troubles]}
    return {**head, "sha256": fingerprint(whole), "vectors": whole["vectors"]}


def fingerprint(whole: Mapping[str, Any]) -> str:
    """Return the SHA-256 of the document without bounds: UTF-8, keys in order, no blanks, complex zeros to twelve digits."""

    def exact(value: Any) -> Any:
        if isinstance(value, Mapping):
            return {key: exact(one) for key, one in value.items() if key not in ("bounds", "sha256")}
        if isinstance(value, (list, tuple)):
            return [exact(one) for one in value]
        return f"{value + 0.0:.12g}" if isinstance(value, float) else value

    return hashlib.sha256(json.dumps(exact(whole), sort_keys=True, separators=(",", ":")).encode()).hexdigest()


@cache
def default_troubles() -> tuple[Trouble, ...]:
    """Return the vectors of the default seed. Raises ValueError where the file is not the one that its own fingerprint is of."""
    read = json.loads(files("faultspace.numeric.audit.vectors").joinpath("data/trouble.json").read_text("utf-8"))
    if (read["format"], read["version"]) != (FORMAT, VERSION):
        raise ValueError(f"trouble.json has format {read['format']!r}, version {read['version']}; this program reads {FORMAT!r}, {VERSION}")
    if read["sha256"] != fingerprint(read):
        raise ValueError("trouble.json was changed: its fingerprint is another one")
    return tuple(Trouble.from_json(one) for one in read["vectors"])
