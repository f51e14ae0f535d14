"""Words, delays, fault spaces and the ranks of named matrices: the third file of the checker, beside `checker.py` and `checker_fields.py`.

    python -I -O checker_structure.py [--json] [--system FILE]... CERTIFICATE...

It needs those two, which are read first, and decides their kinds and those of KINDS below, over every field. Besides them these arguments
have to be believed:

  products      Exact. Matrices are integers over one denominator, blocks over Q(a), and reduced modulo p over GF(p).
  ranks         As many independent rows that vanish on a matrix as it has rows beyond the rank bound it from above; its rank modulo a prime
                bounds it from below.
  words         What a system does from x(0) under v(0), v(1), ... is computed sample by sample.
  fault spaces  Where the rows and their shifts span the left null space of [O_s T_s], [f; g] solves problem (11) iff every row does so.
  lines         The maximal minors of the pencil at a point are binary forms of degree m. Once their multiples by the forms of degree m - 1
                span all of degree 2m - 1 modulo the prime, they do over K, and leave no common zero over any extension.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from functools import reduce
from itertools import accumulate, chain, repeat
from operator import add, mul
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

if TYPE_CHECKING or __package__:
    from . import checker as core
    from . import checker_fields as fields
else:  # alone: the files of these names in the same folder, read now; what Python may have kept of them compiled is not believed
    for name in ("checker", "checker_fields"):
        if name not in sys.modules:
            sys.modules[name] = ModuleType(name)
            sys.modules[name].__file__ = str(file := Path(__file__).with_name(f"{name}.py"))
            exec(compile(file.read_bytes(), file, "exec", dont_inherit=True), vars(sys.modules[name]))
    core, fields = sys.modules["checker"], sys.modules["checker_fields"]


class Mat(core.Table):
    """The matrix rows / den of integers over a field; an entry of K is a d x d block: rows and columns (nc) are d times those over K.

    What makes one charges for it beforehand; `size` bytes are on the meter as long as it lives.
    """

    __slots__ = ("bits", "field", "meter", "size")

    def __init__(self, field: core.Field, rows: list[list[int]], nc: int, den: int = 1) -> None:
        self.size, prime = 0, field.prime
        if prime:  # residues are below it
            rows, self.bits = [[x % prime for x in row] for row in rows], prime.bit_length()
        else:
            self.bits = max(max(map(max, rows)).bit_length(), min(map(min, rows)).bit_length()) if nc and rows else 0
        super().__init__(rows, nc, den)
        self.field = field
        size = core.room(len(rows), nc, self.bits) + den.bit_length() // 7
        self.meter = core.charge(3000 + len(rows) * (1000 + 120 * nc), size)
        self.size = size
        self.meter.held += size

    def __del__(self) -> None:
        if self.size:
            self.meter.held -= self.size

    def __matmul__(self, other: Mat) -> Mat:
        nr, nc, bits = len(self.rows), other.nc, self.bits + other.bits + self.nc.bit_length()
        long = (self.den.bit_length() * other.den.bit_length() >> 10) + (nr + nc) * (500 + self.nc * 150)
        if self.bits + other.bits < 64:  # numbers of a word: a bound for all of them is near enough
            long += 3 * nr * nc * self.nc
        else:
            core.charge(long)
            left = [sum(map(int.bit_length, column)) for column in zip(*self.rows, strict=True)] or [0] * self.nc
            right = [sum(map(int.bit_length, row)) for row in other.rows]
            long = (nc * sum(left) + nr * sum(right) >> 5) + (sum(map(mul, left, right)) >> 10)
        core.charge(nr * (1000 + nc * (400 + self.nc * 60)) + long, core.room(nr, nc, bits))
        columns = list(zip(*other.rows, strict=True)) if other.rows else [()] * nc
        return Mat(self.field, [[sum(map(mul, row, c)) for c in columns] for row in self.rows], nc, self.den * other.den)

    def __add__(self, other: Mat) -> Mat:
        den, pairs = core.common_denominator((self.den, other.den)), zip(self.rows, other.rows, strict=True)
        a, b = den // self.den, den // other.den
        bits = max(a.bit_length() + self.bits, b.bit_length() + other.bits)
        work = a.bit_length() * self.bits + b.bit_length() * other.bits
        core.charge(len(self.rows) * (1000 + self.nc * (200 + (work >> 11) + (bits >> 4))), core.room(len(self.rows), self.nc, bits + 1))
        return Mat(self.field, [[a * x + b * y for x, y in zip(r, s, strict=True)] for r, s in pairs], self.nc, den)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mat):
            return NotImplemented
        return (self.den == other.den and self.rows == other.rows) or not self + other.times(-1)

    def times(self, top: int, bottom: int = 1) -> Mat:
        """Return the matrix times top / bottom."""
        a, b = top.bit_length(), bottom.bit_length()
        core.charge(b * self.den.bit_length() >> 11)
        work = len(self.rows) * (1000 + self.nc * (100 + (a >> 4) + (a * self.bits >> 11)))
        core.charge(work, core.room(len(self.rows), self.nc, a + self.bits))
        return Mat(self.field, [[top * x for x in row] for row in self.rows], self.nc, self.den * bottom)

    def __bool__(self) -> bool:  # whether it is not zero
        return any(map(any, self.rows))

    def at(self, rows: Sequence[int], columns: Sequence[int]) -> Mat:
        """Return these rows and columns, not over Q(a)."""
        core.charge(len(rows) * (1000 + len(columns) * 100), core.room(len(rows), len(columns), self.bits))
        return Mat(self.field, [[self.rows[i][j] for j in columns] for i in rows], len(columns), self.den)

    @property
    def T(self) -> Mat:
        """The transpose, not over Q(a)."""
        core.charge(self.nc * (1000 + len(self.rows) * 100), core.room(self.nc, len(self.rows), self.bits))
        return Mat(self.field, [[row[j] for row in self.rows] for j in range(self.nc)], len(self.rows), self.den)

    def rank(self) -> int:
        """Return the rank modulo the prime, never more than the rank."""
        return len(core.echelon(self.residues(), self.field.modulus))

    def residues(self) -> core.Vectors:
        """Return the rows over K modulo the prime."""
        return self.field.residues(self.rows[:: self.field.degree], self.den)


def scalar(field: core.Field, nr: int, nc: int, value: int = 0) -> Mat:
    """Return the matrix, nr x nc over K, with the value on its diagonal: zero, or the identity."""
    nr, nc = nr * field.degree, nc * field.degree
    core.charge(nr * (1000 + nc * 120), core.room(nr, nc, value.bit_length()))
    return Mat(field, [[value * (i == j) for j in range(nc)] for i in range(nr)], nc)


def assembled(field: core.Field, grid: Sequence[Sequence[Mat]], nc: int) -> Mat:
    """The matrix with nc columns over K made of lines of blocks."""
    count = sum(map(len, grid))
    core.charge(400 * count, 40 * count)
    parts = [part for line in grid for part in line]
    bits, cells = max([part.bits for part in parts], default=0), sum([len(part.rows) * part.nc for part in parts])
    dens = {part.den for part in parts}
    den = core.common_denominator(dens)
    size = den.bit_length()
    height = sum([len(line[0].rows) for line in grid if line])
    core.charge(80 * sum([len(line[0].rows) * len(line) for line in grid if line]))  # blocks may have rows and no column
    core.charge(len(dens) * (size**2 >> 8) + cells * (200 + (size + bits >> 4) + (size * bits >> 11)), len(dens) * (80 + size // 7))
    core.charge(1500 * height, core.room(height, nc * field.degree, size + bits))
    scale = {bottom: den // bottom for bottom in dens}
    rows = [[x * scale[part.den] for part in line for x in part.rows[i]] for line in grid for i in range(len(line[0].rows))]
    return Mat(field, rows, nc * field.degree, den)


def diagonal(field: core.Field, *blocks: Mat) -> Mat:
    """The matrix with these blocks on its diagonal."""
    grid = [[b if i == j else scalar(field, len(a.rows), b.nc) for j, b in enumerate(blocks)] for i, a in enumerate(blocks)]
    return assembled(field, grid, sum(block.nc for block in blocks))


def matrix(field: core.Field, value: core.Json, nr: int, nc: int, where: str) -> Mat:
    """Return a MATRIX of that shape."""
    found = field.matrix(value, nr, nc, where)
    return Mat(field, found.rows, found.nc, found.den)


def columns(field: core.Field, value: core.Json, size: int, where: str, most: int = core.MAX_WINDOW, least: int = 0) -> list[Mat]:
    """Return a list of VECTORs, as columns."""
    vectors = core.items(value, where, most, least)
    return [matrix(field, [[x] for x in core.items(vector, where, size, size)], size, 1, where) for vector in vectors]


def ranked(built: Mat, size: int, left_null: core.Json) -> None:
    """Reject unless the matrix has that rank: no more by the rows that vanish on it, no less modulo the prime."""
    field, pivots, rows = built.field, list[int](), list[core.Vectors]()
    height = len(built.rows) // field.degree
    for a, row in enumerate(core.items(left_null, "row", max(height, core.MAX_DIMENSION))):
        core.keys(row, "pivot row", f"row {a}")
        core.charge(3000 + height * field.degree * 500, height * field.degree * 48)
        rows.append([field.integers(row["row"], height, f"row {a}")])
        pivots.append(core.index(row["pivot"], f"row {a}: pivot"))
        core.require(pivots[-1] < height, "a pivot is out of range")
    fields.triangular(field, pivots, rows)
    core.require(len(rows) == height - size, "the number of left null rows is not the number of rows minus the rank")
    core.require(not Mat(field, [row for (row,) in rows], len(built.rows)) @ built, "a left null row does not vanish on the matrix")
    core.require(built.rank() >= size, "the rank modulo the prime is smaller")


def binary_form(rows: list[list[int]], prime: int) -> list[int]:
    """Return det(a X + b Y) modulo a prime from the m rows of [X Y]: the coefficients of a^m, a^(m-1) b, ..., b^m."""
    m, minors = len(rows), {0: [1]}  # the minors of the rows so far by their columns, as the bits of a number
    core.charge((1000 + 100 * m) * (m + 1) << m, (400 + 50 * m) << m)
    for row in rows:
        larger = dict[int, list[int]]()
        for columns, f in minors.items():
            for j in (j for j in range(m) if not columns >> j & 1):
                x, y = (-c if (columns >> j).bit_count() % 2 else c for c in (row[j], row[m + j]))
                terms = zip(larger.get(columns | 1 << j, repeat(0)), [*f, 0], [0, *f], strict=False)
                larger[columns | 1 << j] = [(old + x * c + y * d) % prime for old, c, d in terms]
        minors = larger
    return minors[2**m - 1]


class System(fields.System):
    """A SYSTEM with matrices that can be multiplied."""

    A: Mat
    F: Mat
    C: Mat
    G: Mat
    inputs: Sequence[Mat]
    powers: list[Mat] | None = None  # C A^k and the Markov parameters, which the windows of several certificates need
    markov: list[Mat] | None = None
    walk: tuple[str, tuple[list[Mat], list[Mat], list[Mat]]] = "", ([], [], [])  # the word of x0 and v that the last certificate was about

    def block(self, value: core.Json, nr: int, nc: int, where: str) -> Mat:
        return matrix(self.field, value, nr, nc, where)

    def nulled(self, given: core.Json) -> tuple[int, int]:
        """Return the numbers d of states and e of the faults beyond, of "nulling": independent ones that are seen to have no output.

        For the i-th state x, or x = 0 from d on, and the i-th fault v, exactly C x + G v = 0, and A x + F v is the sum of the states with
        the i-th row of "motion" as weights. So from each of d states, and after each sample by e faults besides, a word goes on for ever
        with zero output: d + e s words of s samples, which are independent as the states are, and these faults. All n + p equations of
        a row stand in one number, in slots of w bits: none of their sides is above 2^(w-1), so that it is zero iff all of them hold.
        """
        field, n, m = self.field, self.n, self.m
        core.expect(field.degree == 1 and not field.prime, "nulling: over Q only")
        core.keys(given, "states faults motion", "nulling")
        d, count = len(core.items(given["states"], "states", n)), len(core.items(given["faults"], "faults", n + m))
        core.expect(d <= count <= d + m, "nulling: expected a fault for each of the states, and m more at most")
        sides = (("states", d, n), ("faults", count, m), ("motion", count, d))
        V, K, L = (matrix(field, given[key], height, width, key) for key, height, width in sides)
        den = core.common_denominator(part.den for part in (self.A, self.C, self.F, self.G))
        A, C, F, G = (part if part.den == den else part.times(den // part.den) for part in (self.A, self.C, self.F, self.G))
        state, fault, moved = K.den * L.den, V.den * L.den, den * K.den  # what each is to be multiplied by
        sizes = [part.bits + factor.bit_length() for part, factor in ((V, state), (K, fault), (L, moved))]
        w = max(max(sizes[:2]) + max(A.bits, C.bits, F.bits, G.bits), sizes[2] + V.bits) + (n + m + d).bit_length() + 1
        height, cells = n + self.p, (n + self.p) * (n + m) + count * (n + m + d)
        core.charge(cells * (400 + (max(sizes) >> 4)), cells * (60 + max(sizes) // 7) + (n + m + d + height) * w * height // 7)
        core.charge(count * (n + m + d) * (200 + (w * height * (1 + (max(sizes) >> 5)) >> 6)))
        places = [1 << w * i for i in range(height)]
        columns = [*zip(*A.rows, *C.rows, strict=True), *zip(*F.rows, *G.rows, strict=True)]
        table, carried = ([sum(map(mul, line, places)) for line in lines] for lines in (columns, V.rows))
        blank = [0] * n
        for i in range(count):
            weights = [state * x for x in (V.rows[i] if i < d else blank)] + [fault * x for x in K.rows[i]]
            left = sum(map(mul, weights, table)) - moved * sum(map(mul, L.rows[i], carried))
            core.require(left == 0, "a state or fault of nulling has an output, or leaves the states")
        core.require(V.rank() == d, "the states of nulling may be dependent")
        beyond = Mat(field, K.rows[d:], m, K.den)
        core.require(beyond.rank() == count - d, "the faults of nulling may be dependent")
        return d, count - d

    def null_rows(self, w: core.Json, window: int | None) -> list[core.Vectors]:
        """Return KROWS, those of degree below any window: they and their shifts span the left null space of [O_s T_s]."""
        pivots, rows = self.field.kernel_rows(w["kernel"], self.p)
        self.spanned_by(pivots, rows, w, window)
        return [row for row in rows if window is None or len(row) <= window]

    def window(self, s: int, states: bool = True, faults: bool = True) -> Mat:
        """Return [O_s T_s], or one of the two."""
        core.charge(400 * s * s, 40 * s * s)
        powers, markov, blank = self.powers or [self.C], self.markov or [self.G], scalar(self.field, self.p, self.m)
        while len(powers) < s:
            powers.append(powers[-1] @ self.A)
        while faults and len(markov) < s:
            markov.append(powers[len(markov) - 1] @ self.F)
        self.powers, self.markov = powers, markov
        grid = [[powers[i]] * states + [markov[i - j] if j <= i else blank for j in range(s * faults)] for i in range(s)]
        return assembled(self.field, grid, self.n * states + self.m * s * faults)

    def word(self, value: core.Json, samples: int | None = None) -> tuple[list[Mat], list[Mat], list[Mat]]:
        """States x(0..N), faults v(0..N-1), outputs r(0..N-1) of an object with x0 and v, where N is the number of samples if given."""
        states, most = columns(self.field, [value["x0"]], self.n, "x0"), core.MAX_WINDOW if samples is None else samples
        faults = columns(self.field, value["v"], self.m, "v", most, samples or 0)
        for fault in faults:
            states.append(self.A @ states[-1] + self.F @ fault)
        return states, faults, [self.C @ x + self.G @ v for x, v in zip(states, faults, strict=False)]

    def not_left_invertible(self, s: core.Json, w: core.Json) -> None:
        field, n, m = self.field, self.n, self.m
        xs = columns(field, w["state"], n, "state", core.MAX_WINDOW, 1)
        vs = columns(field, w["fault"], m, "fault", len(xs), len(xs))
        core.require(any(xs + vs), "the null vector is zero")
        for shifted, x, v in zip([scalar(field, n, 1), *xs], [*xs, scalar(field, n, 1)], [*vs, scalar(field, m, 1)], strict=True):
            core.require(shifted == self.A @ x + self.F @ v, "(qI - A) x(q) = F v(q) fails")
            core.require(not self.C @ x + self.G @ v, "C x(q) + G v(q) = 0 fails")

    def inversion_delay(self, s: core.Json, w: core.Json) -> None:
        field, n, m, p, known = self.field, self.n, self.m, self.p, s["initial_state"] == "known"
        delay = None if s["delay"] is None else core.index(s["delay"], "delay")
        core.expect(known or s["initial_state"] == "unknown", "initial_state: expected known or unknown")
        parts = ("inverse" in w) == (delay is not None) and ("word" in w) == (delay != 0)
        core.expect(parts, "witness: no inverse with null, no word with 0")
        if delay is not None:
            core.require(delay <= n, "the delay is above n")
            given = matrix(field, w["inverse"], m, p * (delay + 1), "inverse") @ self.window(delay + 1, states=not known)
            wanted = [scalar(field, m, 0 if known else n), scalar(field, m, m, 1), scalar(field, m, m * delay)]
            core.require(given == assembled(field, [wanted], given.nc // field.degree), "the left inverse does not give v(0)")
        if delay != 0:
            states, faults, outputs = self.word(core.keys(w["word"], "x0 v", "word"), n + 1 if delay is None else delay)
            core.require(faults[0], "v(0) of the ambiguous word is zero")
            core.require(not (known and states[0]), "x(0) of the ambiguous word is not zero")
            core.require(not any(outputs), "the output of the ambiguous word is not zero")

    def behaviour_difference(self, s: core.Json, w: core.Json, second: core.System) -> None:
        window = core.index(s["window"], "window", core.MAX_WINDOW)
        row = [matrix(self.field, [c], 1, self.p, "row") for c in core.items(w["row"], "row", window, 1)]
        joined = assembled(self.field, [row], self.p * len(row))  # over one denominator, which plays no part
        width = self.p * self.field.degree
        second.annihilated_by([[joined.rows[0][k : k + width] for k in range(0, joined.nc, width)]] if joined.rows else [])
        core.require(reduce(add, map(Mat.__matmul__, row, self.word(w, window)[2])), "the word satisfies the row")

    def fault_space(self, s: core.Json, w: core.Json) -> None:
        field, d, width = self.field, self.field.degree, self.n + self.p
        window = None if s["window"] is None else core.index(s["window"], "window", core.MAX_WINDOW)
        size = len(core.items(s["basis"], "basis", width))
        basis = matrix(field, s["basis"], size, width, "basis")
        pivots = [next((j // d for j, x in enumerate(row) if x), width) for row in basis.rows[::d]]
        core.require(pivots == sorted({*pivots} - {width}), "the basis is not in row echelon form")
        unit = Mat(field, [[row[j * d + c] for j in pivots for c in range(d)] for row in basis.rows], size * d, basis.den)
        core.require(unit == scalar(field, size, size, 1), "the basis is not in reduced row echelon form")
        rows = self.null_rows(w, window)
        lines = [[row[j] for row in s["basis"]] for j in range(width)]
        F, G = matrix(field, lines[: self.n], self.n, size, "basis"), matrix(field, lines[self.n :], self.p, size, "basis")
        core.require(not any(field.seen(self, rows, F, G)), "a basis column does not solve problem (11)")
        conditions, _ = self.conditions([field.residues(row) for row in rows])
        rank = len(core.echelon(chain.from_iterable(conditions), field.modulus))
        core.require(rank == width - size, "there are more solutions than the basis spans")

    def first_column_only(self, s: core.Json, w: core.Json) -> None:
        field, window, width = self.field, core.index(s["window"], "window", core.MAX_WINDOW), self.n + self.p
        column = [[x] for x in core.items(s["column"], "column", width, width)]
        F, G = matrix(field, column[: self.n], self.n, 1, "column"), matrix(field, column[self.n :], self.p, 1, "column")
        _, first, *later = [*field.seen(self, self.null_rows(w, window), F, G), False]
        # Shift 0 of a row gives X_1 f + N_0 g on (g, C f, C A f, ...), shift j > 0 gives X_0 A^(j-1) f, and X_0 = 0.
        core.require(not first, "the first block column is not annihilated")
        core.require(any(later), "every block column is annihilated")

    def matrix_rank(self, s: core.Json, w: core.Json) -> None:
        field, n, name, size = self.field, self.n, s["matrix"], core.index(s["rank"], "rank")
        core.expect(type(name) is str and name in MATRICES, "matrix: unknown name")
        given = core.keys(s, f"matrix rank system {MATRICES[name]}", "statement")
        window = core.index(given.get("window", 0), "window", core.MAX_WINDOW)
        if name == "observability":
            built = self.window(n, faults=False)
        elif name == "reachability":
            blocks = [*accumulate(repeat(self.A, n), lambda block, A: A @ block, initial=self.F)]
            built = assembled(field, [blocks[:n]][:n], n * self.m)
        elif name in ("toeplitz", "window"):
            built = self.window(window, states=name == "window")
        else:
            text = json.dumps([s["x0"], s["v"]])  # equal texts are equal JSON, down to 1 and true
            if text != self.walk[0]:
                self.walk = text, self.word(s)
            states, faults, outputs = self.walk[1]
            core.expect(window <= len(faults), "window: more than there are samples")
            width = len(faults) - window + 1
            signals = [outputs] * window if name == "residual-hankel" else [states] + [faults] * window
            delays = range(window) if name == "residual-hankel" else [0, *range(window)]
            core.charge(400 * window * width, 40 * window * width)
            built = assembled(field, [signal[i : i + width] for signal, i in zip(signals, delays, strict=True)], width)
        ranked(built, size, w["left_null"])


def left_invertible_line(system: System, s: core.Json, w: core.Json, second: System) -> None:
    n, m, prime, multiples = system.n, system.m, system.field.modulus, list[list[int]]()
    alike = (n, m) == (second.n, second.m) and [system.A, system.C] == [second.A, second.C]
    core.expect(alike, "the two systems differ in A, C or number of faults")
    table = assembled(system.field, [[system.A, system.F, second.F], [system.C, system.G, second.G]], n + 2 * m).residues()
    for minor in core.items(w["minors"], "minors"):
        q = core.index(core.keys(minor, "point rows", "minor")["point"], "point", prime - 1)
        rows = [core.index(i, "rows", n + system.p - 1) for i in core.items(minor["rows"], "rows", n + m, n + m)]
        core.expect(rows == sorted({*rows}), "rows: they do not ascend")
        core.charge(20000 + len(rows) * (n + 2 * m) * 300, (2 * m + len(multiples)) * m * 100)
        pencil = ([(x - q * (i == j < n)) % prime for j, x in enumerate(table[i])] for i in rows)  # up to the sign of its first n rows
        form = core.echelon(pencil, prime)
        rest = [row[n:] for pivot, row in form if pivot >= n]  # what is left to do once the columns of the state are eliminated
        if len(rest) == m == len(form) - n:  # else the minor is zero
            core.charge(m * m * 100)
            multiples += [[0] * j + binary_form(rest, prime) + [0] * (m - 1 - j) for j in range(m)]
    core.require(len(core.echelon(multiples, prime)) == 2 * m, "the minors may have a common zero")


MATRICES = {"observability": "", "reachability": "", "toeplitz": "window", "window": "window"}  # what is stated beside the system
MATRICES |= {"residual-hankel": "x0 v window", "excitation": "x0 v window"}
KINDS: dict[str, core.Kind] = {
    "not-left-invertible": core.Kind(System.not_left_invertible, "system", "state fault",
        "not left-invertible: x(0) = 0 and some v other than 0 give zero output for ever",
        "Read from the highest power down it is a fault from x(0) = 0 with zero output, at rest afterwards; v = 0 would make x zero too."),
    "inversion-delay": core.Kind(System.inversion_delay, "system initial_state delay", "inverse? word?",
        "with x(0) {initial_state} (known: 0), the least l in 0..n such that r(0..l) determines v(0) is {delay} (null: there is none)",
        "The inverse computes v(0) from r(0..l); the word has zero output on one sample less (null: on n + 1) and v(0) other than 0."),
    "behaviour-difference": core.Kind(System.behaviour_difference, "first second window", "x0 v row",
        "some word of {window} samples of the first is not one of the second",
        "The row vanishes on every word of the second, and not on this one of the first."),
    "fault-space": core.Kind(System.fault_space, "system window basis", core.HINTED,
        "at window {window} (null: beyond all left minimal indices) the solutions [f; g] of problem (11) are the span of {basis}",
        "The rows and their shifts span N_s, so the conditions are all there are; the basis solves them, and their rank modulo the prime "
        "leaves no room for more."),
    "first-column-only": core.Kind(System.first_column_only, "system window column", core.HINTED,
        "at window {window}, N_s annihilates the first block column of T_s(z) but not all of it, for z = {column}",
        "The rows and their shifts span N_s; on the first block column the conditions X_1 f + N_0 g are all that differ from zero ones."),
    "matrix-rank": core.Kind(System.matrix_rank, "matrix rank system window? x0? v?", f"{core.MODULAR} left_null",
        "the {matrix} matrix has rank {rank}",
        "As many independent rows vanish on the matrix as its rows exceed the rank, and modulo the prime the rank is no smaller."),
    "left-invertible-line": core.Kind(left_invertible_line, "first second", f"{core.MODULAR} minors",
        "left-invertible with faults a F + b F' and a G + b G' for every (a : b) over every extension of the field",
        "A common zero (a : b) of the minors would be one of all forms of degree 2m - 1, among them a^(2m-1) and b^(2m-1)."),
}  # fmt: skip
core.KINDS.update(KINDS)
core.SUBJECTS |= dict.fromkeys(core.SUBJECTS, System)

if __name__ == "__main__":
    sys.exit(core.run())
