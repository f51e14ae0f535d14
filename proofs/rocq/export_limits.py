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
from ...exact.algebra.matrices import Matrix, beside, rank, right_null_space, row_echelon, stacked
from ...exact.algebra.stability import rational_characteristic_polynomial
from ...exact.limits.lyapunov import stein
from ...exact.system.modular import reduce_matrix
from ..trust import checker, checker_limits
from .numbered import Numbered, Numbers, independent
from .terms import Terms, call, index, natural, sequence, whole

Json = Any
COMPLEX = "forall (C : numClosedFieldType) (embed : {rmorphism K -> C}),"
ORDERED = "(K : fieldType)", "(K : realFieldType)"  # least squares are told by an order
SHOWN = "seq (nat * seq V) * seq (nat * seq V)"
INTO_COMPLEX = "(fun r => embed (value r) : C)"


def schur_stable(s: Json, w: Json) -> Terms:
    """Write schur-stable: a polynomial with its roots inside the unit circle vanishes at A, for every root a of the minimal polynomial."""
    system = Numbered(s["system"], w)
    system.read.field.irreducible(w)
    checker.expect(not system.read.field.prime, "field: a finite one has no unit circle")
    size, order = natural(system.n), system.n * system.numbers.field.degree
    checker.charge(1000 + 500 * order**4, 200 * order**2)
    f = [fmpq(c.numerator, c.denominator) for c in rational_characteristic_polynomial(system.A)]
    return Terms(
        (
            system.numbers.definition,
            system.definition("system"),
            ("h", "seq Z", _descending(fmpq_poly(f))),
        ),
        call("is_stable", system.n, "(tA system) h"),
        f"{system.numbers.given} {COMPLEX} schur_stable (map_mx embed (matrix_of value {size} {size} (tA system)))",
        system.numbers.proof.format(lemma="system_stable"),
    )


def moesp_limit(s: Json, w: Json) -> Terms:
    """Write moesp-limit. Rejected where the ranks modulo the prime are smaller."""
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
    shown = [about.shown(w, table, U.ncols + size, about.given_nulls(rows, table.ncols)) for table, size, rows in evidence]
    n, m, p, nu, c = (natural(x) for x in (read.n, read.m, read.p, read.nu, about.channels))
    s_, past_, q_ = natural(read.s), natural(past), natural(q)
    process = "stationary_process (experiment_of value {n} {m} {p} {nu} {c} E) Q ({past} + {s}) e x states u y"
    given = process.format(n=n, m=m, p=p, nu=nu, c=c, past=past_, s=s_)
    Z = f"row_mx (future 0 {past_} u) (future 0 {q_} y)"
    O_s = f"(O (system_of value {n} {m} {p} (tplant E)) {s_})"
    limit = (
        f"forall L, projected_limit Q ({Z}) (future {past_} {s_} u) (future {past_} {s_} y) L -> "
        f"\\rank L = {natural(ranks['limit'])}%N /\\ \\rank (col_mx L {O_s}) = {natural(ranks['joint'])}%N"
    )
    unit = f"cov Q (future {past_} {s_} u) (future {past_} {s_} u) \\in unitmx"
    return Terms(
        (
            *about.definitions(P),
            *((f"shown{i}", numbers.of(SHOWN), one) for i, one in enumerate(shown)),
        ),
        call(
            "is_limit", read.n, read.m, read.p, read.nu, about.channels, past, q, read.s,
            ranks["limit"], ranks["observability"], ranks["joint"], "E P h shown0 shown1 shown2 shown3",
        ),
        f"{numbers.given} {COMPLEX} {about.stable} /\\ forall N (Q : 'M_N) e x states u y, {given} -> "
        f"[/\\ {unit}, \\rank {O_s} = {natural(ranks['observability'])}%N & {limit}]",
        numbers.proof.format(lemma="is_limit_sound"),
    )  # fmt: skip


def input_limit(s: Json, w: Json) -> Terms:
    """Write input-limit."""
    regressions = {"moesp": regression, "true-AC": output_error}
    checker.expect(s["regression"] in regressions, "regression: true-AC or moesp")
    return regressions[s["regression"]](s, w)


