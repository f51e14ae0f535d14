"""How the vectors are computed: systems drawn from fixed seeds, data and answers by the exact branch, bounds from conditioning.

    MAKERS                  kind -> function that makes its vectors; those of faults are in `fault_records`
    identification_vectors  n_u, p = 1, 2, 3, with and without D and initial state; smooth inputs; a long window
    structure_vectors       the same questions for the system itself; not left-invertible, without zeros; other coordinates
    consistency_vectors     a coloured fault
    documents               all files but one, name -> JSON document
    trouble_documents       that of the kinds of trouble
    main                    `python -m faultspace.numeric.audit.making --out DIR` writes the files

The bounds are those of the problem, not of one program. That of a model is the largest over two ways to compress (QR, Gram) and two
regressions for B and D, each a worst case to first order. That of a fault space is the conditioning of the kernel rows. That of a zero is
its condition number as an eigenvalue of the pencil times the rounding of a backward stable algorithm [GVL13].
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

import numpy as np

from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.limits.experiments import Experiment
from faultspace.exact.limits.filters import Filter
from faultspace.exact.limits.moesp import limit
from faultspace.exact.structure.record import Structure, analyze
from faultspace.exact.system.systems import FaultySystem, ResidualSystem

from ....base.writing import write_text
from ...method.model.compression import EPS
from ...study.conditioning import SMALL
from ..vectors.exact_comparison import roots
from ..vectors.fault_vectors import FaultView
from ..vectors.rationals import ROUNDING, floats, matrix, scaled
from ..vectors.recipe_vectors import ConsistencyVector
from ..vectors.shipped_vectors import FORMAT, KINDS, IdentificationVector, StructureVector
from ..vectors.trouble import SEED
from ..vectors.trouble import document as trouble_document
from .fault_records import fault_vectors, noisy_vectors, unexciting_vectors
from .model_bounds import bounded, model_bounds
from .planting import digits, stable, upward
from .trouble_vectors import drawn_troubles

# -- identification -----------------------------------------------------------------------------------------------------------------


def identification_vectors() -> list[IdentificationVector]:
    """The module says what these vectors are."""
    cases = [(n, n_u, p, True, True, 0) for n, n_u, p in [(2, 1, 1), (1, 2, 1), (2, 3, 1), (2, 1, 2), (3, 2, 2), (2, 3, 2)]]
    cases += [(3, 1, 3, True, True, 0), (2, 2, 3, True, True, 0), (3, 3, 3, True, True, 0)]
    cases += [(2, 2, 2, False, True, 0), (2, 2, 2, True, False, 0), (2, 2, 2, False, False, 0), (3, 1, 2, True, True, 4)]
    return [_identification(*case) for case in cases] + [_long_window()]


def _identification(n: int, n_u: int, p: int, feedthrough: bool, moving: bool, smoothing: int) -> IdentificationVector:
    rng = Random(f"{n} {n_u} {p}")
    A, B, C, D = stable(rng, n), digits(rng, n, n_u, 3), digits(rng, p, n, 5), digits(rng, p, n_u, 7)
    u = digits(rng, 80 + smoothing, n_u, 3)
    for _ in range(smoothing):
        u = u.rows(range(u.nrows - 1)) + u.rows(range(1, u.nrows))
    x0 = matrix([[20 + rng.randint(-9, 9)] for _ in range(n)], 1)
    D = D if feedthrough else Matrix.zero(D.field, p, n_u)
    x0 = x0 if moving else Matrix.zero(x0.field, n, 1)
    slug = f"n{n}-u{n_u}-p{p}" + ("" if feedthrough else "-no-D") + ("" if moving else "-at-rest") + ("-smooth" if smoothing else "")
    return _bounded(IdentificationVector(slug, A, B, C, D, x0, u, n + 2, {}))


def _long_window() -> IdentificationVector:
    """Return a vector for twenty block rows. The entries of A are halves, so that so many samples do not grow too long to write."""
    rng = Random("long window")
    halves = [[1, 1, 0, 1], [-1, 0, 1, 0], [0, 0, 1, 1], [0, 0, 0, -1]]
    A = matrix([[Fraction(entry, 2) for entry in row] for row in halves], 4)
    B, C, D = digits(rng, 4, 2, 1), digits(rng, 3, 4, 1), digits(rng, 3, 2, 1)
    u, x0 = digits(rng, 380, 2, 1), digits(rng, 4, 1, 1)
    return _bounded(IdentificationVector("n4-u2-p3-s20", A, B, C, D, x0, u, 20, {}))


def _bounded(blank: IdentificationVector) -> IdentificationVector:
    """Return the vector with the bounds of the whole record and of those parts of it that are long enough."""
    y, u = floats(blank.y), floats(blank.u)
    N, s, n_u, p = len(y), blank.block_rows, blank.B.ncols, blank.C.nrows
    needed = 2 * (n_u + p + 1) * s - 1  # as many windows as rows of [U; Y], past and future: with past outputs there are more
    cuts = {"time-shift": (7, N), "first-half": (0, N // 2), "second-half": (N // 2, N)}
    parts = {
        slug: (first, last, model_bounds(blank, y[first:last], u[first:last]))
        for slug, (first, last) in cuts.items()
        if last - first >= needed
    }
    return replace(bounded(blank), parts=parts)


# -- structure ----------------------------------------------------------------------------------------------------------------------


def structure_systems() -> list[tuple[str, ResidualSystem]]:
    """Entries are eighths, so that floats hold them exactly."""
    rng = Random("structure")

    def plain(n: int, m: int, p: int, feedthrough: int) -> ResidualSystem:
        F, C = (matrix([[Fraction(rng.randint(-9, 9), 8) for _ in range(b)] for _ in range(a)], b) for a, b in ((n, m), (p, n)))
        A = matrix([[Fraction(rng.randint(-6, 6), 8) for _ in range(n)] for _ in range(n)], n)
        G = [[Fraction(rng.randint(1, 9), 8) if feedthrough > j else 0 for j in range(m)] for _ in range(p)]
        return ResidualSystem(A, F, C, matrix(G, m))

    square = plain(3, 2, 2, 2)
    channel = [["1/2", "1", "0"], ["0", "1/4", "0"], ["0", "0", "1/4"]]
    return [
        ("square-proper", square),
        ("square-half-proper", plain(4, 2, 2, 1)),
        ("square-strictly-proper", plain(3, 1, 1, 0)),
        ("tall-without-zeros", plain(3, 1, 3, 0)),
        ("zero-outside", ResidualSystem.of(channel, [["1"], ["-1"], ["0"]], [["1", "0", "1"], ["2", "0", "0"]], [["0"], ["0"]])),
        ("chain-of-delays", ResidualSystem.of([[0, 1, 0], [0, 0, 1], [0, 0, 0]], [[0], [0], [1]], [[1, 0, 0]], [[0]])),
        ("same-fault-twice", square.with_faults(_doubled(square.F), _doubled(square.G))),
        ("wide", plain(3, 3, 2, 1)),
    ]


def _doubled(given: Matrix) -> Matrix:
    return given.columns([0, 0])


def structure_vectors() -> list[StructureVector]:
    """Yield the vectors that the module describes; those left-invertible come in three views as well, whose units are powers of two."""
    plain = [(slug, system, analyze(system)) for slug, system in structure_systems()]
    result = [_structure(slug, system, known) for slug, system, known in plain]
    for slug, system, known in plain:
        if known.left_invertible:
            result += [_structure(f"{slug}-{name}", seen, analyze(seen)) for name, seen in _otherwise(system)]
    return result


def _otherwise(system: ResidualSystem) -> list[tuple[str, ResidualSystem]]:
    """Return the system with a name each: in another state basis, with outputs turned round, and in other units."""
    units = [Fraction(2) ** (10 - 13 * i) for i in range(system.p)]
    C, G = (scaled(one.transposed(), units).transposed() for one in (system.C, system.G))
    basis, turned = FaultView("", other_basis=True), FaultView("", reversed_outputs=True)
    return [
        ("other-basis", basis.system(system)),
        *([("permuted-outputs", turned.system(system))] if system.p > 1 else []),
        ("other-units", ResidualSystem(system.A, system.F, C, G)),
    ]


def _structure(slug: str, system: ResidualSystem, known: Structure) -> StructureVector:
    zeros = roots(known.invariant_zero_polynomial) if known.finite_zeros else ()
    asked = zeros if known.left_invertible else ()
    bounds = tuple(upward(zero_bound(system, z)) for z in asked)
    return StructureVector(slug, system, known.kernel.normal_rank, asked, bounds, known.infinite_zero_orders)


def zero_bound(system: ResidualSystem, zero: complex) -> float:
    """Return SMALL (rows + columns) eps |P| |x| |y| / |y* E x| for the right null vector x of P(z) and the best left one y, E = diag(I,
    0).
    """
    A, F, C, G = (floats(M) for M in (system.A, system.F, system.C, system.G))
    n, m, p = system.n, system.m, system.p
    pencil = np.block([[zero * np.eye(n) - A, -F], [C, G]])
    left, values, right = np.linalg.svd(pencil)
    seen = int(np.sum(values > 1e-8 * values[0]))
    if seen != n + m - 1:
        raise ArithmeticError(f"{zero}: not a simple zero")
    derivative = np.concatenate([right[-1, :n].conj(), np.zeros(p)])
    conditioned = float(np.linalg.norm(left[:, seen:].conj().T @ derivative))
    return SMALL * (2 * n + m + p) * EPS * float(np.linalg.norm(pencil)) / conditioned


# -- consistency --------------------------------------------------------------------------------------------------------------------


def consistency_vectors() -> list[ConsistencyVector]:
    """Return two recipes: one channel with a = 1/2; two inputs and two outputs. Both faults have c = 9/10."""
    one = FaultySystem(ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]]), matrix([[1]], 1), matrix([[0]], 1))
    two = FaultySystem(
        ResidualSystem.of([["1/2", "1/4"], ["-1/4", "1/2"]], [["1"], ["-1"]], [["1", "0"], ["1/2", "1"]], [["1"], ["0"]]),
        matrix([["1", "0"], ["1/2", "1"]], 2),
        matrix([["0", "1"], ["1", "0"]], 2),
    )
    return [_consistency("coloured", one, 3, 20250519), _consistency("coloured-u2-p2", two, 4, 20250520)]


def _consistency(slug: str, system: FaultySystem, s: int, seed: int) -> ConsistencyVector:
    c, n, p = Fraction(9, 10), system.residual.n, system.residual.p
    unit = [["1" if j == i else "0" for j in range(system.nu + 1)] for i in range(system.nu + 1)]
    u_filter = Filter.of([unit[: system.nu]])
    v_filter = Filter.of([unit[system.nu :]], ["1", str(-c)])
    limits = limit(Experiment(system, s, s, u_filter, v_filter))
    if not limits.past_inputs.equals_observability_range:
        raise ArithmeticError(f"{slug}: past inputs are not consistent here")
    left = np.linalg.svd(floats(limits.past_outputs.matrix))[0][:, :n]
    biased = np.linalg.eigvals(np.linalg.lstsq(left[:-p], left[p:], rcond=None)[0])
    rounded = tuple(sorted((complex(round(z.real, 6), round(z.imag, 6)) for z in biased), key=lambda z: (abs(z), z.imag)))
    return ConsistencyVector(slug, system, c, s, 5000, seed, rounded)


MAKERS: dict[str, Callable[[], Sequence[Any]]] = {
    "identification": identification_vectors,
    "faults": fault_vectors,
    "unexciting": unexciting_vectors,
    "noisy": noisy_vectors,
    "structure": structure_vectors,
    "consistency": consistency_vectors,
}


# -- the files ----------------------------------------------------------------------------------------------------------------------


def documents() -> dict[str, dict[str, Any]]:
    """Return file name -> document, computed anew by the exact branch."""
    return {
        f"{kind}.json": {"format": FORMAT, "kind": kind, "rounding": ROUNDING, "vectors": [one.to_json() for one in MAKERS[kind]()]}
        for kind in KINDS
    }


def trouble_documents() -> dict[str, dict[str, Any]]:
    """Return the file of the kinds of trouble, of the default seed."""
    return {"trouble.json": trouble_document(drawn_troubles(SEED), SEED)}


def written(document: Mapping[str, Any]) -> str:
    """The file has one vector on each line."""
    head = {name: value for name, value in document.items() if name != "vectors"}
    lines = ",\n".join(json.dumps(one) for one in document["vectors"])
    return f'{json.dumps(head)[:-1]}, "vectors": [\n{lines}\n]}}\n'


def main(arguments: Sequence[str] | None = None) -> int:
    """This writes all files and returns 0."""
    parser = argparse.ArgumentParser(prog="python -m faultspace.numeric.audit.making", description="Make the audit's vectors.")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder for the files, made if it is not there")
    out: Path = parser.parse_args(arguments).out
    texts = {name: written(document) for name, document in {**documents(), **trouble_documents()}.items()}
    out.mkdir(parents=True, exist_ok=True)
    for name, text in texts.items():
        write_text(out / name, text)
    return 0
