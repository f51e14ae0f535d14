"""These certificates say what the exact branch found, in the form that `checker.py` accepts (the format is FORMAT.md).

    one function a kind      each takes a system or its kernel representation and returns the JSON-ready certificate
    sha256                   the name of a certificate
    Unprovable               raised when asked to certify what is not so
    accept                   puts a certificate before the checker; nothing that a verdict rests on goes another way

The functions here are untrusted: a wrong certificate is one that the checker rejects.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from itertools import combinations
from threading import local
from typing import Any

from flint import fmpz

from ...base.sheets import counted
from ...exact.algebra.fields import Field, NumberField, PrimeField
from ...exact.algebra.matrices import Matrix, beside, rank, row_echelon, stacked
from ...exact.algebra.polynomials import Poly, PolyMatrix, SmithDiagonal, monic, multiply, written
from ...exact.algebra.stability import is_stable
from ...exact.pairs.linear_determinants import linear_determinant
from ...exact.structure.behavior import Separation, separation
from ...exact.structure.fault_columns import FaultSpace
from ...exact.structure.inversion import ambiguous_word, delay_known_state, delay_unknown_state, left_inverse
from ...exact.structure.kernel_rows import KernelRepresentation, column_conditions, kernel_representation
from ...exact.structure.pencil import finite_diagonal, infinite_diagonal, right_null_polynomial
from ...exact.structure.signals import excitation_matrix, hankel, simulate
from ...exact.system.modular import LARGEST_PRIME, image, reduce_matrix
from ...exact.system.systems import ResidualSystem
from ...exact.system.windows import observability_matrix, reachability_matrix, toeplitz_matrix, window_matrix
from . import checker
from .kernel_witnesses import common_witness, irreducible, kernel_witness, modular_witness, named_image, point_witness, window_witness

Certificate = dict[str, Any]
MOST_READ = 128  # systems that are kept as the checker read them


class Unprovable(ValueError):
    """The statement asked for is not true of these systems, or, where a function says so, has no witness."""


def sha256(certificate: Certificate) -> str:
    """Return the name of a certificate: the SHA-256 over sorted keys without white space, in UTF-8."""
    text = json.dumps(certificate, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    return hashlib.sha256(text.encode()).hexdigest()


class _Read(local):
    """What the checker read lately of the same JSON, of each thread its own: a system stands in many certificates, one after the other."""

    def __init__(self) -> None:
        self.known: dict[tuple[object, str], checker.System] = {}

    def __call__(self, key: str, data: Any) -> checker.System:
        """Return the SYSTEM or EXPERIMENT that stands under this key of a statement. Equal texts are equal JSON, down to 1 and true."""
        name = checker.SUBJECTS[key], json.dumps(data)
        if name not in self.known:
            if len(self.known) >= MOST_READ:
                self.known.clear()
            self.known[name] = checker.SUBJECTS[key](data)
        return self.known[name]


_read = _Read()


def accept(certificate: Certificate) -> str:
    """Return the SHA-256 of the certificate, once the checker has verified it without assuming anything, so that distinct ones can be
    counted. Raises checker.Rejected or checker.Malformed."""
    about = checker.decide(certificate, _read)
    if not about[0].field.irreducible(certificate["witness"]):
        raise checker.Rejected(f"verified only under an assumption: {'; '.join(checker.verify(certificate).assumes)}")
    return sha256(certificate)


def window_ranks(kernel: KernelRepresentation) -> Certificate:
    """Return the certificate of rank [O_s T_s] for every s, with exact rows."""
    return _window_ranks(kernel.system, kernel.left_minimal_indices, kernel_witness(kernel))


def window_ranks_of(system: ResidualSystem) -> Certificate:
    """Return the certificate of rank [O_s T_s] for every s, with rows modulo a prime alone where these are enough, else with exact rows.

    What keeps a window from the rank that its shape allows is said by states and faults without output, where small numbers say it.
    """
    found = modular_witness(system)
    return window_ranks(kernel_representation(system)) if found is None else _window_ranks(system, *found)


def left_invertible(kernel: KernelRepresentation) -> Certificate:
    """The certificate that the system is left-invertible, or that it is not, whichever is so."""
    system = kernel.system
    statement = {"system": system.to_json()}
    if kernel.normal_rank == system.m:
        return as_certificate("left-invertible", statement, point_witness(kernel))
    null = right_null_polynomial(system)
    if null is None:
        raise ArithmeticError("normal rank below m without a right null vector")
    witness = {"state": null.state.to_json(), "fault": null.fault.to_json()}
    return as_certificate("not-left-invertible", statement, witness | irreducible(system.field))


def left_invertible_line(first: ResidualSystem, second: ResidualSystem) -> Certificate:
    """(A, a F + b F', C, a G + b G') is left-invertible for every (a : b), F and G of the first system, F' and G' of the second.

    Raises ValueError where A, C or the number of faults differ, and Unprovable when some (a : b), perhaps over an extension, is an
    exception; over GF(p) with p <= n also when its p points are too few to show that there is none.
    """
    if (first.A, first.C, first.m) != (second.A, second.C, second.m):
        raise ValueError("got two systems that differ in A, C or the number of faults, expected a line of faults of one system")
    minors, multiples = _coprime_minors(first, second)
    statement = {"first": first.to_json(), "second": second.to_json()}
    return as_certificate("left-invertible-line", statement, _line_image(first, second, multiples) | {"minors": minors})


def inversion_delay(kernel: KernelRepresentation, *, known_state: bool) -> Certificate:
    """Return the certificate of the delay of left inversion with the initial state known or unknown, or that there is none."""
    system = kernel.system
    delay = delay_known_state(kernel) if known_state else delay_unknown_state(kernel)
    statement = {"system": system.to_json(), "initial_state": "known" if known_state else "unknown", "delay": delay}
    witness = irreducible(system.field)
    if delay is not None:
        inverse = left_inverse(system, delay, known_state=known_state)
        if inverse is None:
            raise ArithmeticError("no left inverse at the delay found")
        witness["inverse"] = inverse.to_json()
    if delay != 0:
        word = ambiguous_word(system, system.n + 1 if delay is None else delay, known_state=known_state)
        if word is None:
            raise ArithmeticError("no ambiguous word below the delay found")
        witness["word"] = {"x0": _column(word.x0), "v": word.v.to_json()}
    return as_certificate("inversion-delay", statement, witness)


def behaviour_inclusion(inner: ResidualSystem, outer: KernelRepresentation) -> Certificate:
    """Return the certificate that B(inner) lies in B(outer) on every window. Raises Unprovable when it does not."""
    if separation(inner, outer) is not None:
        raise Unprovable("the inner behaviour has a word that the outer one has not")
    statement = {"inner": inner.to_json(), "outer": outer.system.to_json()}
    return as_certificate("behaviour-inclusion", statement, kernel_witness(outer))


def behaviour_equality(first: KernelRepresentation, second: KernelRepresentation) -> Certificate:
    """Return the certificate that B(first) = B(second). Raises Unprovable when they differ."""
    if separation(first.system, second) is not None or separation(second.system, first) is not None:
        raise Unprovable("the behaviours differ")
    statement = {"first": first.system.to_json(), "second": second.system.to_json()}
    return as_certificate("behaviour-equality", statement, common_witness(second.system, first))


def window_equality(first: KernelRepresentation, second: KernelRepresentation, window: int) -> Certificate:
    """The certificate of equal restricted behaviours on `window` samples. Raises Unprovable when they differ there."""
    for maker, other in ((first.system, second), (second.system, first)):
        found = separation(maker, other)
        if found is not None and found.window <= window:
            raise Unprovable(f"the behaviours differ on {counted(found.window, 'sample')}")
    statement = {"first": first.system.to_json(), "second": second.system.to_json(), "window": window}
    return as_certificate("window-equality", statement, window_witness(second.system, first, window))


def behaviour_difference(first: ResidualSystem, second: KernelRepresentation) -> Certificate:
    """Return the certificate of the shortest word of the first system that the second cannot make. Raises Unprovable when there is none."""
    found: Separation | None = separation(first, second)
    if found is None:
        raise Unprovable("every word of the first system is one of the second")
    statement = {"first": first.to_json(), "second": second.system.to_json(), "window": found.window}
    witness = {"x0": _column(found.x0), "v": found.v.to_json(), "row": found.row.coefficients.to_json()}
    return as_certificate("behaviour-difference", statement, witness | irreducible(first.field))


def fault_space(kernel: KernelRepresentation, space: FaultSpace) -> Certificate:
    """Return the certificate of the solution space of problem (11) at the window of `space`, or of its limit."""
    statement = {"system": kernel.system.to_json(), "window": space.window, "basis": space.basis.to_json()}
    return as_certificate("fault-space", statement, kernel_witness(kernel, space.window))


def first_column_only(kernel: KernelRepresentation, window: int, column: Matrix) -> Certificate:
    """Return the certificate that N_s annihilates the first block column of T_s(z), z = column ((n + p) x 1), but not all of T_s(z).

    Raises Unprovable where that is not so."""
    # The first condition of a row, X_1 f + N_0 g, is that of the first block column, and the others are those of the columns behind it.
    conditions = [column_conditions(row.coefficients, kernel.system.A, kernel.system.C) @ column for row in kernel.rows_within(window)]
    if not all(found.rows([0]).is_zero() for found in conditions):
        raise Unprovable("the first block column is not annihilated")
    if all(found.is_zero() for found in conditions):
        raise Unprovable("every block column is annihilated")
    statement = {"system": kernel.system.to_json(), "window": window, "column": _column(column)}
    return as_certificate("first-column-only", statement, kernel_witness(kernel, window))


def matrix_rank(name: str, system: ResidualSystem, *, window: int | None = None) -> Certificate:
    """Return the certificate of the rank of a matrix of the system: "observability", "reachability", "toeplitz" or "window"."""
    statement: dict[str, Any] = {"matrix": name, "system": system.to_json()}
    if name in ("toeplitz", "window"):
        statement["window"] = window
    builders = {
        "observability": lambda: observability_matrix(system, system.n),
        "reachability": lambda: reachability_matrix(system),
        "toeplitz": lambda: toeplitz_matrix(system, window or 0),
        "window": lambda: window_matrix(system, window or 0),
    }
    return _rank_certificate(statement, system, builders[name]())


def data_rank(name: str, system: ResidualSystem, x0: Matrix, v: Matrix, window: int) -> Certificate:
    """Return the certificate of the rank of "residual-hankel" (R_s) or "excitation" ([X; V_s]) of the trajectory from x0 under v."""
    statement = {"matrix": name, "system": system.to_json(), "x0": _column(x0), "v": v.to_json(), "window": window}
    trajectory = simulate(system, x0, v)
    built = hankel(trajectory.residuals, window) if name == "residual-hankel" else excitation_matrix(trajectory, window)
    return _rank_certificate(statement, system, built)


def schur_stable(system: ResidualSystem) -> Certificate:
    """Return the certificate that all eigenvalues of A lie inside the unit circle, over Q(a) in every embedding.

    Raises Unprovable when they do not, InvalidInput over GF(p).
    """
    if not is_stable(system.A):
        raise Unprovable("an eigenvalue of A lies on the unit circle or outside")
    return as_certificate("schur-stable", {"system": system.to_json()}, irreducible(system.field))


def finite_zeros(system: ResidualSystem) -> Certificate:
    """Return the certificate of the invariant zero polynomial, by a diagonal form of the pencil. It is for pencils of a few states."""
    form = finite_diagonal(system)
    nonzero = [f for f in form.diagonal if f]
    product: Poly = (system.field.element(1),)
    for f in nonzero:
        product = multiply(product, f)
    statement = {
        "system": system.to_json(),
        "normal_rank": len(nonzero) - system.n,
        "invariant_zero_polynomial": written(monic(product), system.field),
    }
    return as_certificate("finite-zeros", statement, _diagonal_witness(form, system.field))


def infinite_zeros(system: ResidualSystem) -> Certificate:
    """The certificate of the orders of the infinite zeros, by a diagonal form of the reversed pencil. It is for pencils of a few states."""
    form = infinite_diagonal(system)
    powers = [next(k for k, c in enumerate(f) if c != 0) for f in form.diagonal if f]
    orders = sorted(power - 1 for power in powers if power > 0)
    statement = {"system": system.to_json(), "infinite_zero_orders": orders}
    return as_certificate("infinite-zeros", statement, _diagonal_witness(form, system.field))


# -- parts -------------------------------------------------------------------------------------------------------------


def as_certificate(kind: str, statement: dict[str, Any], witness: dict[str, Any]) -> Certificate:
    """Return a certificate of these parts."""
    return {"format": "faultspace-certificate/1", "kind": kind, "statement": statement, "witness": witness}


def _window_ranks(system: ResidualSystem, indices: Sequence[int], witness: dict[str, Any]) -> Certificate:
    r = system.p - len(indices)
    ranks = [s * r + sum(min(s, mu) for mu in indices) for s in range(1, system.n + 4)]
    statement = {"system": system.to_json(), "normal_rank": r, "left_minimal_indices": list(indices), "window_ranks": ranks}
    return as_certificate("window-ranks", statement, witness)


def _coprime_minors(first: ResidualSystem, second: ResidualSystem) -> tuple[list[dict[str, Any]], Matrix]:
    """Return maximal minors without a common zero (a : b), and their multiples by a^(m-1-j) b^j, 2m of which are independent.

    An (a : b) makes P(q) lose rank for every q iff it is a zero, at n + 1 points, of the minors with all rows of the state: they are
    polynomials in q of degree n at most, det(qI - A) times the minors of the transfer matrix. With fewer points all minors are tried.
    """
    field, n, m, p = first.field, first.n, first.m, first.p
    points = range(min(n + 1, field.p) if isinstance(field, PrimeField) else n + 1)
    outputs = combinations(range(n, n + p), m)
    choices = [(*range(n), *chosen) for chosen in outputs] if len(points) > n else list(combinations(range(n + p), n + m))
    slope = stacked(beside(Matrix.zero(field, n, n), -second.F), beside(Matrix.zero(field, p, n), second.G))
    minors, multiples = list[dict[str, Any]](), Matrix.zero(field, 0, 2 * m)
    for q, rows in ((q, rows) for q in points for rows in choices):
        if (before := rank(multiples)) == 2 * m:
            break
        shift = Matrix.of([[q * (i == j) for j in range(n)] for i in range(n)], field, shape=(n, n))
        constant = stacked(beside(shift - first.A, -first.F), beside(first.C, first.G))
        form = list(linear_determinant(constant.rows(rows), slope.rows(rows)))
        zero = field.element(0)
        form += [zero] * (m + 1 - len(form))
        shifted = Matrix.from_elements(field, m, 2 * m, [[zero] * j + form + [zero] * (m - 1 - j) for j in range(m)])
        if rank(larger := stacked(multiples, shifted)) > before:
            minors.append({"point": q, "rows": list(rows)})
            multiples = larger
    if rank(multiples) < 2 * m:
        raise Unprovable("some (a : b) is an exception" if len(points) > n else f"no minors at the points of {field} show it")
    return minors, multiples


def _line_image(first: ResidualSystem, second: ResidualSystem, multiples: Matrix) -> dict[str, Any]:
    """A prime above the points, modulo which the multiples keep their rank."""
    if isinstance(first.field, PrimeField):
        return {}
    largest = LARGEST_PRIME
    while True:
        picture = image(first, largest=largest)
        largest = image(second, largest=picture.prime).prime
        if largest == picture.prime:
            reduced = reduce_matrix(multiples, picture.prime, picture.root)
            if reduced is not None and rank(reduced) == multiples.ncols and largest > first.n:
                return named_image(picture.prime, picture.root, first.field)
            largest -= 1


def _column(column: Matrix) -> list[object]:
    return [row[0] for row in column.to_json()]


def _rank_certificate(statement: dict[str, Any], system: ResidualSystem, built: Matrix) -> Certificate:
    """Return the certificate of the rank. Upper bound: integer rows that vanish on the matrix, triangular by their pivots. Lower bound:
    the rank modulo a prime.
    """
    form = row_echelon(built.transposed())  # a column beside the pivots says of which independent rows that row is a combination
    independent, relations = form.pivots, form.matrix.elements()
    zero, one = system.field.element(0), system.field.element(1)
    rows = []
    for pivot in (i for i in range(built.nrows) if i not in set(independent)):
        entries = [zero] * built.nrows
        for i, combined in zip(independent, relations, strict=True):
            entries[i] = -combined[pivot]
        entries[pivot] = one
        rows.append({"pivot": pivot, "row": _integral(entries, system.field)})
    statement["rank"] = len(independent)
    kernel_image = _rank_image(system, built, len(independent))
    return as_certificate("matrix-rank", statement, kernel_image | {"left_null": rows})


def _rank_image(system: ResidualSystem, built: Matrix, size: int) -> dict[str, Any]:
    if isinstance(system.field, PrimeField):
        return {}
    picture = image(system)
    while True:
        reduced = reduce_matrix(built, picture.prime, picture.root)
        if reduced is not None and rank(reduced) == size:
            return named_image(picture.prime, picture.root, system.field)
        picture = image(system, largest=picture.prime - 1)


def _integral(entries: list[Any], field: Field) -> list[object]:
    """Return the entries scaled by their common denominator, written out."""
    if isinstance(field, PrimeField):
        return [field.write(x) for x in entries]
    bottom = fmpz(1)
    for x in entries:
        for c in field.coordinates(x) if isinstance(field, NumberField) else [x]:
            bottom = bottom.lcm(c.q)
    return [field.write(x * bottom) for x in entries]


def _diagonal_witness(form: SmithDiagonal, field: Field) -> dict[str, Any]:
    def table(matrix: PolyMatrix) -> list[list[list[object]]]:
        return [[written(f, field) for f in row] for row in matrix]

    return {
        "diagonal": [written(f, field) for f in form.diagonal],
        "left": table(form.left),
        "left_inverse": table(form.left_inverse),
        "right": table(form.right),
        "right_inverse": table(form.right_inverse),
    } | irreducible(field)
