"""The checker of ranks and behaviours: certificates of the format `faultspace-certificate/1` (FORMAT.md), by the standard library alone.

    python -I -O checker.py [--json] [--system FILE]... CERTIFICATE...

Exit 0: all verified, their statements printed. 3: all verified, at least one under an assumption that its line and "assumes" in the JSON
name. 1: one is rejected, also for not being about a --system FILE. 2: one does not parse. 74: the answer could not be written.

It can be copied alone to another machine; `checker_limits.py`, copied beside it, decides every kind of certificate. It searches for
nothing: what it does not read in the witness it computes by elimination or by a recursion of fixed length. It computes with integers, and
trusts no order, prime or hint that it has not looked at itself. What has to be believed is this file, with the Python that runs it, and
these arguments (KINDS says in a line how each kind follows from them):

  annihilation  Exact. An entry of Q(a) stands as the d x d matrix of multiplication by it; over GF(p) every matrix is reduced modulo p.
  upper bounds  Rows that annihilate a system, with independent leading coefficients: they and their shifts are independent, and all vanish
                on [O_s T_s]. So its rank is no more than p s - sum of max(0, s - mu), mu the degrees.
  lower bounds  Ranks modulo a prime never exceed the true ones. There the rows are seen to be a minimal basis of all that vanish, once for
                every s (`System.minimal`); or, without hints, gap by gap along the chain W_k, which decreases, and is constant once its
                dimension repeats (`System.gaps`).
  together      Where both bounds meet, the left null space of [O_s T_s] is spanned by the rows and their shifts.
  packing       Vectors of residues, and integer rows, stand in slots of one number, wide enough that nothing is carried from one to the
                next (`packed`, `System.seen`).

Conventions, the same everywhere (FORMAT.md says them with the notation). Signals are columns: [O_s T_s] has the block rows r(0), ...,
r(s-1) and the block columns x(0), v(0), ..., v(s-1). Kernel rows and left null rows are rows, and multiply from the left; a row has one
block of p entries a sample. Polynomials ascend. Over Q(a) row i of the block of an entry holds the coordinates of a^i times it: the first
row is the entry's own, and the coordinates of x, as a row, times the block of y are those of x y.

Whatever a file holds, the answer comes: what would take more than MAX_WORK or MAX_MEMORY is rejected before it is done.

Public: verify(certificate, systems=()) -> Verified(statement, assumes); load(path), parse(data) -> JSON; subject(data) -> System;
sha256(certificate); Malformed; Rejected; main(argv).
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import re
import stat
import sys
from collections.abc import Callable, Iterable, Sequence
from contextvars import ContextVar
from functools import cache, partial, reduce
from itertools import accumulate, chain, repeat
from math import comb, gcd, lcm
from operator import add, mul
from typing import Any, NamedTuple, NoReturn

Json = Any
Vectors = list[list[int]]  # a polynomial row c_0, c_1, ...: the coordinates of its coefficients, or their residues
MAX_BYTES, MAX_BITS, MAX_DIMENSION, MAX_DEGREE, MAX_WINDOW, MAX_PRIME = 2 * 2**20, 2**16, 512, 16, 4096, 2**64 - 1
MAX_WORK, MAX_MEMORY = 3 * 10**9, 2**27  # of this checker, for one certificate: in nanoseconds and bytes, by estimates from above
NUMBER = re.compile(r"(-?[0-9]{1,19730})(?:/([1-9][0-9]{0,19729}))?")
if 0 < sys.get_int_max_str_digits() < 19730:  # Python's own bound is below that of the format
    sys.set_int_max_str_digits(19730)


class Meter:
    """This is what a certificate has cost so far: work in all, the bytes that its matrices hold now; and the numbers that its fields have
    read.
    """

    __slots__ = ("held", "memos", "work")

    def __init__(self) -> None:
        self.held = self.work = 0
        self.memos = list[dict[object, Mat]]()


_meter: ContextVar[Meter] = ContextVar("meter")


class Malformed(Exception):
    """The certificate does not parse: it is not of the format."""


class Rejected(Exception):
    """The certificate is well formed, and does not prove its statement."""


def require(condition: object, reason: str, error: type[Exception] = Rejected) -> None:
    """Raise Rejected unless the condition holds; `expect` raises Malformed."""
    if not condition:
        raise error(reason)


expect = partial(require, error=Malformed)


def begin() -> Meter:
    """Return a meter at zero, for what is done next; what was remembered of the last one is let go."""
    for memo in last.memos if (last := _meter.get(None)) else []:
        memo.clear()
    _meter.set(meter := Meter())
    return meter


def charge(work: int, room: int = 0) -> Meter:
    """Count work that is about to be done in `room` bytes, and reject what asks for too much of either."""
    meter = _meter.get(None) or begin()
    meter.work += work
    if meter.work > MAX_WORK:  # asked before, so that the words are put together only where they are needed
        require(False, f"checking takes more than {MAX_WORK} units of work")
    if meter.held + room > MAX_MEMORY:
        require(False, f"checking takes more than {MAX_MEMORY} bytes of memory")
    return meter


def rational(value: Json, where: str, integral: bool = False) -> tuple[int, int]:
    """Return (numerator, denominator) of a RATIONAL or, integral, of an INTEGER; reduced."""
    match = NUMBER.fullmatch(value) if type(value) is str else None
    if type(value) is not int and (match is None or (integral and match[2])):
        expect(False, f"{where}: expected {'an integer' if integral else 'a rational'}")
    charge(2000 + (len(match[0]) ** 2 >> 6 if match else value.bit_length() ** 2 >> 8))
    top, bottom = (int(match[1]), int(match[2] or 1)) if match else (value, 1)
    if max(top.bit_length(), bottom.bit_length()) > MAX_BITS:
        expect(False, f"{where}: more than {MAX_BITS} bits")
    return top // (common := gcd(top, bottom)), bottom // common


def index(value: Json, where: str, largest: int = MAX_DIMENSION * MAX_WINDOW) -> int:
    """Return an INDEX up to the largest."""
    if type(value) is not int or not 0 <= value <= largest:
        expect(False, f"{where}: expected an integer in 0..{largest}")
    return int(value)


def items(value: Json, where: str, most: int = MAX_WINDOW, least: int = 0) -> list[Json]:
    """Return a list with least..most items."""
    if type(value) is not list or not least <= len(value) <= most:
        expect(False, f"{where}: expected a list of {least} to {most} items")
    return list(value)


def keys(value: Json, names: str, where: str) -> dict[str, Json]:
    """An object with these keys and no others; a question mark says optional."""
    required, known = {name for name in names.split() if name[-1] != "?"}, {*names.replace("?", "").split()}
    expect(type(value) is dict and required <= set(value) <= known, f"{where}: expected an object with the keys {names}")
    return dict(value)


@cache
def is_prime(number: int) -> bool:
    """Say whether the number is prime, by Miller-Rabin, which is right for every number below 2^64."""
    bases = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37)
    if number <= bases[-1]:
        return number in bases
    twos = ((number - 1) & (1 - number)).bit_length() - 1
    odd = (number - 1) >> twos
    return all(pow(b, odd, number) in (1, number - 1) or number - 1 in (pow(b, odd << i, number) for i in range(1, twos)) for b in bases)


def slot(prime: int, terms: int) -> int:
    """Return the bytes of a slot in which a sum of so many products of two residues fits: terms (prime - 1)^2 < 256^slot."""
    return (2 * prime.bit_length() + terms.bit_length() + 7) // 8


def packed(vector: Iterable[int], size: int) -> int:
    """Return residues as one number, one in each slot of so many bytes, the first in the lowest.

    A multiple of such a number, or a sum, is that of the vector, slot by slot, as long as what stands in every slot stays below
    256^size: nothing is carried from one to the next.
    """
    return int.from_bytes(b"".join([x.to_bytes(size, "little") for x in vector]), "little")


def unpacked(number: int, size: int, count: int, prime: int) -> list[int]:
    """Return the residues that stand in the slots."""
    data = number.to_bytes(size * count, "little")
    return [int.from_bytes(data[i : i + size], "little") % prime for i in range(0, size * count, size)]


def echelon(vectors: Iterable[list[int]], prime: int) -> list[tuple[int, list[int]]]:
    """Row echelon form modulo a prime of lists of residues: [(pivot column, row with leading 1), ...] ascending by pivot.

    Each vector, packed, is cleared of the pivots so far in the order in which they were found, each of which has zeros at those before it.
    A slot receives one residue, and one product of two for each of them.
    """
    found, leads, rows = list[tuple[int, list[int]]](), list[tuple[int, int]](), [v for v in vectors if any(v)]
    count = len(rows[0]) if rows else 0
    size = slot(prime, min(len(rows), count) + 1)
    mask = (1 << 8 * size) - 1
    for row in rows:
        charge(1000 + 500 * count + (1 + len(leads)) * (500 + size * count), (100 + size) * (count + 1))
        number = packed(row, size)
        for shift, lead in leads:
            if c := (number >> shift & mask) % prime:
                number += (prime - c) * lead
        rest = unpacked(number, size, count, prime)
        if (j := next((j for j, x in enumerate(rest) if x), count)) < count:
            inverse = pow(rest[j], -1, prime)
            found.append((j, [x * inverse % prime for x in rest]))
            leads.append((8 * size * j, packed(found[-1][1], size)))
    return sorted(found)


def determinant(rows: list[list[int]], prime: int) -> int:
    """Return a determinant modulo a prime."""
    value, rows = 1, rows[:]
    while rows:
        lead = next((row for row in rows if row[-1]), None)
        if lead is None:
            return 0
        value = value * lead[-1] * (-1 if (len(rows) - 1 - rows.index(lead)) % 2 else 1) % prime
        rows.remove(lead)
        inverse, lead = pow(lead[-1], -1, prime), lead[:-1]
        rest = ((row[:-1], row[-1] * inverse % prime) for row in rows)
        rows = [[(x - c * y) % prime for x, y in zip(row, lead, strict=True)] if c else row for row, c in rest]
    return value


def determinant_polynomial(table: list[list[list[int]]], degree: int, prime: int) -> list[int]:
    """Return det of a square matrix of polynomials modulo a prime above its degree, which is `degree` at most: degree + 1 coefficients.

    A polynomial of that degree is the one that has its values at 0, ..., degree, by divided differences.
    """
    size, longest = len(table), max((len(f) for row in table for f in row), default=0)
    charge((degree + 1) * (2000 + size**2 * (300 + 80 * longest + 40 * size) + 250 * degree), 200 * (degree + size**2 + longest))
    values = list[int]()
    for q in range(degree + 1):
        powers = [*accumulate(repeat(q, longest - 1), lambda power, q: power * q % prime, initial=1)]
        values.append(determinant([[sum(map(mul, f, powers)) % prime for f in row] for row in table], prime))
    for k in range(1, degree + 1):
        inverse = pow(k, -1, prime)
        values[k:] = [(y - x) * inverse % prime for x, y in zip(values[k - 1 :], values[k:], strict=False)]
    found = values[degree:]
    for k in reversed(range(degree)):  # times (q - k), plus the k-th difference
        found = [(x - k * y) % prime for x, y in zip([values[k], *found], [*found, 0], strict=True)]
    return found


def coprime(f: list[int], g: list[int], prime: int) -> bool:
    """Return whether two polynomials modulo a prime, the first not zero, have no common factor, by Euclid."""
    while any(g):
        while not g[-1]:
            g = g[:-1]
        charge((1 + abs(len(f) - len(g))) * (1500 + 120 * len(g)))
        inverse, rest = pow(g[-1], -1, prime), f
        while len(rest) >= len(g):
            if c := rest[-1] * inverse % prime:
                at = len(rest) - len(g)
                rest[at:] = [(x - c * y) % prime for x, y in zip(rest[at:], g, strict=True)]
            rest.pop()
        f, g = g, rest
    return not any(f[1:])


def common_denominator(numbers: Iterable[int]) -> int:
    """Return the least common multiple."""
    found = 1
    for number in {*numbers}:
        charge(500 + (found.bit_length() * number.bit_length() >> 8))
        found = lcm(found, number)
    return found


def shorten(value: Json) -> str:
    """JSON for a reader; a long one is cut and named by its digest, so that no two look alike."""
    text = json.dumps(value, separators=(",", ":")).replace('"', "")
    return text if len(text) <= 240 else f"{text[:200]}... [{len(text)} characters, SHA-256 {hashlib.sha256(text.encode()).hexdigest()}]"


class Mat:
    """The matrix rows / den of integers over a field; an entry of K is a d x d block: rows and columns (nc) are d times those over K.

    What makes one charges for it beforehand; `size` bytes are on the meter as long as it lives.
    """

    __slots__ = ("bits", "den", "field", "meter", "nc", "rows", "size")

    def __init__(self, field: Field, rows: list[list[int]], nc: int, den: int = 1) -> None:
        self.size = 0
        if field.prime:
            rows = [[x % field.prime for x in row] for row in rows]
        self.field, self.rows, self.nc, self.den = field, rows, nc, den
        self.bits = max(map(int.bit_length, chain.from_iterable(rows)), default=0)
        size = room(len(rows), nc, self.bits) + den.bit_length() // 7
        self.meter = charge(3000 + len(rows) * (1000 + 120 * nc), size)
        self.size = size
        self.meter.held += size

    def __del__(self) -> None:
        if self.size:
            self.meter.held -= self.size

    def __matmul__(self, other: Mat) -> Mat:
        nr, nc, bits = len(self.rows), other.nc, self.bits + other.bits + self.nc.bit_length()
        charge((self.den.bit_length() * other.den.bit_length() >> 10) + (nr + nc) * (500 + self.nc * 150))
        if self.bits + other.bits < 64:  # numbers of a word: a bound for all of them is near enough
            long = 3 * nr * nc * self.nc
        else:
            left = [sum(map(int.bit_length, column)) for column in zip(*self.rows, strict=True)] or [0] * self.nc
            right = [sum(map(int.bit_length, row)) for row in other.rows]
            long = (nc * sum(left) + nr * sum(right) >> 5) + (sum(map(mul, left, right)) >> 10)
        charge(nr * (1000 + nc * (400 + self.nc * 60)) + long, room(nr, nc, bits))
        columns = list(zip(*other.rows, strict=True)) if other.rows else [()] * nc
        return Mat(self.field, [[sum(map(mul, row, c)) for c in columns] for row in self.rows], nc, self.den * other.den)

    def __add__(self, other: Mat) -> Mat:
        den, pairs = common_denominator((self.den, other.den)), zip(self.rows, other.rows, strict=True)
        a, b = den // self.den, den // other.den
        bits = max(a.bit_length() + self.bits, b.bit_length() + other.bits)
        work = a.bit_length() * self.bits + b.bit_length() * other.bits
        charge(len(self.rows) * (1000 + self.nc * (200 + (work >> 11) + (bits >> 4))), room(len(self.rows), self.nc, bits + 1))
        return Mat(self.field, [[a * x + b * y for x, y in zip(r, s, strict=True)] for r, s in pairs], self.nc, den)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mat) or (self.den == other.den and self.rows == other.rows):
            return isinstance(other, Mat)
        return not self + other.times(-1)

    def times(self, top: int, bottom: int = 1) -> Mat:
        """Return the matrix times top / bottom."""
        a, b = top.bit_length(), bottom.bit_length()
        charge(b * self.den.bit_length() >> 11)
        charge(len(self.rows) * (1000 + self.nc * (100 + (a >> 4) + (a * self.bits >> 11))), room(len(self.rows), self.nc, a + self.bits))
        return Mat(self.field, [[top * x for x in row] for row in self.rows], self.nc, self.den * bottom)

    def __bool__(self) -> bool:  # whether it is not zero
        return any(map(any, self.rows))

    def at(self, rows: Sequence[int], columns: Sequence[int]) -> Mat:
        """Return these rows and columns, not over Q(a)."""
        charge(len(rows) * (1000 + len(columns) * 100), room(len(rows), len(columns), self.bits))
        return Mat(self.field, [[self.rows[i][j] for j in columns] for i in rows], len(columns), self.den)

    @property
    def T(self) -> Mat:
        """This is the transpose, not over Q(a)."""
        charge(self.nc * (1000 + len(self.rows) * 100), room(self.nc, len(self.rows), self.bits))
        return Mat(self.field, [[row[j] for row in self.rows] for j in range(self.nc)], len(self.rows), self.den)

    def rank(self) -> int:
        """Return the rank modulo the prime, never more than the rank."""
        return len(echelon(self.residues(), self.field.modulus[0]))

    def residues(self) -> list[list[int]]:
        """Return the rows over K modulo the prime of the modular bound, a going to its root; Rejected when a denominator vanishes."""
        d, prime, root = self.field.degree, *self.field.modulus
        height = len(self.rows) // d
        charge(self.den.bit_length() + height * (500 + self.nc * (150 + self.bits)), room(height, self.nc // d, 64))
        require(self.den % prime, "the prime divides a denominator")
        if d == 1:
            inverse = pow(self.den, -1, prime)
            return [[x * inverse % prime for x in row] for row in self.rows]
        powers = [pow(self.den, -1, prime) * pow(root, c, prime) for c in range(d)]
        return [[sum(map(mul, row[j : j + d], powers)) % prime for j in range(0, self.nc, d)] for row in self.rows[::d]]


def room(nr: int, nc: int, bits: int) -> int:
    """Return the bytes that a matrix of that shape takes, with numbers of so many bits."""
    return 400 + nr * (100 + nc * (40 + bits // 7))


class Field:
    """K: `prime`, 0 in characteristic 0; over Q(a) its `degree` d and `f`, primitive (else 1 and []); equal fields have equal keys."""

    def __init__(self, value: Json) -> None:
        self.prime, self.f, self.degree, self.bad, self.key, self.known = 0, list[int](), 1, 1, value, dict[object, Mat]()
        charge(1000).memos.append(self.known)
        if type(value) is dict and "prime" in value:
            self.prime = index(keys(value, "prime", "field")["prime"], "field.prime", MAX_PRIME)
            expect(is_prime(self.prime), "field.prime: not a prime")
        elif value != "Q":
            given = keys(value, "minimal_polynomial", "field")["minimal_polynomial"]
            pairs = [rational(c, "minimal_polynomial") for c in items(given, "minimal_polynomial", MAX_DEGREE + 1, 2)]
            expect(pairs[-1][0], "minimal_polynomial: the leading coefficient is zero")
            common = common_denominator(bottom for _, bottom in pairs)
            multiple = [top * (common // bottom) for top, bottom in pairs]
            charge(len(pairs) * max(map(int.bit_length, multiple)) ** 2 >> 7)
            content = gcd(*multiple) * (1 if multiple[-1] > 0 else -1)
            self.key = self.f = [c // content for c in multiple]
            self.degree, self.bad = len(pairs) - 1, common * multiple[-1]  # usable primes do not divide the latter
        self.modulus, self.numbers = (self.prime, 0), dict[str | int, tuple[int, int]]()
        d, (*low, lead) = self.degree, self.f or [0, 1]
        a = Mat(self, [[lead * (j == i + 1) for j in range(d)] for i in range(d - 1)] + [[-c for c in low]], d, lead)
        self.powers = [*accumulate(repeat(a, max(d - 1, 1)), Mat.__matmul__, initial=self.scalar(1, 1, 1))]  # 1, a, a^2, ...

    def scalar(self, nr: int, nc: int, value: int = 0) -> Mat:
        """Return the matrix, nr x nc over K, with the value on its diagonal: zero, or the identity."""
        nr, nc = nr * self.degree, nc * self.degree
        charge(nr * (1000 + nc * 120), room(nr, nc, value.bit_length()))
        return Mat(self, [[value * (i == j) for j in range(nc)] for i in range(nr)], nc)

    def assembled(self, grid: Sequence[Sequence[Mat]], nc: int) -> Mat:
        """The matrix with nc columns over K made of lines of blocks."""
        count = sum(map(len, grid))
        charge(400 * count, 40 * count)
        parts = [part for line in grid for part in line]
        bits, cells = max([part.bits for part in parts], default=0), sum([len(part.rows) * part.nc for part in parts])
        dens = {part.den for part in parts}
        den = common_denominator(dens)
        size = den.bit_length()
        height = sum([len(line[0].rows) for line in grid if line])
        charge(len(dens) * (size**2 >> 8) + cells * (200 + (size + bits >> 4) + (size * bits >> 11)), len(dens) * (80 + size // 7))
        charge(1500 * height, room(height, nc * self.degree, size + bits))
        scale = {bottom: den // bottom for bottom in dens}
        rows = [[x * scale[part.den] for part in line for x in part.rows[i]] for line in grid for i in range(len(line[0].rows))]
        return Mat(self, rows, nc * self.degree, den)

    def diagonal(self, *blocks: Mat) -> Mat:
        """The matrix with these blocks on its diagonal."""
        grid = [[b if i == j else self.scalar(len(a.rows), b.nc) for j, b in enumerate(blocks)] for i, a in enumerate(blocks)]
        return self.assembled(grid, sum(block.nc for block in blocks))

    def entry(self, value: Json, where: str, integral: bool = False) -> Mat:
        """An ENTRY as the d x d matrix of multiplication by it: row i holds the coordinates of a^i times it."""
        key = (value, integral) if type(value) in (str, int) else None
        if key is None or key not in self.known:
            charge(3000)
            given = items(value, where, self.degree, self.degree) if type(value) is list and self.f else [value]
            pairs = [rational(x, where, integral or self.prime > 0) for x in given]
            terms = [power.times(top, bottom) for power, (top, bottom) in zip(self.powers, pairs, strict=False) if top]
            self.known[key] = reduce(add, terms) if terms else self.scalar(1, 1)
        return self.known[key]

    def number(self, value: Json, where: str, integral: bool) -> tuple[int, int]:
        """Return numerator and denominator of an ENTRY, not over Q(a); what stands often is read once."""
        if (found := self.numbers.get(value) if type(value) in (str, int) else None) is None or integral:
            found = rational(value, where, integral or self.prime > 0)
            self.numbers[value] = found
        return found

    def matrix(self, value: Json, nr: int, nc: int, where: str, integral: bool = False) -> Mat:
        """Return a MATRIX of that shape; with no entries, [] or the right number of empty rows."""
        charge(1000 + nr * (500 + 600 * nc), 100 * nr * (nc + 1))
        rows, grid = items([[]] * nr if value == [] and nc == 0 else value, where, nr, nr), list[list[Mat]]()
        if not self.f:
            lines = ((row, f"{where}[{i}]") for i, row in enumerate(rows))
            table = [[self.number(x, line, integral) for x in items(row, line, nc, nc)] for row, line in lines]
            dens = {bottom for row in table for _, bottom in row}
            den, bits = common_denominator(dens), max((top.bit_length() for row in table for top, _ in row), default=0)
            size = den.bit_length()
            charge(len(dens) * (size**2 >> 8) + nr * nc * (size + bits >> 4) + nr * nc * (size * bits >> 11), room(nr, nc, size + bits))
            return Mat(self, [[top * (den // bottom) if bottom != den else top for top, bottom in row] for row in table], nc, den)
        for i, row in enumerate(rows):
            line = f"{where}[{i}]"
            grid.append([self.entry(x, line, integral) for x in items(row, line, nc, nc)])
        return self.assembled(grid, nc) if nc else self.scalar(nr, 0)

    def columns(self, value: Json, size: int, where: str, most: int = MAX_WINDOW, least: int = 0) -> list[Mat]:
        """Return a list of VECTORs, as columns."""
        return [self.matrix([[x] for x in items(vector, where, size, size)], size, 1, where) for vector in items(value, where, most, least)]

    def reduce(self, w: Json) -> None:
        """Set `modulus`: the prime of the modular bound (the field's own, if it has one) and, over Q(a), the root, else 0."""
        expect(("prime" in w) == (self.prime == 0) and ("root" in w) == (self.f != []), "witness: a prime over Q, with a root over Q(a)")
        prime = self.prime or self.usable(w["prime"])
        root, value, slope = index(w["root"], "witness.root", prime - 1) if self.f else 0, 0, 0
        for c in reversed(self.f):
            slope, value = (slope * root + value) % prime, (value * root + c) % prime
        require(not self.f or (value == 0 and slope), f"{root} is not a simple root of the minimal polynomial modulo {prime}")
        self.modulus = prime, root

    def usable(self, prime: Json) -> int:
        """Return a prime below 2^64 that divides no denominator and not the leading coefficient of the minimal polynomial, if there is
        one.
        """
        require(is_prime(index(prime, "prime", MAX_PRIME)), f"{prime} is not a prime")
        require(self.bad % prime, f"{prime} divides a denominator or the leading coefficient of the minimal polynomial")
        return int(prime)

    def irreducible(self, w: Json) -> bool:
        """Return whether f is shown to be irreducible, where its degree is above 1. Rejected when what is given is wrong."""
        if "irreducible" not in w:
            return self.degree == 1
        given, f, d = keys(w["irreducible"], "modulo? eisenstein?", "irreducible"), self.f, self.degree
        expect(f and len(given) == 1, "irreducible: expected modulo or eisenstein, over Q(a)")
        if "eisenstein" in given:
            how = keys(given["eisenstein"], "prime shift", "eisenstein")
            prime, shift = index(how["prime"], "eisenstein.prime", MAX_PRIME), rational(how["shift"], "eisenstein.shift", True)[0]
            charge(d**2 * (3000 + ((d * shift.bit_length()) ** 2 + d * shift.bit_length() * max(map(int.bit_length, f)) >> 9)))
            *low, lead = (sum(comb(k, i) * shift ** (k - i) * f[k] for k in range(i, d + 1)) for i in range(d + 1))  # f(x + shift)
            applies = is_prime(prime) and lead % prime and not any(c % prime for c in low) and low[0] % prime**2
            require(applies, "Eisenstein's criterion does not apply")
            return True
        prime = self.usable(given["modulo"])
        ground, inverse = Field({"prime": prime}), pow(f[-1], -1, prime)
        a, power = Mat(ground, [[x * inverse for x in row] for row in self.powers[1].rows], d), ground.scalar(d, d, 1)
        for bit in f"{prime:b}":
            power = power @ power @ a if bit == "1" else power @ power
        # Berlekamp: g -> g^prime is linear on GF(prime)[x]/f, injective iff f is squarefree, and fixes a line iff f has one prime factor.
        frobenius = ground.assembled([[row] for row in accumulate(repeat(power, d - 1), Mat.__matmul__, initial=ground.scalar(1, d, 1))], d)
        ranks = [len(echelon(matrix.rows, prime)) for matrix in (frobenius, frobenius + ground.scalar(d, d, -1))]
        require(ranks == [d, d - 1], f"f is reducible modulo {prime}")
        return True

    def integer(self, value: Json, where: str) -> list[int]:
        """Return the d coordinates of an ENTRY that is integral, modulo p over GF(p)."""
        if type(value) is list and self.f:
            return [rational(x, where, True)[0] for x in items(value, where, self.degree, self.degree)]
        found = rational(value, where, True)[0]
        return [found % self.prime] if self.prime else [found] + [0] * (self.degree - 1)

    def integer_rows(self, given: Json, key: str, size: int, longest: int = 1) -> tuple[list[int], list[Vectors]]:
        """Return the pivots, and the VECTORs of integers (coordinates one after the other), of each {"pivot", key} ("row": just one).

        The numbers of vectors ascend.
        """
        rows, pivots = list[Vectors](), list[int]()
        for a, row in enumerate(items(given, key, max(size, MAX_DIMENSION))):
            vectors = keys(row, f"pivot {key}", where := f"{key} {a}")[key]
            vectors = [vectors] if key == "row" else items(vectors, where, MAX_WINDOW, 1)
            charge(3000 + len(vectors) * size * self.degree * 500, len(vectors) * size * self.degree * 48)
            rows.append([[x for entry in items(v, where, size, size) for x in self.integer(entry, where)] for v in vectors])
            pivots.append(pivot := index(row["pivot"], f"{where}: pivot"))
            require(pivot < size, "a pivot is out of range")
            require(len(rows[-2:][0]) <= len(vectors) <= longest, "the degrees of the kernel rows do not ascend, or not below the window")
        return pivots, rows

    def triangular(self, pivots: list[int], rows: list[Vectors]) -> None:
        """Reject unless the last vectors are triangular by the pivots: entry (a, pivot b) is zero for b < a, and not for b = a."""
        d = self.degree
        for a, row in enumerate(rows):
            charge(1000 + 400 * a * d)
            entries = [row[-1][pivot * d : pivot * d + d] for pivot in pivots[: a + 1]]
            require(any(entries[-1]) and not any(map(any, entries[:-1])), "the rows are not triangular by their pivots")

    def residues(self, rows: list[Vectors]) -> list[Vectors]:
        """Return the rows modulo the prime, over K: a goes to its root."""
        d, prime, root = self.degree, *self.modulus
        charge(sum(map(len, rows)) * 1000 + sum(len(v) for row in rows for v in row) * 400)
        if d == 1:
            return [[[x % prime for x in v] for v in row] for row in rows]
        powers = [pow(root, c, prime) for c in range(d)]
        return [[[sum(map(mul, v[j : j + d], powers)) % prime for j in range(0, len(v), d)] for v in row] for row in rows]

    def ranked(self, built: Mat, size: int, left_null: Json) -> None:
        """Reject unless the matrix has that rank: no more by the rows that vanish on it, no less modulo the prime."""
        height = len(built.rows) // self.degree
        pivots, rows = self.integer_rows(left_null, "row", height)
        self.triangular(pivots, rows)
        require(len(rows) == height - size, "the number of left null rows is not the number of rows minus the rank")
        require(not Mat(self, [row for (row,) in rows], len(built.rows)) @ built, "a left null row does not vanish on the matrix")
        require(built.rank() >= size, "the rank modulo the prime is smaller")


class System:
    """A SYSTEM: equal ones have equal keys, `words` shows one. Below, one method a kind, or a few, with statement s and witness w."""

    SHAPES = (("A", "n", "n"), ("F", "n", "m"), ("C", "p", "n"), ("G", "p", "m"), ("B", "n", "nu"), ("D", "p", "nu"))

    def __init__(self, data: Json) -> None:
        keys(data, "A F C G field? n? m? p? B? D? nu?", "system")
        expect(("B" in data) == ("D" in data) and ("B" in data or "nu" not in data), "system: B and D go together, nu with them")
        self.field, sizes = Field(data.get("field", "Q")), dict[str, int]()
        for name, height, width in self.SHAPES[: 6 if "B" in data else 4]:
            rows = items(data[name], name, MAX_DIMENSION)
            for size, seen in (height, rows), (width, items(rows[0], name, MAX_DIMENSION) if rows else []):
                sizes.setdefault(size, index(data.get(size, len(seen)), size, MAX_DIMENSION))
        expect(all(sizes.values()) or {*sizes} <= {*data}, f"system: with a zero dimension {', '.join(sizes)} are required")
        self.n, self.m, self.p = sizes["n"], sizes["m"], sizes["p"]
        expect(self.n + self.m + self.p <= MAX_DIMENSION, f"system: n + m + p is above {MAX_DIMENSION}")
        blocks = [self.field.matrix(data[name], sizes[nr], sizes[nc], name) for name, nr, nc in self.SHAPES if name in data]
        self.A, self.F, self.C, self.G = blocks[:4]
        self.nu, self.inputs = sizes.get("nu", 0), blocks[4:]
        self.reduced = Vectors()
        self.key: tuple[Any, ...] = (self.field.key, self.n, self.m, self.p, blocks[:4])
        dimensions = "" if self.n and self.m and self.p else f" (n={self.n}, m={self.m}, p={self.p})"
        over = "" if self.field.key == "Q" else f" over {shorten(data['field'])}"
        self.words = f"({', '.join(f'{name}={shorten(data[name])}' for name in 'AFCG')}){dimensions}{over}"

    def window(self, s: int, states: bool = True, faults: bool = True) -> Mat:
        """Return [O_s T_s], or one of the two."""
        charge(400 * s * s, 40 * s * s)
        powers, blank = [*accumulate(repeat(self.A, s), Mat.__matmul__, initial=self.C)], self.field.scalar(self.p, self.m)
        markov = [self.G, *(power @ self.F for power in powers)]
        grid = [[powers[i]] * states + [markov[i - j] if j <= i else blank for j in range(s)] * faults for i in range(s)]
        return self.field.assembled(grid, self.n * states + self.m * s * faults)

    def word(self, value: Json, samples: int | None = None) -> tuple[list[Mat], list[Mat], list[Mat]]:
        """States x(0..N), faults v(0..N-1), outputs r(0..N-1) of an object with x0 and v, where N is the number of samples if given."""
        states, most = self.field.columns([value["x0"]], self.n, "x0"), MAX_WINDOW if samples is None else samples
        faults = self.field.columns(value["v"], self.m, "v", most, samples or 0)
        for fault in faults:
            states.append(self.A @ states[-1] + self.F @ fault)
        return states, faults, [self.C @ x + self.G @ v for x, v in zip(states, faults, strict=False)]

    def gaps(self) -> list[int]:
        """gap(0), gap(1), ... of the modular bound until the chain W_k is constant; the last repeats for ever."""
        A, F, C, G, prime = *(part.residues() for part in (self.A, self.F, self.C, self.G)), self.field.modulus[0]
        charge(100 * (self.n + self.m) * (self.n + self.p), 80 * (self.n + self.m) * (self.n + self.p))
        inputs, found = [[row[j] for row in [*G, *F]] for j in range(self.m)], list[int]()
        space = [[int(i == j) for i in range(self.n)] for j in range(self.n)]
        while True:
            width = self.n + self.p
            charge(10000 + (len(space) + self.m) * width * (200 + (10 + prime.bit_length()) * self.n), 80 * (len(space) + self.m) * width)
            moved = [[sum(map(mul, row, x)) % prime for row in [*C, *A]] for x in space]
            form = echelon(moved + inputs, prime)  # of the vectors (output, next state)
            found.append(sum(1 for pivot, _ in form if pivot < self.p))
            after = [row[self.p :] for pivot, row in form if pivot >= self.p]
            if len(after) == len(space):
                return found
            space = after

    def seen(self, rows: list[Vectors], F: Mat, G: Mat) -> list[bool]:
        """Return whether X_0 of some row is not zero, and, for k = 0, 1, ..., whether N_k G + X_(k+1) F of some row is not.

        Exact, in integers: with A, F, C, G = A', F', C', G' / e, what X_k and N_k G + X_(k+1) F are, times e^i, i = 1, 2, ... the number of
        steps so far, are Y_k = e^(i-1) N_k C' + Y_(k+1) A' and likewise. All rows in one number, one in each slot of w bits: no entry is
        above the largest of the rows times L^i, L the largest of e and of the sums of absolute values of the columns of [C' G'; A' F'],
        hence all are below 2^(w-1), and sum v_a 2^(w a) is zero iff every v_a is: the rest is less than the highest one that is not zero.
        Over GF(p) everything is modulo p.
        """
        if self.field.prime:
            columns = [[row[j] for row in [*F.rows, *G.rows]] for j in range(F.nc)]
            conditions, ends = self.conditions(rows)
            found = [ends] + [False] * max(map(len, rows), default=0)
            for k, condition in ((k, condition) for row in conditions for k, condition in enumerate(row, 1)):
                found[k] = found[k] or any(sum(map(mul, condition, column)) % self.field.prime for column in columns)
            return found
        den = common_denominator(part.den for part in (self.A, F, self.C, G))
        A, F_, C, G_ = ([[x * (den // part.den) for x in row] for row in part.rows] for part in (self.A, F, self.C, G))
        states, faults = list(zip(*C, *A, strict=True)), list(zip(*G_, *F_, strict=True))
        largest = max((sum(map(abs, column)) for column in states + faults), default=0)
        steps, most = max(map(len, rows), default=0), max((abs(x) for row in rows for v in row for x in v), default=0)
        w = most.bit_length() + steps * max(den, largest).bit_length() + 1
        carried, factor, found = [0] * len(A), 1, []
        for k in reversed(range(steps)):
            both = [factor * sum(row[k][j] << w * a for a, row in enumerate(rows) if k < len(row)) for j in range(len(C))] + carried
            found.append(any(sum(map(mul, both, column)) for column in faults))
            carried, factor = [sum(map(mul, both, column)) for column in states], factor * den
        return [any(carried), *reversed(found)]

    def annihilated_by(self, rows: list[Vectors]) -> None:
        """Reject unless every row annihilates the system."""
        require(not any(self.seen(rows, self.F, self.G)), "a row does not annihilate the system")

    def conditions(self, rows: list[Vectors]) -> tuple[list[Vectors], bool]:
        """Return [X_(k+1), N_k], k = 0, ..., mu, of every row of residues, modulo the prime; and whether some row does not annihilate.

        A slot of a packed row of [A F; C G] receives n + p products of residues.
        """
        prime, n, width = self.field.modulus[0], self.n, self.n + self.m
        size = slot(prime, n + self.p)
        table = [packed(row, size) for row in self.pencil()]
        charge(sum(map(len, rows)) * (2000 + len(table) * (200 + size * width // 2) + 500 * width), 80 * sum(map(len, rows)) * len(table))
        found, left = list[Vectors](), False
        for row in rows:
            state, conditions = [0] * n, Vectors()
            for coefficient in reversed(row):
                conditions.append(state + coefficient)
                after = unpacked(sum(map(mul, conditions[-1], table)), size, width, prime)
                state, left = after[:n], left or any(after[n:])
            found.append(conditions[::-1])
            left = left or any(state)
        return found, left

    def pencil(self, q: int = 0) -> Vectors:
        """Return the rows of [[A - qI, F], [C, G]] modulo the prime."""
        if not self.reduced:
            A, F, C, G = (part.residues() for part in (self.A, self.F, self.C, self.G))
            self.reduced = [[*x, *y] for x, y in zip(A + C, F + G, strict=True)]
        return [
            [(x - q) % self.field.modulus[0] if i == j < self.n else x for j, x in enumerate(row)] for i, row in enumerate(self.reduced)
        ]

    def pencil_rank(self, w: Json) -> int:
        """Return the rank of the pencil modulo the prime at the hinted point, no more than n plus the normal rank."""
        return len(echelon(self.pencil(index(w["point"], "point", self.field.modulus[0] - 1)), self.field.modulus[0]))

    def minimal(self, pivots: list[int], rows: list[Vectors], w: Json) -> None:
        """Reject unless the rows, residues that annihilate the system modulo the prime, are seen to be a minimal basis of all that do.

        Then no window has a rank below p s - sum of max(0, s - mu): let k rows N_a with X_a pass. Their minor at the pivots has the degree
        sum of mu, so that their leading coefficients are independent and they themselves, too. The rank of the pencil leaves no more than
        k independent [X z] that vanish on it. So what a z with X_0 = 0 is, [X z] = sum of c_a [X_a N_a] with rational c_a. By Cramer a
        denominator of c divides two determinants: the minor, and that of [X N] times any constant matrix. They are coprime, so the c_a are
        polynomials, and by the independent leading coefficients no c_a N_a has a degree above that of z. So a z of s samples is one of
        sum of max(0, s - mu), modulo the prime, where ranks are never above the true ones.
        """
        prime, n, degree = self.field.modulus[0], self.n, sum(len(row) - 1 for row in rows)
        mix, terms = index(w["mix"], "mix", prime - 1), sum(map(len, rows))
        conditions, left = self.conditions(rows)
        require(not left, "a row does not annihilate the system")
        require(degree < prime, "the prime is not above the sum of the left minimal indices")
        first = determinant_polynomial([[[c[n + j] for c in row] for j in pivots] for row in conditions], degree, prime)
        require(first[degree], "the leading coefficients of the rows at the pivots are dependent")
        charge(len(rows) * (n + self.p) * (200 + 80 * terms))
        powers = [*accumulate(repeat(mix, n + self.p - 1), lambda power, mix: power * mix % prime, initial=mix)]
        columns = [[pow(power, b + 1, prime) for power in powers] for b in range(len(rows))]
        mixed = [[[sum(map(mul, c, column)) % prime for c in row] for column in columns] for row in conditions]
        require(coprime(first, determinant_polynomial(mixed, degree, prime), prime), "the rows may have a common factor")
        require(self.pencil_rank(w) >= n + self.p - len(rows), "there may be more rows")

    def met_by(self, rows: list[Vectors], window: int | None = None) -> None:
        """Reject unless the rows meet the modular bound on k < window (None: for ever)."""
        found = self.gaps()
        for k in range(max([len(found), *map(len, rows)]) if window is None else window):
            charge(1000 + 100 * len(rows))
            above = self.p - sum(1 for row in rows if len(row) <= k + 1)
            require(found[min(k, len(found) - 1)] == above, f"the bounds do not meet at sample {k}: {above} above")

    def kernel(self, w: Json, window: int | None = None) -> tuple[list[int], list[Vectors]]:
        """Return pivots and coefficients of KROWS, those of degree below any window: they and their shifts span the left null space of
        [O_s T_s], on that window or on every one.
        """
        expect(("mix" in w) == ("point" in w), "witness: point and mix go together")
        short = "mix" in w
        pivots, rows = self.field.integer_rows(w["kernel"], "coefficients", self.p, MAX_WINDOW if short or window is None else window)
        if short:
            self.minimal(pivots, self.field.residues(rows), w)
        else:
            self.field.triangular(pivots, rows)
            self.met_by(rows, window)
        self.annihilated_by(rows)
        return pivots, [row for row in rows if window is None or len(row) <= window]

    def window_ranks(self, s: Json, w: Json) -> None:
        r, p = index(s["normal_rank"], "normal_rank"), self.p
        expect(("kernel" in w) != ("kernel_modulo" in w), "witness: expected one of kernel and kernel_modulo")
        rows = self.kernel(w)[1] if "kernel" in w else self.kernel_modulo(w)
        etas, ranks = ([index(x, key) for x in items(s.get(key, []), key)] for key in ("left_minimal_indices", "window_ranks"))
        require(etas == [len(row) - 1 for row in rows], "the left minimal indices are not the degrees of the rows")
        require(r == p - len(rows), "the normal rank is not p minus the number of rows")
        follow = [k * r + sum(min(k, eta) for eta in etas) for k in range(1, len(ranks) + 1)]
        require(ranks == follow, "window_ranks do not follow from the indices")

    def kernel_modulo(self, w: Json) -> list[Vectors]:
        """Return rows known modulo the prime alone, where no window can have a rank above p s - sum of max(0, s - mu) whatever they are.

        [O_s T_s] has p s rows and n + m s columns. Where there are no rows, p s is the bound. Else let there be p - m, with degrees that
        add up to n and differ by one at most: for s up to the least the bound is p s, from the largest on it is p s - (p - m) s + n.
        """
        expect(not self.field.prime and {"mix", "point"} <= {*w}, "witness: kernel_modulo needs a point and a mix, and no prime field")
        pivots, rows = self.field.integer_rows(w["kernel_modulo"], "coefficients", self.p, MAX_WINDOW)
        degrees = [len(row) - 1 for row in rows]
        generic = not rows or (len(rows) == self.p - self.m and sum(degrees) == self.n and degrees[-1] - degrees[0] <= 1)
        require(generic, "the indices are not those of windows that have all the rank that their shape allows")
        self.minimal(pivots, self.field.residues(rows), w)
        return rows

    def left_invertible(self, s: Json, w: Json) -> None:
        if "point" in w:
            require(self.pencil_rank(w) >= self.n + self.m, "the pencil modulo the prime has a smaller rank at that point")
        else:
            require(self.gaps()[-1] == self.m, "the gap modulo the prime stays below the number of faults")

    def not_left_invertible(self, s: Json, w: Json) -> None:
        field, n, m = self.field, self.n, self.m
        xs = field.columns(w["state"], n, "state", MAX_WINDOW, 1)
        vs = field.columns(w["fault"], m, "fault", len(xs), len(xs))
        require(any(xs + vs), "the null vector is zero")
        for shifted, x, v in zip([field.scalar(n, 1), *xs], [*xs, field.scalar(n, 1)], [*vs, field.scalar(m, 1)], strict=True):
            require(shifted == self.A @ x + self.F @ v, "(qI - A) x(q) = F v(q) fails")
            require(not self.C @ x + self.G @ v, "C x(q) + G v(q) = 0 fails")

    def inversion_delay(self, s: Json, w: Json) -> None:
        field, n, m, p, known = self.field, self.n, self.m, self.p, s["initial_state"] == "known"
        delay = None if s["delay"] is None else index(s["delay"], "delay")
        expect(known or s["initial_state"] == "unknown", "initial_state: expected known or unknown")
        expect(("inverse" in w) == (delay is not None) and ("word" in w) == (delay != 0), "witness: no inverse with null, no word with 0")
        if delay is not None:
            require(delay <= n, "the delay is above n")
            given = field.matrix(w["inverse"], m, p * (delay + 1), "inverse") @ self.window(delay + 1, states=not known)
            wanted = [field.scalar(m, 0 if known else n), field.scalar(m, m, 1), field.scalar(m, m * delay)]
            require(given == field.assembled([wanted], given.nc // field.degree), "the left inverse does not give v(0)")
        if delay != 0:
            states, faults, outputs = self.word(keys(w["word"], "x0 v", "word"), n + 1 if delay is None else delay)
            require(faults[0], "v(0) of the ambiguous word is zero")
            require(not (known and states[0]), "x(0) of the ambiguous word is not zero")
            require(not any(outputs), "the output of the ambiguous word is not zero")

    def behaviours(self, s: Json, w: Json, second: System) -> None:
        window = index(s["window"], "window", MAX_WINDOW) if "window" in s else None
        pivots, rows = second.kernel(w, window)
        self.annihilated_by(rows)
        if "inner" in s:
            return
        if "mix" in w:
            self.minimal(pivots, self.field.residues(rows), w)
        else:
            self.met_by(rows, window)

    def behaviour_difference(self, s: Json, w: Json, second: System) -> None:
        window = index(s["window"], "window", MAX_WINDOW)
        row = [self.field.matrix([c], 1, self.p, "row") for c in items(w["row"], "row", window, 1)]
        joined = self.field.assembled([row], self.p * len(row))  # over one denominator, which plays no part
        width = self.p * self.field.degree
        second.annihilated_by([[joined.rows[0][k : k + width] for k in range(0, joined.nc, width)]] if joined.rows else [])
        require(reduce(add, map(Mat.__matmul__, row, self.word(w, window)[2])), "the word satisfies the row")

    def fault_space(self, s: Json, w: Json) -> None:
        field, d, width = self.field, self.field.degree, self.n + self.p
        window, size = None if s["window"] is None else index(s["window"], "window", MAX_WINDOW), len(items(s["basis"], "basis", width))
        basis = field.matrix(s["basis"], size, width, "basis")
        pivots = [next((j // d for j, x in enumerate(row) if x), width) for row in basis.rows[::d]]
        require(pivots == sorted({*pivots} - {width}), "the basis is not in row echelon form")
        unit = Mat(field, [[row[j * d + c] for j in pivots for c in range(d)] for row in basis.rows], size * d, basis.den)
        require(unit == field.scalar(size, size, 1), "the basis is not in reduced row echelon form")
        _, rows = self.kernel(w, window)
        columns = [[row[j] for row in s["basis"]] for j in range(width)]
        F, G = field.matrix(columns[: self.n], self.n, size, "basis"), field.matrix(columns[self.n :], self.p, size, "basis")
        require(not any(self.seen(rows, F, G)), "a basis column does not solve problem (11)")
        conditions, _ = self.conditions(field.residues(rows))
        rank = len(echelon(chain.from_iterable(conditions), field.modulus[0]))
        require(rank == width - size, "there are more solutions than the basis spans")

    def first_column_only(self, s: Json, w: Json) -> None:
        field, window, width = self.field, index(s["window"], "window", MAX_WINDOW), self.n + self.p
        column = [[x] for x in items(s["column"], "column", width, width)]
        F, G = field.matrix(column[: self.n], self.n, 1, "column"), field.matrix(column[self.n :], self.p, 1, "column")
        _, first, *later = [*self.seen(self.kernel(w, window)[1], F, G), False]
        # Shift 0 of a row gives X_1 f + N_0 g on (g, C f, C A f, ...), shift j > 0 gives X_0 A^(j-1) f, and X_0 = 0.
        require(not first, "the first block column is not annihilated")
        require(any(later), "every block column is annihilated")

    def matrix_rank(self, s: Json, w: Json) -> None:
        field, n, name, size = self.field, self.n, s["matrix"], index(s["rank"], "rank")
        expect(type(name) is str and name in MATRICES, "matrix: unknown name")
        window = index(keys(s, f"matrix rank system {MATRICES[name]}", "statement").get("window", 0), "window", MAX_WINDOW)
        if name == "observability":
            built = self.window(n, faults=False)
        elif name == "reachability":
            blocks = [*accumulate(repeat(self.A, n), lambda block, A: A @ block, initial=self.F)]
            built = field.assembled([blocks[:n]][:n], n * self.m)
        elif name in ("toeplitz", "window"):
            built = self.window(window, states=name == "window")
        else:
            states, faults, outputs = self.word(s)
            expect(window <= len(faults), "window: more than there are samples")
            columns = len(faults) - window + 1
            signals = [outputs] * window if name == "residual-hankel" else [states] + [faults] * window
            delays = range(window) if name == "residual-hankel" else [0, *range(window)]
            charge(400 * window * columns, 40 * window * columns)
            built = field.assembled([signal[i : i + columns] for signal, i in zip(signals, delays, strict=True)], columns)
        field.ranked(built, size, w["left_null"])


SUBJECTS: dict[str, type[System]] = dict.fromkeys(("system", "inner", "outer", "first", "second"), System)
MODULAR, KERNEL = "prime? root?", "prime? root? kernel"
HINTED, RANKED = f"{KERNEL} point? mix?", "prime? root? kernel? kernel_modulo? point? mix?"
MATRICES = {"observability": "", "reachability": "", "toeplitz": "window", "window": "window"}  # what is stated beside the system
MATRICES |= {"residual-hankel": "x0 v window", "excitation": "x0 v window"}


class Kind(NamedTuple):
    """This is what verifies a kind, keys of the statement and of the witness, the statement in words, and the proof in a line."""

    check: Callable[..., None]
    statement: str
    witness: str
    words: str
    proof: str


KINDS: dict[str, Kind] = {
    "window-ranks": Kind(System.window_ranks, "system normal_rank left_minimal_indices window_ranks?", RANKED,
        "for every s >= 1: rank [O_s T_s] = {normal_rank} s + sum of min(s, eta), eta the left minimal indices {left_minimal_indices}",
        "The bounds of every gap meet, and gap(0) + ... + gap(s-1) = sum over k < s of p - #{mu <= k} is this formula."),
    "left-invertible": Kind(System.left_invertible, "system", f"{MODULAR} point?",
        "left-invertible: x(0) = 0 and zero output for ever imply v = 0",
        "The last gap modulo the prime is m, the true normal rank is no smaller, and more than m there cannot be."),
    "not-left-invertible": Kind(System.not_left_invertible, "system", "state fault",
        "not left-invertible: x(0) = 0 and some v other than 0 give zero output for ever",
        "Read from the highest power down it is a fault from x(0) = 0 with zero output, at rest afterwards; v = 0 would make x zero too."),
    "inversion-delay": Kind(System.inversion_delay, "system initial_state delay", "inverse? word?",
        "with x(0) {initial_state} (known: 0), the least l in 0..n such that r(0..l) determines v(0) is {delay} (null: there is none)",
        "The inverse computes v(0) from r(0..l); the word has zero output on one sample less (null: on n + 1) and v(0) other than 0."),
    "behaviour-inclusion": Kind(System.behaviours, "inner outer", HINTED,
        "every word of the first is one of the second, on every window",
        "The rows and their shifts span the left null space of the outer [O_s T_s] for every s, and annihilate the inner one."),
    "behaviour-equality": Kind(System.behaviours, "first second", HINTED,
        "both systems have the same output behaviour, on every window",
        "The rows and their shifts span the left null space of both [O_s T_s], for every s."),
    "window-equality": Kind(System.behaviours, "first second window", KERNEL,
        "both have the same restricted behaviour on {window} samples",
        "The rows and their shifts span the left null space of both [O_s T_s] on that window."),
    "behaviour-difference": Kind(System.behaviour_difference, "first second window", "x0 v row",
        "some word of {window} samples of the first is not one of the second",
        "The row vanishes on every word of the second, and not on this one of the first."),
    "fault-space": Kind(System.fault_space, "system window basis", HINTED,
        "at window {window} (null: beyond all left minimal indices) the solutions [f; g] of problem (11) are the span of {basis}",
        "The rows and their shifts span N_s, so the conditions are all there are; the basis solves them, and their rank modulo the prime "
        "leaves no room for more."),
    "first-column-only": Kind(System.first_column_only, "system window column", HINTED,
        "at window {window}, N_s annihilates the first block column of T_s(z) but not all of it, for z = {column}",
        "The rows and their shifts span N_s; on the first block column the conditions X_1 f + N_0 g are all that differ from zero ones."),
    "matrix-rank": Kind(System.matrix_rank, "matrix rank system window? x0? v?", f"{MODULAR} left_null",
        "the {matrix} matrix has rank {rank}",
        "As many independent rows vanish on the matrix as its rows exceed the rank, and modulo the prime the rank is no smaller."),
}  # fmt: skip


class Verified(NamedTuple):
    """This is the statement in words, and what it assumes beyond what was verified: nothing, or that a polynomial is irreducible."""

    statement: str
    assumes: list[str]


def subject(data: Json) -> System:
    """Return the EXPERIMENT where it has a filter of u, else the SYSTEM, read on a meter of its own. Raises Malformed, Rejected."""
    begin()
    return SUBJECTS["experiment" if type(data) is dict and "u_filter" in data and "experiment" in SUBJECTS else "system"](data)


def verify(certificate: Json, systems: Iterable[Json | System] = ()) -> Verified:
    """Return the statement, once verified. Raises Malformed or Rejected. Every one of `systems` (JSON or read) must be one of the
    statement's.
    """
    insisted = [data if isinstance(data, System) else subject(data) for data in systems]
    begin()
    keys(certificate, "format kind statement witness", "certificate")
    expect(certificate["format"] == "faultspace-certificate/1", "format: expected faultspace-certificate/1")
    expect(type(name := certificate["kind"]) is str and name in KINDS, "kind: unknown, or one of checker_limits.py, which is another file")
    kind = KINDS[name]
    s = keys(certificate["statement"], kind.statement, "statement")
    w = keys(certificate["witness"], f"irreducible? {kind.witness}", "witness")
    about = [reader(s[key]) for key, reader in SUBJECTS.items() if key in s]
    alike = all(system.field.key == about[0].field.key and system.p == about[0].p for system in about)
    expect(alike, "the two systems differ in field or number of outputs")
    for system in about if "prime" in kind.witness else []:
        system.field.reduce(w)
    kind.check(about[0], s, w, *about[1:])
    proven = about[0].field.irreducible(w)
    for system in insisted:
        require(any(system.key == other.key[: len(system.key)] for other in about), f"the statement is not about {system.words}")
    words = kind.words.format_map({key: shorten(value) for key, value in s.items()})
    words += "".join(f", {key[:-1]} = {shorten(s[key[:-1]])}" for key in kind.statement.split() if key[-1] == "?" and key[:-1] in s)
    words += f"; for {' and '.join(system.words for system in about)}"
    if proven:
        return Verified(words, [])
    assumed = f"f is irreducible, with the coefficients {shorten(about[0].field.f)} (ascending)"
    return Verified(f"assuming f irreducible: {words}", [assumed])


def content(path: str) -> bytes:
    """Return what is in a file, without waiting: Malformed for what is none, such as a pipe, a device or a directory."""

    def seen(status: os.stat_result) -> None:
        expect(not stat.S_ISDIR(status.st_mode), "is a directory")
        expect(stat.S_ISREG(status.st_mode), "is no regular file, but a pipe or a device")

    try:
        seen(os.stat(path))
        with open(os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)), "rb") as file:
            seen(os.fstat(file.fileno()))  # what is opened may be another than what was seen
            data = file.read(MAX_BYTES + 1)
    except OSError as error:
        raise Malformed(error.strerror or "cannot be read") from None
    except ValueError:  # a name with a zero in it
        raise Malformed("no name of a file") from None
    return data or b""


def parse(data: bytes) -> Json:
    """Return the JSON in them, or Malformed: duplicate keys, floats, NaN, over-long numbers, more than MAX_BYTES."""

    def unique(pairs: list[tuple[str, Json]]) -> dict[str, Json]:
        result = dict(pairs)
        expect(len(result) == len(pairs), "a key stands twice")
        return result

    def whole(digits: str) -> int:
        expect(len(digits) <= 19731, "a number: more digits than a number may have")
        return int(digits)

    def refused(_: str) -> None:
        expect(False, "a number: expected an integer")

    expect(len(data) <= MAX_BYTES, f"more than {MAX_BYTES} bytes")
    try:
        return json.loads(data.decode(), object_pairs_hook=unique, parse_int=whole, parse_float=refused, parse_constant=refused)
    except (ValueError, RecursionError, MemoryError) as error:
        raise Malformed(f"not JSON: {' '.join(str(error).split())[:80]}") from None


def load(path: str) -> Json:
    """Return the JSON of a file. Raises Malformed."""
    return parse(content(path))


def sha256(certificate: Json) -> str:
    """Return the name of a certificate: SHA-256 over sorted keys without white space, in UTF-8."""
    return hashlib.sha256(json.dumps(certificate, sort_keys=True, separators=(",", ":"), ensure_ascii=False).encode()).hexdigest()


CODES = {"verified": 0, "verified under an assumption": 3, "rejected": 1, "malformed": 2}  # from the best to the worst


def result_of(path: str, systems: Sequence[System]) -> dict[str, Json]:
    """Return what is printed about a file."""
    try:
        statement, assumes = verify(certificate := load(path), systems)
        result = "verified under an assumption" if assumes else "verified"
        words = {"kind": certificate["kind"], "statement": statement, "assumes": assumes, "sha256": sha256(certificate)}
        return {"file": path, "result": result, **words}
    except Malformed as error:
        return {"file": path, "result": "malformed", "reason": str(error)}
    except (Rejected, MemoryError) as error:
        return {"file": path, "result": "rejected", "reason": str(error) or "not enough memory"}


def worst(results: Iterable[str]) -> int:
    """Return the exit code of several files."""
    return CODES[max(results, key=[*CODES].index, default="verified")]


def quote_path(name: str) -> str:
    """Return the name where it can be mistaken for nothing else on a terminal, else quoted."""
    return name if name.isprintable() and re.fullmatch(r"[^\s:'\"\\]+", name) else ascii(name)


class Arguments(argparse.ArgumentParser):
    """This is a parser whose complaints hold no control characters."""

    def error(self, message: str) -> NoReturn:
        super().error(message if message.isprintable() else ascii(message))


def main(argv: Sequence[str] | None = None) -> int:
    """Check the files; returns the exit code. Wrong arguments and a --system that does not parse exit with 2."""
    parser = Arguments(prog="checker.py", description="Decides certificates of the format faultspace-certificate/1.")
    parser.add_argument("--json", action="store_true", help="print the results as JSON")
    parser.add_argument("--system", action="append", default=[], metavar="FILE", help="insist on statements about this system")
    parser.add_argument("certificates", nargs="+", metavar="CERTIFICATE")
    options = parser.parse_args(argv)
    systems = list[System]()
    for path in options.system:
        try:
            systems.append(subject(load(path)))
        except (Malformed, Rejected, MemoryError) as error:
            parser.error(f"--system {quote_path(path)}: {error}")
    results = list[dict[str, Json]]()
    for path in options.certificates:
        results.append(one := result_of(path, systems))
        if not options.json:
            message = one.get("reason") or "{kind}: {statement} (SHA-256 {sha256})".format(**one)
            print(f"{quote_path(path)}: {one['result']}: {message}", flush=True)
    if options.json:
        print(json.dumps(results, indent=1), flush=True)
    return worst(one["result"] for one in results)


def run() -> int:
    """Return the exit code of the command: that of `main`, 74 where nobody takes the answer, 130 where it was interrupted."""
    try:
        if sys.stdout is None:
            return 74
        sys.stdout.reconfigure(errors="backslashreplace")  # type: ignore[union-attr]  # names of files need not be text
        return main()
    except OSError:  # files are opened with errors of their own: what is left is the output itself
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # so that nothing more is tried, and said, on leaving
        return 74
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(run())
