"""Attacks on what is said of PI-MOESP and PO-MOESP: experiments over continuous families, decided by certified population limits.

    shaped_family      n states of given poles, one input of any colour by its reflection coefficients, an independent fault
    range_attacks      the range of the limit is all of that of O_s: a change of sign of the determinant, a small singular value
    ...                one function a reading
    decided_by         an exact decision from a test on certified limits
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

from ...exact.covariances import covariances, window_covariances
from ...exact.limits import past_input_limit
from ...exact.lyapunov import solve
from ...exact.population_limits import population_limits
from ...exact.windows import observability_matrix
from .. import checker
from ..experiments_tried import LimitDossier, certificates_of, examine_experiment
from .attacks import Aim, Attack, Family, Floats, Point, Witness
from .float_limits import Drawn, determinant, exact_experiment, float_limits, least_ratio
from .spectra import shaped_input

POLE = (-0.97, 0.97)
REFLECTION = (-0.95, 0.95)

At = Callable[[Sequence[Any]], Drawn]
Fails = Callable[[LimitDossier], bool]


def decided_by(at: At, fails: Fails) -> Callable[[Point], Witness | None]:
    """The experiment at a point, its limits certified; a witness where they fail the statement."""

    def decide(point: Point) -> Witness | None:
        experiment = exact_experiment(at(point))
        dossier = examine_experiment("adversary", experiment)
        if not fails(dossier):
            return None
        certificates = tuple(certificates_of(population_limits(experiment)))
        for certificate in certificates:
            checker.verify(certificate)
        return Witness(describe(at(point), dossier), point, certificates)

    return decide


def describe(drawn: Drawn, dossier: LimitDossier) -> str:
    """The experiment for a reader."""
    e = dossier.experiment
    u, v = e.u_filter.to_json(), e.v_filter.to_json()
    rank = f"limit of rank {dossier.limit_rank}, n = {e.system.residual.n}"
    return f"{e.system.residual}, B={e.system.B}, D={e.system.D}, s = {e.s}, past = {e.past}, u = {u}, v = {v}: {rank}".replace("'", "")


def exact_determinant(at: At) -> Callable[[Point], Fraction]:
    """det M of the limit O_s M, exactly, for past nu = n."""

    def value(point: Point) -> Fraction:
        experiment = exact_experiment(at(point))
        blocks = window_covariances(experiment, covariances(experiment))
        seen = observability_matrix(experiment.system.residual, experiment.s)
        L = past_input_limit(experiment, blocks).matrix
        M = solve(seen.transposed() @ seen, seen.transposed() @ L)
        found = M.flint.det()
        return Fraction(int(found.p), int(found.q))

    return value


def float_determinant(at: At) -> Callable[[Floats], float]:
    """det M against Hadamard's bound."""
    return lambda point: determinant(float_limits(at(point)).coordinates)


def float_least_ratio(at: At) -> Callable[[Floats], float]:
    """The least singular value of M against the largest."""
    return lambda point: least_ratio(float_limits(at(point)).coordinates)


def chain(poles: Sequence[Any]) -> list[list[Any]]:
    """A companion matrix with these poles, repeated or not: (A, e_1) is controllable."""
    coefficients: list[Any] = [1]
    for pole in poles:
        coefficients = [
            (coefficients[i] if i < len(coefficients) else 0) - (pole * coefficients[i - 1] if i else 0) for i in range(len(coefficients) + 1)
        ]
    n = len(poles)
    return [[-c for c in coefficients[1:]], *([int(i == j) for j in range(n)] for i in range(n - 1))]


def shaped_family(
    n: int, s: int, past: int, reflections: int, tail: int, *, repeated: bool = False, fault: Sequence[Any] = ([[0, 1]],), words: str = ""
) -> Family:
    """Parameters: n poles (one where they are repeated), reflection coefficients, then the gain and the zeros of the rest of u.

    C = I, B = e_1; the fault enters the last state and has white noise of its own through the taps `fault`.
    """
    count = 1 if repeated else n
    box = [POLE] * count + [REFLECTION] * reflections + [REFLECTION] * (tail + 1 if tail else 0)

    def at(point: Sequence[Any]) -> Drawn:
        poles, rest = list(point[:count]) * (n if repeated else 1), point[count:]
        behind = rest[reflections:]
        u = shaped_input(rest[:reflections], behind[1:], behind[0] if tail else 0)
        unit = [[int(i == j) for j in range(n)] for i in range(n)]
        return Drawn(
            A=chain(poles),
            F=[[int(i == n - 1)] for i in range(n)],
            C=unit,
            G=[[0]] * n,
            B=[[int(i == 0)] for i in range(n)],
            D=[[0]] * n,
            s=s,
            past=past,
            u_taps=[[[x, 0]] for x in u.numerator],
            u_den=u.denominator,
            v_taps=list(fault),
        )

    text = f"n = {n}, s = {s}, past = {past}, one {f'pole {n} times' if repeated else 'real pole a state'}, C = I, B = e_1, "
    text += f"u of {reflections} reflection coefficients" + (f" and {tail} zeros behind them" if tail else "")
    return Family(text + (f", {words}" if words else ", v white and independent of u"), tuple(box), at)


DETERMINANT = "det M of the limit O_s M, against Hadamard's bound"
LEAST = "least singular value of M of the limit O_s M, against the largest"


def range_attacks(target: str, families: Sequence[tuple[str, Family]], fails: Fails) -> list[Attack]:
    """All of the range: signs of the determinant where past = n, the least singular value where past > n."""
    made = []
    for name, family in families:
        zero: Drawn = family.at([0.0] * len(family.box))
        square = zero.past * len(zero.B[0]) == len(zero.A)
        made.append(
            Attack(
                target=target,
                name=name,
                aim=Aim.SIGN if square else Aim.ZERO,
                measured=DETERMINANT if square else LEAST,
                family=family,
                quantity=float_determinant(family.at) if square else float_least_ratio(family.at),
                decide=decided_by(family.at, fails),
                exact=exact_determinant(family.at) if square else None,
            )
        )
    return made


def not_whole(d: LimitDossier) -> bool:
    """Every hypothesis of "all of the range" is met, and it is not."""
    return d.uncorrelated and d.controllable and d.observable and d.long_past and not d.equal
