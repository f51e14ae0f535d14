"""Small systems as a page shows them: matrices as texts, ranks over s beside two formulas, zeros, delays, a word that tells it apart.

described         the object of one system
against           the word that one of two systems makes and the other cannot, as texts; None where they make the same outputs
systems           those that can be chosen in the page: the packaged ones, and the small ones of the certificates of a run
matrix            a matrix as texts
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from importlib import resources
from typing import Any

from ...base.progress import Progress, silent
from ...exact.algebra.matrices import Matrix
from ...exact.algebra.notation import entry, field_words, polynomial
from ...exact.structure.behavior import Comparison, compare
from ...exact.structure.record import analyze
from ...exact.system.systems import FaultySystem, ResidualSystem, System, read_system, residual_of

PACKAGED = ("paper", "theorem-1-first", "theorem-1-second", "proposition-3", "theorem-3", "theorem-3-bad-pair", "zeros", "same-behaviour")
LARGEST, MOST = 6, 24  # n + m + p of a system out of a certificate, and how many of them are offered beside the packaged ones


def systems(certificates: Mapping[str, Mapping[str, Any]], *, on_progress: Progress = silent) -> dict[str, Any]:
    """Return the systems that can be chosen, each with a word that it makes and the same system without its faults cannot."""
    listed = []
    chosen = [*_packaged(), *_of_certificates(certificates)]
    for place, (name, system) in enumerate(chosen):
        on_progress("computing the systems to choose from", place, len(chosen))
        listed.append({"name": name, **described(system), "word": _beside_healthy(residual_of(system))})
    return {"systems": listed}


def described(system: System) -> dict[str, Any]:
    """Return the matrices of a system, its structure, and its ranks over s by two formulas: that of the indices, and that of theorem-2."""
    residual = residual_of(system)
    structure = analyze(residual)
    document = structure.to_json()
    windows = list(range(1, len(document["window_ranks"]) + 1))
    indices, r = document["left_minimal_indices"], document["normal_rank"]
    names = {"A": residual.A, "F": residual.F, "C": residual.C, "G": residual.G}
    if isinstance(system, FaultySystem):
        names |= {"B": system.B, "D": system.D}
    return {
        "sizes": residual.sizes,
        "field": field_words(residual.field),
        "matrices": {name: matrix(found) for name, found in names.items()},
        "structure": document,
        "zero_polynomial": polynomial(structure.invariant_zero_polynomial, residual.field),
        "windows": windows,
        "by_indices": [s * r + sum(min(s, index) for index in indices) for s in windows],
        "by_zeros": [residual.n + s * residual.m - document["zeta"] for s in windows] if document["left_invertible"] else None,
        "fault_space": matrix(structure.fault_space.F.transposed(), structure.fault_space.G.transposed()),
    }


def matrix(*parts: Matrix) -> dict[str, Any]:
    """Return matrices of equal height beside each other, with each entry as a text."""
    rows = parts[0].nrows
    entries = [[entry(part[i, j], part.field) for part in parts for j in range(part.ncols)] for i in range(rows)]
    return {"rows": rows, "columns": sum(part.ncols for part in parts), "entries": entries}


def against(
    first: ResidualSystem, second: ResidualSystem, names: Sequence[str] = ("first system", "second system")
) -> dict[str, Any] | None:
    """Return the shortest word that one makes and the other cannot, with the law of the other that it breaks."""
    return _word(compare(first, second), names)


def _word(found: Comparison, names: Sequence[str]) -> dict[str, Any] | None:
    word = found.word
    if word is None:
        return None
    field, row = word.maker.field, word.separation.row.coefficients
    maker, other = names if word.of == "first" else reversed(names)
    return {
        "samples": word.separation.window,
        "maker": maker,
        "other": other,
        "x0": matrix(word.separation.x0)["entries"],
        "v": matrix(word.separation.v)["entries"],
        "r": matrix(word.outputs)["entries"],
        "law": [polynomial([row[k, j] for k in range(row.nrows)], field) for j in range(row.ncols)],
    }


def _beside_healthy(system: ResidualSystem) -> dict[str, Any] | None:
    """Return a word that the system makes by its faults, None where they do not show in the outputs."""
    zero = [[0] * system.m for _ in range(max(system.n, system.p))]
    if not (system.n and system.m and system.p):
        return None
    healthy = ResidualSystem(system.A, Matrix.of(zero[: system.n], system.field), system.C, Matrix.of(zero[: system.p], system.field))
    return _word(compare(system, healthy), ("this system", "the same system without its faults"))


def _packaged() -> Iterator[tuple[str, System]]:
    for name in PACKAGED:
        text = resources.files("faultspace").joinpath("examples", f"{name}.json").read_text("utf-8")
        yield f"example:{name}", read_system(json.loads(text))


def _of_certificates(certificates: Mapping[str, Mapping[str, Any]]) -> list[tuple[str, System]]:
    """Return the smallest different systems that the certificates of a run are about, the degenerate ones left out."""
    found: dict[str, tuple[str, ResidualSystem]] = {}
    for digest, certificate in certificates.items():
        for document in (certificate["statement"].get(name) for name in ("system", "first", "second", "inner", "outer")):
            if document is None:
                continue
            residual = residual_of(read_system(document))
            n, m, p = residual.n, residual.m, residual.p
            if n >= 1 and m >= 1 and p >= 1 and n + m + p <= LARGEST and not residual.F.is_zero() and not residual.C.is_zero():
                found.setdefault(json.dumps(residual.to_json(), sort_keys=True), (f"{certificate['kind']}-{digest[:12]}", residual))
    ordered = sorted(found.items(), key=lambda item: (item[1][1].n + item[1][1].m + item[1][1].p, len(item[0]), item[0]))
    largest_first = ordered[::-1][:MOST]  # of equal interest to a reader are the larger ones: with one state there is little to see
    return [value for _, value in largest_first[::-1]]
