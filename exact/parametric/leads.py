"""This takes white u and v(k) = sum_(j=0..J) phi_j u(k+j), every entry of A, B, C, D, F, G and phi_j an indeterminate: what past inputs
see.

    lead_identities   the response to a pulse of u, simulated in sympy's ring, against its closed form, multiplied out by FLINT
    LeadIdentities    the B and D that are seen, and how much was multiplied out
    LARGEST           the largest n, nu, m, p, J

x+ = A x + B u + F v, y = C x + D u + G v. To a unit pulse of u at time 0, x(-J) = 0, the outputs answer

    y(t) = G phi_(-t) + sum_(j > -t) C A^(j+t-1) F phi_j   for -J <= t < 0,
    y(0) = D~ = D + G phi_0 + sum_(j >= 1) C A^(j-1) F phi_j,
    y(t) = C A^(t-1) B~ for t >= 1,   B~ = B + sum_j A^j F phi_j.

As u is white of unit covariance, Cov(y(k+t), u(k)) = y(t). So Cov(Yf, Up) = O_s [A^(past-1) B~, ..., A B~, B~], which is the limit of
PI-MOESP, since Cov(Uf, Up) = 0; and from t = 0 on y(t) is the response of (A, B~, C, D~), which therefore is what the least mean square
of y - G(q) u gives with the true A, C. Checked for s = past = n + 1 block rows; beyond, each row follows from x(1) = B~. Source: [V93].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ..algebra.validation import natural
from .case_tree import Polynomial, Ring
from .identities import SecondRoute, read_back

LARGEST = (2, 2, 2, 2, 2)

# Rows of polynomials, of sympy or of FLINT.
Table = Sequence[Sequence[Any]]


@dataclass(frozen=True)
class LeadIdentities:
    """`B` (n x nu) and `D` (p x nu) are B~ and D~ over `ring`, its generators the entries of A, B, C, D, F, G, phi_0, ..., phi_J by rows.

    expanded: identities that FLINT multiplied out.
    """

    ring: Ring
    B: tuple[tuple[Polynomial, ...], ...]
    D: tuple[tuple[Polynomial, ...], ...]
    expanded: int


def lead_identities(n: int, nu: int, m: int, p: int, J: int) -> LeadIdentities:
    """This expands all identities of the module's docstring at n, m, J from 0 to 2 and nu, p from 1 to 2.

    Raises InvalidInput for other dimensions, IdentityFailure at the first identity that does not hold.
    """
    for name, value, least, most in zip(("n", "nu", "m", "p", "J"), (n, nu, m, p, J), (0, 1, 0, 1, 0), LARGEST, strict=True):
        natural(value, name, least=least, most=most)
    shapes = {"a": (n, n), "b": (n, nu), "c": (p, n), "d": (p, nu), "f": (n, m), "g": (p, m)}
    shapes |= {f"phi{j}_": (m, nu) for j in range(J + 1)}
    names = [f"{letter}{i + 1}{k + 1}" for letter, (h, w) in shapes.items() for i in range(h) for k in range(w)]
    from sympy import ZZ  # here, where it is needed
    from sympy.polys.rings import ring as polynomial_ring

    ring, *_ = polynomial_ring(names, ZZ)
    rows = n + 1
    response = _pulse_response(_entries(ring.gens, shapes), ring, J, 2 * rows)

    route = SecondRoute(ring)
    entries = _entries([route.generator(name) for name in names], shapes)
    zero, one = route.context.constant(0), route.context.constant(1)
    powers = [[[one if i == k else zero for k in range(n)] for i in range(n)]]
    for _ in range(max(J, 2 * rows)):
        powers.append(_product(entries["a"], powers[-1], n, zero))
    early, seen_B, seen_D = _closed_form(entries, powers, J, zero)
    for t, block in enumerate(early, -J):
        _compare(route, response[t], block, f"y({t})")
    _compare(route, response[0], seen_D, "y(0)")
    for t in range(1, 2 * rows):
        _compare(route, response[t], _product(_product(entries["c"], powers[t - 1], n, zero), seen_B, nu, zero), f"y({t})")
    observability = [line for power in powers[:rows] for line in _product(entries["c"], power, n, zero)]
    reached = [_product(power, seen_B, nu, zero) for power in powers[:rows]]
    columns = [[x for block in reversed(reached) for x in block[i]] for i in range(n)]
    _compare(route, _covariance(response, rows), _product(observability, columns, rows * nu, zero), "Cov(Yf, Up)")

    B, D = (tuple(tuple(read_back(ring, f) for f in row) for row in table) for table in (seen_B, seen_D))
    return LeadIdentities(ring, B, D, route.expanded)


def _pulse_response(entries: dict[str, Table], ring: Ring, J: int, end: int) -> dict[int, Table]:
    """Return y(t), -J <= t < end, p x nu: one column for a pulse in each input, by stepping through time."""
    A, B, C, D, F, G = (entries[letter] for letter in "abcdfg")
    n, nu, zero = len(A), len(D[0]), ring.zero
    state: Table = [[zero] * nu for _ in range(n)]
    result: dict[int, Table] = {}
    for t in range(-J, end):
        outputs: list[Table] = [_product(C, state, nu, zero)]
        states: list[Table] = [_product(A, state, nu, zero)]
        if t <= 0:  # v(t) = phi_(-t) u(0)
            outputs.append(_product(G, entries[f"phi{-t}_"], nu, zero))
            states.append(_product(F, entries[f"phi{-t}_"], nu, zero))
        if t == 0:
            outputs.append(D)
            states.append(B)
        result[t] = _sum(outputs)
        state = _sum(states)
    return result


def _closed_form(entries: dict[str, Table], powers: Sequence[Table], J: int, zero: Any) -> tuple[list[Table], Table, Table]:
    """Return y(-J), ..., y(-1), then B~ and D~, from powers of A."""
    C, D, G = entries["c"], entries["d"], entries["g"]
    n, nu = len(entries["a"]), len(D[0])
    driven = [_product(entries["f"], entries[f"phi{j}_"], nu, zero) for j in range(J + 1)]

    def fault_alone(t: int) -> Table:
        later = [_product(_product(C, powers[j + t - 1], n, zero), driven[j], nu, zero) for j in range(1 - t, J + 1)]
        return _sum([_product(G, entries[f"phi{-t}_"], nu, zero), *later])

    seen_B = _sum([entries["b"], *(_product(powers[j], driven[j], nu, zero) for j in range(J + 1))])
    return [fault_alone(t) for t in range(-J, 0)], seen_B, _sum([D, fault_alone(0)])


def _covariance(response: dict[int, Table], rows: int) -> Table:
    """Return Cov(Yf, Up) of s = past = rows: block (i, l) is Cov(y(k+i), u(k-past+l)) = y(i + past - l)."""
    p = len(response[0])
    return [[x for lag in range(rows, 0, -1) for x in response[i + lag][line]] for i in range(rows) for line in range(p)]


def _compare(route: SecondRoute, found: Table, expanded: Table, what: str) -> None:
    """Entry by entry, sympy's polynomial must be FLINT's."""
    for left, right in zip(found, expanded, strict=True):
        for f, g in zip(left, right, strict=True):
            route.equal(route(f), g, what)


def _entries(generators: Sequence[Any], shapes: dict[str, tuple[int, int]]) -> dict[str, Table]:
    rest = iter(generators)
    return {letter: [[next(rest) for _ in range(w)] for _ in range(h)] for letter, (h, w) in shapes.items()}


def _product(left: Table, right: Table, width: int, zero: Any) -> list[list[Any]]:
    """Return the matrix product; `width` columns, also where the inner dimension is 0."""
    return [[sum((x * line[k] for x, line in zip(row, right, strict=True)), zero) for k in range(width)] for row in left]


def _sum(tables: Sequence[Table]) -> list[list[Any]]:
    result = [list(row) for row in tables[0]]
    for table in tables[1:]:
        result = [[x + y for x, y in zip(left, right, strict=True)] for left, right in zip(result, table, strict=True)]
    return result