def regression(s: Json, w: Json) -> Terms:
    """Write input-limit of the regression of MOESP: the states that the response is left with come from the witness."""
    window = checker_limits.Experiment(s["experiment"]).s
    about = Process(s["experiment"], w, window)
    read, numbers = about.read, about.plant.numbers
    n, p, nu = read.n, read.p, read.nu
    P = about.covariance(w["covariance"], False)
    B, D = (plain(numbers.matrix(s[name], height, nu)) for name, height in (("B", n), ("D", p)))
    response = plain(numbers.matrix(w["response"], p * window, nu * window)).transposed()
    inverse = plain(numbers.matrix(w["inverse"], n, p * window)).transposed()
    inputs, _ = about.signals()
    U = stacked_columns(inputs, about.size)
    X = (response - about.forced(B.transposed(), D.transposed())) @ inverse
    before = about.observability().columns(range(p * (window - 1)))
    shown = [about.shown(w, table, size, about.nulls(table)) for table, size in ((about.moments(P, U, U), nu * window), (before, n))]
    sizes = n, read.m, p, nu, about.channels, window
    states, faults, outputs, channels, samples = (natural(x) for x in (n, read.m, p, about.channels, window))
    process = f"stationary_process (experiment_of value {states} {faults} {outputs} {natural(nu)} {channels} E) Q {samples} e x st u y"
    Uf = f"(future 0 {samples} u)"
    rest = f"regression_rest (system_of value {states} {faults} {outputs} (tplant E)) M"
    B0, D0 = f"(matrix_of value {natural(nu)} {states} B)", f"(matrix_of value {natural(nu)} {outputs} D)"
    least = f"squares ({rest} {B0} {D0} X) <= squares ({rest} B' D' X')"
    alone = f"squares ({rest} B' D' X') <= squares ({rest} {B0} {D0} X) -> B' = {B0} /\\ D' = {D0}"
    return Terms(
        (
            *about.definitions(P),
            *about.tables({"B": B.transposed(), "D": D.transposed(), "R'": response, "X": X}),
            *((f"shown{i}", numbers.of(SHOWN), one) for i, one in enumerate(shown)),
        ),
        call("is_regression", *sizes, "E B D P h R' X shown0 shown1"),
        f"{numbers.given.replace(*ORDERED)} {COMPLEX} {about.stable} /\\ forall N (Q : 'M_N) e x st u y, {process} -> "
        f"cov Q {Uf} {Uf} \\in unitmx /\\ forall M, cov Q {Uf} {Uf} *m M = cov Q {Uf} (future 0 {samples} y) -> "
        f"exists X, forall B' D' X', {least} /\\ ({alone})",
        numbers.proof.format(lemma="is_regression_sound").replace(*ORDERED),
    )


def output_error(s: Json, w: Json) -> Terms:
    """Write input-limit of output error: the process of the errors has its own covariance."""
    about = Process(s["experiment"], w, 1)
    read, numbers = about.read, about.plant.numbers
    n, m, p, nu = read.n, read.m, read.p, read.nu
    B, D = (plain(numbers.matrix(s[name], height, nu)) for name, height in (("B", n), ("D", p)))
    left = about.inputs[0] - B.transposed(), about.inputs[1] - D.transposed()
    P = Process(s["experiment"], w, 1, left).covariance(w["errors"], False)
    series = plain(numbers.matrix(w["series"], n, about.states)).transposed()
    E0 = f"(experiment_of value {natural(n)} {natural(m)} {natural(p)} {natural(nu)} {natural(about.channels)} E)"
    B0, D0 = f"(matrix_of value {natural(nu)} {natural(n)} B)", f"(matrix_of value {natural(nu)} {natural(p)} D)"
    states = f"model_states {E0} Q e x st u"
    one, other = f"(model_error {E0} u y {D0} z 0)", f"(model_error {E0} u y D1 z1 0)"
    return Terms(
        (
            *about.definitions(P),
            *about.tables({"B": B.transposed(), "D": D.transposed(), "B'": left[0], "D'": left[1], "S": series}),
        ),
        call("is_output_error", n, m, p, nu, about.channels, "E B D B' D' P h S"),
        f"{numbers.given} {COMPLEX} {about.stable} /\\ forall N (Q : 'M_N) e x st u y, stationary_process {E0} Q 1 e x st u y -> "
        f"forall z z1 B1 D1, {states} {B0} z -> {states} B1 z1 -> cov Q (z 1%N) (z 1%N) = cov Q (z 0%N) (z 0%N) -> "
        f"cov Q (z1 1%N) (z 1%N) = cov Q (z1 0%N) (z 0%N) -> "
        f"\\tr (cov Q {other} {other}) = \\tr (cov Q {one} {one}) + \\tr (cov Q ({one} - {other}) ({one} - {other}))",
        numbers.proof.format(lemma="is_output_error_sound"),
    )


LIMIT_KINDS: dict[str, Callable[[Json, Json], Terms]] = {
    "schur-stable": schur_stable,
    "moesp-limit": moesp_limit,
    "input-limit": input_limit,
}


# -- parts -------------------------------------------------------------------------------------------------------------


