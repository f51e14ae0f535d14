"""Families of experiments, and how a point of one is decided: by certified population limits.

shaped_family      n states of given poles, one input of any colour by its reflection coefficients, an independent fault
led_family         a fault that leads the input, or comes with it
open_family        every matrix of the system free, u and v independent
decided_by         an exact decision from a test on certified limits
shaped_input       a Shaped, numerator and denominator of a scalar filter ascending in lag: from reflection coefficients k_1, ..., k_N and
                   the zeros and gain of the Schur function that remains after them

Every value of the reflection coefficients in (-1, 1) gives a stationary input with a rational filter.
With z = q^-1 the spectrum of u is (1 - |f|^2) / |1 - z f|^2 for a Schur function f, and f is k_1, ..., k_N followed by what remains, by
f_(i-1) = (k_i + z f_i) / (1 + k_i z f_i). Written f_i = p_i / q_i this is p_(i-1) = k_i q_i + z p_i, q_(i-1) = q_i + k_i z p_i, and
|q|^2 - |p|^2 only changes by the factor 1 - k_i^2. What remains is a gain c times a Blaschke product of real zeros b: with |c| < 1 the
spectrum has the factor (1 - b z) ... over 1 - z f, and u = that filter of white noise, up to scale. gain 0: autoregressive of order N.
The covariances of u up to lag i depend on k_1, ..., k_i alone. Source: [S17].
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ...exact.limits.column_space import past_input_limit
from ...exact.limits.lyapunov import solve
from ...exact.limits.moesp import limit
from ...exact.limits.moments import covariances, window_covariances
from ...exact.system.windows import observability_matrix
from ..evidence.attacks import Family, Point, Witness
from ..evidence.experiments import LimitEvidence, examine_experiment
from ..trust.limit_certificates import certificates_of
from .float_limits import Drawn, exact_experiment
from .structure_families import cut
from .witnesses import confirmed

POLE = (-0.97, 0.97)
REFLECTION = (-0.95, 0.95)

At = Callable[[Sequence[Any]], Drawn]
Fails = Callable[[LimitEvidence], bool]


def decided_by(at: At, fails: Fails) -> Callable[[Point], Witness | None]:
    """Return the exact decision: the experiment at a point, its limits certified, and a witness where they fail the statement."""

    def decide(point: Point) -> Witness | None:
        experiment = exact_experiment(at(point))
        evidence = examine_experiment("adversary", experiment)
        if not fails(evidence):
            return None
        return confirmed(describe(at(point), evidence), point, certificates_of(limit(experiment)))

    return decide


def describe(drawn: Drawn, evidence: LimitEvidence) -> str:
    """Return the experiment in words, for a reader."""
    e = evidence.experiment
    u, v = e.u_filter.to_json(), e.v_filter.to_json()
    rank = f"limit of rank {evidence.limit_rank}, n = {e.system.residual.n}"
    return f"{e.system.residual}, B={e.system.B}, D={e.system.D}, s = {e.s}, past = {e.past}, u = {u}, v = {v}: {rank}".replace("'", "")


def exact_determinant(at: At) -> Callable[[Point], Fraction]:
    """Return a function of a point: det M of the limit O_s M, exactly, for past nu = n."""

    def value(point: Point) -> Fraction:
        experiment = exact_experiment(at(point))
        blocks = window_covariances(experiment, covariances(experiment))
        seen = observability_matrix(experiment.system.residual, experiment.s)
        L = past_input_limit(experiment, blocks).matrix
        M = solve(seen.transposed() @ seen, seen.transposed() @ L)
        found = M.flint.det()
        return Fraction(int(found.p), int(found.q))

    return value


def chain(poles: Sequence[Any]) -> list[list[Any]]:
    """Return a companion matrix with these poles, repeated or not: (A, e_1) is controllable."""
    coefficients: list[Any] = [1]
    for pole in poles:
        coefficients = [
            (coefficients[i] if i < len(coefficients) else 0) - (pole * coefficients[i - 1] if i else 0)
            for i in range(len(coefficients) + 1)
        ]
    n = len(poles)
    return [[-c for c in coefficients[1:]], *([int(i == j) for j in range(n)] for i in range(n - 1))]


def chained(poles: Sequence[Any], s: int, past: int, u: Shaped, fault: Sequence[Any]) -> Drawn:
    """Return an experiment on the companion matrix of these poles: C = I, B = e_1, and the fault enters the last state, with white noise
    of its own through the taps `fault`."""
    n = len(poles)
    return Drawn(
        A=chain(poles),
        F=[[int(i == n - 1)] for i in range(n)],
        C=[[int(i == j) for j in range(n)] for i in range(n)],
        G=[[0]] * n,
        B=[[int(i == 0)] for i in range(n)],
        D=[[0]] * n,
        s=s,
        past=past,
        u_taps=[[[x, 0]] for x in u.numerator],
        u_den=u.denominator,
        v_taps=list(fault),
    )


def shaped_family(
    n: int, s: int, past: int, reflections: int, tail: int, *, repeated: bool = False, fault: Sequence[Any] = ([[0, 1]],), words: str = ""
) -> Family:
    """Return a family of `chained` experiments. The parameters are n poles (one where they are repeated), the reflection coefficients of
    u, then the gain and the zeros of the rest of u."""
    count = 1 if repeated else n
    box = [POLE] * count + [REFLECTION] * reflections + [REFLECTION] * (tail + 1 if tail else 0)

    def at(point: Sequence[Any]) -> Drawn:
        poles, rest = list(point[:count]) * (n if repeated else 1), point[count:]
        behind = rest[reflections:]
        return chained(poles, s, past, shaped_input(rest[:reflections], behind[1:], behind[0] if tail else 0), fault)

    order = (*reversed(range(count, count + reflections)), *range(count + reflections, len(box)))
    text = f"n = {n}, s = {s}, past = {past}, one {f'pole {n} times' if repeated else 'real pole a state'}, C = I, B = e_1, "
    text += f"u of {reflections} reflection coefficients" + (f" and {tail} zeros behind them" if tail else "")
    return Family(text + (f", {words}" if words else ", v white and independent of u"), tuple(box), at, order)


def moving_average_family(n: int, s: int, past: int, order: int) -> Family:
    """Return a family of `chained` experiments. The parameters are one pole, taken n times, and the taps of u beyond the first."""

    def at(point: Sequence[Any]) -> Drawn:
        return chained([point[0]] * n, s, past, Shaped((1, *point[1:]), (1,)), ([[0, 1]],))

    words = f"n = {n}, s = {s}, past = {past}, one pole {n} times, C = I, B = e_1, u a moving average of order {order}, v white of its own"
    return Family(words, (POLE, *[(-2.0, 2.0)] * order), at)


def led_family(n: int, p: int, phi: Sequence[int], *, reflections: int = 0, taps: int = 0, past: int | None = None) -> Family:
    """Return a family with v(k) = sum_j phi_j u(k+j), F = e_1, D = 0 and s = n + 1. The parameters are n poles, C, B, G, then the
    reflection coefficients or the taps of u."""
    box = [POLE] * n + [(-2.0, 2.0)] * (p * n + n + p) + [REFLECTION] * reflections + [(-0.9, 0.9)] * taps
    lead = len(phi) - 1

    def at(point: Sequence[Any]) -> Drawn:
        (poles,), C, B, G, values = cut(point, (1, n), (p, n), (n, 1), (p, 1))
        u = shaped_input(values[:reflections])
        numerator = [*u.numerator, *values[reflections:]] if taps else list(u.numerator)
        fault: list[Any] = [0] * (len(numerator) + lead)
        for j, weight in enumerate(phi):
            for i, x in enumerate(numerator):
                fault[i + lead - j] = fault[i + lead - j] + weight * x
        return Drawn(
            A=chain(poles),
            F=[[int(i == 0)] for i in range(n)],
            C=C,
            G=G,
            B=B,
            D=[[0]] * p,
            s=n + 1,
            past=past or n + 1,
            u_taps=[[[0]]] * lead + [[[x]] for x in numerator],
            u_den=u.denominator,
            v_taps=[[[x]] for x in fault],
            v_den=u.denominator,
        )

    colour = f"u autoregressive of order {reflections}" if reflections else f"u a moving average of order {taps}" if taps else "u white"
    led = " + ".join(f"{w} u(k+{j})" for j, w in enumerate(phi) if w)
    words = f"n = {n}, p = {p}, s = {n + 1}, past = {past or n + 1}, F = e_1, G free, {colour}, v(k) = {led}"
    return Family(words, tuple(box), at)


def open_family(n: int, p: int) -> Family:
    """Return a family with one u, white, and one v, coloured and independent of it. The parameters are n poles, C, F, G, B; then a tap and
    a pole of v."""
    box = [POLE] * n + [(-2.0, 2.0)] * (p * n + n + p + n) + [(-0.9, 0.9)] * 2

    def at(point: Sequence[Any]) -> Drawn:
        (poles,), C, F, G, B, (v_tap, v_pole) = cut(point, (1, n), (p, n), (n, 1), (p, 1), (n, 1))
        return Drawn(
            A=chain(poles),
            F=F,
            C=C,
            G=G,
            B=B,
            D=[[1]] * p,
            s=n + 1,
            past=n,
            u_taps=[[[1, 0]]],
            u_den=(1,),
            v_taps=[[[0, 1]], [[0, v_tap]]],
            v_den=(1, -v_pole),
        )

    words = f"n = {n}, p = {p}, s = {n + 1}, past = {n}, all matrices free, white u, coloured v of its own noise"
    return Family(words, tuple(box), at)


@dataclass(frozen=True)
class Shaped:
    """A filter makes u = (sum numerator_j q^-j / sum denominator_j q^-j) e; the denominator begins with 1 and is Schur-stable."""

    numerator: tuple[Any, ...]
    denominator: tuple[Any, ...]


def shaped_input(coefficients: Sequence[Any], zeros: Sequence[Any] = (), gain: Any = 0) -> Shaped:
    """Return the input with these reflection coefficients, each in (-1, 1), and the remaining Schur function gain * prod (z - b)/(1 - b
    z)."""
    p, q = [gain], [gain * 0 + 1]
    for b in zeros:
        p, q = _times(p, (-b, 1)), _times(q, (1, -b))
    numerator = q
    for k in reversed(coefficients):
        shifted = [0, *p]
        p, q = _sum([k * x for x in q], shifted), _sum(q, [k * x for x in shifted])
    denominator = _sum(q, [-x for x in (0, *p)])
    return Shaped(tuple(numerator), tuple(denominator))


def _times(first: Sequence[Any], second: Sequence[Any]) -> list[Any]:
    result = [0 * first[0]] * (len(first) + len(second) - 1)
    for i, x in enumerate(first):
        for j, y in enumerate(second):
            result[i + j] = result[i + j] + x * y
    return result


def _sum(first: Sequence[Any], second: Sequence[Any]) -> list[Any]:
    size = max(len(first), len(second))
    return [(first[i] if i < len(first) else 0) + (second[i] if i < len(second) else 0) for i in range(size)]
