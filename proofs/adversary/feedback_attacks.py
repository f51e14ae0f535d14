"""Attacks on settle-1: a fault that follows the input, v(k) = u(k-1), u white.

    feedback_attacks   on "for every system", by the leading left singular vectors; on "A and C wrong", by the range
    leading_gap        how far the n leading left singular vectors of L are from the range of O_s, and B, D from the truth

The columns of L: the first is O_s B + T_s(F, G) e_1, the others O_s A^i (A B + F). Its n leading left singular vectors span the range of
O_s iff that range is invariant under L L' and its n eigenvalues there are the largest: `exact.leading_vectors` decides it. Invariant:
P L L' O_s = 0, P on the complement, which only the first column enters: affine in B. B and D by output error are right iff
C'G + A'Q F = 0, Q = A'Q A + C'C: affine in G. The singular vectors are those of plain MOESP; with other weights on the outputs the
condition is another one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from ...exact.algebra.matrices import Matrix
from ...exact.limits.column_space import past_input_limit
from ...exact.limits.inputs import by_output_error
from ...exact.limits.lyapunov import solve
from ...exact.limits.moesp import PopulationLimits, limit
from ...exact.limits.moments import covariances, window_covariances
from ...exact.structure.kernel_rows import kernel_representation
from ...exact.system.windows import observability_matrix
from ..evidence.attacks import Aim, Attack, Block, Family, Floats, Point, Witness
from ..evidence.experiments import LimitEvidence, examine_experiment
from ..trust.limit_certificates import certificates_of
from .float_limits import Drawn, exact_experiment, float_limits, outside
from .limit_attacks import POLE, chain, describe
from .structure_families import cut
from .witnesses import confirmed

Fails = Callable[[LimitEvidence, PopulationLimits], bool]

LEADING = "the bias of B, D by output error and the part of L L' that leaves the range of O_s, each against its parts and L L'"
SHARE = "the share of (G; CF; CAF; ...) outside the range of O_s, in the Euclidean norm"


def feedback_attacks() -> Iterator[Attack]:
    """Yield the attacks on "for every system", for one state, and on "A and C wrong", for one state and for two."""
    for n, p in ((1, 2), (2, 2), (2, 3)):
        family = _family(n, p, 6)
        first = n + p * n  # poles, C; then F, G, B
        of_F, of_G, of_B = range(first, first + n), range(first + n, first + n + p), range(first + n + p, first + n + p + n)
        if n == 1:
            bias, leaving = Block(partial(_bias, family), tuple(of_G)), Block(partial(_leaving, family), tuple(of_B))
            note = "its leading left singular vectors span the range of O_s, B and D by output error are right"
            yield _attack("for-every-system", family, LEADING, leading_gap, partial(_decide, family, _leading_right, note), (bias, leaving))
        outer = Block(partial(_outside, family), (*of_F, *of_G))
        decide = partial(_decide, family, lambda evidence, found: evidence.equal, "its range is that of O_s")
        yield _attack("a-c-wrong", family, SHARE, _share, decide, (outer,))


def _attack(
    reading: str,
    family: Family,
    measured: str,
    quantity: Callable[[Drawn], float | Floats],
    decide: Callable[[Point], Witness | None],
    blocks: tuple[Block, ...],
) -> Attack:
    name = family.words.partition(", s")[0]
    return Attack(f"settle-1.{reading}", name, Aim.ZERO, measured, family, lambda x: quantity(family.at(x)), decide, blocks=blocks)


def leading_gap(drawn: Drawn) -> Floats:
    """Return the entries of the bias and of P L L' O_s, and by how much the largest eigenvalue of P L L' P exceeds the least within the
    range."""
    found = float_limits(drawn)
    basis, _ = np.linalg.qr(found.observability)
    product = found.past_inputs @ found.past_inputs.T / np.linalg.norm(found.past_inputs) ** 2
    outer = product - basis @ (basis.T @ product)
    within = float(np.linalg.eigvalsh(basis.T @ product @ basis)[0])
    excess = max(0.0, float(np.linalg.norm(outer - (outer @ basis) @ basis.T)) - within)
    return np.concatenate([_bias_in_floats(drawn), (outer @ basis).ravel(), [excess]])


def _family(n: int, p: int, past: int) -> Family:
    box = [POLE] * n + [(-2.0, 2.0)] * (p * n + n + p + n)

    def at(point: Sequence[Any]) -> Drawn:
        (poles,), C, F, G, B, _ = cut(point, (1, n), (p, n), (n, 1), (p, 1), (n, 1))
        return Drawn(
            A=chain(poles),
            F=F,
            C=C,
            G=G,
            B=B,
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


def _share(drawn: Drawn) -> float:
    A, F, C, G = (np.array(getattr(drawn, name), dtype=np.float64) for name in "AFCG")
    powers = [np.linalg.matrix_power(A, i) for i in range(drawn.s)]
    return outside(np.vstack([G, *(C @ power @ F for power in powers[:-1])]), np.vstack([C @ power for power in powers]))


def _bias(family: Family, point: Point) -> list[Fraction]:
    """Return the n + p entries of B and D by output error less the true ones."""
    experiment = exact_experiment(family.at(point))
    system = experiment.system
    found = by_output_error(covariances(experiment), system.residual.A, system.residual.C)
    if found is None:
        raise ArithmeticError("output error has no unique minimiser")
    return _numbers(found.B - system.B) + _numbers(found.D - system.D)


def _leaving(family: Family, point: Point) -> list[Fraction]:
    """Return the entries of P L L' O_s."""
    L, W, outer = _parted(family, point)
    return _numbers(outer @ (L.transposed() @ W))


def _outside(family: Family, point: Point) -> list[Fraction]:
    """Return the entries of P L."""
    return _numbers(_parted(family, point)[2])


def _parted(family: Family, point: Point) -> tuple[Matrix, Matrix, Matrix]:
    """Return the limit L, O_s, and the part P L of the limit outside the range of O_s."""
    experiment = exact_experiment(family.at(point))
    L = past_input_limit(experiment, window_covariances(experiment, covariances(experiment))).matrix
    W = observability_matrix(experiment.system.residual, experiment.s)
    return L, W, L - W @ solve(W.transposed() @ W, W.transposed() @ L)


def _numbers(matrix: Matrix) -> list[Fraction]:
    return [Fraction(int(x.p), int(x.q)) for row in matrix.elements() for x in row]


def _decide(family: Family, fails: Fails, note: str, point: Point) -> Witness | None:
    """Return a witness where the fault is seen, what every reading asks for is met, and `fails` holds."""
    experiment = exact_experiment(family.at(point))
    evidence = examine_experiment("adversary", experiment)
    residual = experiment.system.residual
    seen = kernel_representation(residual).normal_rank == residual.m
    if not (seen and evidence.observable and evidence.controllable and evidence.long_past):
        return None
    found = limit(experiment)
    if not fails(evidence, found):
        return None
    return confirmed(f"{describe(family.at(point), evidence)}, {note}", point, certificates_of(found))


def _leading_right(evidence: LimitEvidence, found: PopulationLimits) -> bool:
    return evidence.output_error_right and found.leading_vectors_right(found.past_inputs)