def _descending(f: Any) -> str:
    """Write a rational polynomial as integers without a common divisor, from the highest power down."""
    coefficients = [fmpq(c) for c in f.coeffs()]
    common = checker.common_denominator(int(c.q) for c in coefficients)
    values = [int(c * common) for c in coefficients]
    content = reduce(gcd, values, 0)
    return sequence(whole(value // content) for value in reversed(values))


def plain(matrix: Matrix) -> Matrix:
    """Return a matrix over Q as one, where the theory has Q for a field with a root."""
    return Matrix(QQ, matrix.nrows, matrix.ncols, matrix.flint)


def stacked_columns(parts: list[Matrix], height: int) -> Matrix:
    """Return tables side by side, also where there are none."""
    return beside(Matrix.zero(QQ, height, 0), *parts)


@dataclass(frozen=True, init=False)
class Process:
    """An EXPERIMENT, and its signals by their coefficients at xi(0) = (x; s_1; ...; s_L) and e(0), e(1), ..., as the theory follows them:
    a row each. `read`: as the checker reads it; `plant`: its system as the theory lists it; `size`: how many basic signals there are, for
    so many `samples`; `inputs`: what drives it, B and D or, of the errors of a model, what they differ by, transposed."""

    read: Any
    plant: Numbered
    channels: int
    states: int
    size: int
    samples: int
    inputs: tuple[Matrix, ...]

    def __init__(self, data: Json, w: Json, samples: int | None = None, inputs: tuple[Matrix, ...] = ()) -> None:
        read = checker_limits.Experiment(data)
        read.field.irreducible(w)
        read.field.reduce(w)
        plant = Numbered({name: value for name, value in data.items() if name not in read.OWN}, w)
        states = read.n + (len(read.chain) - 1) * (read.nu + read.m + read.p)
        channels = read.chain[0][0].nc
        samples = read.past + read.s if samples is None else samples
        size = states + samples * channels
        checker.charge(500 * size * (size + 10) * (samples + 1) * (read.n + read.nu + read.m + read.p + 1), 400 * size**2)
        values = {"read": read, "plant": plant, "channels": channels, "states": states, "size": size, "samples": samples}
        for name, value in values.items():
            object.__setattr__(self, name, value)
        given = [self.turned(part, height, read.nu) for part, height in zip(read.inputs, (read.n, read.p), strict=True)]
        object.__setattr__(self, "inputs", inputs or tuple(given))

    @property
    def height(self) -> int:
        """The number of entries of f = (u; v; w)."""
        return int(self.read.nu + self.read.m + self.read.p)

    def turned(self, part: Any, height: int, width: int) -> Matrix:
        """Return a matrix of the checker, height x width, transposed."""
        return Matrix(QQ, height, width, self.plant.numbers.lifted(part, height, width).flint).transposed()

    def table(self, matrix: Matrix) -> str:
        """Write a matrix as a term."""
        numbers = self.plant.numbers
        return numbers.table(Matrix(numbers.field, matrix.nrows, matrix.ncols, matrix.flint).elements())

    def parts(self) -> tuple[list[Matrix], list[Matrix], list[Matrix], list[Matrix]]:
        """Return A, F, C, G; B, D; N_j; and d_1, d_2, ..., transposed."""
        read, h = self.read, self.height
        shapes = ((read.A, read.n, read.n), (read.F, read.n, read.m), (read.C, read.p, read.n), (read.G, read.p, read.m))
        forward = [self.turned(N, h, self.channels) for N, _ in read.chain]
        back = [-self.turned(minus, h, h) for _, minus in read.chain[1:]]
        return (
            [self.turned(*shape) for shape in shapes],
            [*self.inputs],
            forward,
            back,
        )

    @property
    def term(self) -> str:
        """The experiment as a term."""
        _, inputs, forward, back = self.parts()
        B, D = map(self.table, inputs)
        return f"ExperimentList ({self.plant.term}) {B} {D} {sequence(map(self.table, forward))} {sequence(map(self.table, back))}"

    def basic(self, start: int, count: int) -> Matrix:
        """Return basic signals from a place on."""
        return Matrix.identity(QQ, self.size).columns(range(start, start + count))

    def step(self, e: Matrix, x: Matrix, states: list[Matrix]) -> tuple[Matrix, Matrix, Matrix, list[Matrix]]:
        """Return u, y, and the next states."""
        (A, F, C, G), (B, D), forward, back = self.parts()
        nu, m = self.read.nu, self.read.m
        f = e @ forward[0] + states[0] if states else e @ forward[0]
        u, v, noise = (f.columns(part) for part in (range(nu), range(nu, nu + m), range(nu + m, self.height)))
        y = x @ C + u @ D + v @ G + noise
        moved = [e @ forward[i + 1] - f @ back[i] for i in range(len(states))]
        after = [one + later for one, later in zip(moved, states[1:], strict=False)] + moved[-1:]
        return u, y, x @ A + u @ B + v @ F, after if states else []

    def start(self) -> tuple[Matrix, list[Matrix]]:
        """Return the states at time 0."""
        n, h = self.read.n, self.height
        return self.basic(0, n), [self.basic(start, h) for start in range(n, self.states, h)] if h else []

    def signals(self) -> tuple[list[Matrix], list[Matrix]]:
        """Return the inputs and the outputs, one sample after the other."""
        (x, states), inputs, outputs = self.start(), list[Matrix](), list[Matrix]()
        for k in range(self.samples):
            u, y, x, states = self.step(self.basic(self.states + k * self.channels, self.channels), x, states)
            inputs.append(u)
            outputs.append(y)
        return inputs, outputs

    def covariance(self, given: Json, whole: bool) -> Matrix:
        """Return the covariance of a witness. Where it has the columns of the filters' states alone, the rest is solved for."""
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
        """Return the covariances of signals."""
        first = range(self.states)
        return left.transposed() @ stacked(P @ right.rows(first), right.rows(range(self.states, self.size)))

    def observability(self) -> Matrix:
        """Return [C, A C, ...], the transpose of O_s."""
        (A, _, block, _), _, _, _ = self.parts()
        blocks = [block]
        while len(blocks) < self.read.s:
            blocks.append(A @ blocks[-1])
        return beside(*blocks)

    def forced(self, B: Matrix, D: Matrix) -> Matrix:
        """Return T_s(B, D), both transposed."""
        (A, _, C, _), _, _, _ = self.parts()
        impulse = [D]
        while len(impulse) < self.read.s:
            impulse.append(B @ C)
            B = B @ A
        blank = Matrix.zero(QQ, D.nrows, D.ncols)
        count = range(self.read.s)
        return stacked(*(beside(*(impulse[k - j] if k >= j else blank for k in count)) for j in count))

    @property
    def stable(self) -> str:
        """This says that the experiment is stable."""
        sizes = " ".join(natural(x) for x in (self.read.n, self.read.m, self.read.p, self.read.nu, self.channels))
        return f"stable_experiment (experiment_of {INTO_COMPLEX} {sizes} E)"

    def definitions(self, P: Matrix) -> tuple[tuple[str, str, str], ...]:
        """Return what all begin with: the numbers, the experiment E, its covariance P, what vanishes at its states."""
        numbers = self.plant.numbers
        listed = ("E", f"experiment_list ({numbers.name})", self.term)
        return numbers.definition, listed, *self.tables({"P": P}), ("h", "seq Z", _descending(self.annihilator()))

    def tables(self, named: dict[str, Matrix]) -> list[tuple[str, str, str]]:
        """Return the definitions of tables."""
        return [(name, self.plant.numbers.of("seq (seq V)"), self.table(matrix)) for name, matrix in named.items()]

    def given_nulls(self, rows: Json, width: int) -> list[tuple[int, list[Any]]]:
        """Return the rows of a certificate that show a rank from above."""
        given = checker.items(rows, "row", max(width, checker.MAX_DIMENSION))
        return [(index(row["pivot"]), self.plant.numbers.integral(row["row"], width)) for row in given]

    def annihilator(self) -> Any:
        """Return det(qI - A) times the least common multiple of the polynomials of the filters."""
        (A, *_), _, _, back = self.parts()
        f = fmpq_poly([fmpq(c.numerator, c.denominator) for c in rational_characteristic_polynomial(A)])
        filters = {tuple(d[i, i] for d in reversed(back)) for i in range(self.height)}
        multiple = fmpq_poly([1])
        for tail in filters:
            one = fmpq_poly([*tail, 1])
            multiple = multiple * one / multiple.gcd(one)
        return f * multiple

    def nulls(self, table: Matrix) -> list[tuple[int, list[Any]]]:
        """Return vectors that a table sends to zero, as many as there are, with their pivots."""
        form = row_echelon(right_null_space(table).transposed())
        rows = form.matrix.rows(range(len(form.pivots)))
        return list(zip(form.pivots, Matrix(self.plant.numbers.field, rows.nrows, rows.ncols, rows.flint).elements(), strict=True))

    def shown(self, w: Json, table: Matrix, size: int, above: list[tuple[int, list[Any]]]) -> str:
        """Write what shows that a table has that rank: vectors that it sends to zero, and combinations."""
        numbers: Numbers = self.plant.numbers
        prime = index(w["prime"], checker.MAX_PRIME)
        image = reduce_matrix(table, prime, None)
        checker.require(image is not None and rank(image) >= size, "the rank modulo the prime is smaller")
        elements = Matrix(numbers.field, table.nrows, table.ncols, table.flint).elements()
        found = independent(numbers, elements, table.ncols)
        return f"({numbers.pivoted(above)}, {numbers.pivoted(found)})"
