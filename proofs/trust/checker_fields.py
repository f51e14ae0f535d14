"""Other fields, and witnesses without hints: the second file of the checker, beside `checker.py`, which it needs and which is read first.

    python -I -O checker_fields.py [--json] [--system FILE]... CERTIFICATE...

It decides the kinds of `checker.py` over GF(p) and over Q(a), too, where an entry stands as the d x d block of multiplication by it: row i
holds the coordinates of a^i times it, so that the first row is the entry's own, and the coordinates of x, as a row, times the block of y
are those of x y. Besides that file these arguments have to be believed:

  the chain      Without hints, lower bounds are found gap by gap modulo the prime, along the chain W_k, which decreases, and is constant
                 once its dimension repeats (`System.gaps`). So it is for fields with few elements, for windows of one length, and for all
                 files that were made before there were hints.
  independence   Leading coefficients that are triangular by their pivots are independent.
  a root         What is true modulo the prime with a simple root of f in the place of a bounds what is true over Q(a) as before.
  irreducible    By Berlekamp modulo a prime, or by Eisenstein after a shift. A witness without either is verified under an assumption.
"""

from __future__ import annotations

import sys
from itertools import accumulate, repeat
from math import comb, gcd
from operator import mul
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

if TYPE_CHECKING or __package__:
    from . import checker as core
else:  # alone: the file of that name in the same folder, read now; what Python may have kept of it compiled is not believed
    if "checker" not in sys.modules:
        sys.modules["checker"] = ModuleType("checker")
        sys.modules["checker"].__file__ = str(file := Path(__file__).with_name("checker.py"))
        exec(compile(file.read_bytes(), file, "exec", dont_inherit=True), vars(sys.modules["checker"]))
    core = sys.modules["checker"]

MAX_DEGREE = 16
PRIME_WORDS = "witness: a prime over Q, with a root over Q(a)"


class PrimeField(core.Field):
    """GF(p), p being the prime of the modular bound, too: every matrix is reduced modulo p, and so is what is exact elsewhere."""

    def __init__(self, value: core.Json) -> None:
        super().__init__("Q")
        self.key, self.prime = value, core.index(core.keys(value, "prime", "field")["prime"], "field.prime", core.MAX_PRIME)
        core.expect(core.is_prime(self.prime), "field.prime: not a prime")
        self.modulus = self.prime

    def matrix(self, value: core.Json, nr: int, nc: int, where: str) -> core.Table:
        return core.Table([[x % self.prime for x in row] for row in super().matrix(value, nr, nc, where).rows], nc)

    def integers(self, value: core.Json, size: int, where: str) -> list[int]:
        return [x % self.prime for x in super().integers(value, size, where)]

    def reduce(self, w: core.Json) -> None:
        core.expect("prime" not in w and "root" not in w, PRIME_WORDS)

    def seen(self, system: core.System, rows: list[core.Vectors], F: core.Table, G: core.Table) -> list[bool]:
        columns = [[row[j] for row in [*F.rows, *G.rows]] for j in range(F.nc)]
        conditions, _ = system.conditions(rows)
        core.charge(sum(map(len, rows)) * F.nc * (1000 + 60 * (system.n + system.p)))
        ends = (row[0] for row in conditions)  # X_0 = X_1 A + N_0 C
        table = [*system.A.rows, *system.C.rows]
        found = [any(sum(map(mul, end, column)) % self.prime for end in ends for column in zip(*table, strict=True))]
        found += [False] * max(map(len, rows), default=0)
        for k, condition in ((k, condition) for row in conditions for k, condition in enumerate(row, 1)):
            found[k] = found[k] or any(sum(map(mul, condition, column)) % self.prime for column in columns)
        return found


