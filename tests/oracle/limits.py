"""Population limits from their definitions: stationary covariances by dense elimination, regressions written out column by column.

parse_experiment(json)    EXPERIMENT -> Experiment; raises ValueError, over other fields than Q as well
is_stationary(e)          A and all denominators have their roots inside the unit circle
Process(Phi, Gamma)       xi(k+1) = Phi xi(k) + Gamma e(k); its states are x and the past values that the difference equations name
covariance(a, b, lag)     E a(k + lag) b(k)' of two of its signals
moesp_limit_of(e, past_outputs)   L = Cov(Yf, Z) - Cov(Yf, Uf) Cov(Uf)^-1 Cov(Uf, Z), None where Cov(Uf) is singular
moesp_ranks(e, past_outputs)   the ranks of L, O_s and [L O_s], None likewise
output_error(e)           the only (B, D) that minimise E|y - G(q)u|^2, None where there are several
moesp_regression(e)       the only (B, D) nearest to Cov(Yf, Uf) Cov(Uf)^-1 up to the columns of O_s, None likewise

Signals of a process are pairs (H, J): H xi(k) + J e(k). Nothing is assumed about numbers of samples, ranks or structure.
"""

from __future__ import annotations

from dataclasses import dataclass

from . import stability
from .fields import Element, Json, Rationals, parse_index, parse_rational
from .linear import Matrix, above, beside, identity, matrix, rank, solve, unit_vector, zeros
from .systems import System, parse_keys, parse_matrix, parse_system
from .windows import observability, toeplitz

Q = Rationals()
MAX_WINDOW = 4096
OWN = ("s", "past", "u_filter", "v_filter", "w_filter")
Signal = tuple[Matrix, Matrix]


@dataclass(frozen=True)
class Filter:
    """This is f(k) = sum over j of numerator[j] e(k-j) - sum over j >= 1 of denominator[j] f(k-j); denominator[0] = 1."""

    numerator: tuple[Matrix, ...]
    denominator: tuple[Element, ...]


@dataclass(frozen=True)
class Experiment:
    """x+ = A x + B u + F v, y = C x + D u + G v + w, with u, v, w filtered; w has its own noise."""

    system: System
    B: Matrix
    D: Matrix
    s: int
    past: int
    u: Filter
    v: Filter
    w: Filter

    @property
    def nu(self) -> int:
        return self.B.width


@dataclass(frozen=True)
class Process:
    """This is xi(k+1) = Phi xi(k) + Gamma e(k), with the covariance P of xi."""

    Phi: Matrix
    Gamma: Matrix
    P: Matrix

    def covariance(self, a: Signal, b: Signal, lag: int) -> Matrix:
        """The result is E a(k + lag) b(k)'."""
        if lag < 0:
            return self.covariance(b, a, -lag).T
        if lag == 0:
            return a[0] @ self.P @ b[0].T + a[1] @ b[1].T
        reached = self.Phi @ self.P @ b[0].T + self.Gamma @ b[1].T
        for _ in range(lag - 1):
            reached = self.Phi @ reached
        return a[0] @ reached

    def windows(self, a: Signal, rows: range, b: Signal, columns: range) -> Matrix:
        """The result is E of (a(i); i in rows) times (b(j); j in columns)'."""
        return above(*(beside(*(self.covariance(a, b, i - j) for j in columns)) for i in rows))


def parse_experiment(json: Json) -> Experiment:
    """EXPERIMENT -> Experiment; raises ValueError."""
    parse_keys(json, {"A", "F", "C", "G", "B", "D", *OWN[:4]}, frozenset({"w_filter", "field", "n", "m", "p", "nu"}))
    system = parse_system({key: value for key, value in json.items() if key not in OWN})
    if system.field != Q:
        raise ValueError("an experiment is one over Q")
    nu = parse_index(json["nu"]) if "nu" in json else len(json["B"][0]) if json["B"] else 0
    s, past = parse_index(json["s"]), parse_index(json["past"])
    if nu == 0 or not 1 <= s <= MAX_WINDOW or not 1 <= past <= MAX_WINDOW:
        raise ValueError("an input and windows of 1..4096 block rows are due")
    u = _parse_filter(json["u_filter"], nu, None)
    v = _parse_filter(json["v_filter"], system.m, u.numerator[0].width)
    none = Filter((zeros(Q, system.p, 0),), (Q.one,))
    w = _parse_filter(json["w_filter"], system.p, None) if "w_filter" in json else none
    return Experiment(system, parse_matrix(Q, json["B"], system.n, nu), parse_matrix(Q, json["D"], system.p, nu), s, past, u, v, w)


