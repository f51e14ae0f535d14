"""Certificates of population limits, kinds "moesp-limit" and "input-limit", as FORMAT.md has them.

    Certified          of an experiment's PopulationLimits the certificates, each a method: the ranks of L, O_s and [O_s L], by the
                       instruments of PI-MOESP and of PO-MOESP, and B and D of the two regressions with the true A and C
    certificates_of    all of these that there are

A certificate is JSON-ready, and untrusted as all are. The covariances of the witness
are in the coordinates of FORMAT.md, xi = (x; s_1; ...; s_L), s_i a block of the filters' own states, which need not be those in which
the limits were computed; `Chain` is that realisation.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from flint import fmpq, fmpq_poly, fmpz

from ...base.sheets import counted
from ...exact.algebra.fields import QQ
from ...exact.algebra.matrices import Matrix, RowEchelon, beside, rank, row_echelon, stacked
from ...exact.algebra.stability import rational_characteristic_polynomial
from ...exact.limits.experiments import Experiment
from ...exact.limits.lyapunov import solve, stein
from ...exact.limits.moesp import PopulationLimits
from ...exact.system.modular import LARGEST_PRIME, primes_below, reduce_matrix
from ...exact.system.windows import observability_matrix
from .structure_certificates import Certificate, Unprovable, as_certificate


@dataclass(frozen=True)
class Chain:
    """The filters as s(k+1) = a s(k) + b e(k), (u; v; w) = c s(k) + first e(k); `annihilator`, ascending, has a among its zeros."""

    a: Matrix
    b: Matrix
    c: Matrix
    first: Matrix
    annihilator: tuple[Any, ...]

    def covariance(self) -> Matrix:
        """Return the stationary covariance of s."""
        return stein(self.a, self.a, self.b @ self.b.transposed(), self.annihilator)

    def with_states(self, A: Matrix, into: Matrix, own: Matrix) -> Matrix:
        """Return the covariance Cov(x, s) for x(k+1) = A x(k) + into f(k), where `own` is the covariance of s."""
        source = into @ (self.c @ own @ self.a.transposed() + self.first @ self.b.transposed())
        return stein(A, self.a, source, self.annihilator)


@dataclass(frozen=True, eq=False)
class Certified:
    """The certificates of one experiment's limits, each a method, and what several of them need, found once."""

    limits: PopulationLimits

    @cached_property
    def chain(self) -> Chain:
        """The filters of the experiment."""
        return _chain(self.limits.experiment)

    @cached_property
    def own(self) -> Matrix:
        """The covariance of the filters' states."""
        return self.chain.covariance()

    @cached_property
    def across(self) -> Matrix:
        """Cov(x, s)."""
        experiment = self.limits.experiment
        return self.chain.with_states(experiment.system.residual.A, _into(experiment, experiment.system.B), self.own)

    @cached_property
    def part(self) -> list[list[object]]:
        """Cov(xi, s), which is enough where inputs alone are asked for."""
        return stacked(self.across, self.own).to_json()

    @cached_property
    def seen(self) -> Matrix:
        """The observability matrix O_s of the plant (p s, n)."""
        return observability_matrix(self.limits.experiment.system.residual, self.limits.experiment.s)

    @cached_property
    def response(self) -> Matrix:
        """Cov(Yf, Uf) Cov(Uf)^-1."""
        blocks = self.limits.blocks
        return solve(blocks.uf_uf, blocks.yf_uf.transposed()).transposed()

    def past_input_limit(self) -> Certificate:
        """Return the certificate of the ranks of the limit of PI-MOESP."""
        blocks = self.limits.blocks
        return self._ranks("past-inputs", self.part, blocks.uf_up, blocks.yf_up, self.limits.past_inputs.matrix)

    def past_input_and_output_limit(self) -> Certificate:
        """Return the certificate of the ranks of the limit of PO-MOESP."""
        experiment, blocks, chain = self.limits.experiment, self.limits.blocks, self.chain
        A, into = experiment.system.residual.A, _into(experiment, experiment.system.B)
        driven, direct = into @ chain.c, into @ chain.first
        crossed = A @ self.across @ driven.transposed()
        source = crossed + crossed.transposed() + driven @ self.own @ driven.transposed() + direct @ direct.transposed()
        states = stein(A, A, source, _ascending(A))
        covariance = stacked(beside(states, self.across), beside(self.across.transposed(), self.own)).to_json()
        inputs, outputs = beside(blocks.uf_up, blocks.uf_yp), beside(blocks.yf_up, blocks.yf_yp)
        return self._ranks("past-inputs-and-outputs", covariance, inputs, outputs, self.limits.past_outputs.matrix)

    def output_error_inputs(self) -> Certificate:
        """Return the certificate of B and D that minimise the stationary E|y - G(q)u|^2. Raises Unprovable when they are not unique, and
        where n + 1 block rows of u have a singular covariance."""
        limits, chain = self.limits, self.chain
        if limits.true_AC is None:
            raise Unprovable("the minimiser is not unique")
        experiment, (B, D) = limits.experiment, (limits.true_AC.B, limits.true_AC.D)
        residual, u = experiment.system.residual, limits.known.process.u
        into = _into(experiment, experiment.system.B - B)
        turned, C = residual.A.transposed(), residual.C
        gramian = stein(turned, turned, C.transposed() @ C, _ascending(residual.A))
        seen = beside(experiment.system.D - D, residual.G, Matrix.identity(QQ, residual.p))
        source = (turned @ gramian @ into + C.transposed() @ seen) @ chain.c
        series = beside(gramian, stein(turned, chain.a.transposed(), source, chain.annihilator))
        window = range(residual.n + 1)
        prime = _prime(limits.known.windows(u, u, window, window), observability_matrix(residual, residual.n))
        witness = {
            "prime": prime,
            "covariance": self.part,
            "errors": stacked(chain.with_states(residual.A, into, self.own), self.own).to_json(),
            "series": series.to_json(),
        }
        return _input_certificate(experiment, "true-AC", B, D, witness)

    def moesp_inputs(self) -> Certificate:
        """Return the certificate of B and D of MOESP's regression. Raises Unprovable."""
        limits, seen = self.limits, self.seen
        if limits.moesp is None:
            raise Unprovable("the regression has more than one solution")
        experiment = limits.experiment
        witness = {
            "prime": _prime(limits.blocks.uf_uf, observability_matrix(experiment.system.residual, experiment.s - 1)),
            "covariance": self.part,
            "response": self.response.to_json(),
            "inverse": solve(seen.transposed() @ seen, seen.transposed()).to_json(),
        }
        return _input_certificate(experiment, "moesp", limits.moesp.B, limits.moesp.D, witness)

    def all(self) -> list[Certificate]:
        """Return the certificates of both limits, and of each regression that has a unique limit."""
        made = [self.past_input_limit(), self.past_input_and_output_limit()]
        for regression in (self.output_error_inputs, self.moesp_inputs):
            try:
                made.append(regression())
            except Unprovable:
                continue
        return made

    def _ranks(self, instruments: str, covariance: list[list[object]], inputs: Matrix, outputs: Matrix, limit: Matrix) -> Certificate:
        """Return the rows that vanish on L, O_s or both, continued to (Uf; Yf) so that they vanish on the covariances and no inverse is
        needed.
        """
        experiment, blocks, seen = self.limits.experiment, self.limits.blocks, self.seen
        named = {"limit": limit, "observability": seen, "joint": beside(limit, seen)}
        forms = {name: row_echelon(matrix.transposed()) for name, matrix in named.items()}
        profiles = {name: form.pivots for name, form in forms.items()}
        statement: dict[str, Any] = {"experiment": experiment.to_json(), "instruments": instruments}
        statement |= {f"{name}_rank": len(profile) for name, profile in profiles.items()}
        first, behind = stacked(blocks.uf_uf, blocks.yf_uf), stacked(inputs, outputs)
        below = stacked(Matrix.zero(QQ, first.ncols, seen.ncols), seen)
        tables = {"limit": beside(first, behind), "observability": beside(first, below), "joint": beside(first, behind, below)}
        bordered = [(tables[name], first.ncols + len(profile)) for name, profile in profiles.items()]
        witness: dict[str, Any] = {"prime": _prime_of_ranks([(blocks.uf_uf, first.ncols), *bordered]), "covariance": covariance}
        for name, profile in profiles.items():
            if name == "joint" or len(profile) < len(profiles["joint"]):  # else the rows of both serve
                witness[name] = _left_null(forms[name], self.response)
        return as_certificate("moesp-limit", statement, witness)


