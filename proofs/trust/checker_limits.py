"""Population limits, stability and zeros: the fourth file of the checker, beside the three that it needs and that are read first.

    python -I -O checker_limits.py [--json] [--system FILE]... CERTIFICATE...

It needs `checker.py`, `checker_fields.py` and `checker_structure.py`, and decides their kinds and those of KINDS below. Besides them
these arguments have to be believed:

  stability     Exact. The characteristic polynomial of the blocks is the product over all embeddings. A polynomial f of degree d, f* the
                same reversed, has all its roots inside the unit circle iff |f_d| > |f_0| and (f_d f - f_0 f*) / q has (Schur and Cohn).
  covariances   Exact. With Phi stable, P = Phi P Phi' + Gamma Gamma' has one solution, the stationary covariance. The others follow.
  regressions   Exact. What minimises a sum of squares are the solutions of the normal equations; that there is one only is seen by ranks.
  zeros         Exact. Unimodular multipliers keep the normal rank and the invariant polynomials.
"""

from __future__ import annotations

import sys
from functools import partial, reduce
from itertools import accumulate, repeat
from math import gcd
from operator import add
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

if TYPE_CHECKING or __package__:
    from . import checker as core
    from . import checker_structure as structure
else:  # alone: the files of these names in the same folder, read now; what Python may have kept of them compiled is not believed
    for name in ("checker", "checker_fields", "checker_structure"):
        if name not in sys.modules:
            sys.modules[name] = ModuleType(name)
            sys.modules[name].__file__ = str(file := Path(__file__).with_name(f"{name}.py"))
            exec(compile(file.read_bytes(), file, "exec", dont_inherit=True), vars(sys.modules[name]))
    core, structure = sys.modules["checker"], sys.modules["checker_structure"]

Polynomial = dict[int, "structure.Mat"]  # a polynomial matrix: the nonzero coefficients by their powers


