"""White inputs that lead a fault, all entries indeterminate: the identities hold, and at random values B~ and D~ are the exact limits."""

from __future__ import annotations

from itertools import product
from random import Random
from typing import Any

import pytest

from faultspace.base.errors import InvalidInput
from faultspace.exact.algebra.fields import QQ
from faultspace.exact.algebra.matrices import Matrix, beside
from faultspace.exact.algebra.stability import is_stable
from faultspace.exact.limits.experiments import read_experiment
from faultspace.exact.limits.inputs import by_output_error
from faultspace.exact.limits.moesp import limit
from faultspace.exact.parametric.case_tree import evaluate
from faultspace.exact.parametric.identities import IdentityFailure
from faultspace.exact.parametric.leads import lead_identities
from faultspace.exact.system.windows import observability_matrix
from tests.exact.test_broken_on_purpose import Broken, noticed
from tests.thorough import sampled

ALL = list(product(range(3), (1, 2), range(3), (1, 2), range(3)))


@pytest.mark.parametrize("n", range(3))
def test_every_dimension(n: int) -> None:
    for dimensions in ALL:
        if dimensions[0] == n:
            found = lead_identities(*dimensions)
            _, nu, m, p, J = dimensions
            assert found.expanded == (J + 2 * (n + 1)) * p * nu + (n + 1) ** 2 * p * nu
            assert len(found.ring.gens) == n * n + n * (nu + m + p) + p * (nu + m) + (J + 1) * m * nu


def test_lead_one_by_hand() -> None:
    """With n = nu = m = p = J = 1 the inputs enter by B + F phi_0 + A F phi_1 and D + G phi_0 + C F phi_1."""
    found = lead_identities(1, 1, 1, 1, 1)
    a, b, c, d, f, g, phi0, phi1 = found.ring.gens
    assert ((b + f * phi0 + a * f * phi1,),) == found.B
    assert ((d + g * phi0 + c * f * phi1,),) == found.D


def test_without_faults_nothing_is_added() -> None:
    found = lead_identities(2, 1, 0, 1, 2)
    names = {str(g): g for g in found.ring.gens}
    assert ((names["b11"],), (names["b21"],)) == found.B and ((names["d11"],),) == found.D


def _experiment(dimensions: tuple[int, int, int, int, int], values: list[Any]) -> Any:
    """The experiment with these entries; u is delayed by J, so that v needs no lead."""
    n, nu, m, p, J = dimensions
    rest = iter(values)
    shapes = {"A": (n, n), "B": (n, nu), "C": (p, n), "D": (p, nu), "F": (n, m), "G": (p, m)}
    given: dict[str, Any] = {k: [[str(next(rest)) for _ in range(w)] for _ in range(h)] for k, (h, w) in shapes.items()}
    phi = [[[str(next(rest)) for _ in range(nu)] for _ in range(m)] for _ in range(J + 1)]
    delayed = [[["0"] * nu for _ in range(nu)]] * J + [[["1" if i == k else "0" for k in range(nu)] for i in range(nu)]]
    return read_experiment(given | {"s": n + 1, "past": n + 1, "u_filter": delayed, "v_filter": phi[::-1]})


@pytest.mark.parametrize("dimensions", [(1, 1, 1, 1, 1), (2, 1, 1, 2, 2), (2, 2, 1, 1, 1), (1, 2, 2, 2, 2), (2, 2, 2, 2, 0)], ids=str)
def test_the_exact_limits_agree(dimensions: tuple[int, int, int, int, int]) -> None:
    """At random values: the exact limit of PI-MOESP is O_s [A^n B~, ..., B~], output error tends to B~ and D~ where it is unique."""
    n, nu, _, p, _ = dimensions
    found, random, unique = lead_identities(*dimensions), Random(str(dimensions)), 0
    for _ in range(4):
        while True:
            values = [QQ.element(f"{random.randint(-4, 4)}/5") for _ in found.ring.gens]
            if is_stable(Matrix.of([values[i * n : (i + 1) * n] for i in range(n)], shape=(n, n))):
                break
        B, D = (
            Matrix.of([[evaluate(f, values) for f in row] for row in table], shape=(height, nu))
            for table, height in ((found.B, n), (found.D, p))
        )
        limits = limit(_experiment(dimensions, values))
        residual = limits.experiment.system.residual
        blocks = [B]
        for _ in range(n):
            blocks.append(residual.A @ blocks[-1])
        assert limits.past_inputs.matrix == observability_matrix(residual, n + 1) @ beside(*reversed(blocks))
        best = by_output_error(limits.known, residual.A, residual.C)
        if best is not None:
            unique += 1
            assert (best.B, best.D) == (B, D)
    assert unique


@pytest.mark.parametrize(
    ("dimensions", "message"),
    [
        ((3, 1, 1, 1, 1), "n: got 3, expected an integer from 0 to 2"),
        ((1, 0, 1, 1, 1), "nu: got 0, expected an integer from 1 to 2"),
        ((1, 1, 1, 1, 3), "J: got 3, expected an integer from 0 to 2"),
        ((1, 1, 1, True, 1), "p: got True, expected an integer from 1 to 2"),
    ],
    ids=str,
)
def test_what_is_not_covered_is_told(dimensions: tuple[Any, ...], message: str) -> None:
    with pytest.raises(InvalidInput, match=message):
        lead_identities(*dimensions)


BROKEN = {
    "the fault acts one sample late": ("_pulse_response", "t <= 0", "t < 0"),
    "the simulation forgets G": (
        "_pulse_response",
        "outputs.append(_product(G, entries[f'phi{-t}_'], nu, zero))",
        "states.append(_product(G, entries[f'phi{-t}_'], nu, zero))",
    ),
    "A^j F phi_j of one power less": (
        "_closed_form",
        "_product(powers[j], driven[j], nu, zero)",
        "_product(powers[max(j - 1, 0)], driven[j], nu, zero)",
    ),
    "C F phi_1 is forgotten": ("_closed_form", "range(1 - t, J + 1)", "range(2 - t, J + 1)"),
    "phi_0 is forgotten in B~": (
        "_closed_form",
        "(_product(powers[j], driven[j], nu, zero) for j in range(J + 1))",
        "(_product(powers[j], driven[j], nu, zero) for j in range(1, J + 1))",
    ),
    "past inputs in the wrong order": ("_covariance", "range(rows, 0, -1)", "range(1, rows + 1)"),
    "a product of entries in the wrong order": ("_pulse_response", "_product(A, state, nu, zero)", "_product([*zip(*A)], state, nu, zero)"),
}


@pytest.mark.parametrize("name", sampled(BROKEN, 4))
def test_it_is_noticed(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    function, old, new = BROKEN[name]
    dimensions = (2, 1, 2, 2, 2)  # p = n, so that what is added in the wrong place still fits
    noticed(monkeypatch, Broken(function, old, new, lead_identities, dimensions), IdentityFailure)
