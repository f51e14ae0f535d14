"""Certificates of stability and of population limits as terms of Rocq: recomputed by the checks of theory/field_checks, over Q and Q(a).

    LIMIT_KINDS     kind -> what writes it

Q is Q(a) where a is the root 0 of q, as for zeros. Three things in the terms are not in a certificate and are computed here: a polynomial
that vanishes at the matrix of the states, whose roots Rocq sees inside the unit circle; of the stationary covariance the part of the
plant's states, where the certificate has only the columns that are enough; and combinations that show the lower bounds. They are believed
by nobody. The prime of a certificate is looked at by the checker, and here: Rocq's lower bounds are over Q.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import reduce
from math import gcd
from typing import Any

from flint import fmpq, fmpq_poly

from ...exact.algebra.fields import QQ
from ...exact.algebra.matrices import Matrix, beside, rank, stacked
from ...exact.algebra.stability import rational_characteristic_polynomial
from ...exact.limits.lyapunov import stein
from ...exact.system.modular import reduce_matrix
from ..trust import checker, checker_limits
from .numbered import Numbered, Numbers, independent
from .terms import Terms, index
from .text import call, natural, sequence, vector

Json = Any
COMPLEX = "forall (C : numClosedFieldType) (embed : {rmorphism K -> C}),"
INTO_COMPLEX = "(fun r => embed (value r) : [fieldType of C])"


def schur_stable(s: Json, w: Json) -> Terms:
    """Writes schur-stable: a polynomial with its roots inside the unit circle vanishes at A, for every root a of the minimal polynomial."""
    system = Numbered(s["system"])
    system.read.field.irreducible(w)
    checker.expect(not system.read.field.prime, "field: a finite one has no unit circle")
    size, order = natural(system.n), system.n * system.numbers.field.degree
    checker.charge(1000 + 500 * order**4, 200 * order**2)
    f = [fmpq(c.numerator, c.denominator) for c in rational_characteristic_polynomial(system.A)]
    return Terms(
        (
            system.numbers.definition,
            ("system", f"listing ({system.numbers.name})", system.term),
            ("h", "seq Z", _descending(fmpq_poly(f))),
        ),
        call("is_stable", system.n, "(tA system) h"),
        f"{system.numbers.given} {COMPLEX} schur_stable (map_mx embed (matrix_of value {size} {size} (tA system)))",
        system.numbers.proof.format(lemma="system_stable"),
    )


def moesp_limit(s: Json, w: Json) -> Terms:
    """Writes moesp-limit. Rejected where the ranks modulo the prime are smaller."""
    about = Process(s["experiment"], w)
    checker.expect(s["instruments"] in ("past-inputs", "past-inputs-and-outputs"), "instruments: past-inputs or past-inputs-and-outputs")
    with_outputs = s["instruments"] == "past-inputs-and-outputs"
    read, numbers, past, q = about.read, about.plant.numbers, about.read.past, about.read.past if with_outputs else 0
    whole = with_outputs and read.p > 0
    P = about.covariance(w["covariance"], whole)
    ranks = {name: index(s[f"{name}_rank"]) for name in ("limit", "observability", "joint")}
    inputs, outputs = about.signals()
    future, behind = inputs[past:], stacked_columns([*inputs[:past], *outputs[:q]], about.size)
    U = stacked_columns(future, about.size)
    UY = beside(U, stacked_columns(outputs[past:], about.size))
    upper, lower = about.moments(P, U, UY), about.moments(P, behind, UY)
    seen = beside(Matrix.zero(QQ, read.n, U.ncols), about.observability())
    tables = {"limit": stacked(upper, lower), "observability": stacked(upper, seen), "joint": stacked(upper, lower, seen)}
    evidence: list[tuple[Matrix, int, Json]] = [(about.moments(P, U, U), 0, [])]
    evidence += [(table, ranks[name], w.get(name, w["joint"])) for name, table in tables.items()]
    shown = [about.shown(w, table, U.ncols + size, rows) for table, size, rows in evidence]
    n, m, p, nu, c = (natural(x) for x in (read.n, read.m, read.p, read.nu, about.channels))
    s_, past_, q_ = natural(read.s), natural(past), natural(q)
    process = "stationary_process (experiment_of value {n} {m} {p} {nu} {c} E) Q ({past} + {s}) e x states u y"
    given = process.format(n=n, m=m, p=p, nu=nu, c=c, past=past_, s=s_)
    stable = f"stable_experiment (experiment_of {INTO_COMPLEX} {n} {m} {p} {nu} {c} E)"
    Z = f"row_mx (future 0 {past_} u) (future 0 {q_} y)"
    O_s = f"(O (system_of value {n} {m} {p} (tplant E)) {s_})"
    limit = (
        f"forall L, projected_limit Q ({Z}) (future {past_} {s_} u) (future {past_} {s_} y) L -> "
        f"\\rank L = {natural(ranks['limit'])}%N /\\ \\rank (col_mx L {O_s}) = {natural(ranks['joint'])}%N"
    )
    unit = f"cov Q (future {past_} {s_} u) (future {past_} {s_} u) \\in unitmx"
    kind = "seq (nat * seq V) * seq (nat * seq V)"
    return Terms(
        (
            numbers.definition,
            ("E", f"experiment_list ({numbers.name})", about.term),
            ("P", numbers.of("seq (seq V)"), about.table(P)),
            ("h", "seq Z", _descending(about.annihilator())),
            *((f"shown{i}", numbers.of(kind), one) for i, one in enumerate(shown)),
        ),
        call(
            "is_limit", read.n, read.m, read.p, read.nu, about.channels, past, q, read.s,
            ranks["limit"], ranks["observability"], ranks["joint"], "E P h shown0 shown1 shown2 shown3",
        ),
        f"{numbers.given} {COMPLEX} {stable} /\\ forall N (Q : 'M_N) e x states u y, {given} -> "
        f"[/\\ {unit}, \\rank {O_s} = {natural(ranks['observability'])}%N & {limit}]",
        numbers.proof.format(lemma="is_limit_sound"),
    )  # fmt: skip


LIMIT_KINDS: dict[str, Callable[[Json, Json], Terms]] = {"schur-stable": schur_stable, "moesp-limit": moesp_limit}


# -- parts -------------------------------------------------------------------------------------------------------------


def _descending(f: Any) -> str:
    """Writes a rational polynomial as integers without a common divisor, from the highest power down."""
    coefficients = [fmpq(c) for c in f.coeffs()]
    common = checker.common_denominator(int(c.q) for c in coefficients)
    values = [int(c * common) for c in coefficients]
    content = reduce(gcd, values, 0)
    return vector(value // content for value in reversed(values))


def stacked_columns(parts: list[Matrix], height: int) -> Matrix:
    """Returns tables side by side, also where there are none."""
    return beside(Matrix.zero(QQ, height, 0), *parts)


@dataclass(frozen=True, init=False)
class Process:
    """An EXPERIMENT, and its signals by their coefficients at xi(0) = (x; s_1; ...; s_L) and e(0), e(1), ..., as the theory follows them:
    a row each. `read`: as the checker reads it; `plant`: its system as the theory lists it; `size`: how many basic signals there are."""

    read: Any
    plant: Numbered
    channels: int
    states: int
    size: int

    def __init__(self, data: Json, w: Json) -> None:
        read = checker_limits.Experiment(data)
        read.field.irreducible(w)
        read.field.reduce(w)
        plant = Numbered({name: value for name, value in data.items() if name not in read.OWN})
        states = read.n + (len(read.chain) - 1) * (read.nu + read.m + read.p)
        channels = read.chain[0][0].nc
        size = states + (read.past + read.s) * channels
        checker.charge(500 * size * (size + 10) * (read.past + read.s) * (read.n + read.nu + read.m + read.p + 1), 400 * size**2)
        for name, value in zip(("read", "plant", "channels", "states", "size"), (read, plant, channels, states, size), strict=True):
            object.__setattr__(self, name, value)

    @property
    def height(self) -> int:
        """This is the number of entries of f = (u; v; w)."""
        return int(self.read.nu + self.read.m + self.read.p)

    def turned(self, part: Any, height: int, width: int) -> Matrix:
        """Returns a matrix of the checker, height x width, transposed."""
        return Matrix(QQ, height, width, self.plant.numbers.lifted(part, height, width).flint).transposed()

    def table(self, matrix: Matrix) -> str:
        """Writes a matrix as a term."""
        numbers = self.plant.numbers
        return numbers.table(Matrix(numbers.field, matrix.nrows, matrix.ncols, matrix.flint).elements())

    def parts(self) -> tuple[list[Matrix], list[Matrix], list[Matrix], list[Matrix]]:
        """Returns A, F, C, G; B, D; N_j; and d_1, d_2, ..., transposed."""
        read, h = self.read, self.height
        shapes = ((read.A, read.n, read.n), (read.F, read.n, read.m), (read.C, read.p, read.n), (read.G, read.p, read.m))
        B, D = read.inputs
        forward = [self.turned(N, h, self.channels) for N, _ in read.chain]
        back = [-self.turned(minus, h, h) for _, minus in read.chain[1:]]
        return (
            [self.turned(*shape) for shape in shapes],
            [self.turned(B, read.n, read.nu), self.turned(D, read.p, read.nu)],
            forward,
            back,
        )

    @property
    def term(self) -> str:
        """This is the experiment as a term."""
        _, inputs, forward, back = self.parts()
        B, D = map(self.table, inputs)
        return f"ExperimentList ({self.plant.term}) {B} {D} {sequence(map(self.table, forward))} {sequence(map(self.table, back))}"

    def basic(self, start: int, count: int) -> Matrix:
        """Returns basic signals from a place on."""
        return Matrix.identity(QQ, self.size).columns(range(start, start + count))

    def step(self, e: Matrix, x: Matrix, states: list[Matrix]) -> tuple[Matrix, Matrix, Matrix, list[Matrix]]:
        """Returns u, y, and the next states."""
        (A, F, C, G), (B, D), forward, back = self.parts()
        nu, m = self.read.nu, self.read.m
        f = e @ forward[0] + states[0] if states else e @ forward[0]
        u, v, noise = (f.columns(part) for part in (range(nu), range(nu, nu + m), range(nu + m, self.height)))
        y = x @ C + u @ D + v @ G + noise
        moved = [e @ forward[i + 1] - f @ back[i] for i in range(len(states))]
        after = [one + later for one, later in zip(moved, states[1:], strict=False)] + moved[-1:]
        return u, y, x @ A + u @ B + v @ F, after if states else []

    def start(self) -> tuple[Matrix, list[Matrix]]:
        """Returns the states at time 0."""
        n, h = self.read.n, self.height
        return self.basic(0, n), [self.basic(start, h) for start in range(n, self.states, h)] if h else []

    def signals(self) -> tuple[list[Matrix], list[Matrix]]:
        """Returns the inputs and the outputs, one sample after the other."""
        (x, states), inputs, outputs = self.start(), list[Matrix](), list[Matrix]()
        for k in range(self.read.past + self.read.s):
            u, y, x, states = self.step(self.basic(self.states + k * self.channels, self.channels), x, states)
            inputs.append(u)
            outputs.append(y)
        return inputs, outputs

    def covariance(self, given: Json, whole: bool) -> Matrix:
        """Returns the covariance of a witness. Where it has the columns of the filters' states alone, the rest is solved for."""
        n, size = self.read.n, self.states
        wide = size if whole else size - n
        P = Matrix(QQ, size, wide, self.plant.numbers.matrix(given, size, wide).flint)
        if whole:
            return P
        across, own = P.rows(range(n)), P.rows(range(n, size))
        (x, states), A = self.start(), self.parts()[0][0]
        _, _, after, _ = self.step(self.basic(size, self.channels), x, states)
        known = stacked(beside(Matrix.zero(QQ, n, n), across), beside(across.transposed(), own))
        source = self.moments(known, after, after)
        characteristic = [fmpq(c.numerator, c.denominator) for c in rational_characteristic_polynomial(A)]
        try:
            rest = stein(A.transposed(), A.transposed(), source, characteristic)
        except ZeroDivisionError:  # A is not stable: Rocq will say so
            rest = Matrix.zero(QQ, n, n)
        return stacked(beside(rest, across), beside(across.transposed(), own))

    def moments(self, P: Matrix, left: Matrix, right: Matrix) -> Matrix:
        """Returns the covariances of signals."""
        first = range(self.states)
        return left.transposed() @ stacked(P @ right.rows(first), right.rows(range(self.states, self.size)))

    def observability(self) -> Matrix:
        """Returns [C, A C, ...], the transpose of O_s."""
        (A, _, block, _), _, _, _ = self.parts()
        blocks = [block]
        while len(blocks) < self.read.s:
            blocks.append(A @ blocks[-1])
        return beside(*blocks)

    def annihilator(self) -> Any:
        """Returns det(qI - A) times the least common multiple of the polynomials of the filters."""
        (A, *_), _, _, back = self.parts()
        f = fmpq_poly([fmpq(c.numerator, c.denominator) for c in rational_characteristic_polynomial(A)])
        filters = {tuple(d[i, i] for d in reversed(back)) for i in range(self.height)}
        multiple = fmpq_poly([1])
        for tail in filters:
            one = fmpq_poly([*tail, 1])
            multiple = multiple * one / multiple.gcd(one)
        return f * multiple

    def shown(self, w: Json, table: Matrix, size: int, rows: Json) -> str:
        """Writes what shows that a table has that rank: the rows of a certificate, and combinations."""
        numbers: Numbers = self.plant.numbers
        prime = index(w["prime"], checker.MAX_PRIME)
        image = reduce_matrix(table, prime, None)
        checker.require(image is not None and rank(image) >= size, "the rank modulo the prime is smaller")
        given = checker.items(rows, "row", max(table.ncols, checker.MAX_DIMENSION))
        nulls = [(index(row["pivot"]), numbers.integral(row["row"], table.ncols)) for row in given]
        elements = Matrix(numbers.field, table.nrows, table.ncols, table.flint).elements()
        found = independent(numbers, elements, table.ncols)
        return f"({numbers.pivoted(nulls)}, {numbers.pivoted(found)})"