def inside_circle(f: list[int]) -> bool:
    """Return whether all roots of a polynomial, coefficients descending, lie inside the unit circle, by Schur and Cohn."""
    while len(f) > 1 and abs(f[0]) > abs(f[-1]):
        bits = max(map(int.bit_length, f))
        core.charge(len(f) * (1000 + (bits**2 >> 6)), len(f) * (80 + bits))
        f = [f[0] * x - f[-1] * y for x, y in zip(f[:-1], reversed(f[1:]), strict=True)]
        content = gcd(*f)
        f = [c // content for c in f]
    return len(f) == 1


def product(left: Polynomial, right: Polynomial) -> Polynomial:
    """Return the product of polynomial matrices: of all coefficients of the one, stacked, with those of the other, side by side."""
    if not (left and right):
        return {}
    one, two = next(iter(left.values())), next(iter(right.values()))
    field, height, width, terms = one.field, len(one.rows), two.nc, dict[int, core.Vectors]()
    above = structure.assembled(field, [[a] for a in left.values()], one.nc // field.degree)
    whole = above @ structure.assembled(field, [[*right.values()]], len(right) * width // field.degree)
    core.charge(
        len(left) * len(right) * height * (1000 + width * (100 + (whole.bits >> 4))), core.room(len(whole.rows), whole.nc, whole.bits)
    )
    for r, i in enumerate(left):
        for c, j in enumerate(right):
            block = [row[c * width : c * width + width] for row in whole.rows[r * height : r * height + height]]
            before = terms.get(i + j)
            terms[i + j] = [[*map(add, x, y)] for x, y in zip(before, block, strict=True)] if before else block
    return {k: term for k, rows in terms.items() if (term := structure.Mat(field, rows, width, whole.den))}


def polynomial(field: core.Field, value: core.Json, nr: int, nc: int, where: str) -> Polynomial:
    """Return a POLYMATRIX of that shape."""
    table = [[core.items(f, where) for f in core.items(row, where, nc, nc)] for row in core.items(value, where, nr, nr)]
    powers, width = range(max((len(f) for row in table for f in row), default=0)), nc * field.degree
    # The coefficients side by side, read at once.
    whole = field.matrix([[f[k] if k < len(f) else 0 for k in powers for f in row] for row in table], nr, nc * len(powers), where)
    parts = ((k, [row[k * width : k * width + width] for row in whole.rows]) for k in powers)
    return {k: part for k, rows in parts if (part := structure.Mat(field, rows, width, whole.den))}


def schur_stable(system: structure.System, s: core.Json, w: core.Json) -> None:
    size, den, one = system.A.nc, system.A.den, structure.scalar(system.field, system.n, system.n, 1)
    core.expect(not system.field.prime, "field: a finite one has no unit circle")
    core.charge(size * ((size * den.bit_length()) ** 2 >> 9), size**2 * den.bit_length() // 7)
    scaled, power, f = structure.Mat(system.field, system.A.rows, size), one, [1]
    for k in range(1, size + 1):  # Faddeev and LeVerrier: det(qI - den A), coefficients descending
        power = scaled @ power
        core.charge(size * (100 + (power.bits >> 4)))
        f.append(-sum(row[i] for i, row in enumerate(power.rows)) // k)
        power = power + one.times(f[-1])
    bits = max(map(int.bit_length, f))
    core.charge(size * (bits * size * den.bit_length() >> 11), size * (bits + size * den.bit_length()) // 7)
    core.require(inside_circle([c * den ** (size - k) for k, c in enumerate(f)]), "an eigenvalue is not inside the unit circle")


def zeros(system: structure.System, s: core.Json, w: core.Json) -> None:
    field, nr, nc, one = system.field, system.n + system.p, system.n + system.m, structure.scalar(system.field, 1, 1, 1)
    constant = structure.assembled(field, [[system.A.times(-1), system.F.times(-1)], [system.C, system.G]], nc)
    slope = structure.assembled(field, [[structure.scalar(field, system.n, nc, 1)], [structure.scalar(field, system.p, nc)]], nc)
    pencil = {k: part for k, part in enumerate([constant, slope] if "normal_rank" in s else [slope, constant]) if part}
    left, left_inverse = (polynomial(field, w[key], nr, nr, key) for key in ("left", "left_inverse"))
    right, right_inverse = (polynomial(field, w[key], nc, nc, key) for key in ("right", "right_inverse"))
    core.require(product(left, left_inverse) == ({0: structure.scalar(field, nr, nr, 1)} if nr else {}), "left is not unimodular")
    core.require(product(right, right_inverse) == ({0: structure.scalar(field, nc, nc, 1)} if nc else {}), "right is not unimodular")
    diagonal = core.items(w["diagonal"], "diagonal", min(nr, nc), min(nr, nc))
    target = polynomial(field, [[diagonal[i] if i == j else [] for j in range(nc)] for i in range(nr)], nr, nc, "diagonal")
    core.require(product(product(left, pencil), right) == target, "the multipliers do not give the diagonal")
    nonzero = [f for entry in diagonal if (f := polynomial(field, [[entry]], 1, 1, "diagonal"))]
    if "infinite_zero_orders" in s:
        orders = [core.index(x, "infinite_zero_orders") for x in core.items(s["infinite_zero_orders"], "infinite_zero_orders")]
        core.require(orders == sorted(min(f) - 1 for f in nonzero if min(f)), "the powers of t in the diagonal give other orders")
    else:
        r, given = core.index(s["normal_rank"], "normal_rank"), s["invariant_zero_polynomial"]
        stated, found = polynomial(field, [[given]], 1, 1, "invariant_zero_polynomial"), reduce(product, nonzero, {0: one})
        core.require(stated.get(len(given) - 1) == one, "the polynomial is not monic")
        core.require(len(nonzero) == system.n + r, "the number of nonzero diagonal entries is not n plus the normal rank")
        core.require(found and found == product(stated, {0: found[max(found)]}), "the product of the diagonal is not the polynomial")


class Experiment(structure.System):
    """An EXPERIMENT. f = (u; v; w) is filtered white noise: f = N_0 e + s_1, s_i(k+1) = s_(i+1)(k) + N_i e(k) - d_i f(k) for i = 1..L.
    With xi = (x; s_1; ...; s_L): xi(k+1) = Phi xi(k) + Gamma e(k), z = (u; y) = H xi + J e."""

    OWN = ("s", "past", "u_filter", "v_filter", "w_filter")

    def __init__(self, data: core.Json) -> None:
        core.keys(data, "A F C G B D s past u_filter v_filter w_filter? field? n? m? p? nu?", "experiment")
        super().__init__({name: value for name, value in data.items() if name not in self.OWN})
        core.expect(self.field.key == "Q" and self.nu, "experiment: over Q only, and with an input")
        self.s, self.past = (core.index(data[name], name, core.MAX_WINDOW) for name in ("s", "past"))
        core.expect(self.s and self.past, "s, past: one block row at least")
        u = self.filter(data["u_filter"], self.nu, "u_filter")
        v = self.filter(data["v_filter"], self.m, "v_filter", u[0][0].nc)
        w = self.filter(data.get("w_filter", [[[]] * self.p]), self.p, "w_filter")
        self.chain = list[tuple[structure.Mat, structure.Mat]]()  # N_i and -d_i
        for i in range(max(map(len, (u, v, w)))):
            (a, c), (b, d), (g, h) = (one[i] if i < len(one) else (one[0][0].times(0), one[0][1].times(0)) for one in (u, v, w))
            self.chain.append(
                (
                    structure.diagonal(self.field, structure.assembled(self.field, [[a], [b]], a.nc), g),
                    structure.diagonal(self.field, c, d, h),
                )
            )
        self.key += ([self.nu, self.s, self.past, len(self.chain), u[0][0].nc, w[0][0].nc], self.inputs, self.chain)
        self.given = data
        self.moves, self.solved = tuple[structure.Mat, ...](), dict[int, tuple[structure.Mat, ...]]()

    @property
    def words(self) -> str:
        told = ", ".join(f"{name}={core.shorten(self.given[name])}" for name in ("B", "D", *self.OWN) if name in self.given)
        return f"{super().words} with nu={self.nu}, {told}"

    def filter(self, value: core.Json, height: int, where: str, width: int | None = None) -> list[tuple[structure.Mat, structure.Mat]]:
        """Return N_i and -d_i of a FILTER, i = 0, 1, ..."""
        given = core.keys(value, "num den", where) if type(value) is dict else {"num": value, "den": [1]}
        num, den = (core.items(given[key], where, core.MAX_DIMENSION, 1) for key in ("num", "den"))
        pairs = [core.rational(d, where) for d in den]
        core.expect(pairs[0] == (1, 1), f"{where}: the denominator does not begin with 1")
        common = core.common_denominator(bottom for _, bottom in pairs)
        core.charge(sum(common.bit_length() * (common.bit_length() + top.bit_length()) >> 8 for top, _ in pairs))
        core.require(inside_circle([top * (common // bottom) for top, bottom in pairs]), f"{where}: the denominator is not stable")
        if width is None:
            width = len(core.items(rows[0], where, core.MAX_DIMENSION)) if (rows := core.items(num[0], where, height)) else 0
        unit, extra = structure.scalar(self.field, height, height, 1), [0] * abs(len(num) - len(den))
        forward = [structure.matrix(self.field, part, height, width, where) for part in num] + [
            structure.scalar(self.field, height, width) for _ in extra
        ]
        return list(zip(forward, [unit.times(-top, bottom) for top, bottom in pairs] + [unit.times(0) for _ in extra], strict=False))

    def process(self, B: structure.Mat, D: structure.Mat) -> tuple[structure.Mat, structure.Mat, structure.Mat, structure.Mat]:
        """Return Phi, Gamma, H, J with these in the place of B and D."""
        zero, joined, first, steps = (
            partial(structure.scalar, self.field),
            partial(structure.assembled, self.field),
            self.chain[0][0],
            range(1, len(self.chain)),
        )
        height, size = len(first.rows), len(first.rows) * len(steps)
        core.charge(400 * len(steps) ** 2, 40 * len(steps) ** 2)
        unit, blank = zero(height, height, 1), zero(height, height)
        moves = [[self.chain[i][1], *(unit if j == i + 1 else blank for j in steps[1:])] for i in steps]
        enter = [[num + minus @ first] for num, minus in self.chain[1:]]
        into, seen = joined([[B, self.F, zero(self.n, self.p)]], height), joined([[D, self.G, zero(self.p, self.p, 1)]], height)
        direct, reads = joined([[zero(self.nu, height, 1)], [seen]], height), zero(height, size, 1)
        Phi = joined([[self.A, into @ reads], [zero(size, self.n), joined(moves, size)]], self.n + size)
        H = joined([[joined([[zero(self.nu, self.n)], [self.C]], self.n), direct @ reads]], self.n + size)
        return Phi, joined([[into @ first], *enter], first.nc), H, direct @ first

    def covariances(
        self, value: core.Json, samples: int, width: int, B: structure.Mat, D: structure.Mat
    ) -> tuple[structure.Mat, structure.Mat, structure.Mat, structure.Mat]:
        """Return Phi, H, Cov(xi(k+1), t(k)) and Cov(z(0..samples-1), t(0..samples-1)), t the first `width` of the channels of z: u, or all.

        The value is Cov(xi), or for t = u the part Cov(xi, (s_1; ...; s_L)) that is enough. What is exact is found once for an experiment
        that stands in several certificates: that it is stable, and what follows from a value, which is looked at again where it differs.
        """
        core.charge(400 * samples**2, 40 * samples**2)
        own = B is self.inputs[0] and D is self.inputs[1]
        if not self.moves:
            schur_stable(self, {}, {})
            self.moves = self.process(*self.inputs)
        Phi, Gamma, H, J = self.moves if own else self.process(B, D)
        part, some = range(self.n if width == self.nu else 0, Phi.nc), range(width)
        a, b, h, j = Phi.at(part, part), Gamma.at(part, range(Gamma.nc)), H.at(some, part), J.at(some, range(J.nc))
        P = structure.matrix(self.field, value, Phi.nc, len(part), "covariance")
        if own and width in self.solved and self.solved[width][0] == P:
            _, following, backward, now = self.solved[width]
        else:
            core.require(Phi @ P @ a.T + Gamma @ b.T == P, "the covariance does not solve the Lyapunov equation")
            following, backward, now = Phi @ P @ h.T + Gamma @ j.T, a @ P.T @ H.T + b @ J.T, H @ P @ h.T + J @ j.T
            if own:
                self.solved[width] = P, following, backward, now
        later = [H @ block for block in accumulate(repeat(Phi, samples - 2), lambda block, step: step @ block, initial=following)]
        sooner = [(h @ block).T for block in accumulate(repeat(a, samples - 2), lambda block, step: step @ block, initial=backward)]
        lags = [*reversed(sooner), now, *later]  # Cov(z(k), t(0)) at len(sooner) + k
        grid = [lags[len(sooner) + i - samples + 1 : len(sooner) + i + 1][::-1] for i in range(samples)]
        return Phi, H, following, structure.assembled(self.field, grid, samples * width)

    def places(self, samples: range, channels: range, width: int) -> list[int]:
        """Return where these channels stand in (z(0); z(1); ...) with `width` channels a sample."""
        core.charge(100 * len(samples) * len(channels), 50 * len(samples) * len(channels))
        return [k * width + i for k in samples for i in channels]

    def moesp_limit(self, s: core.Json, w: core.Json) -> None:
        nu, width, field = self.nu, self.nu + self.p, self.field
        core.expect(s["instruments"] in ("past-inputs", "past-inputs-and-outputs"), "instruments: past-inputs or past-inputs-and-outputs")
        right, past, future = nu if s["instruments"] == "past-inputs" else width, range(self.past), range(self.past, self.past + self.s)
        *_, moments = self.covariances(w["covariance"], self.past + self.s, right, *self.inputs)
        rows = self.places(future, range(nu), width) + self.places(future, range(nu, width), width)
        first = moments.at(rows, self.places(future, range(nu), right))
        limit = moments.at(rows, self.places(past, range(right), right))
        size = first.nc
        core.require(first.at(range(size), range(size)).rank() == size, "the covariance of the inputs may be singular")
        seen = structure.assembled(field, [[structure.scalar(field, size, self.n)], [self.window(self.s, faults=False)]], self.n)
        for name, parts in (("limit", [limit]), ("observability", [seen]), ("joint", [limit, seen])):
            table = structure.assembled(field, [[first, *parts]], size + sum(part.nc for part in parts))
            structure.ranked(table, size + core.index(s[f"{name}_rank"], f"{name}_rank"), w.get(name, w["joint"]))

    def input_limit(self, s: core.Json, w: core.Json) -> None:
        field, n, p, nu, true = self.field, self.n, self.p, self.nu, s["regression"] == "true-AC"
        core.expect(true or s["regression"] == "moesp", "regression: true-AC or moesp")
        given = {*w} - {"prime", "covariance", "irreducible"}
        core.expect(
            given == ({"errors", "series"} if true else {"response", "inverse"}), "witness: errors and series, or response and inverse"
        )
        window, stated = (
            n + 1 if true else self.s,
            [structure.matrix(field, s["B"], n, nu, "B"), structure.matrix(field, s["D"], p, nu, "D")],
        )
        *_, moments = self.covariances(w["covariance"], window, nu, *self.inputs)
        outputs, size = self.places(range(window), range(nu, nu + p), nu + p), nu * window
        inputs = moments.at(self.places(range(window), range(nu), nu + p), range(size))
        before, seen = (self.window(k, faults=False) for k in (window - 1, window))
        core.require(inputs.rank() == size, "the covariance of the inputs may be singular")
        core.require(before.rank() == n, "the observability matrix may lose rank")
        if true:
            errors = (mine + other.times(-1) for mine, other in zip(self.inputs, stated, strict=True))
            Phi, H, following, present = self.covariances(w["errors"], 1, nu, *errors)  # y is here what the stated B and D leave of it
            series = structure.matrix(field, w["series"], n, Phi.nc, "series")  # sum of A'^k C' (the rows of y in H) Phi^k
            solved = self.A.T @ series @ Phi + self.C.T @ H.at(range(nu, nu + p), range(Phi.nc))
            core.require(solved == series, "the series does not solve its equation")
            core.require(not series @ following, "the error is correlated with the past inputs")
            core.require(not present.at(range(nu, nu + p), range(nu)), "the error is correlated with the present input")
            return
        response, inverse = (
            structure.matrix(field, w["response"], p * window, size, "response"),
            structure.matrix(field, w["inverse"], n, p * window, "inverse"),
        )
        core.require(response @ inputs == moments.at(outputs, range(size)), "the response is not that of the future inputs")
        core.require(seen.T @ (seen @ inverse) == seen.T, "the inverse does not project on the observability matrix")
        column = structure.assembled(
            field,
            [[structure.scalar(field, p, n), structure.scalar(field, p, p, 1)], [before, structure.scalar(field, p * window - p, p)]],
            n + p,
        )
        theta, slope = structure.assembled(field, [[part.times(-1)] for part in stated], nu), structure.scalar(field, n + p, nu)
        for j in range(window):  # block column j of response - T_s(B, D), and what of it is orthogonal to the observability matrix
            shifted = structure.assembled(
                field, [[structure.scalar(field, p * j, n + p)], [column.at(range(p * (window - j)), range(n + p))]], n + p
            )
            rest = response.at(range(p * window), range(nu * j, nu * j + nu)) + shifted @ theta
            slope = slope + shifted.T @ (rest + seen @ (inverse @ rest).times(-1))
        core.require(not slope, "the normal equations fail")


DIAGONAL = "diagonal left left_inverse right right_inverse"
KINDS: dict[str, core.Kind] = {
    "schur-stable": core.Kind(schur_stable, "system", "",
        "all eigenvalues of A lie inside the unit circle (over Q(a): for every root a)",
        "The characteristic polynomial of the blocks is the product over the roots a, and Schur and Cohn decide it."),
    "moesp-limit": core.Kind(Experiment.moesp_limit, "experiment instruments limit_rank observability_rank joint_rank",
        "prime covariance joint limit? observability?",
        "A and the denominators are Schur stable, and of the stationary process, with {instruments} as instruments Z: Cov(Uf) is "
        "nonsingular, L = Cov(Yf, Z) - Cov(Yf, Uf) Cov(Uf)^-1 Cov(Uf, Z) has rank {limit_rank}, O_s rank {observability_rank}, "
        "[L O_s] rank {joint_rank}",
        "The covariances follow from the one solution of the Lyapunov equation; eliminating Cov(Uf) leaves L, O_s and [L O_s]."),
    "input-limit": core.Kind(Experiment.input_limit, "experiment regression B D", "prime covariance errors? series? response? inverse?",
        "A and the denominators are Schur stable, and of the stationary process, with the true A and C, the {regression} regression has "
        "one solution: B = {B}, D = {D}",
        "What solves the normal equations minimises a convex quadratic; the two ranks leave one solution."),
    "finite-zeros": core.Kind(zeros, "system normal_rank invariant_zero_polynomial", DIAGONAL,
        "the pencil has normal rank n + {normal_rank} and invariant zero polynomial {invariant_zero_polynomial} (ascending)",
        "Unimodular multipliers keep the normal rank and, up to constants, the product of the invariant polynomials."),
    "infinite-zeros": core.Kind(zeros, "system infinite_zero_orders", DIAGONAL,
        "the infinite zeros have the orders {infinite_zero_orders}",
        "Unimodular multipliers keep the Smith form at t = 0 of the reversed pencil, whose powers of t are the orders, plus one."),
}  # fmt: skip
core.KINDS.update(KINDS)
core.SUBJECTS["experiment"] = Experiment

if __name__ == "__main__":
    sys.exit(core.run())