def certificates_of(limits: PopulationLimits) -> list[Certificate]:
    """Return the certificates of both limits, and of each regression that has a unique limit."""
    return Certified(limits).all()


# -- parts -------------------------------------------------------------------------------------------------------------


def _input_certificate(experiment: Experiment, regression: str, B: Matrix, D: Matrix, witness: dict[str, Any]) -> Certificate:
    statement = {"experiment": experiment.to_json(), "regression": regression, "B": B.to_json(), "D": D.to_json()}
    return as_certificate("input-limit", statement, witness)


def _chain(experiment: Experiment) -> Chain:
    filters = [experiment.u_filter, experiment.v_filter] + ([] if experiment.w_filter is None else [experiment.w_filter])
    heights = [experiment.system.nu, experiment.system.residual.m, experiment.system.residual.p]
    noises = [experiment.u_filter.noise, 0 if experiment.w_filter is None else experiment.w_filter.noise]
    length = max(one.memory for one in filters)
    forward, feedback = list[Matrix](), list[Matrix]()
    for i in range(length + 1):
        rows = list[list[Any]]()
        for one, height, start in zip(filters, heights, (0, 0, noises[0]), strict=False):
            entries = one.numerator[i].elements() if i < len(one.numerator) else [[fmpq(0)] * one.noise] * height
            rows += [[fmpq(0)] * start + entry + [fmpq(0)] * (sum(noises) - start - one.noise) for entry in entries]
        rows += [[fmpq(0)] * sum(noises) for _ in range(sum(heights) - len(rows))]
        forward.append(Matrix.from_elements(QQ, sum(heights), sum(noises), rows))
        taps = [one.denominator[i] if i < len(one.denominator) else fmpq(0) for one in filters] + [fmpq(0)]
        feedback.append(_diagonal([tap for tap, height in zip(taps, heights, strict=False) for _ in range(height)]))
    size, nothing, unit = sum(heights), Matrix.zero(QQ, sum(heights), sum(heights)), Matrix.identity(QQ, sum(heights))
    steps = range(1, length + 1)
    moves = [beside(-feedback[i], *(unit if j == i + 1 else nothing for j in steps[1:])) for i in steps]
    enters = [forward[i] - feedback[i] @ forward[0] for i in steps]
    a, b = stacked(Matrix.zero(QQ, 0, size * length), *moves), stacked(Matrix.zero(QQ, 0, sum(noises)), *enters)
    c = beside(Matrix.zero(QQ, size, 0), *([unit] + [nothing] * (length - 1))[:length])
    return Chain(a, b, c, forward[0], _annihilator([one.denominator for one in filters], length))