def is_stationary(e: Experiment) -> bool:
    """This tells whether there is a stationary solution that e determines: A and the denominators are Schur stable."""
    return stability.is_stable(e.system) and all(stability.inside_circle(list(reversed(f.denominator))) for f in (e.u, e.v, e.w))


def process(e: Experiment, more: tuple[Matrix, Matrix] | None = None) -> tuple[Process, dict[str, Signal]]:
    """The result is the process with the signals u and y, and "z", for `more` = (A, B), where z(k+1) = A z(k) + B u(k)."""
    n, q, r = e.system.n, e.u.numerator[0].width, e.w.numerator[0].width
    tail, drive = more or (zeros(Q, 0, 0), zeros(Q, 0, e.nu))
    heights = {"x": n, "z": tail.height}
    for name, f, noise in (("u", e.u, q), ("v", e.v, q), ("w", e.w, r)):
        for j in range(1, len(f.numerator)):
            heights[f"{name} e{j}"] = noise
        for j in range(1, len(f.denominator)):
            heights[f"{name} f{j}"] = f.numerator[0].height
    size = sum(heights.values())
    starts = {name: sum(list(heights.values())[:i]) for i, name in enumerate(heights)}

    def part(name: str) -> Matrix:
        """The result is the rows of xi that hold this part."""
        return matrix(Q, heights[name], size, identity(Q, size).rows[starts[name] : starts[name] + heights[name]])

    noises = {"u": beside(identity(Q, q), zeros(Q, q, r)), "w": beside(zeros(Q, r, q), identity(Q, r))}
    noises["v"] = noises["u"]
    signals: dict[str, Signal] = {}
    for name, f in (("u", e.u), ("v", e.v), ("w", e.w)):
        H, J = zeros(Q, f.numerator[0].height, size), f.numerator[0] @ noises[name]
        for j, block in enumerate(f.numerator[1:], start=1):
            H = H + block @ part(f"{name} e{j}")
        for j, d in enumerate(f.denominator[1:], start=1):
            H = H + _times(-d, part(f"{name} f{j}"))
        signals[name] = H, J
    u, v, w = (signals[name] for name in "uvw")
    following: dict[str, Signal] = {
        "x": _sum((e.system.A @ part("x"), zeros(Q, n, q + r)), _through(e.B, u), _through(e.system.F, v)),
        "z": _sum((tail @ part("z"), zeros(Q, tail.height, q + r)), _through(drive, u)),
    }
    for name, f in (("u", e.u), ("v", e.v), ("w", e.w)):
        for j in range(1, len(f.numerator)):
            new = zeros(Q, noises[name].height, size), noises[name]
            following[f"{name} e{j}"] = new if j == 1 else (part(f"{name} e{j - 1}"), zeros(Q, noises[name].height, q + r))
        for j in range(1, len(f.denominator)):
            height = f.numerator[0].height
            following[f"{name} f{j}"] = signals[name] if j == 1 else (part(f"{name} f{j - 1}"), zeros(Q, height, q + r))
    Phi, Gamma = (above(zeros(Q, 0, width), *(following[name][i] for name in heights)) for i, width in enumerate((size, q + r)))
    signals["y"] = _sum((e.system.C @ part("x"), zeros(Q, e.system.p, q + r)), _through(e.D, u), _through(e.system.G, v), w)
    signals["z"] = part("z"), zeros(Q, tail.height, q + r)
    return Process(Phi, Gamma, lyapunov(Phi, Gamma)), signals


