"""The checker: decides certificates of the format `faultspace-certificate/1` (FORMAT.md) with the standard library alone.

    python -I -O checker.py [--json] [--system FILE]... CERTIFICATE...

Exit 0: every certificate is verified, its statement printed. 1: one is rejected, one about another system than a --system FILE included.
2: one does not parse.

It imports nothing of faultspace and can be copied alone to another machine. It never searches, uses integers only, and trusts no order,
prime or hint that it has not looked at itself. What has to be believed is this file, and these arguments:

  annihilation  Exact, in integers after clearing denominators. An entry of Q(a) stands as the d x d matrix of multiplication by it, so that
                a statement over Q(a) is one over Q; over GF(p) every product is reduced modulo p.
  upper bounds  Kernel rows with triangular leading coefficients that annihilate a system: once k >= mu, the leading coefficient of a row
                kills [C W_k, G], and independent leading coefficients cost gap(k) one each. So gap(k) <= p - #{mu <= k} for every k.
  lower bounds  Ranks modulo a prime never exceed the true ranks. The chain W_k is decreasing, and constant from its first repeated
                dimension on.
  together      Where the gaps modulo the prime are p - #{mu <= k} for k < s, both bounds meet, and the left null space of [O_s T_s] is
                spanned by the rows and their shifts.
  prime fields  The chain is exact there, no second bound is needed; the rows are checked all the same.

Public: verify(certificate, systems=()) -> the statement in words; load(path); sha256(certificate); Malformed; Rejected; main(argv).
Inside: Field, Mat (an exact matrix), System, Row (a kernel row); then what witnesses are made of; then one function a kind, named as it,
called with statement s, witness w and the systems of the statement.
"""

from __future__ import annotations

import argparse
import hashlib
import io
import json
import re
import sys
from collections.abc import Callable, Iterable, Sequence
from contextvars import ContextVar
from math import gcd, lcm
from operator import mul
from typing import Any, NamedTuple

Json = Any
Entry = tuple[tuple[int, int], ...]  # d reduced pairs (numerator, denominator)
MAX_BYTES, MAX_BITS, MAX_DIMENSION, MAX_DEGREE, MAX_WINDOW = 64 * 2**20, 2**16, 512, 16, 4096
# Bounds of this checker, not of the format: units of work, each some 50 nanoseconds or a byte, and the bits of a number on the way.
MAX_WORK, MAX_GROWTH = 2 * 10**9, 2**20
MAX_DIGITS = 19730
INTEGER = re.compile(f"-?[0-9]{{1,{MAX_DIGITS}}}")
RATIONAL = re.compile(f"(-?[0-9]{{1,{MAX_DIGITS}}})(?:/([1-9][0-9]{{0,{MAX_DIGITS}}}))?")
if 0 < sys.get_int_max_str_digits() <= MAX_DIGITS:  # Python refuses above 4300 digits by default; numbers of the format have more.
    sys.set_int_max_str_digits(MAX_DIGITS + 1)


class Malformed(Exception):
    """The certificate does not parse: it is not of the format."""


class Rejected(Exception):
    """The certificate is well formed, and does not prove its statement."""


def require(condition: object, reason: str) -> None:
    """Raise Rejected with the reason unless the condition holds."""
    if not condition:
        raise Rejected(reason)


def expect(condition: object, reason: str) -> None:
    """Raise Malformed with the reason unless the condition holds."""
    if not condition:
        raise Malformed(reason)


_work: ContextVar[int] = ContextVar("work", default=0)


def charge(units: int) -> None:
    """Count work; Rejected when a certificate asks for more than MAX_WORK."""
    total = _work.get() + units
    require(total <= MAX_WORK, f"checking takes more than {MAX_WORK} units of work")
    _work.set(total)


# -- numbers and fields -------------------------------------------------------------------------------------------------------------


def rational(value: Json, where: str, integral: bool = False) -> tuple[int, int]:
    """(numerator, denominator), reduced, of a RATIONAL or, integral, of an INTEGER."""
    top, bottom = value, 1
    if type(value) is not int:
        match = RATIONAL.fullmatch(value) if type(value) is str else None
        if match is None or (integral and match[2]):
            raise Malformed(f"{where}: expected {'an integer' if integral else 'a rational'} or a string that is one")
        top, bottom = int(match[1]), int(match[2] or 1)
    expect(max(top.bit_length(), bottom.bit_length()) <= MAX_BITS, f"{where}: more than {MAX_BITS} bits")
    common = gcd(top, bottom)
    return top // common, bottom // common


def index(value: Json, where: str, largest: int) -> int:
    """An INDEX in 0..largest."""
    if type(value) is not int or not 0 <= value <= largest:
        raise Malformed(f"{where}: expected an integer in 0..{largest}")
    return value


def items(value: Json, where: str, largest: int, smallest: int = 0) -> list[Json]:
    """A list with smallest..largest items."""
    if type(value) is not list or not smallest <= len(value) <= largest:
        raise Malformed(f"{where}: expected a list of {largest if smallest == largest else f'{smallest} to {largest}'}")
    return value


def keys(value: Json, names: str, where: str) -> dict[str, Json]:
    """An object with these keys, those with a question mark optional, and no others."""
    known = {name.rstrip("?") for name in names.split()}
    if type(value) is not dict or not known >= set(value) >= {name for name in names.split() if name[-1] != "?"}:
        raise Malformed(f"{where}: expected an object with the keys {names}")
    return value


def is_prime(number: int) -> bool:
    """Deterministic Miller-Rabin, right for every number below 2^64."""
    bases = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37)
    if number < 2 or any(number % b == 0 for b in bases):
        return number in bases
    odd, twos = number - 1, 0
    while odd % 2 == 0:
        odd, twos = odd // 2, twos + 1
    for base in bases:
        x = pow(base, odd, number)
        if x not in (1, number - 1) and not any((x := x * x % number) == number - 1 for _ in range(twos - 1)):
            return False
    return True


