"""Attacks on settle-1: a fault that follows the input, v(k) = u(k-1), u white.

    feedback_attacks   on "biased for every system", by the leading left singular vectors; on "not both", by the range and the bias
    leading_gap        how far the n leading left singular vectors of L are from the range of O_s, and B, D from the truth
    spans_leading      whether they span it, exactly

The columns of L: the first is O_s B + T_s(F, G) e_1, the others O_s A^i (A B + F). Its n leading left singular vectors span the range of
O_s iff that range is invariant under L L' and its n eigenvalues there are the largest. Invariant: P L L' O_s = 0, P on the complement,
which only the first column enters: affine in B. B and D by output error are right iff C'G + A'Q F = 0, Q = A'Q A + C'C: affine in G.
The singular vectors are those of plain MOESP; with other weights on the outputs the condition is another one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from ...exact.covariances import covariances, window_covariances
from ...exact.input_limits import by_output_error
from ...exact.kernel_representation import kernel_representation
from ...exact.limits import past_input_limit
from ...exact.lyapunov import solve
from ...exact.matrices import Matrix
from ...exact.population_limits import PopulationLimits, population_limits
from ...exact.windows import observability_matrix
from .. import checker
from ..experiments_tried import certificates_of, examine_experiment
from .attacks import Aim, Attack, Block, Family, Floats, Point, Witness
from .float_limits import Drawn, exact_experiment, float_limits, outside
from .limit_attacks import POLE, chain, describe

LEADING = "the bias of B, D by output error and the part of L L' that leaves the range of O_s, each against its parts and L L'"
BOTH = "the share of L outside the range of O_s and the bias of B, D by output error, against its parts"


def feedback_attacks() -> Iterator[Attack]:
    """For one state and for two."""
    for n, p, past in ((1, 2, 6), (2, 2, 6), (2, 3, 6)):
        family = _family(n, p, past)
        first = n + p * n + n  # poles, C, F; then G, then B
        blocks = (
            Block(lambda point, family=family: _bias(family, point), tuple(range(first, first + p))),  # type: ignore[misc]
            Block(lambda point, family=family: _leaving(family, point), tuple(range(first + p, first + p + n))),  # type: ignore[misc]
        )
        yield Attack(
            target="settle-1.for-every-system",
            name=f"n = {n}, p = {p}",
            aim=Aim.ZERO,
            measured=LEADING,
            family=family,
            quantity=lambda point, family=family: leading_gap(family.at(point)),  # type: ignore[misc]
            decide=lambda point, family=family: _decide_leading(family, point),  # type: ignore[misc]
            blocks=blocks,
        )
        yield Attack(
            target="settle-1.not-both",
            name=f"n = {n}, p = {p}",
            aim=Aim.ZERO,
            measured=BOTH,
            family=family,
            quantity=lambda point, family=family: _both(family.at(point)),  # type: ignore[misc]
            decide=lambda point, family=family: _decide_both(family, point),  # type: ignore[misc]
            blocks=blocks[:1],
            starts=8,
        )


def leading_gap(drawn: Drawn) -> Floats:
    """n entries of bias, those of P L L' O_s, and by how much the largest eigenvalue of P L L' P exceeds the least within the range."""
    found = float_limits(drawn)
    basis, _ = np.linalg.qr(found.observability)
    product = found.past_inputs @ found.past_inputs.T / np.linalg.norm(found.past_inputs) ** 2
    outer = product - basis @ (basis.T @ product)
    within = float(np.linalg.eigvalsh(basis.T @ product @ basis)[0])
    excess = max(0.0, float(np.linalg.norm(outer - (outer @ basis) @ basis.T)) - within)
    return np.concatenate([_bias_in_floats(drawn), (outer @ basis).ravel(), [excess]])


def spans_leading(found: PopulationLimits) -> bool:
    """Whether the n leading left singular vectors of L span the range of O_s, and their singular values are larger than the others.

    With W = O_s: invariant, and W'L L'W - t W'W positive definite, t = trace of P L L' P, which is at least its largest eigenvalue.
    """
    residual = found.experiment.system.residual
    W, L = observability_matrix(residual, found.experiment.s), found.past_inputs.matrix
    gram, across = W.transposed() @ W, L.transposed() @ W
    outer = L - W @ solve(gram, W.transposed() @ L)  # P L
    if not (outer @ across).is_zero():
        return False
    size = outer.transposed() @ outer
    t = sum((size[i, i] for i in range(size.nrows)), start=size[0, 0] * 0)
    inner = across.transposed() @ across
    form = inner - Matrix(inner.field, *gram.shape, gram.flint * t)
    corners = (form.rows(range(k)).columns(list(range(k))).flint.det() for k in range(1, form.nrows + 1))
    return all(corner > 0 for corner in corners)


def _family(n: int, p: int, past: int) -> Family:
    box = [POLE] * n + [(-2.0, 2.0)] * (p * n + n + p + n)

    def at(point: Sequence[Any]) -> Drawn:
        values = list(point)
        poles, values = values[:n], values[n:]
        C, values = [values[i * n : (i + 1) * n] for i in range(p)], values[p * n :]
        F, values = [[x] for x in values[:n]], values[n:]
        return Drawn(
            A=chain(poles),
            F=F,
            C=C,
            G=[[x] for x in values[:p]],
            B=[[x] for x in values[p:]],
            D=[[0]] * p,
            s=n + 1,
            past=past,
            u_taps=[[[1]]],
            u_den=(1,),
            v_taps=[[[0]], [[1]]],
        )

    return Family(f"n = {n}, p = {p}, s = {n + 1}, past = {past}, all matrices free, u white, v(k) = u(k-1)", tuple(box), at)


def _bias_in_floats(drawn: Drawn) -> Floats:
    A, F, C, G = (np.array(getattr(drawn, name), dtype=np.float64) for name in "AFCG")
    n = len(A)
    Q = np.linalg.solve(np.eye(n * n) - np.kron(A.T, A.T), (C.T @ C).ravel()).reshape(n, n)
    direct, later = (C.T @ G).ravel(), (A.T @ Q @ F).ravel()
    return np.asarray((direct + later) / (np.linalg.norm(direct) + np.linalg.norm(later)))


def _both(drawn: Drawn) -> Floats:
    found = float_limits(drawn)
    return np.append(_bias_in_floats(drawn), outside(found.past_inputs, found.observability))


def _bias(family: Family, point: Point) -> list[Fraction]:
    """B and D by output error less the true ones, for n, p of the family: n + p numbers."""
    experiment = exact_experiment(family.at(point))
    system = experiment.system
    found = by_output_error(covariances(experiment), system.residual.A, system.residual.C)
    if found is None:
        raise ArithmeticError("output error has no unique minimiser")
    return _numbers(found.B - system.B) + _numbers(found.D - system.D)


def _leaving(family: Family, point: Point) -> list[Fraction]:
    """P L L' O_s."""
    experiment = exact_experiment(family.at(point))
    L = past_input_limit(experiment, window_covariances(experiment, covariances(experiment))).matrix
    W = observability_matrix(experiment.system.residual, experiment.s)
    outer = L - W @ solve(W.transposed() @ W, W.transposed() @ L)
    return _numbers(outer @ (L.transposed() @ W))


def _numbers(matrix: Matrix) -> list[Fraction]:
    return [Fraction(int(x.p), int(x.q)) for row in matrix.elements() for x in row]


def _decide_leading(family: Family, point: Point) -> Witness | None:
    return _decide(family, point, leading=True)


def _decide_both(family: Family, point: Point) -> Witness | None:
    return _decide(family, point, leading=False)


def _decide(family: Family, point: Point, *, leading: bool) -> Witness | None:
    """The fault is seen, (A, C) observable on s - 1 samples, B and D by output error right; and A, C too."""
    experiment = exact_experiment(family.at(point))
    dossier = examine_experiment("adversary", experiment)
    system = experiment.system
    seen = kernel_representation(system.residual).normal_rank == system.residual.m
    if not (seen and dossier.observable and dossier.state_inputs == (system.B, system.D)):
        return None
    found = population_limits(experiment)
    if not (spans_leading(found) if leading else dossier.equal):
        return None
    certificates = tuple(certificates_of(found))
    for certificate in certificates:
        checker.verify(certificate)
    note = "its leading left singular vectors span the range of O_s" if leading else "its range is that of O_s"
    return Witness(f"{describe(family.at(point), dossier)}, {note}, B and D by output error are right", point, certificates)