def lyapunov(Phi: Matrix, Gamma: Matrix) -> Matrix:
    """The result is P = P' with P = Phi P Phi' + Gamma Gamma', one equation for each entry on and above the diagonal."""
    size = Phi.height
    unknowns = {pair: k for k, pair in enumerate((i, j) for i in range(size) for j in range(i, size))}
    noise = (Gamma @ Gamma.T).rows
    rows = []
    for i, j in unknowns:
        row = [Q.zero] * len(unknowns)
        row[unknowns[i, j]] += 1
        for a, x in enumerate(Phi.rows[i]):
            for b, y in enumerate(Phi.rows[j]):
                if x and y:
                    row[unknowns[min(a, b), max(a, b)]] -= x * y
        rows.append(row)
    found = solve(matrix(Q, len(rows), len(rows), rows), matrix(Q, len(rows), 1, [[noise[i][j]] for i, j in unknowns]))
    assert found is not None, "a stationary process has a covariance"
    return matrix(Q, size, size, [[found.rows[unknowns[min(i, j), max(i, j)]][0] for j in range(size)] for i in range(size)])


def moesp_limit_of(e: Experiment, past_outputs: bool) -> Matrix | None:
    """Return L with past inputs for Z, or with past inputs and outputs."""
    driven, signals = process(e)
    past, future = range(-e.past, 0), range(e.s)
    u, y = signals["u"], signals["y"]
    inner = driven.windows(u, future, u, future)
    if rank(inner) < inner.height:
        return None
    inputs, outputs = driven.windows(u, future, u, past), driven.windows(y, future, u, past)
    if past_outputs:
        inputs = beside(inputs, driven.windows(u, future, y, past))
        outputs = beside(outputs, driven.windows(y, future, y, past))
    projection = solve(inner, inputs)
    assert projection is not None
    return outputs + _times(-Q.one, driven.windows(y, future, u, future) @ projection)


def moesp_ranks(e: Experiment, past_outputs: bool) -> tuple[int, int, int] | None:
    """Return the ranks of L, of O_s and of [L O_s]."""
    limit, seen = moesp_limit_of(e, past_outputs), observability(e.system, e.s)
    return None if limit is None else (rank(limit), rank(seen), rank(beside(limit, seen)))


def output_error(e: Experiment) -> tuple[Matrix, Matrix] | None:
    """The normal equations are those over the signals that each entry of B and of D, set to 1, predicts."""
    n, p, nu = e.system.n, e.system.p, e.nu
    pairs = [(i, j) for j in range(nu) for i in range(n)]
    copies = len(pairs)
    tail = _kron(identity(Q, copies), e.system.A)
    drive = above(zeros(Q, 0, nu), *(unit_vector(Q, n, i) @ unit_vector(Q, nu, j).T for i, j in pairs))
    driven, signals = process(e, (tail, drive))
    predicted = [
        (_rows(signals["z"][0], k * n, n), _rows(signals["z"][1], k * n, n)) for k in range(copies)
    ]  # the states of which C reads the prediction
    regressors = [_through(e.system.C, state) for state in predicted]
    regressors += [_through(unit_vector(Q, p, i) @ unit_vector(Q, nu, j).T, signals["u"]) for j in range(nu) for i in range(p)]
    gram = [[_trace(driven.covariance(a, b, 0)) for b in regressors] for a in regressors]
    right = [[_trace(driven.covariance(a, signals["y"], 0))] for a in regressors]
    return _unique(e, gram, right)


def moesp_regression(e: Experiment) -> tuple[Matrix, Matrix] | None:
    """This solves least squares over the entries of Pi T_s(B, D), a column for each entry of B and of D, Pi the projection beside O_s."""
    driven, signals = process(e)
    future, n, p, nu = range(e.s), e.system.n, e.system.p, e.nu
    u, y = signals["u"], signals["y"]
    inner = driven.windows(u, future, u, future)
    if rank(inner) < inner.height:
        return None
    turned = solve(inner, driven.windows(y, future, u, future).T)
    seen = observability(e.system, e.s)
    along = solve(seen.T @ seen, seen.T)
    assert turned is not None and along is not None
    beside_seen = identity(Q, p * e.s) + _times(-Q.one, seen @ along)
    columns = []
    for height, place in ((n, "B"), (p, "D")):
        for j in range(nu):
            for i in range(height):
                one = unit_vector(Q, height, i) @ unit_vector(Q, nu, j).T
                B, D = (one, zeros(Q, p, nu)) if place == "B" else (zeros(Q, n, nu), one)
                columns.append((beside_seen @ toeplitz(System(Q, e.system.A, B, e.system.C, D), e.s)).entries())
    target = (beside_seen @ turned.T).entries()
    gram = [[sum((x * y for x, y in zip(a, b, strict=True)), Q.zero) for b in columns] for a in columns]
    right = [[sum((x * y for x, y in zip(a, target, strict=True)), Q.zero)] for a in columns]
    return _unique(e, gram, right)