class NumberField(core.Field):
    """Q(a), `key` the primitive integer multiple of the minimal polynomial f of a, coefficients ascending."""

    def __init__(self, value: core.Json) -> None:
        super().__init__("Q")
        given = core.keys(value, "minimal_polynomial", "field")["minimal_polynomial"]
        pairs = [core.rational(c, "minimal_polynomial") for c in core.items(given, "minimal_polynomial", MAX_DEGREE + 1, 2)]
        core.expect(pairs[-1][0], "minimal_polynomial: the leading coefficient is zero")
        common = core.common_denominator(bottom for _, bottom in pairs)
        multiple = [top * (common // bottom) for top, bottom in pairs]
        core.charge(len(pairs) * max(map(int.bit_length, multiple)) ** 2 >> 7)
        content = gcd(*multiple) * (1 if multiple[-1] > 0 else -1)
        self.key = self.f = [c // content for c in multiple]
        self.degree, self.bad = len(pairs) - 1, common * multiple[-1]  # usable primes do not divide the latter
        self.root, self.blocks = 0, dict[core.Json, tuple[core.Vectors, int]]()

    def entry(self, value: core.Json, where: str) -> tuple[core.Vectors, int]:
        """Return the block of an ENTRY, integers and their denominator; what is no list is read once."""
        if type(value) in (int, str) and value in self.blocks:
            return self.blocks[value]
        *low, lead = self.f
        given = core.items(value, where, self.degree, self.degree) if type(value) is list else [value] + [0] * (self.degree - 1)
        pairs = [core.rational(x, where) for x in given]
        den = core.common_denominator(bottom for _, bottom in pairs)
        size, own = den.bit_length() + max(top.bit_length() for top, _ in pairs), max(map(int.bit_length, self.f))
        bits = size + self.degree * own
        core.charge(3000 + self.degree**2 * (600 + (bits >> 3) + (bits * own >> 9)), core.room(self.degree, self.degree, bits))
        rows, scale = [[top * (den // bottom) for top, bottom in pairs]], lead ** (self.degree - 1)
        for _ in low[1:]:  # a times the row before, times lead: a^d is -low / lead
            rows.append([lead * x - rows[-1][-1] * c for x, c in zip([0, *rows[-1][:-1]], low, strict=True)])
        found = [[x * lead ** (self.degree - 1 - i) for x in row] for i, row in enumerate(rows)], den * scale
        if type(value) is not list:
            self.blocks[value] = found
        return found

    def matrix(self, value: core.Json, nr: int, nc: int, where: str) -> core.Table:
        d = self.degree
        core.charge(1000 + nr * (500 + 600 * nc), 100 * nr * (nc + 1))
        rows = core.items([[]] * nr if value == [] and nc == 0 else value, where, nr, nr)
        grid = [[self.entry(x, f"{where}[{i}]") for x in core.items(row, f"{where}[{i}]", nc, nc)] for i, row in enumerate(rows)]
        den = core.common_denominator(bottom for line in grid for _, bottom in line)
        bits = max((x.bit_length() for line in grid for block, _ in line for row in block for x in row), default=0)
        size = den.bit_length()
        core.charge(nr * nc * d * d * (300 + (size + bits >> 3) + (size * (bits + size) >> 9)), core.room(nr * d, nc * d, size + bits))
        built = [[x * (den // bottom) for block, bottom in line for x in block[i]] for line in grid for i in range(d)]
        common = gcd(den, *(x for row in built for x in row))
        return core.Table([[x // common for x in row] for row in built], nc * d, den // common)

    def integers(self, value: core.Json, size: int, where: str) -> list[int]:
        found = list[int]()
        for x in core.items(value, where, size, size):
            given = core.items(x, where, self.degree, self.degree) if type(x) is list else [x]
            found += [core.rational(c, where, True)[0] for c in given] + [0] * (self.degree - len(given))
        return found

    def reduce(self, w: core.Json) -> None:
        core.expect("prime" in w and "root" in w, PRIME_WORDS)
        prime, value, slope = self.usable(w["prime"]), 0, 0
        self.root, self.modulus = core.index(w["root"], "witness.root", prime - 1), prime
        for c in reversed(self.f):
            slope, value = (slope * self.root + value) % prime, (value * self.root + c) % prime
        core.require(value == 0 and slope, f"{self.root} is not a simple root of the minimal polynomial modulo {prime}")

    def usable(self, prime: core.Json) -> int:
        """Return a prime below 2^64 that divides no denominator and not the leading coefficient of the minimal polynomial."""
        core.require(core.is_prime(core.index(prime, "prime", core.MAX_PRIME)), f"{prime} is not a prime")
        core.require(self.bad % prime, f"{prime} divides a denominator or the leading coefficient of the minimal polynomial")
        return int(prime)

    def residues(self, rows: list[list[int]], den: int = 1) -> core.Vectors:
        prime, d = self.modulus, self.degree
        core.charge(den.bit_length() + sum(1000 + 200 * len(row) + (sum(map(int.bit_length, row)) >> 3) for row in rows))
        core.require(den % prime, "the prime divides a denominator")
        powers = [pow(den, -1, prime) * pow(self.root, c, prime) % prime for c in range(d)]
        return [[sum(map(mul, row[j : j + d], powers)) % prime for j in range(0, len(row), d)] for row in rows]

    def irreducible(self, w: core.Json) -> bool:
        """Return whether f is shown to be irreducible, where its degree is above 1. Rejected when what is given is wrong."""
        if "irreducible" not in w:
            return self.degree == 1
        given, f, d = core.keys(w["irreducible"], "modulo? eisenstein?", "irreducible"), self.f, self.degree
        core.expect(len(given) == 1, "irreducible: expected modulo or eisenstein, over Q(a)")
        if "eisenstein" in given:
            how = core.keys(given["eisenstein"], "prime shift", "eisenstein")
            prime = core.index(how["prime"], "eisenstein.prime", core.MAX_PRIME)
            shift = core.rational(how["shift"], "eisenstein.shift", True)[0]
            core.charge(d**2 * (3000 + ((d * shift.bit_length()) ** 2 + d * shift.bit_length() * max(map(int.bit_length, f)) >> 9)))
            *low, lead = (sum(comb(k, i) * shift ** (k - i) * f[k] for k in range(i, d + 1)) for i in range(d + 1))  # f(x + shift)
            applies = core.is_prime(prime) and lead % prime and not any(c % prime for c in low) and low[0] % prime**2
            core.require(applies, "Eisenstein's criterion does not apply")
            return True
        prime = self.usable(given["modulo"])
        core.charge(prime.bit_length() * d * d * 2000 + sum(map(int.bit_length, f)))
        monic = [c * pow(f[-1], -1, prime) % prime for c in f[:-1]]

        def shifted(g: list[int]) -> list[int]:  # x g modulo f
            return [(x - g[-1] * c) % prime for x, c in zip([0, *g[:-1]], monic, strict=True)]

        def product(g: list[int], h: list[int]) -> list[int]:
            shifts = accumulate(repeat(h, d - 1), lambda one, _: shifted(one), initial=h)
            return [sum(map(mul, g, column)) % prime for column in zip(*shifts, strict=True)]

        unit = [1] + [0] * (d - 1)
        power = unit
        for bit in f"{prime:b}":
            power = product(power, power)
            power = shifted(power) if bit == "1" else power
        # Berlekamp: g -> g^prime is linear on GF(prime)[x]/f, injective iff f is squarefree, and fixes a line iff f has one prime factor.
        frobenius = [*accumulate(repeat(power, d - 1), product, initial=unit)]
        moved = [[(x - (i == j)) % prime for j, x in enumerate(row)] for i, row in enumerate(frobenius)]
        ranks = [len(core.echelon(matrix, prime)) for matrix in (frobenius, moved)]
        core.require(ranks == [d, d - 1], f"f is reducible modulo {prime}")
        return True


def triangular(field: core.Field, pivots: list[int], rows: list[core.Vectors]) -> None:
    """Reject unless the last vectors are triangular by the pivots: entry (a, pivot b) is zero for b < a, and not for b = a."""
    d = field.degree
    for a, row in enumerate(rows):
        core.charge(1000 + 400 * a * d)
        entries = [row[-1][pivot * d : pivot * d + d] for pivot in pivots[: a + 1]]
        core.require(any(entries[-1]) and not any(map(any, entries[:-1])), "the rows are not triangular by their pivots")


class System(core.System):
    """A SYSTEM whose witnesses may have no hints."""

    def gaps(self) -> list[int]:
        """gap(0), gap(1), ... of the modular bound until the chain W_k is constant; the last repeats for ever."""
        prime, n, p, table, found = self.field.modulus, self.n, self.p, self.pencil(), list[int]()
        core.charge(100 * (n + self.m) * (n + p), 80 * (n + self.m) * (n + p))
        outputs_first = [*table[n:], *table[:n]]
        inputs = [[row[n + j] for row in outputs_first] for j in range(self.m)]
        space = [[int(i == j) for i in range(n)] for j in range(n)]
        while True:
            width = n + p
            core.charge(10000 + (len(space) + self.m) * width * (200 + (10 + prime.bit_length()) * n), 80 * (len(space) + self.m) * width)
            moved = [[sum(map(mul, row, x)) % prime for row in outputs_first] for x in space]
            form = core.echelon(moved + inputs, prime)  # of the vectors (output, next state)
            found.append(sum(1 for pivot, _ in form if pivot < p))
            after = [row[p:] for pivot, row in form if pivot >= p]
            if len(after) == len(space):
                return found
            space = after

    def unhinted(self, pivots: list[int], rows: list[core.Vectors], window: int | None) -> None:
        triangular(self.field, pivots, rows)
        found, longest = self.gaps(), max(map(len, rows), default=0)
        core.require(window is None or longest <= window, "the degrees of the kernel rows are not below the window")
        for k in range(max(len(found), longest) if window is None else window):
            core.charge(1000 + 100 * len(rows))
            above = self.p - sum(1 for row in rows if len(row) <= k + 1)
            core.require(found[min(k, len(found) - 1)] == above, f"the bounds do not meet at sample {k}: {above} above")

    def left_invertible(self, s: core.Json, w: core.Json) -> None:
        if "point" in w:
            super().left_invertible(s, w)
        else:
            core.require(self.gaps()[-1] == self.m, "the gap modulo the prime stays below the number of faults")


core.FIELDS |= {"prime": PrimeField, "minimal_polynomial": NumberField}
core.SUBJECTS |= dict.fromkeys(core.SUBJECTS, System)
core.KINDS["left-invertible"] = core.KINDS["left-invertible"]._replace(
    check=System.left_invertible,
    proof="The rank of the pencil at a point, or the last gap, modulo the prime is full, so that the true normal rank is m.",
)
core.KINDS["window-equality"] = core.Kind(System.behaviours, "first second window", "prime? root? kernel",
    "both have the same restricted behaviour on {window} samples",
    "The rows and their shifts span the left null space of both [O_s T_s] on that window.",
)  # fmt: skip

if __name__ == "__main__":
    sys.exit(core.run())