def _annihilator(denominators: list[tuple[Any, ...]], length: int) -> tuple[Any, ...]:
    """Return q^length times the product of the different q^k + d_1 q^(k-1) + ... + d_k, ascending."""
    product = fmpq_poly([0] * length + [1])
    for one in {*denominators}:
        product *= fmpq_poly([*reversed(one)])
    return tuple(product.coeffs())


def _into(experiment: Experiment, B: Matrix) -> Matrix:
    residual = experiment.system.residual
    return beside(B, residual.F, Matrix.zero(QQ, residual.n, residual.p))


def _diagonal(entries: list[Any]) -> Matrix:
    rows = [[x if i == j else fmpq(0) for j in range(len(entries))] for i, x in enumerate(entries)]
    return Matrix.from_elements(QQ, len(entries), len(entries), rows)


def _ascending(A: Matrix) -> list[Any]:
    return [fmpq(c.numerator, c.denominator) for c in rational_characteristic_polynomial(A)]


def _left_null(form: RowEchelon, response: Matrix) -> list[dict[str, Any]]:
    """Return integer rows (-r response, r) for a basis of the r with r matrix = 0, each alone at its pivot.

    `form` is the echelon form of the transpose of that matrix.
    """
    size, relations = form.matrix.ncols, form.matrix.elements()
    dependent = [i for i in range(size) if i not in set(form.pivots)]
    entries = [[fmpq(0)] * size for _ in dependent]
    for row, pivot in zip(entries, dependent, strict=True):
        for i, combined in zip(form.pivots, relations, strict=True):
            row[i] = -combined[pivot]
        row[pivot] = fmpq(1)
    rows = Matrix.from_elements(QQ, len(dependent), size, entries)
    continued = beside(-(rows @ response), rows).elements()
    return [{"pivot": response.ncols + pivot, "row": _integral(row)} for pivot, row in zip(dependent, continued, strict=True)]


def _integral(entries: list[Any]) -> list[object]:
    bottom = fmpz(1)
    for x in entries:
        bottom = bottom.lcm(x.q)
    return [QQ.write(x * bottom) for x in entries]


def _prime(covariance: Matrix, seen: Matrix) -> int:
    """Return a prime modulo which both have full column rank; Unprovable where they have not."""
    if rank(covariance) < covariance.ncols:
        raise Unprovable(f"the covariance of {counted(covariance.nrows, 'row')} of inputs is singular")
    return _prime_of_ranks([(covariance, covariance.ncols), (seen, seen.ncols)])


def _prime_of_ranks(matrices: list[tuple[Matrix, int]]) -> int:
    """Return the largest prime of a usual size modulo which every matrix has the rank beside it."""
    for prime in primes_below(LARGEST_PRIME):
        images = ((reduce_matrix(matrix, prime, None), size) for matrix, size in matrices)
        if all(image is not None and rank(image) >= size for image, size in images):
            return prime
    raise ArithmeticError("every prime up to the bound divides a denominator or a minor")