def moesp_limit(statement: Json) -> bool:
    """This tells whether the process is stationary, Cov(Uf) nonsingular, and the ranks are these."""
    ranks = ("limit_rank", "observability_rank", "joint_rank")
    parse_keys(statement, {"experiment", "instruments", *ranks})
    e, claimed = parse_experiment(statement["experiment"]), tuple(parse_index(statement[name]) for name in ranks)
    if statement["instruments"] not in ("past-inputs", "past-inputs-and-outputs"):
        raise ValueError(f"not a choice of instruments: {statement['instruments']!r}")
    return is_stationary(e) and moesp_ranks(e, statement["instruments"] != "past-inputs") == claimed


def input_limit(statement: Json) -> bool:
    """Stationary, and the regression has these B and D as its only solution."""
    parse_keys(statement, {"experiment", "regression", "B", "D"})
    e = parse_experiment(statement["experiment"])
    claimed = parse_matrix(Q, statement["B"], e.system.n, e.nu), parse_matrix(Q, statement["D"], e.system.p, e.nu)
    if statement["regression"] not in ("true-AC", "moesp"):
        raise ValueError(f"not a regression: {statement['regression']!r}")
    if not is_stationary(e):
        return False
    return (output_error(e) if statement["regression"] == "true-AC" else moesp_regression(e)) == claimed


def _unique(e: Experiment, gram: list[list[Element]], right: list[list[Element]]) -> tuple[Matrix, Matrix] | None:
    size, nu = len(gram), e.nu
    square = matrix(Q, size, size, gram)
    if rank(square) < size:
        return None
    found = solve(square, matrix(Q, size, 1, right))
    assert found is not None
    theta = [x for (x,) in found.rows]
    n, p = e.system.n, e.system.p
    B = [[theta[j * n + i] for j in range(nu)] for i in range(n)]
    D = [[theta[nu * n + j * p + i] for j in range(nu)] for i in range(p)]
    return matrix(Q, n, nu, B), matrix(Q, p, nu, D)


def _parse_filter(json: Json, height: int, width: int | None) -> Filter:
    num, den = json, ["1"]
    if isinstance(json, dict):
        parse_keys(json, {"num", "den"})
        num, den = json["num"], json["den"]
    if not isinstance(num, list) or not num or not isinstance(den, list) or not den:
        raise ValueError(f"not a FILTER: {json!r}")
    if width is None:
        width = len(num[0][0]) if isinstance(num[0], list) and num[0] and isinstance(num[0][0], list) else 0
    denominator = tuple(parse_rational(x) for x in den)
    if denominator[0] != 1:
        raise ValueError(f"a denominator begins with 1: {den!r}")
    return Filter(tuple(parse_matrix(Q, block, height, width) for block in num), denominator)


def _times(c: Element, a: Matrix) -> Matrix:
    return matrix(Q, a.height, a.width, [[c * x for x in row] for row in a.rows])


def _through(a: Matrix, signal: Signal) -> Signal:
    return a @ signal[0], a @ signal[1]


def _sum(first: Signal, *others: Signal) -> Signal:
    H, J = first
    for other in others:
        H, J = H + other[0], J + other[1]
    return H, J


def _rows(a: Matrix, start: int, count: int) -> Matrix:
    return matrix(Q, count, a.width, a.rows[start : start + count])


def _trace(a: Matrix) -> Element:
    return sum((a.rows[i][i] for i in range(a.height)), Q.zero)


def _kron(a: Matrix, b: Matrix) -> Matrix:
    rows = [[x * y for x in a.rows[i] for y in b.rows[k]] for i in range(a.height) for k in range(b.height)]
    return matrix(Q, a.height * b.height, a.width * b.width, rows)
