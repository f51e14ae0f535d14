"""The core of the checker: ranks and behaviours, in certificates of the format `faultspace-certificate/1` (FORMAT.md).

    python -I -O checker.py [--json] [--system FILE]... CERTIFICATE...

Exit 0: all verified, their statements printed. 3: all verified, at least one under an assumption that its line and "assumes" in the JSON
name. 1: one is rejected, also for not being about a --system FILE. 2: one does not parse. 74: the answer could not be written.

It can be copied alone to another machine, imports the standard library only, and decides the kinds of KINDS over Q, by witnesses with
hints. For all else there are files beside it (ELSEWHERE), started in the same way, each of which needs those before it. READING.md is a
guide. It searches for nothing: what it does not read in the witness it computes by elimination or by a recursion of fixed length. It
trusts no order, prime or hint that it has not looked at itself. What has to be believed is this file, with the Python that runs it, and
these arguments (KINDS says in a line how each kind follows from them):

  annihilation  Exact, in integers.
  upper bounds  Rows that annihilate a system, with independent leading coefficients: they and their shifts are independent, and all vanish
                on [O_s T_s]. So its rank is no more than p s - sum of max(0, s - mu), mu the degrees.
  lower bounds  Ranks modulo a prime never exceed the true ones. There the rows are seen to be a minimal basis of all that vanish, once for
                every s (`System.minimal`).
  together      Where both bounds meet, the left null space of [O_s T_s] is spanned by the rows and their shifts.

Conventions, the same everywhere (FORMAT.md says them with the notation). Signals are columns: [O_s T_s] has the block rows r(0), ...,
r(s-1) and the block columns x(0), v(0), ..., v(s-1). Kernel rows and left null rows are rows, and multiply from the left; a row has one
block of p entries a sample. Polynomials ascend.

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
from array import array
from collections.abc import Callable, Iterable, Sequence
from contextvars import ContextVar
from functools import cache, partial
from itertools import chain
from math import gcd, lcm
from operator import mul
from typing import Any, NamedTuple, NoReturn

Json = Any
Vectors = list[list[int]]  # a polynomial row c_0, c_1, ...: the coordinates of its coefficients, or their residues
MAX_BYTES, MAX_BITS, MAX_DIMENSION, MAX_WINDOW, MAX_PRIME = 2 * 2**20, 2**16, 512, 4096, 2**64 - 1
MAX_WORK, MAX_MEMORY = 3 * 10**9, 2**27  # of this checker, for one certificate: in nanoseconds and bytes, by estimates from above
NUMBER, SHORT = re.compile(r"(-?[0-9]{1,19730})(?:/([1-9][0-9]{0,19729}))?"), re.compile(r"-?[0-9]{1,18}")
if 0 < sys.get_int_max_str_digits() < 19730:  # Python's own bound is below that of the format
    sys.set_int_max_str_digits(19730)


class Meter:
    """What a certificate has cost so far: work in all, and the bytes that its matrices hold now."""

    held = work = 0


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
    """Return a meter at zero, for what is done next."""
    _meter.set(meter := Meter())
    return meter


def charge(work: int, room: int = 0, kept: int = 0) -> Meter:
    """Count work that is about to be done in `room` bytes, some of which are kept, and reject what asks for too much of either."""
    meter = _meter.get(None) or begin()
    meter.work += work
    if meter.work > MAX_WORK:  # asked before, so that the words are put together only where they are needed
        require(False, f"checking takes more than {MAX_WORK} units of work")
    if (room or kept) and meter.held + max(room, kept) > MAX_MEMORY:
        require(False, f"checking takes more than {MAX_MEMORY} bytes of memory")
    meter.held += kept
    return meter


def room(nr: int, nc: int, bits: int) -> int:
    """Return the bytes that a matrix of that shape takes, with numbers of so many bits."""
    return 400 + nr * (100 + nc * (40 + bits // 7))


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


def short_integers(values: list[Json]) -> list[int] | None:
    """Return the values where all are INTEGERs in strings, or all in numbers, of 18 digits at most: such lists are read at once."""
    charge(500 + 200 * len(values), 150 * len(values))
    kinds = {*map(type, values)}
    if kinds <= {int}:
        return values if -(10**18) < min(values, default=0) <= max(values, default=0) < 10**18 else None
    if kinds == {str} and all(map(SHORT.fullmatch, texts := {*values})):
        return [*map({x: int(x) for x in texts}.__getitem__, values)]
    return None


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


# -- modulo a prime ----------------------------------------------------------------------------------------------------


def slot(prime: int, terms: int) -> int:
    """Return the bytes, 8 at least, of a slot in which a sum of so many products of two residues fits: terms (prime - 1)^2 < 256^slot."""
    return max(8, (2 * prime.bit_length() + terms.bit_length() + 7) // 8)


def packed(vector: Sequence[int], size: int) -> int:
    """Return residues as one number, one in each slot of so many bytes, the first in the lowest.

    A multiple of such a number, or a sum, is that of the vector, slot by slot, as long as what stands in every slot stays below
    256^size: nothing is carried from one to the next.
    """
    if size == 8 and sys.byteorder == "little":
        return int.from_bytes(array("Q", vector).tobytes(), "little")
    return int.from_bytes(b"".join([x.to_bytes(size, "little") for x in vector]), "little")


def unpacked(number: int, size: int, count: int, prime: int) -> list[int]:
    """Return the residues that stand in the slots."""
    data = number.to_bytes(size * count, "little")
    if size == 8 and sys.byteorder == "little":
        return [x % prime for x in array("Q", data)]
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
        charge(1000 + 500 * count + (1 + len(leads)) * (500 + size * count), (1 + len(leads)) * (40 + size) * (count + 1))
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


# -- systems -----------------------------------------------------------------------------------------------------------


class Table:
    """The matrix rows / den of integers, den the least; where an entry is a d x d block, as over Q(a), nc is d times the width."""

    __slots__ = ("den", "nc", "rows")

    def __init__(self, rows: list[list[int]], nc: int, den: int = 1) -> None:
        self.rows, self.nc, self.den = rows, nc, den

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Table) and (self.rows, self.nc, self.den) == (other.rows, other.nc, other.den)


class Field:
    """Q. Equal fields have equal keys; `modulus` is the prime of the modular bound. Other fields change what is here (`degree` is that of
    Q(a), `prime` that of GF(p), and 0 in characteristic 0).
    """

    def __init__(self, value: Json) -> None:
        expect(value == "Q", "field: expected Q; GF(p) and Q(a) are read by checker_fields.py, which is another file")
        self.key, self.degree, self.prime, self.modulus, self.known = value, 1, 0, 0, dict[Json, tuple[int, int]]()

    def matrix(self, value: Json, nr: int, nc: int, where: str) -> Table:
        """Return a MATRIX of that shape; with no entries, [] or the right number of empty rows. What stands often is read once."""
        charge(1000 + nr * (500 + 200 * nc), 100 * nr * (nc + 1))
        rows, used = items([[]] * nr if value == [] and nc == 0 else value, where, nr, nr), set[Json]()
        for i, row in enumerate(rows):
            items(row, f"{where}[{i}]", nc, nc)
        if (short := short_integers([*chain.from_iterable(rows)])) is not None:
            charge(0, room(nr, nc, 60))
            return Table([short[i * nc : (i + 1) * nc] for i in range(nr)], nc)
        for i, row in enumerate(rows):
            plain = {*map(type, row)} <= {int, str}
            for x in {*row} - self.known.keys() if plain else row:
                self.known[x] = rational(x, f"{where}[{i}]", self.prime > 0)
            used.update(row)
        dens = {self.known[x][1] for x in used}
        den, bits = common_denominator(dens), max((self.known[x][0].bit_length() for x in used), default=0)
        size = den.bit_length()
        charge(len(dens) * (size**2 >> 8) + len(used) * (400 + (size + bits >> 4) + (size * bits >> 11)), room(nr, nc, size + bits))
        integer = {x: top * (den // bottom) for x in used for top, bottom in [self.known[x]]}
        return Table([[integer[x] for x in row] for row in rows], nc, den)

    def integers(self, value: Json, size: int, where: str) -> list[int]:
        """Return the coordinates of a VECTOR of that size that is integral."""
        given = items(value, where, size, size)
        return short if (short := short_integers(given)) is not None else [rational(x, where, True)[0] for x in given]

    def kernel_rows(self, given: Json, size: int) -> tuple[list[int], list[Vectors]]:
        """Return pivots and coefficients of KROWS whose degrees ascend."""
        rows, pivots = list[Vectors](), list[int]()
        for a, row in enumerate(items(given, "kernel", max(size, MAX_DIMENSION))):
            vectors = items(keys(row, "pivot coefficients", where := f"kernel {a}")["coefficients"], where, MAX_WINDOW, 1)
            charge(3000 + len(vectors) * size * self.degree * 500, len(vectors) * size * self.degree * 48)
            rows.append([self.integers(v, size, where) for v in vectors])
            pivots.append(index(row["pivot"], f"{where}: pivot"))
            require(pivots[-1] < size, "a pivot is out of range")
            require(len(rows[-2:][0]) <= len(vectors), "the degrees of the kernel rows do not ascend")
        return pivots, rows

    def reduce(self, w: Json) -> None:
        """Set `modulus` to the prime of the witness, below 2^64."""
        expect("prime" in w and "root" not in w, "witness: a prime over Q, with a root over Q(a)")
        require(is_prime(index(w["prime"], "prime", MAX_PRIME)), f"{w['prime']} is not a prime")
        self.modulus = w["prime"]

    def residues(self, rows: list[list[int]], den: int = 1) -> Vectors:
        """Return rows of coordinates, over den, modulo the prime, over K; Rejected when the denominator vanishes."""
        charge(den.bit_length() + sum(1000 + 200 * len(row) + (sum(map(int.bit_length, row)) >> 3) for row in rows))
        require(den % self.modulus, "the prime divides a denominator")
        prime, inverse = self.modulus, pow(den, -1, self.modulus)
        return [[x % prime for x in row] if den == 1 else [x * inverse % prime for x in row] for row in rows]

    def irreducible(self, w: Json) -> bool:
        """Return whether this is seen to be a field."""
        expect("irreducible" not in w, "irreducible: expected modulo or eisenstein, over Q(a)")
        return True

    def seen(self, system: System, rows: list[Vectors], F: Table, G: Table) -> list[bool]:
        """Return whether X_0 of some row is not zero, and, for k = 0, 1, ..., whether N_k G + X_(k+1) F of some row is not.

        Exact, in integers: with A, F, C, G = A', F', C', G' / e, what X_k and N_k G + X_(k+1) F are, times e^i, i = 1, 2, ... the number of
        steps so far, are Y_k = e^(i-1) N_k C' + Y_(k+1) A' and likewise. All rows in one number, one in each slot of w bits: no entry is
        above the largest of the rows times L^i, L the largest of e and of the sums of absolute values of the columns of [C' G'; A' F'],
        hence all are below 2^(w-1), and sum v_a 2^(w a) is zero iff every v_a is: the rest is less than the highest one that is not zero.
        """
        parts = (system.C, G, system.A, F)
        den, cells = common_denominator(part.den for part in parts), sum(len(part.rows) * part.nc for part in parts)
        bits = max((x.bit_length() for part in parts for row in part.rows for x in (max(row, default=0), min(row, default=0))), default=0)
        size = den.bit_length() + bits
        charge(cells * (300 + (den.bit_length() * bits >> 11) + (size >> 4)), cells * (80 + size // 7))
        whole = (part.rows if part.den == den else [[x * (den // part.den) for x in row] for row in part.rows] for part in parts)
        C, G_, A, F_ = whole
        states, faults = list(zip(*C, *A, strict=True)), list(zip(*G_, *F_, strict=True))
        largest = max((sum(map(abs, column)) for column in states + faults), default=0)
        steps, most = max(map(len, rows), default=0), max((abs(x) for row in rows for v in row for x in v), default=0)
        w = most.bit_length() + steps * max(den, largest).bit_length() + 1
        wide, factors = w * len(rows), steps * den.bit_length()  # bits of a number with all rows, of the last factor
        entries = sum(map(int.bit_length, chain.from_iterable(states + faults)))
        charge(steps * (cells * (150 + (wide >> 6)) + (entries * wide >> 10)), (len(A) + len(C)) * wide // 3)
        charge(steps * len(C) * (len(rows) * (300 + (wide >> 4)) + (wide * factors >> 10)), len(C) * (wide + factors) // 3)
        carried, factor, found = [0] * len(A), 1, []
        for k in reversed(range(steps)):
            both = [factor * sum(row[k][j] << w * a for a, row in enumerate(rows) if k < len(row)) for j in range(len(C))] + carried
            found.append(any(sum(map(mul, both, column)) for column in faults))
            carried, factor = [sum(map(mul, both, column)) for column in states], factor * den
        return [any(carried), *reversed(found)]


FIELDS: dict[str, type[Field]] = {"Q": Field}  # by their name, or by the key of their object


class System:
    """A SYSTEM: equal ones have equal keys, `words` shows one. Below, one method a kind, with statement s and witness w."""

    SHAPES = (("A", "n", "n"), ("F", "n", "m"), ("C", "p", "n"), ("G", "p", "m"), ("B", "n", "nu"), ("D", "p", "nu"))

    def __init__(self, data: Json) -> None:
        keys(data, "A F C G field? n? m? p? B? D? nu?", "system")
        expect(("B" in data) == ("D" in data) and ("B" in data or "nu" not in data), "system: B and D go together, nu with them")
        charge(1000)
        value, sizes = data.get("field", "Q"), dict[str, int]()
        self.field = FIELDS.get(next(iter(value), "") if type(value) is dict else "Q", Field)(value)
        for name, height, width in self.SHAPES[: 6 if "B" in data else 4]:
            rows = items(data[name], name, MAX_DIMENSION)
            for size, seen in (height, rows), (width, items(rows[0], name, MAX_DIMENSION) if rows else []):
                sizes.setdefault(size, index(data.get(size, len(seen)), size, MAX_DIMENSION))
        expect(all(sizes.values()) or {*sizes} <= {*data}, f"system: with a zero dimension {', '.join(sizes)} are required")
        self.n, self.m, self.p = sizes["n"], sizes["m"], sizes["p"]
        expect(self.n + self.m + self.p <= MAX_DIMENSION, f"system: n + m + p is above {MAX_DIMENSION}")
        blocks = [self.block(data[name], sizes[nr], sizes[nc], name) for name, nr, nc in self.SHAPES if name in data]
        self.A, self.F, self.C, self.G = blocks[:4]
        self.nu = sizes.get("nu", 0)
        self.inputs: Sequence[Table] = blocks[4:]
        self.data, self.image, self.spanned = data, Vectors(), tuple[object, ...]()
        self.key: tuple[Any, ...] = (self.field.key, self.n, self.m, self.p, blocks[:4])

    def block(self, value: Json, nr: int, nc: int, where: str) -> Table:
        """Return a MATRIX that is kept."""
        found = self.field.matrix(value, nr, nc, where)
        charge(0, kept=room(nr, nc, max(map(int.bit_length, chain.from_iterable(found.rows)), default=0)) + found.den.bit_length() // 7)
        return found

    @property
    def words(self) -> str:
        """The matrices, with what they do not tell."""
        dimensions = "" if self.n and self.m and self.p else f" (n={self.n}, m={self.m}, p={self.p})"
        over = "" if self.field.key == "Q" else f" over {shorten(self.data['field'])}"
        return f"({', '.join(f'{name}={shorten(self.data[name])}' for name in 'AFCG')}){dimensions}{over}"

    def pencil(self) -> Vectors:
        """Return the rows of [[A, F], [C, G]] modulo the prime."""
        if not self.image:
            A, F, C, G = (self.field.residues(part.rows[:: self.field.degree], part.den) for part in (self.A, self.F, self.C, self.G))
            self.image = [[*x, *y] for x, y in zip(A + C, F + G, strict=True)]
        return self.image

    def pencil_rank(self, w: Json) -> int:
        """Return the rank of [[A - qI, F], [C, G]] modulo the prime at the hinted point q, or n + rank G, that at infinity.

        It is no more than n plus the normal rank.
        """
        prime, table = self.field.modulus, self.pencil()
        if w["point"] == "infinity":
            return self.n + len(echelon((row[self.n :] for row in table[self.n :]), prime))
        q = index(w["point"], "point", prime - 1)
        return len(echelon(([*row[:i], (row[i] - q) % prime, *row[i + 1 :]] if i < self.n else row for i, row in enumerate(table)), prime))

    def conditions(self, rows: list[Vectors]) -> tuple[list[Vectors], bool]:
        """Return [X_(k+1), N_k], k = 0, ..., mu, of every row of residues, modulo the prime; and whether some row does not annihilate.

        A slot of a packed row of [A F; C G] receives n + p products of residues.
        """
        prime, n, width = self.field.modulus, self.n, self.n + self.m
        size = slot(prime, n + self.p)
        charge((n + self.p) * width * 500, (n + self.p) * width * (120 + size))
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

    def minimal(self, pivots: list[int], rows: list[Vectors], w: Json) -> None:
        """Reject unless the rows, residues that annihilate the system modulo the prime, are seen to be a minimal basis of all that do.

        Then no window has a rank below p s - sum of max(0, s - mu): let k rows N_a pass, X_a = sum of X_(a,j+1) q^j. As their leading
        coefficients are independent they are so themselves, and the rank of the pencil leaves no more than k independent [X z] that vanish
        on it. So what a z with X_0 = 0 is, [X z] = sum of c_a [X_a N_a] with rational c_a. Were there a denominator, then at one of its
        zeros q, perhaps of an extension, numbers u_a, not all zero, with sum of u_a [X_a N_a](q) = 0: a dependence of the states X_(a,j),
        1 <= j <= mu_a, in which X_(a,1) has the weight u_a, or, where all rows with u_a other than 0 have degree 0, one of their leading
        coefficients. But both are seen to be independent. So the c_a are polynomials, and, by the leading coefficients, no c_a N_a has a
        degree above that of z: a z of s samples is one of sum of max(0, s - mu), modulo the prime, where ranks never exceed the true ones.
        """
        prime, n, terms = self.field.modulus, self.n, sum(map(len, rows))
        index(w.get("mix", 0), "mix", prime - 1)  # of older files, whose rows were seen by two determinants that it chose
        conditions, left = self.conditions(rows)
        require(not left, "a row does not annihilate the system")
        leading = [[row[-1][j] for j in pivots] for row in rows]
        require(len(echelon(leading, prime)) == len(rows), "the leading coefficients of the rows at the pivots are dependent")
        charge(terms * (500 + 20 * n), terms * (100 + 10 * n))
        states = [condition[:n] for row in conditions for condition in row[:-1]]
        require(len(echelon(states, prime)) == len(states), "the states of the rows are dependent: they may have a common factor")
        require(self.pencil_rank(w) >= n + self.p - len(rows), "there may be more rows")

    def unhinted(self, pivots: list[int], rows: list[Vectors], window: int | None) -> None:
        """Reject unless the rows are all, on that window or on every one, as a witness without hints has it seen."""
        expect(False, "witness: without a point it is for checker_fields.py, which is another file")

    def annihilated_by(self, rows: list[Vectors]) -> None:
        """Reject unless every row annihilates the system."""
        require(not any(self.field.seen(self, rows, self.F, self.G)), "a row does not annihilate the system")

    def spanned_by(self, pivots: list[int], rows: list[Vectors], w: Json, window: int | None = None) -> None:
        """Reject unless the rows of degree below s and their shifts span the left null space of [O_s T_s]: s = window, or every s.

        With a point it is for every s. So what was seen of the same rows there, by the same prime, is not looked at again: the certificates
        of several windows have the same witness.
        """
        expect("point" in w or "mix" not in w, "witness: mix goes with a point")
        if "point" not in w:
            self.unhinted(pivots, rows, window)
            self.annihilated_by(rows)
        elif (seen := (pivots, rows, self.field.modulus, *(repr(w.get(key)) for key in ("root", "point", "mix")))) != self.spanned:
            self.minimal(pivots, [self.field.residues(row) for row in rows], w)
            self.annihilated_by(rows)
            self.spanned = seen

    def window_ranks(self, s: Json, w: Json) -> None:
        r, p = index(s["normal_rank"], "normal_rank"), self.p
        expect(("kernel" in w) != ("kernel_modulo" in w), "witness: expected one of kernel and kernel_modulo")
        expect("kernel_modulo" in w or "nulling" not in w, "witness: nulling goes with kernel_modulo")
        pivots, rows = self.field.kernel_rows(w.get("kernel", w.get("kernel_modulo")), p)
        if "kernel" in w:
            self.spanned_by(pivots, rows, w)
        else:
            self.spanned_modulo(pivots, rows, w)
        etas, ranks = ([index(x, key) for x in items(s.get(key, []), key)] for key in ("left_minimal_indices", "window_ranks"))
        require(etas == [len(row) - 1 for row in rows], "the left minimal indices are not the degrees of the rows")
        require(r == p - len(rows), "the normal rank is not p minus the number of rows")
        follow = [k * r + sum(min(k, eta) for eta in etas) for k in range(1, len(ranks) + 1)]
        require(ranks == follow, "window_ranks do not follow from the indices")

    def spanned_modulo(self, pivots: list[int], rows: list[Vectors], w: Json) -> None:
        """Reject unless that holds modulo the prime, and no window can have a rank above p s - sum of max(0, s - mu) whatever the rows are.

        [O_s T_s] has p s rows and n + m s columns, of which d + e s are seen to depend on others (`nulled`: none, where nothing is said).
        Where there are no rows, p s is the bound. Else let there be p - m + e, with degrees that add up to n - d and differ by one at most:
        for s up to the least the bound is p s, from the largest on it is p s - (p - m + e) s + n - d.
        """
        expect(not self.field.prime and "point" in w, "witness: kernel_modulo needs a point, and no prime field")
        degrees, (d, e) = [len(row) - 1 for row in rows], self.nulled(w["nulling"]) if "nulling" in w else (0, 0)
        generic = not rows or (len(rows) == self.p - self.m + e and sum(degrees) == self.n - d and degrees[-1] - degrees[0] <= 1)
        require(generic, "the indices are not those of windows that have all the rank that their shape allows")
        self.minimal(pivots, [self.field.residues(row) for row in rows], w)

    def nulled(self, given: Json) -> tuple[int, int]:
        """Return (d, e) where [O_s T_s] is seen to have d + e s independent null vectors for every s."""
        raise Malformed("witness: nulling is for checker_structure.py, which is another file")

    def left_invertible(self, s: Json, w: Json) -> None:
        expect("point" in w, "witness: without a point it is for checker_fields.py, which is another file")
        require(self.pencil_rank(w) >= self.n + self.m, "the pencil modulo the prime has a smaller rank at that point")

    def behaviours(self, s: Json, w: Json, second: System) -> None:
        window = index(s["window"], "window", MAX_WINDOW) if "window" in s else None
        pivots, rows = self.field.kernel_rows(w["kernel"], self.p)
        second.spanned_by(pivots, rows, w, window)
        if "inner" in s:
            self.annihilated_by(rows)
        else:
            self.spanned_by(pivots, rows, w, window)


# -- kinds -------------------------------------------------------------------------------------------------------------

SUBJECTS: dict[str, Callable[[Json], System]] = dict.fromkeys(("system", "inner", "outer", "first", "second"), System)
MODULAR = "prime? root?"
HINTED = f"{MODULAR} kernel point? mix?"
ELSEWHERE = {  # the kinds of the other files
    "checker_fields.py": "window-equality",
    "checker_structure.py": "behaviour-difference fault-space first-column-only inversion-delay left-invertible-line matrix-rank "
    "not-left-invertible",
    "checker_limits.py": "finite-zeros infinite-zeros input-limit moesp-limit schur-stable",
}


class Kind(NamedTuple):
    """What verifies a kind, keys of the statement and of the witness, the statement in words, and the proof in a line."""

    check: Callable[..., None]
    statement: str
    witness: str
    words: str
    proof: str


KINDS: dict[str, Kind] = {
    "window-ranks": Kind(System.window_ranks, "system normal_rank left_minimal_indices window_ranks?",
        f"{MODULAR} kernel? kernel_modulo? nulling? point? mix?",
        "for every s >= 1: rank [O_s T_s] = {normal_rank} s + sum of min(s, eta), eta the left minimal indices {left_minimal_indices}",
        "Both bounds on the rank of [O_s T_s] are p s - sum of max(0, s - mu), which is this formula, r being p minus the number of rows."),
    "left-invertible": Kind(System.left_invertible, "system", f"{MODULAR} point?",
        "left-invertible: x(0) = 0 and zero output for ever imply v = 0",
        "The pencil has full column rank at a point modulo the prime, hence as a matrix of polynomials over K."),
    "behaviour-inclusion": Kind(System.behaviours, "inner outer", HINTED,
        "every word of the first is one of the second, on every window",
        "The rows and their shifts span the left null space of the outer [O_s T_s] for every s, and annihilate the inner one."),
    "behaviour-equality": Kind(System.behaviours, "first second", HINTED,
        "both systems have the same output behaviour, on every window",
        "The rows and their shifts span the left null space of both [O_s T_s], for every s."),
}  # fmt: skip


class Verified(NamedTuple):
    """The statement in words, and what it assumes beyond what was verified: nothing, or that a polynomial is irreducible."""

    statement: str
    assumes: list[str]


def subject(data: Json) -> System:
    """Return the EXPERIMENT where it has a filter of u, else the SYSTEM, read on a meter of its own. Raises Malformed, Rejected."""
    begin()
    return SUBJECTS["experiment" if type(data) is dict and "u_filter" in data and "experiment" in SUBJECTS else "system"](data)


def verify(certificate: Json, systems: Iterable[Json | System] = ()) -> Verified:
    """Return the statement, once verified; each of `systems` (JSON or read) must be one that it is about. Raises Malformed or Rejected."""
    insisted = [data if isinstance(data, System) else subject(data) for data in systems]
    about = decide(certificate)
    kind, s, proven = KINDS[certificate["kind"]], certificate["statement"], about[0].field.irreducible(certificate["witness"])
    for system in insisted:
        if not any(system.key == other.key[: len(system.key)] for other in about):
            raise Rejected(f"the statement is not about {system.words}")
    words = kind.words.format_map({key: shorten(value) for key, value in s.items() if f"{{{key}}}" in kind.words})
    words += "".join(f", {key[:-1]} = {shorten(s[key[:-1]])}" for key in kind.statement.split() if key[-1] == "?" and key[:-1] in s)
    words += f"; for {' and '.join(system.words for system in about)}"
    assumed = [] if proven else [f"f is irreducible, with the coefficients {shorten(about[0].field.key)} (ascending)"]
    return Verified(f"assuming f irreducible: {words}" if assumed else words, assumed)


def decide(certificate: Json, read: Callable[[str, Json], System] = lambda key, data: SUBJECTS[key](data)) -> list[System]:
    """Return what the statement is about, verified if K is a field. `read` may give what it has read before of the same JSON."""
    begin()
    keys(certificate, "format kind statement witness", "certificate")
    expect(certificate["format"] == "faultspace-certificate/1", "format: expected faultspace-certificate/1")
    known = type(name := certificate["kind"]) is str and name in KINDS
    other = [file for file, names in ELSEWHERE.items() if name in names.split()]
    expect(known, f"kind: unknown{''.join(f' here: {file} decides it, which is another file' for file in other)}")
    s = keys(certificate["statement"], (kind := KINDS[name]).statement, "statement")
    w = keys(certificate["witness"], f"irreducible? {kind.witness}", "witness")
    about = [read(key, s[key]) for key in SUBJECTS if key in s]
    expect(all((x.field.key, x.p) == (about[0].field.key, about[0].p) for x in about), "they differ in field or number of outputs")
    for system in about if "prime" in kind.witness else []:
        system.image = Vectors()  # another witness may have left one
        system.field.reduce(w)
    kind.check(about[0], s, w, *about[1:])
    return about


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
        known = int if 0 < sys.get_int_max_str_digits() <= 19730 else whole  # Python refuses by itself what is longer than its own bound
        return json.loads(data.decode(), object_pairs_hook=unique, parse_int=known, parse_float=refused, parse_constant=refused)
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
    """A parser whose complaints hold no control characters."""

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