def common_denominator(values: Iterable[int]) -> int:
    """The least common multiple of positive numbers."""
    result = 1
    for value in {*values} - {1}:
        charge(1 + (result.bit_length() * value.bit_length() >> 14))
        result = lcm(result, value)
        require(result.bit_length() <= MAX_GROWTH, f"a number grows beyond {MAX_GROWTH} bits")
    return result


class Field:
    """K: `prime` (0 in characteristic 0), `degree` d, over Q(a) `f` as a primitive integer polynomial, else []; fields with equal keys are equal."""

    def __init__(self, value: Json) -> None:
        self.prime, self.degree, self.key, self.f = 0, 1, value, list[int]()
        if type(value) is dict and "prime" in value:
            self.prime = index(keys(value, "prime", "field")["prime"], "field.prime", 2**64 - 1)
            expect(is_prime(self.prime), "field.prime: not a prime")
        elif type(value) is dict:
            where = "field.minimal_polynomial"
            given = items(keys(value, "minimal_polynomial", "field")["minimal_polynomial"], where, MAX_DEGREE + 1, 2)
            pairs = [rational(c, where) for c in given]
            expect(pairs[-1][0], f"{where}: the leading coefficient is zero")
            self._reduction(pairs)
        else:
            expect(value == "Q", "field: expected Q, a minimal polynomial or a prime")

    def _reduction(self, pairs: list[tuple[int, int]]) -> None:
        """f, `avoid` (what a usable prime must not divide), and `scale` times the coordinates of the powers of a, up to a^(2d-2)."""
        common = common_denominator(bottom for _, bottom in pairs)
        multiple = [top * (common // bottom) for top, bottom in pairs]
        content = gcd(*multiple) * (1 if multiple[-1] > 0 else -1)
        self.avoid, self.f, self.degree = common * multiple[-1], [c // content for c in multiple], len(pairs) - 1
        self.key, d, lead = self.f, self.degree, self.f[-1]
        bits = max(c.bit_length() for c in self.f)
        require(d * bits <= MAX_GROWTH, f"a number grows beyond {MAX_GROWTH} bits")
        charge(d**3 * (1 + (bits * bits >> 15)))
        self.scale = lead ** (d - 1)
        self.powers = [[self.scale * (i == j) for j in range(d)] for i in range(d)]
        for _ in range(d - 1):  # a^d = -(f_0 + ... + f_(d-1) a^(d-1)) / lead; each step uses up one factor of the scale
            *low, high = self.powers[-1]
            self.powers.append([a - high // lead * c for a, c in zip([0, *low], self.f)])

    def entry(self, value: Json, where: str, integral: bool = False) -> Entry:
        """An ENTRY."""
        if self.prime:
            return ((rational(value, where, True)[0] % self.prime, 1),)
        if type(value) is list and self.f:
            return tuple([rational(x, where, integral) for x in items(value, where, self.degree, self.degree)])
        return (rational(value, where, integral),) + ((0, 1),) * (self.degree - 1)

    def vector(self, value: Json, size: int, where: str, integral: bool = False) -> list[Entry]:
        """A VECTOR of that many entries."""
        charge(200 * size * self.degree)
        return [self.entry(x, f"{where}[{i}]", integral) for i, x in enumerate(items(value, where, size, size))]

    def table(self, value: Json, nr: int, nc: int, where: str) -> list[list[Entry]]:
        """A MATRIX of that shape; with no entries, [] or the right number of empty rows."""
        if value == [] and nc == 0:
            return [[] for _ in range(nr)]
        return [self.vector(row, nc, f"{where}[{i}]") for i, row in enumerate(items(value, where, nr, nr))]

    def block(self, entry: Entry) -> tuple[list[list[int]], int]:
        """The d x d matrix of multiplication by an entry (row i: coordinates of a^i times it), as integers and a denominator."""
        d, bottom = self.degree, common_denominator(bottom for _, bottom in entry)
        tops = [top * (bottom // below) for top, below in entry]
        if not any(tops[1:]):
            return [[tops[0] * (i == j) for j in range(d)] for i in range(d)], bottom
        charge(d**3 * (1 + (max(map(int.bit_length, tops)) * self.scale.bit_length() >> 16)))
        return [[sum(map(mul, tops, column)) for column in zip(*self.powers[i : i + d])] for i in range(d)], bottom * self.scale


# -- exact matrices -----------------------------------------------------------------------------------------------------------------


class Mat:
    """The matrix rows / den over a field, in integers and d x d blocks: rows and columns (nc) are d times those over K."""

    __slots__ = ("bits", "den", "field", "nc", "rows")

    def __init__(self, field: Field, rows: list[list[int]], nc: int, den: int = 1) -> None:
        if field.prime:
            rows = [[x % field.prime for x in row] for row in rows]
        self.field, self.rows, self.nc, self.den = field, rows, nc, den
        self.bits = den.bit_length() + max([x.bit_length() for row in rows for x in row], default=0)
        require(self.bits <= MAX_GROWTH, f"a number grows beyond {MAX_GROWTH} bits")
        charge_cells(len(rows) * nc, self.bits)

    def __matmul__(self, other: Mat) -> Mat:
        charge(len(self.rows) * self.nc * other.nc * (1 + (self.bits * other.bits >> 16)))
        columns = list(zip(*other.rows)) if other.rows else [()] * other.nc
        return Mat(self.field, [[sum(map(mul, row, c)) for c in columns] for row in self.rows], other.nc, self.den * other.den)

    def __add__(self, other: Mat) -> Mat:
        den = common_denominator((self.den, other.den))
        a, b = den // self.den, den // other.den
        return Mat(self.field, [[a * x + b * y for x, y in zip(r, s)] for r, s in zip(self.rows, other.rows)], self.nc, den)

    def __neg__(self) -> Mat:
        return Mat(self.field, [[-x for x in row] for row in self.rows], self.nc, self.den)

    def is_zero(self) -> bool:
        """Whether every entry is zero."""
        return not any(map(any, self.rows))

    def equals(self, other: Mat) -> bool:
        """Whether two matrices of one shape are equal."""
        return (self + -other).is_zero()

    def modulo(self, prime: int, root: int) -> list[list[int]]:
        """The rows over K modulo a prime, a going to the root. Rejected when a denominator vanishes."""
        require(self.den % prime, "the prime divides a denominator")
        d, scale = self.field.degree, pow(self.den, -1, prime)
        powers = [scale * pow(root, c, prime) for c in range(d)]
        return [[sum(map(mul, row[j : j + d], powers)) % prime for j in range(0, self.nc, d)] for row in self.rows[::d]]


def charge_cells(count: int, bits: int) -> None:
    """Charge for the making and the memory of that many numbers."""
    charge(100 + count * (64 + bits // 4))


def matrix(field: Field, table: Sequence[Sequence[Entry]], nc: int) -> Mat:
    """The matrix of a table of entries."""
    blocks = [[field.block(entry) for entry in row] for row in table]
    den = common_denominator(b for row in blocks for _, b in row)
    charge_cells(len(table) * nc * field.degree**2, den.bit_length())
    rows = [[x * (den // b) for part, b in row for x in part[i]] for row in blocks for i in range(field.degree)]
    return Mat(field, rows, nc * field.degree, den)


def column(field: Field, entries: Sequence[Entry]) -> Mat:
    """The column of a list of entries."""
    return matrix(field, [[x] for x in entries], 1)


def zero(field: Field, nr: int, nc: int) -> Mat:
    """The zero matrix, nr x nc over K."""
    d = field.degree
    return Mat(field, [[0] * (nc * d) for _ in range(nr * d)], nc * d)


def identity(field: Field, size: int) -> Mat:
    """The identity over K."""
    k = size * field.degree
    return Mat(field, [[int(i == j) for j in range(k)] for i in range(k)], k)


def assembled(field: Field, grid: Sequence[Sequence[Mat]], nc: int) -> Mat:
    """The matrix with nc columns over K made of rows of blocks."""
    den = common_denominator(part.den for line in grid for part in line)
    cells = sum(len(part.rows) * part.nc for line in grid for part in line)
    charge_cells(cells, den.bit_length() + max((part.bits for line in grid for part in line), default=0))
    rows = [[x * (den // part.den) for part in line for x in part.rows[i]] for line in grid for i in range(len(line[0].rows))]
    return Mat(field, rows, nc * field.degree, den)


def echelon(vectors: Iterable[list[int]], prime: int) -> list[tuple[int, list[int]]]:
    """Row echelon form modulo a prime of lists of residues: [(pivot column, row with leading 1), ...] ascending by pivot."""
    found = []
    rest = [v for v in vectors if any(v)]
    for j in range(len(rest[0]) if rest else 0):
        at = next((i for i, v in enumerate(rest) if v[j]), None)
        if at is not None:
            lead = rest.pop(at)
            inverse = pow(lead[j], -1, prime)
            lead = [x * inverse % prime for x in lead]
            found.append((j, lead))
            charge(3 * (len(rest) + 1) * len(lead))
            rest = [[(x - c * y) % prime for x, y in zip(v, lead)] if (c := v[j]) else v for v in rest]
            rest = [v for v in rest if any(v)]
    return found


# -- systems ------------------------------------------------------------------------------------------------------------------------


class System:
    """A SYSTEM: field, n, m, p and the exact A, F, C, G; `key` decides equality, `words` shows it."""

    SHAPES = (("A", "n", "n"), ("F", "n", "m"), ("C", "p", "n"), ("G", "p", "m"), ("B", "n", "nu"), ("D", "p", "nu"))

    def __init__(self, data: Json) -> None:
        keys(data, "A F C G field? n? m? p? B? D? nu?", "system")
        expect(("B" in data) == ("D" in data) and ("B" in data or "nu" not in data), "system: B and D go together, nu with them")
        self.field, sizes = Field(data.get("field", "Q")), dict[str, int]()
        for name, height, width in self.SHAPES:
            rows = items(data.get(name, []), name, MAX_DIMENSION)
            first = rows[0] if rows and type(rows[0]) is list else []
            for size, seen in ((height, len(rows)), (width, len(first))):
                if name in data:
                    sizes.setdefault(size, index(data.get(size, seen), size, MAX_DIMENSION))
        expect(all(sizes.values()) or set(sizes) <= set(data), "system: with a zero dimension all dimensions are required")
        self.n, self.m, self.p = sizes["n"], sizes["m"], sizes["p"]
        expect(self.n + self.m + self.p <= MAX_DIMENSION, f"system: n + m + p is above {MAX_DIMENSION}")
        tables = {name: self.field.table(data[name], sizes[nr], sizes[nc], name) for name, nr, nc in self.SHAPES if name in data}
        self.A, self.F, self.C, self.G = blocks = [matrix(self.field, tables[name], sizes[nc]) for name, _, nc in self.SHAPES[:4]]
        self.key = (self.field.key, self.n, self.m, self.p, [(block.rows, block.den) for block in blocks])
        dimensions = "" if all(sizes.values()) else f" (n={self.n}, m={self.m}, p={self.p})"
        over = "" if self.field.key == "Q" else f" over {shown(data['field'])}"
        self.words = f"({', '.join(f'{name}={shown(data[name])}' for name in 'AFCG')}){dimensions}{over}"


def shown(value: Json) -> str:
    """JSON for a reader, cut when it is long."""
    text = json.dumps(value, separators=(",", ":")).replace('"', "")
    return text if len(text) <= 240 else f"{text[:200]}... [{len(text)} characters]"


def window_matrix(system: System, s: int, with_state: bool = True) -> Mat:
    """[O_s T_s], or T_s."""
    charge(s * s)
    observed, markov, power = [], [system.G], system.C
    for _ in range(s):
        observed.append(power)
        markov.append(power @ system.F)
        power = power @ system.A
    blank = zero(system.field, system.p, system.m)
    grid = [[observed[i]] * with_state + [markov[i - j] if j <= i else blank for j in range(s)] for i in range(s)]
    return assembled(system.field, grid, system.n * with_state + system.m * s)


def word(system: System, value: Json, samples: int | None = None) -> tuple[Mat, list[Mat]]:
    """x(0) and v(0), v(1), ... of an object with x0 and v, of that many samples if given, as columns."""
    field, most = system.field, MAX_WINDOW if samples is None else samples
    faults = [column(field, field.vector(x, system.m, f"v[{k}]")) for k, x in enumerate(items(value["v"], "v", most, samples or 0))]
    return column(field, field.vector(value["x0"], system.n, "x0")), faults


def simulate(system: System, x0: Mat, v: list[Mat]) -> tuple[list[Mat], list[Mat]]:
    """States x(0..N) and outputs r(0..N-1) of the trajectory from x0 under v(0..N-1)."""
    states, outputs = [x0], []
    for fault in v:
        outputs.append(system.C @ states[-1] + system.G @ fault)
        states.append(system.A @ states[-1] + system.F @ fault)
    return states, outputs


# -- what witnesses are made of -----------------------------------------------------------------------------------------------------


def modulus(field: Field, w: Json) -> tuple[int, int]:
    """The prime of the modular bound and, over Q(a), the root (else 0). Over a prime field its own."""
    expect(field.f or "root" not in w, "witness: a root belongs to a minimal polynomial")
    if field.prime:
        expect("prime" not in w, "witness: no prime over a prime field")
        return field.prime, 0
    prime = index(w.get("prime"), "witness.prime", 2**64 - 1)
    require(is_prime(prime), f"{prime} is not a prime")
    if not field.f:
        return prime, 0
    root = index(w.get("root"), "witness.root", prime - 1)
    require(field.avoid % prime, "the prime divides a denominator of the minimal polynomial or its leading coefficient")
    value = slope = 0
    for c in reversed(field.f):
        slope, value = (slope * root + value) % prime, (value * root + c) % prime
    require(value == 0 and slope != 0, "not a simple root of the minimal polynomial modulo the prime")
    return prime, root


def irreducible(field: Field, w: Json) -> bool:
    """Whether f is shown to be irreducible, where there is one of degree above 1; Rejected when what is given is wrong."""
    if "irreducible" not in w:
        return field.degree == 1
    given, f, d = keys(w["irreducible"], "modulo? eisenstein?", "witness.irreducible"), field.f, field.degree
    expect(f and len(given) == 1, "witness.irreducible: expected modulo or eisenstein, over Q(a)")
    if "modulo" in given:
        prime = index(given["modulo"], "irreducible.modulo", 2**64 - 1)
        require(is_prime(prime) and field.avoid % prime, "irreducible: not a usable prime")
        require(irreducible_modulo(f, prime), f"f is reducible modulo {prime}")
        return True
    how = keys(given["eisenstein"], "prime shift", "irreducible.eisenstein")
    prime, shift = index(how["prime"], "eisenstein.prime", 2**64 - 1), rational(how["shift"], "eisenstein.shift", True)[0]
    charge(d**3 * (1 + (max(shift, *f, key=abs).bit_length() ** 2 >> 15)))
    shifted = [0]
    for c in reversed(f):  # Horner for f(x + shift)
        shifted = [a + shift * b for a, b in zip([0, *shifted], [*shifted, 0])]
        shifted[0] += c
    content = gcd(*shifted)
    low, *middle, lead = [c // content for c in shifted[: d + 1]]
    require(is_prime(prime), f"{prime} is not a prime")
    applies = lead % prime and not any(c % prime for c in [low, *middle]) and low % (prime * prime)
    require(applies, "Eisenstein's criterion does not apply")
    return True


def irreducible_modulo(f: list[int], prime: int) -> bool:
    """Berlekamp: g -> g^prime on GF(prime)[x]/f is linear, injective where f is squarefree, and fixes a line where f has one prime factor."""
    d, ground = len(f) - 1, Field({"prime": prime})
    scale = -pow(f[-1], -1, prime)
    times_x = Mat(ground, [[int(j == i + 1) for j in range(d)] for i in range(d - 1)] + [[c * scale for c in f[:d]]], d)
    power, image, images = identity(ground, d), Mat(ground, [[int(j == 0) for j in range(d)]], d), list[Mat]()
    for bit in f"{prime:b}":
        power = power @ power @ times_x if bit == "1" else power @ power
    for _ in range(d):  # x^(prime i), i = 0, ..., d - 1
        images.append(image)
        image = image @ power
    frobenius = assembled(ground, [[image] for image in images], d)
    fixed = frobenius + -identity(ground, d)
    return len(echelon(frobenius.rows, prime)) == d and len(echelon(fixed.rows, prime)) == d - 1


def rank_modulo(built: Mat, w: Json) -> int:
    """The rank modulo the prime of the witness."""
    prime, root = modulus(built.field, w)
    return len(echelon(built.modulo(prime, root), prime))


def gaps(system: System, w: Json) -> list[int]:
    """gap(0), gap(1), ... modulo the prime of the witness until the chain W_k is constant; the last repeats for ever."""
    prime, root = modulus(system.field, w)
    A, F, C, G = (part.modulo(prime, root) for part in (system.A, system.F, system.C, system.G))
    n, m, p = system.n, system.m, system.p
    down = [*C, *A]
    inputs = [[row[j] for row in [*G, *F]] for j in range(m)]
    space, found = [[int(i == j) for i in range(n)] for j in range(n)], list[int]()
    while True:
        charge(100 + 2 * len(space) * (n + p) * n)
        moved = [[sum(map(mul, row, x)) % prime for row in down] for x in space]
        form = echelon(moved + inputs, prime)  # of the vectors (output, next state), one a generator
        found.append(sum(1 for pivot, _ in form if pivot < p))
        after = [row[p:] for pivot, row in form if pivot >= p]
        if len(after) == len(space):
            return found
        space = after


class Row(NamedTuple):
    """A kernel row N(q): its pivot and its coefficients, 1 x p each, by ascending powers."""

    pivot: int
    coefficients: list[Mat]

    @property
    def degree(self) -> int:
        """mu."""
        return len(self.coefficients) - 1


def kernel_rows(w: Json, system: System, window: int | None = None) -> list[Row]:
    """The KROWS of the witness, admissible; of degree below the window, if there is one."""
    field, p, rows = system.field, system.p, list[Row]()
    for a, given in enumerate(items(w["kernel"], "kernel", MAX_DIMENSION)):
        where = f"kernel[{a}]"
        vectors = items(keys(given, "pivot coefficients", where)["coefficients"], f"{where}.coefficients", MAX_WINDOW, 1)
        coefficients = [matrix(field, [field.vector(c, p, f"{where}.coefficients[{k}]", True)], p) for k, c in enumerate(vectors)]
        rows.append(Row(index(given["pivot"], f"{where}.pivot", MAX_DIMENSION), coefficients))
    triangular([(row.pivot, row.coefficients[-1]) for row in rows], p)
    degrees = [row.degree for row in rows]
    require(degrees == sorted(degrees), "kernel rows: the degrees do not ascend")
    require(window is None or all(mu < window for mu in degrees), "a kernel row is longer than the window")
    return rows


def triangular(rows: list[tuple[int, Mat]], size: int) -> None:
    """Reject unless the pivots are below size and entry (a, b), entry pivot_b of row a, is zero for b < a and not for b = a."""
    require(all(pivot < size for pivot, _ in rows), "a pivot is out of range")
    charge(10 * len(rows) ** 2)
    for a, (_, row) in enumerate(rows):
        d = row.field.degree
        for b, (pivot, _) in enumerate(rows[: a + 1]):
            require(any(row.rows[0][pivot * d : pivot * d + d]) == (b == a), "the rows are not triangular by their pivots")


def annihilate(rows: list[Row], system: System) -> list[list[Mat]]:
    """Reject unless every row annihilates the system (Horner). Returns the condition rows [X_(k+1), N_k], k = mu, ..., 0, of each."""
    conditions = []
    for row in rows:
        state, demands = zero(system.field, 1, system.n), []
        for coefficient in reversed(row.coefficients):
            require((coefficient @ system.G + state @ system.F).is_zero(), "a kernel row does not annihilate the system (at a fault)")
            demands.append(assembled(system.field, [[state, coefficient]], system.n + system.p))
            state = coefficient @ system.C + state @ system.A
        require(state.is_zero(), "a kernel row does not annihilate the system (at the state)")
        conditions.append(demands)
    return conditions


def meet(rows: list[Row], system: System, w: Json, window: int | None = None) -> None:
    """Reject unless the rows meet the modular bound on k < window (None: for ever)."""
    found = gaps(system, w)
    samples = max([len(found), *(row.degree + 1 for row in rows)]) if window is None else window
    for k in range(samples):
        above = system.p - sum(1 for row in rows if row.degree <= k)
        require(found[min(k, len(found) - 1)] == above, f"the bounds do not meet at sample {k}: {above} above")


# -- the kinds ----------------------------------------------------------------------------------------------------------------------


class Kind(NamedTuple):
    """The keys of statement and witness, and the function that verifies and words the statement."""

    check: Callable[..., str]
    statement: str
    witness: str


KINDS: dict[str, Kind] = {}
MODULAR, KERNEL, DIAGONAL = "prime? root?", "prime? root? kernel", "diagonal left left_inverse right right_inverse"


def kind(statement: str, witness: str) -> Callable[[Callable[..., str]], Callable[..., str]]:
    """Enter a function into KINDS, under its name."""

    def enter(check: Callable[..., str]) -> Callable[..., str]:
        KINDS[check.__name__.replace("_", "-")] = Kind(check, statement, f"irreducible? {witness}")
        return check

    return enter


@kind("system normal_rank left_minimal_indices window_ranks?", KERNEL)
def window_ranks(s: Json, w: Json, system: System) -> str:
    r = index(s["normal_rank"], "normal_rank", MAX_DIMENSION)
    etas = [index(eta, "left_minimal_indices", MAX_WINDOW) for eta in items(s["left_minimal_indices"], "left_minimal_indices", MAX_DIMENSION)]
    rows = kernel_rows(w, system)
    require(etas == [row.degree for row in rows], "the left minimal indices are not the degrees of the rows")
    require(r == system.p - len(rows), "the normal rank is not p minus the number of rows")
    for k, stated in enumerate(items(s.get("window_ranks", []), "window_ranks", MAX_WINDOW), 1):
        follows = k * r + sum(min(k, eta) for eta in etas)
        require(index(stated, "window_ranks", MAX_DIMENSION * MAX_WINDOW) == follows, "window_ranks do not follow from the indices")
    annihilate(rows, system)
    meet(rows, system, w)
    return f"for every s >= 1: rank [O_s T_s] = {r} s + sum of min(s, eta) over the left minimal indices eta = {etas}"


@kind("system", MODULAR)
def left_invertible(s: Json, w: Json, system: System) -> str:
    require(gaps(system, w)[-1] == system.m, "the gap modulo the prime stays below the number of faults")
    return "left-invertible: x(0) = 0 and zero output for ever imply v = 0; the normal rank is m"


@kind("system", "state fault")
def not_left_invertible(s: Json, w: Json, system: System) -> str:
    field, xs, vs = system.field, items(w["state"], "state", MAX_WINDOW, 1), items(w["fault"], "fault", MAX_WINDOW, 1)
    expect(len(xs) == len(vs), "state, fault: expected lists of equal length")
    states = [column(field, field.vector(x, system.n, f"state[{j}]")) for j, x in enumerate(xs)]
    faults = [column(field, field.vector(v, system.m, f"fault[{j}]")) for j, v in enumerate(vs)]
    require(not all(part.is_zero() for part in states + faults), "the null vector is zero")
    for x, v, shifted in zip(states, faults, [zero(field, system.n, 1), *states]):
        require(shifted.equals(system.A @ x + system.F @ v), "(qI - A) x(q) = F v(q) fails")
        require((system.C @ x + system.G @ v).is_zero(), "C x(q) + G v(q) = 0 fails")
    require(states[-1].is_zero(), "(qI - A) x(q) = F v(q) fails at the highest power")
    return "not left-invertible: some v other than 0 gives zero output for ever from x(0) = 0; the normal rank is below m"


@kind("system initial_state delay", "inverse? word?")
def inversion_delay(s: Json, w: Json, system: System) -> str:
    field, n, m, p, delay, known = system.field, system.n, system.m, system.p, s["delay"], s["initial_state"] == "known"
    expect(known or s["initial_state"] == "unknown", "initial_state: expected known or unknown")
    expect(("inverse" in w) == (delay is not None), "witness: an inverse goes with a delay")
    expect(("word" in w) == (delay is None or delay != 0), "witness: a word goes with a delay other than 0")
    if delay is not None:
        require(index(delay, "delay", MAX_WINDOW) <= n, "the delay is above n")
        inverse = matrix(field, field.table(w["inverse"], m, p * (delay + 1), "inverse"), p * (delay + 1))
        wanted = [zero(field, m, 0 if known else n), identity(field, m), zero(field, m, m * delay)]
        given = inverse @ window_matrix(system, delay + 1, not known)
        require(given.equals(assembled(field, [wanted], given.nc)), "the left inverse does not give v(0)")
    if delay != 0:
        x0, v = word(system, keys(w["word"], "x0 v", "word"), n + 1 if delay is None else delay)
        require(not v[0].is_zero(), "v(0) of the ambiguous word is zero")
        require(not known or x0.is_zero(), "x(0) of the ambiguous word is not zero")
        require(all(r.is_zero() for r in simulate(system, x0, v)[1]), "the output of the ambiguous word is not zero")
    premise = "x(0) = 0" if known else "x(0) unknown"
    if delay is None:
        return f"with {premise}, r(0..n) does not determine v(0): there is no delay in 0..n"
    return f"with {premise}, the least l such that r(0..l) determines v(0) is {delay}"


@kind("inner outer", KERNEL)
def behaviour_inclusion(s: Json, w: Json, inner: System, outer: System) -> str:
    rows = kernel_rows(w, outer)
    annihilate(rows, inner)
    annihilate(rows, outer)
    meet(rows, outer, w)
    return "the output behaviour of the first system is contained in that of the second, on every window"


@kind("first second", KERNEL)
def behaviour_equality(s: Json, w: Json, first: System, second: System) -> str:
    rows = kernel_rows(w, first)
    for system in (first, second):
        annihilate(rows, system)
        meet(rows, system, w)
    return "the output behaviours of the two systems are equal, on every window"


@kind("first second window", KERNEL)
def window_equality(s: Json, w: Json, first: System, second: System) -> str:
    window = index(s["window"], "window", MAX_WINDOW)
    rows = kernel_rows(w, first, window)
    for system in (first, second):
        annihilate(rows, system)
        meet(rows, system, w, window)
    return f"the restricted behaviours of the two systems on {window} samples are equal"


@kind("first second window", "x0 v row")
def behaviour_difference(s: Json, w: Json, first: System, second: System) -> str:
    field, p, window = first.field, first.p, index(s["window"], "window", MAX_WINDOW)
    given = items(w["row"], "row", window, 1)
    row = Row(0, [matrix(field, [field.vector(c, p, f"row[{k}]")], p) for k, c in enumerate(given)])
    annihilate([row], second)
    _, outputs = simulate(first, *word(first, w, window))
    total = zero(field, 1, 1)
    for coefficient, output in zip(row.coefficients, outputs):
        total = total + coefficient @ output
    require(not total.is_zero(), "the word satisfies the row")
    return f"some word of {window} samples of the first system is not one of the second"


@kind("system window basis", KERNEL)
def fault_space(s: Json, w: Json, system: System) -> str:
    field, width = system.field, system.n + system.p
    window = None if s["window"] is None else index(s["window"], "window", MAX_WINDOW)
    basis = field.table(s["basis"], len(items(s["basis"], "basis", width)), width, "basis")
    unit, nothing, last = field.entry(1, "1"), field.entry(0, "0"), -1
    for row in basis:
        pivot = next((j for j, x in enumerate(row) if x != nothing), width)
        alone = last < pivot < width and row[pivot] == unit and sum(1 for other in basis if other[pivot] != nothing) == 1
        require(alone, "the basis is not in reduced row echelon form")
        last = pivot
    rows = kernel_rows(w, system, window)
    demands = assembled(field, [[demand] for demands in annihilate(rows, system) for demand in demands], width)
    meet(rows, system, w, window)
    columns = matrix(field, [[row[j] for row in basis] for j in range(width)], len(basis))
    require((demands @ columns).is_zero(), "a basis column does not solve problem (11)")
    require(rank_modulo(demands, w) == width - len(basis), "there are more solutions than the basis spans")
    at = "every window beyond all left minimal indices" if window is None else f"window {window}"
    return f"at {at} the solutions of problem (11) are exactly the span of the {len(basis)} columns [f; g] in {shown(s['basis'])}"


@kind("system window column", KERNEL)
def first_column_only(s: Json, w: Json, system: System) -> str:
    field, window = system.field, index(s["window"], "window", MAX_WINDOW)
    z = column(field, field.vector(s["column"], system.n + system.p, "column"))
    rows = kernel_rows(w, system, window)
    conditions = annihilate(rows, system)
    meet(rows, system, w, window)
    # The row itself (shift 0) gives X_1 f + N_0 g on (g, C f, C A f, ...), shift j > 0 gives X_0 A^(j-1) f, and X_0 = 0.
    require(all((demands[-1] @ z).is_zero() for demands in conditions), "the first block column is not annihilated")
    require(not all((demand @ z).is_zero() for demands in conditions for demand in demands), "every block column is annihilated")
    return f"at window {window}, N_s annihilates the first block column of T_s(z) but not all of it, for z = {shown(s['column'])}"


MATRICES = {"observability": "", "reachability": "", "toeplitz": "window", "window": "window"}
MATRICES |= {"residual-hankel": "x0 v window", "excitation": "x0 v window"}


def named_matrix(name: str, s: Json, system: System) -> Mat:
    """The matrix of that name."""
    field, n, A = system.field, system.n, system.A
    window = index(s.get("window", 0), "window", MAX_WINDOW)
    if name in ("toeplitz", "window"):
        return window_matrix(system, window, name == "window")
    if name in ("observability", "reachability"):
        blocks, power = [], system.C if name == "observability" else system.F
        for _ in range(n):
            blocks.append(power)
            power = power @ A if name == "observability" else A @ power
        grid = [[block] for block in blocks] if name == "observability" else [blocks][:n]
        return assembled(field, grid, n if name == "observability" else n * system.m)
    x0, v = word(system, s)
    expect(window <= len(v), "window: more than there are samples")
    states, outputs = simulate(system, x0, v)
    columns = range(len(v) - window + 1)
    charge(window * len(columns))
    lines = [(outputs, i) for i in range(window)] if name == "residual-hankel" else [(states, 0), *((v, i) for i in range(window))]
    return assembled(field, [[signal[k + i] for k in columns] for signal, i in lines], len(columns))


@kind("matrix rank system window? x0? v?", f"left_null {MODULAR}")
def matrix_rank(s: Json, w: Json, system: System) -> str:
    field, name, size = system.field, s["matrix"], index(s["rank"], "rank", MAX_DIMENSION * MAX_WINDOW)
    expect(type(name) is str and name in MATRICES, "matrix: unknown name")
    keys(s, f"matrix rank system {MATRICES[name]}", "statement")
    built = named_matrix(name, s, system)
    height, rows = len(built.rows) // field.degree, list[tuple[int, Mat]]()
    for a, given in enumerate(items(w["left_null"], "left_null", height)):
        entries = field.vector(keys(given, "pivot row", f"left_null[{a}]")["row"], height, f"left_null[{a}].row", True)
        rows.append((index(given["pivot"], f"left_null[{a}].pivot", height), matrix(field, [entries], height)))
    triangular(rows, height)
    require(len(rows) == height - size, "the number of left null rows is not the number of rows minus the rank")
    require((assembled(field, [[row] for _, row in rows], height) @ built).is_zero(), "a left null row does not vanish on the matrix")
    require(rank_modulo(built, w) >= size, "the rank modulo the prime is smaller")
    window = f", window {s['window']}" if "window" in s else ""
    data = f", for the trajectory from x0 = {shown(s['x0'])} under v = {shown(s['v'])}" if "v" in s else ""
    return f"the {name} matrix{window} has rank {size}{data}"


Polynomial = list[Mat]  # a polynomial matrix by its coefficients, ascending, the last one not zero


def trimmed(coefficients: list[Mat]) -> Polynomial:
    """Without zero coefficients at the end."""
    while coefficients and coefficients[-1].is_zero():
        coefficients.pop()
    return coefficients


def polynomial(field: Field, value: Json, nr: int, nc: int, where: str) -> Polynomial:
    """A POLYMATRIX of that shape."""
    table = [[items(f, where, MAX_WINDOW) for f in items(row, where, nc, nc)] for row in items(value, where, nr, nr)]
    entries = [[field.vector(f, len(f), where) for f in row] for row in table]
    nothing, length = field.entry(0, where), max((len(f) for row in table for f in row), default=0)
    return trimmed([matrix(field, [[f[k] if k < len(f) else nothing for f in row] for row in entries], nc) for k in range(length)])


def product(*factors: Polynomial) -> Polynomial:
    """The product of polynomial matrices."""
    result = factors[0]
    for factor in factors[1:]:
        terms: list[Mat | None] = [None] * (len(result) + len(factor) - 1) if result and factor else []
        for i, a in enumerate(result):
            for j, b in enumerate(factor):
                before, term = terms[i + j], a @ b
                terms[i + j] = term if before is None else before + term
        result = trimmed([term for term in terms if term is not None])
    return result


def same(left: Polynomial, right: Polynomial) -> bool:
    """Whether two polynomial matrices of one shape are equal."""
    return len(left) == len(right) and all(a.equals(b) for a, b in zip(left, right))


def pencil(system: System) -> tuple[Mat, Mat]:
    """P(q) = constant + q slope."""
    field, n, m, p = system.field, system.n, system.m, system.p
    constant = assembled(field, [[-system.A, -system.F], [system.C, system.G]], n + m)
    return constant, assembled(field, [[identity(field, n), zero(field, n, m)], [zero(field, p, n), zero(field, p, m)]], n + m)


def nonzero_diagonal(system: System, w: Json, linear: list[Mat]) -> list[Polynomial]:
    """The nonzero diagonal entries, once left (linear[0] + linear[1] q) right is that diagonal and both multipliers are unimodular."""
    field, nr, nc = system.field, system.n + system.p, system.n + system.m
    left, left_inverse = (polynomial(field, w[name], nr, nr, name) for name in ("left", "left_inverse"))
    right, right_inverse = (polynomial(field, w[name], nc, nc, name) for name in ("right", "right_inverse"))
    require(same(product(left, left_inverse), trimmed([identity(field, nr)])), "left is not unimodular")
    require(same(product(right, right_inverse), trimmed([identity(field, nc)])), "right is not unimodular")
    diagonal = items(w["diagonal"], "diagonal", min(nr, nc), min(nr, nc))
    target = [[diagonal[i] if i == j else [] for j in range(nc)] for i in range(nr)]
    stated = polynomial(field, target, nr, nc, "diagonal")
    require(same(product(left, trimmed(linear), right), stated), "the multipliers do not give the diagonal")
    return [f for f in (polynomial(field, [[entry]], 1, 1, "diagonal") for entry in diagonal) if f]


@kind("system normal_rank invariant_zero_polynomial", DIAGONAL)
def finite_zeros(s: Json, w: Json, system: System) -> str:
    r, one = index(s["normal_rank"], "normal_rank", MAX_DIMENSION), identity(system.field, 1)
    given = items(s["invariant_zero_polynomial"], "invariant_zero_polynomial", MAX_WINDOW, 1)
    stated = polynomial(system.field, [[given]], 1, 1, "invariant_zero_polynomial")
    require(len(stated) == len(given) and stated[-1].equals(one), "the polynomial is not monic")
    nonzero = nonzero_diagonal(system, w, [*pencil(system)])
    require(len(nonzero) == system.n + r, "the number of nonzero diagonal entries is not n plus the normal rank")
    found = product([one], *nonzero)
    require(found and same(product(stated, found[-1:]), found), "the product of the diagonal is not the polynomial")
    return f"the pencil has normal rank n + {r} and invariant zero polynomial with ascending coefficients {shown(given)}"


@kind("system infinite_zero_orders", DIAGONAL)
def infinite_zeros(s: Json, w: Json, system: System) -> str:
    given = items(s["infinite_zero_orders"], "infinite_zero_orders", MAX_DIMENSION)
    orders = [index(order, "infinite_zero_orders", MAX_DIMENSION) for order in given]
    constant, slope = pencil(system)
    nonzero = nonzero_diagonal(system, w, [slope, constant])
    powers = [next(k for k, c in enumerate(f) if not c.is_zero()) for f in nonzero]
    require(sorted(power - 1 for power in powers if power) == orders, "the powers of t in the diagonal give other orders")
    return f"the infinite zeros of the pencil have the orders {orders}"


def verify(certificate: Json, systems: Iterable[Json] = ()) -> str:
    """The statement in words, once verified. Raises Malformed or Rejected. Every one of `systems` must be one of the statement's."""
    _work.set(0)
    keys(certificate, "format kind statement witness", "certificate")
    expect(certificate["format"] == "faultspace-certificate/1", "format: expected faultspace-certificate/1")
    name = certificate["kind"]
    expect(type(name) is str and name in KINDS, "kind: unknown")
    check, statement_keys, witness_keys = KINDS[name]
    s, w = keys(certificate["statement"], statement_keys, "statement"), keys(certificate["witness"], witness_keys, "witness")
    try:
        insisted = [System(data) for data in systems]
        about = [System(s[key]) for key in ("system", "inner", "outer", "first", "second") if key in s]
        alike = all(other.field.key == about[0].field.key and other.p == about[0].p for other in about)
        expect(alike, "the two systems differ in field or number of outputs")
        words = check(s, w, *about)
        assumption = "" if irreducible(about[0].field, w) else "assuming f irreducible: "
    except (RecursionError, MemoryError, OverflowError) as error:
        raise Rejected(f"checking failed: {type(error).__name__}") from None
    for system in insisted:
        require(any(system.key == other.key for other in about), f"the statement is not about {system.words}")
    return f"{assumption}{words}; for {' and '.join(system.words for system in about)}"


# -- files and the command line -----------------------------------------------------------------------------------------------------


def load(path: str) -> Json:
    """The JSON of a file, or Malformed: duplicate keys, floats, NaN, over-long numbers, too large a file."""

    def pairs(found: list[tuple[str, Json]]) -> dict[str, Json]:
        expect(len(dict(found)) == len(found), "a key stands twice")
        return dict(found)

    def integer(text: str) -> int:
        expect(INTEGER.fullmatch(text), "a number is too long")
        return int(text)

    def refuse(text: str) -> None:
        raise Malformed(f"got the number {text[:40]}, expected integers or rational strings")

    try:
        with open(path, "rb") as file:
            data = file.read(MAX_BYTES + 1)
        expect(len(data) <= MAX_BYTES, f"more than {MAX_BYTES} bytes")
        return json.loads(data.decode(), object_pairs_hook=pairs, parse_int=integer, parse_float=refuse, parse_constant=refuse)
    except OSError as error:
        raise Malformed(error.strerror or "cannot be read") from None
    except (ValueError, RecursionError, MemoryError) as error:
        raise Malformed(f"not JSON: {' '.join(str(error).split())[:80]}") from None


def sha256(certificate: Json) -> str:
    """The name of a certificate: SHA-256 over sorted keys without white space, in UTF-8."""
    text = json.dumps(certificate, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    return hashlib.sha256(text.encode(errors="surrogatepass")).hexdigest()


def judge(path: str, systems: Iterable[Json] = ()) -> dict[str, str]:
    """{"file", "result", ...}: result is verified, rejected or malformed."""
    try:
        certificate = load(path)
        words = verify(certificate, systems)
        return {"file": path, "result": "verified", "kind": certificate["kind"], "statement": words, "sha256": sha256(certificate)}
    except (Rejected, Malformed) as error:
        return {"file": path, "result": type(error).__name__.lower(), "reason": str(error)}


def main(argv: Sequence[str] | None = None) -> int:
    """Check the files; returns the exit code. Wrong arguments and a --system that does not parse end with exit code 2."""
    parser = argparse.ArgumentParser(prog="checker.py", description="Decides certificates of the format faultspace-certificate/1.")
    parser.add_argument("--json", action="store_true", help="print the results as JSON")
    parser.add_argument("--system", action="append", default=[], metavar="FILE", help="insist on statements about this system")
    parser.add_argument("certificates", nargs="+", metavar="CERTIFICATE")
    options = parser.parse_args(argv)
    systems = []
    for path in options.system:
        try:
            systems.append(load(path))
            System(systems[-1])
        except (Malformed, Rejected) as error:
            parser.error(f"{path}: {error}")
    results = [judge(path, systems) for path in options.certificates]
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")  # file names need not be text
    if options.json:
        print(json.dumps(results, indent=1))
    else:
        for result in results:
            print(f"{result['file']}: {result['result']}: {result.get('statement') or result.get('reason')}")
            if "sha256" in result:
                print(f"    {result['kind']}, SHA-256 {result['sha256']}")
    return max({"verified": 0, "rejected": 1, "malformed": 2}[result["result"]] for result in results)


if __name__ == "__main__":
    sys.exit(main())
