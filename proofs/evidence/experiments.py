"""Experiments whose population limits are known exactly, with certificates that the checker accepted: proposition-1 rests on these.

    LimitEvidence           an experiment, what its signals are like, and what certificates say of both methods and both regressions
    LIMITS                  those of an effort, in families named after how v and u belong together
    examine_experiment      the evidence on one experiment
    first_look              the same before the checker has seen the certificates
    Drawn, FAMILIES         the families, and how an experiment of each is drawn
    nilpotent_points        one (A, B) for each of several spectra of u, at which the limit of PI-MOESP is to have full rank
    experiments_in_order    small experiments, for the smallest counterexample

Correlations of v and u are decided for all lags: beyond the size of the joint state they are combinations of those before
(Cayley-Hamilton).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from fractions import Fraction
from functools import partial
from itertools import product
from random import Random
from typing import Any

from ...exact.algebra.fields import QQ
from ...exact.algebra.matrices import Matrix, rank
from ...exact.algebra.stability import is_stable, rational_characteristic_polynomial
from ...exact.limits.column_space import StatePart
from ...exact.limits.experiments import Experiment, read_experiment
from ...exact.limits.lyapunov import solve
from ...exact.limits.moesp import PopulationLimits, limit
from ...exact.limits.moments import toeplitz
from ...exact.system.systems import ResidualSystem
from ...exact.system.windows import observability_matrix, reachability_matrix
from ..trust.limit_certificates import certificates_of
from ..trust.structure_certificates import accept
from .material import Material
from .refuting_experiments import in_order, seasonal

Rows = list[list[str]]


class Drawn(StrEnum):
    """The families of experiments that are drawn, each with its words."""

    INDEPENDENT = "v independent of u"
    INDEPENDENT_AUTOREGRESSIVE = "v independent of u, u autoregressive of order at most s"
    DEGENERATE = "v independent of u, poles and spectra degenerate"
    PERIODIC = "v independent of u, u of period 3"
    WHITE_LED = "u white, v leads it"
    SIMULTANEOUS = "u white, v(k) = u(k)"
    MOVING_AVERAGE_LED = "u a moving average, v leads it"
    LEAD_ONE = "u coloured, v(k) = u(k+1), G = 0"
    AUTOREGRESSIVE_LED = "u autoregressive of order at most s, v leads it"
    FEEDBACK = "u white, v(k) = K u(k-1)"
    FEEDBACK_HIDDEN = "u white, v(k) = K u(k-1), F K = A z and G K = C z"
    FEEDBACK_UNSEEN_IN_INPUTS = "u white, v(k) = K u(k-1), B and D right by output error"
    INDEPENDENT_WHITE = "u and v white and independent"


@dataclass(frozen=True)
class LimitEvidence:
    """What accepted certificates say of an experiment and of its signals.

    `past_lags`: v(k) is uncorrelated with u(k-l) for all l >= 1; `same_time`: for l = 0; `leads`: for all l <= -1.

    `observable`: on s - 1 samples already, which shift invariance takes; `long_past`: past >= n. `within`: the limit of PI-MOESP lies in
    the range of O_s; `equal`: is that range; the same for PO-MOESP. `inputs_right`: every regression that has a unique limit gives the true
    B and D. `state` is the (A, C) that the columns of PI-MOESP's limit carry, None where they carry none; `predicted`: u(k) less its best
    prediction from u(k-1), ..., u(k-s) is uncorrelated with all of its past. `weight` is 1.
    """

    origin: str
    experiment: Experiment
    past_lags: bool
    same_time: bool
    leads: bool
    white: bool
    controllable: bool
    seen_controllable: bool
    observable: bool
    long_past: bool
    within: bool
    equal: bool
    past_outputs_within: bool
    limit_rank: int
    inputs_right: bool
    state_inputs: tuple[Matrix, Matrix] | None
    state: StatePart | None
    predicted: bool
    weight: int
    accepted: frozenset[str]

    @property
    def uncorrelated(self) -> bool:
        """This says whether u and v are uncorrelated at all lags of both signs."""
        return self.past_lags and self.same_time and self.leads

    @property
    def output_error_right(self) -> bool:
        """This says whether output error with the true A and C gives the true B and D."""
        return self.state_inputs == (self.experiment.system.B, self.experiment.system.D)

    @property
    def whole_range_expected(self) -> bool:
        """Whether (A, B) is controllable, (A, C) observable on s - 1 samples, past >= n, and u and v are uncorrelated."""
        return self.uncorrelated and self.controllable and self.observable and self.long_past

    @property
    def autoregressive(self) -> bool:
        """This says whether u is autoregressive of order at most s."""
        u = self.experiment.u_filter
        return len(u.numerator) == 1 and u.memory <= self.experiment.s

    @property
    def nilpotent(self) -> bool:
        """This says whether A^n = 0."""
        return not any(rational_characteristic_polynomial(self.experiment.system.residual.A)[:-1])

    @property
    def past_of_input(self) -> bool:
        """This says whether past >= n + the order of the filter of u, from which on a longer past brings nothing new."""
        return self.experiment.past >= self.experiment.system.residual.n + self.experiment.u_filter.memory

    @property
    def one_sided(self) -> bool:
        """This says whether u and v are uncorrelated at all lags l >= 0, as the assumption is printed."""
        return self.past_lags and self.same_time


def examine_experiment(origin: str, experiment: Experiment) -> LimitEvidence:
    """The evidence on an experiment: its limits certified, and what its signals are like."""
    found = limit(experiment)
    certificates = certificates_of(found)
    decided = frozenset(map(accept, certificates))
    inside, outside, *inputs = (certificate["statement"] for certificate in certificates)
    ranks = [(one["joint_rank"], one["observability_rank"], one["limit_rank"]) for one in (inside, outside)]
    return _evidence(origin, found, ranks, [(one["B"], one["D"]) for one in inputs], decided)


def first_look(experiment: Experiment) -> LimitEvidence:
    """Return what the certificates would state, none of which is made: with it a search passes over what cannot fail."""
    found = limit(experiment)
    ranks = [(one.joint_rank, one.observability_rank, one.rank) for one in (found.past_inputs, found.past_outputs)]
    inputs = [(one.B.to_json(), one.D.to_json()) for one in (found.true_AC, found.moesp) if one is not None]
    return _evidence("first look", found, ranks, inputs, frozenset())


def _evidence(
    origin: str,
    found: PopulationLimits,
    ranks: Sequence[tuple[int, int, int]],
    inputs: Sequence[tuple[Any, Any]],
    accepted: frozenset[str],
) -> LimitEvidence:
    """Return the evidence; of both limits `ranks` has that of [O_s L], of O_s and of L, and `inputs` the B and D of the regressions."""
    experiment = found.experiment
    process, residual = found.known.process, experiment.system.residual
    largest = process.Phi.nrows + 1
    lags = found.known.sequence(process.v, process.u, -largest, largest)  # Cov(v(k + l), u(k))
    of_input = found.known.sequence(process.u, process.u, 1, largest)
    true = experiment.system.B.to_json(), experiment.system.D.to_json()
    state_inputs = None if found.true_AC is None else (found.true_AC.B, found.true_AC.D)
    (joint, seen, inside), (outer_joint, outer_seen, _) = ranks
    return LimitEvidence(
        origin=origin,
        experiment=experiment,
        past_lags=all(c.is_zero() for lag, c in lags.items() if lag >= 1),
        same_time=lags[0].is_zero(),
        leads=all(c.is_zero() for lag, c in lags.items() if lag <= -1),
        white=all(c.is_zero() for c in of_input.values()),
        controllable=_controllable(residual.A, experiment.system.B),
        seen_controllable=state_inputs is not None and _controllable(residual.A, state_inputs[0]),
        observable=rank(observability_matrix(residual, max(experiment.s - 1, 0))) == residual.n,
        long_past=experiment.past >= residual.n,
        within=joint == seen,
        equal=joint == seen == inside,
        past_outputs_within=outer_joint == outer_seen,
        limit_rank=inside,
        inputs_right=all(one == true for one in inputs),
        state_inputs=state_inputs,
        state=found.past_inputs.state,
        predicted=_predicted(found, experiment.s),
        weight=1,
        accepted=accepted,
    )


def _predicted(found: PopulationLimits, order: int) -> bool:
    """Return whether u(k) less its best prediction from u(k-1..k-order) is uncorrelated with all of its past.

    Beyond `order` these correlations are powers of the joint state's matrix between two fixed ones, so that as many as it has rows decide
    (Cayley-Hamilton).
    """
    known, u = found.known, found.known.process.u
    near, now = range(-order, 0), range(1)
    far = range(-order - known.process.Phi.nrows - 1, -order)
    lags = dict(enumerate(known.forward(u, u, -far[0])))
    lags |= {-lag: block.transposed() for lag, block in lags.items()}
    weights = solve(toeplitz(lags, near, near), toeplitz(lags, near, now)).transposed()
    return toeplitz(lags, now, far) == weights @ toeplitz(lags, near, far)


def _sources(bench: Any) -> list[tuple[str, int]]:
    count = 400 if bench.full else 8
    return [(name, seed) for name in FAMILIES for seed in range(MORE.get(name, 1) * count)]


def _examined(item: tuple[str, int]) -> LimitEvidence:
    name, seed = item
    return examine_experiment(name, FAMILIES[name](Random(f"{name} {seed}")))


def _nilpotent(bench: Any) -> Iterator[Experiment]:
    return nilpotent_points(3 if bench.full else 2)


def _controllable(A: Matrix, B: Matrix) -> bool:
    nothing = Matrix.zero(QQ, 1, A.nrows), Matrix.zero(QQ, 1, B.ncols)
    return rank(reachability_matrix(ResidualSystem(A, B, *nothing))) == A.nrows


# -- how experiments are drawn ---------------------------------------------------------------------------------------------


def _rows(random: Random, nrows: int, ncols: int) -> Rows:
    return [[str(Fraction(random.randint(-3, 3), random.choice((1, 2, 3)))) for _ in range(ncols)] for _ in range(nrows)]


def _stable(random: Random, n: int) -> Rows:
    A = _rows(random, n, n)
    while not is_stable(Matrix.of(A, shape=(n, n))):
        A = [[str(Fraction(x) / 2) for x in row] for row in A]
    return A


def _system(random: Random, m: int, nu: int) -> dict[str, Any]:
    n, p = random.randint(1, 2), random.randint(1, 2)
    shapes = {"F": (n, m), "C": (p, n), "G": (p, m), "B": (n, nu), "D": (p, nu)}
    return {"A": _stable(random, n)} | {name: _rows(random, *shape) for name, shape in shapes.items()}


def experiment_of(system: dict[str, Any], u: object, v: object, w: object = None, past: int | None = None) -> Experiment:
    """Return the experiment with s = n + 1 block rows, and as many of the past where nothing else is said."""
    n = len(system["A"])
    given = system | {"s": n + 1, "past": past or n + 1, "u_filter": u, "v_filter": v}
    return read_experiment(given if w is None else given | {"w_filter": w})


def leading(system: dict[str, Any], u: Sequence[str], den: Sequence[str], phi: Sequence[str], past: int | None = None) -> Experiment:
    """Return the experiment with u = (sum u_j q^-j / den) e and v(k) = sum_j phi_j u(k+j), all of it delayed by the largest lead."""
    delay = len(phi) - 1
    product = [Fraction(0)] * (len(u) + delay)
    for j, weight in enumerate(phi):
        for i, x in enumerate(u):
            product[i + delay - j] += Fraction(weight) * Fraction(x)
    numerator = [[["0"]]] * delay + [[[x]] for x in u]
    fault = [[[str(x)]] for x in product]
    return experiment_of(system, {"num": numerator, "den": list(den)}, {"num": fault, "den": list(den)}, None, past)


def _independent(random: Random) -> Experiment:
    m, nu = random.randint(1, 2), random.randint(1, 2)
    system = _system(random, m, nu)
    unit = [[*("1" if i == j else "0" for j in range(nu)), *["0"] * m] for i in range(nu)]
    later = [row + ["0"] * m for row in _rows(random, nu, nu)]
    v = [[["0"] * nu + row for row in _rows(random, m, m)] for _ in range(2)]
    w = [_rows(random, len(system["C"]), 1)] if random.random() < 0.5 else None
    past = random.choice((1, None, None))
    return experiment_of(system, {"num": [unit, later], "den": ["1", "-1/2"]}, {"num": v, "den": ["1", "1/3"]}, w, past)


def _independent_autoregressive(random: Random) -> Experiment:
    """Return one or two inputs of order 0 to s, with F and G as they come and D = 0."""
    m, nu = 1, random.randint(1, 2)
    system = _system(random, m, nu)
    n = len(system["A"])
    den = ["1", *random.choice((["-1/2", "1/4", "-1/8"], ["1/3", "-1/4", "1/8"], ["0", "0", "9/10"]))[: random.randint(0, n + 1)]]
    unit = [[*("1" if i == j else "0" for j in range(nu)), "0"] for i in range(nu)]
    return experiment_of(system, {"num": [unit], "den": den}, [[["0"] * nu + ["1"]]], None, random.choice((1, n, None)))


# Poles that are equal, close together, at zero, on the edge of stability, or no more than the input sees; zeros of u on the unit circle, at
# the poles, or a whole period apart.
_POLES: tuple[Rows, ...] = (
    [["9/10"]],
    [["0"]],
    [["9/10", "1"], ["0", "9/10"]],
    [["9/10", "0"], ["0", "89/100"]],
    [["0", "1"], ["0", "0"]],
    [["1/2", "1"], ["0", "-1/2"]],
    [["999/1000", "0"], ["0", "1/2"]],
    [["7/4", "-4/5"], ["1", "0"]],
    [["0", "-99/100"], ["1", "0"]],
    [["0", "1", "0"], ["0", "0", "1"], ["0", "0", "0"]],
    [["9/10", "1", "0"], ["0", "9/10", "1"], ["0", "0", "9/10"]],
)
_COLOURS: tuple[tuple[list[str], list[str]], ...] = (
    (["1", "-1"], ["1"]),
    (["1", "0", "-1"], ["1"]),
    (["1", "1", "1"], ["1"]),
    (["1", "0", "0", "-1"], ["1"]),
    (["1", "-9/10"], ["1"]),
    (["1", "-9/10"], ["1", "-89/100"]),
    (["1"], ["1", "0", "0", "5/3", "0", "0", "3/4"]),
    (["1", "-4/5"], ["1", "-6/5", "1/2", "-2/3", "17/15", "-3/4"]),
    (["1", "-999/1000"], ["1", "-1/2"]),
)


def _degenerate(random: Random) -> Experiment:
    """C = I; the last state is driven or all are; past goes from 1 to n + the order of the filter of u, and s from 2 to n + 1."""
    A, (num, den) = random.choice(_POLES), random.choice(_COLOURS)
    n, order = len(A), max(len(num), len(den)) - 1
    B = random.choice(([["1"]] * n, [["0"]] * (n - 1) + [["1"]], [["1"]] + [["0"]] * (n - 1)))
    unit = [["1" if i == j else "0" for j in range(n)] for i in range(n)]
    return read_experiment(
        {"A": A, "B": B, "C": unit, "D": [["0"]] * n, "F": [["1"]] * n, "G": [["0"]] * n}
        | {"s": random.randint(2, n + 1), "past": random.choice((1, n, n + 1, n + order, n + order))}
        | {"u_filter": {"num": [[[x, "0"]] for x in num], "den": den}, "v_filter": [[["0", "1"]], [["0", "1"]], [["0", "1"]]]}
    )


def _period(random: Random) -> Experiment:
    """Return members of the family of period three that lose a rank, and some beside them; with a longer past as well."""
    one = random.choice(in_order(7))
    near = replace(one, a=one.a * random.choice((1, 1, Fraction(99, 100))))
    return seasonal(near, random.choice((1, 3)), random.choice((2, 2, 3, 8)))


def _white_leads(random: Random) -> Experiment:
    phi = ["0", *(str(random.randint(-2, 2)) for _ in range(random.randint(0, 1))), "1"]
    return leading(_system(random, 1, 1), ["1"], ["1"], phi, random.choice((1, None, None)))


def _lead_one(random: Random) -> Experiment:
    system = _system(random, 1, 1)
    system["G"] = [["0"] for _ in system["C"]]
    return leading(system, ["1", "1/2"], ["1", "-1/3"], ["0", "1"])


def _autoregressive(random: Random) -> Experiment:
    system = _system(random, 1, 1)
    den = ["1", "-1/2", "1/4", "-1/8"][: random.randint(2, len(system["A"]) + 2)]  # of order 1 to s = n + 1
    return leading(system, ["1"], den, ["0"] * random.randint(1, 2) + ["1"])


def following(system: dict[str, Any], gain: str) -> Experiment:
    """Return the experiment in which u is white and v(k) = gain u(k-1)."""
    return experiment_of(system, [[["1"]]], [[["0"]], [[gain]]])


def independent_white(system: dict[str, Any]) -> Experiment:
    """Return the experiment in which u and v are white, each of its own noise."""
    return experiment_of(system, [[["1", "0"]]], [[["0", "1"]]])


def _feedback_hidden(random: Random) -> Experiment:
    """With F K = A z and G K = C z the fault moves the state by z one sample earlier, and adds no column to those of O_s."""
    system = _system(random, 1, 1)
    A, C = Matrix.of(system["A"]), Matrix.of(system["C"])
    z = Matrix.of(_rows(random, A.nrows, 1))
    return following(system | {"F": (A @ z).to_json(), "G": (C @ z).to_json()}, "1")


def _feedback_unseen_in_inputs(random: Random) -> Experiment:
    """With C'G = -A'Q F, where Q is the observability gramian, output error gives the true B and D."""
    a, f = Fraction(random.randint(-4, 4), 5), random.randint(1, 3)
    g = -a * f / (1 - a * a)
    b = random.choice((Fraction(1), a**3 * f / (1 - a**4)))  # with the second the rest of the limit is orthogonal to O_s for s = 2
    return following({"A": [[str(a)]], "B": [[str(b)]], "C": [["1"]], "D": [["0"]], "F": [[str(f)]], "G": [[str(g)]]}, "1")


FAMILIES: dict[str, Callable[[Random], Experiment]] = {
    Drawn.INDEPENDENT: _independent,
    Drawn.INDEPENDENT_AUTOREGRESSIVE: _independent_autoregressive,
    Drawn.DEGENERATE: _degenerate,
    Drawn.PERIODIC: _period,
    Drawn.WHITE_LED: _white_leads,
    Drawn.SIMULTANEOUS: lambda random: leading(_system(random, 1, 1), ["1"], ["1"], ["1"]),
    Drawn.MOVING_AVERAGE_LED: lambda random: leading(_system(random, 1, 1), ["1", "1/2"], ["1"], ["0"] * random.randint(1, 2) + ["1"]),
    Drawn.LEAD_ONE: _lead_one,
    Drawn.AUTOREGRESSIVE_LED: _autoregressive,
    Drawn.FEEDBACK: lambda random: following(_system(random, 1, 1), random.choice(("1", "-1", "2"))),
    Drawn.FEEDBACK_HIDDEN: _feedback_hidden,
    Drawn.FEEDBACK_UNSEEN_IN_INPUTS: _feedback_unseen_in_inputs,
    Drawn.INDEPENDENT_WHITE: lambda random: independent_white(_system(random, 1, 1)),
}


# Families of which more are drawn, since few of them meet the hypotheses of some reading.
MORE: dict[str, int] = {Drawn.INDEPENDENT: 3, Drawn.INDEPENDENT_AUTOREGRESSIVE: 2}


def nilpotent_points(largest: int = 3) -> Iterator[Experiment]:
    """For each spectrum above, n = 1 to `largest` and s = 2 to n + 1: a nilpotent A driven at its end, past = n; one input and two."""
    for n, (num, den), nu in product(range(1, largest + 1), _COLOURS, (1, 2)):
        shift = [["1" if j == i + 1 else "0" for j in range(n)] for i in range(n)]
        B = [["1" if i == n - 1 else "0", *["0"] * (nu - 1)] for i in range(n)]
        unit = [["1" if i == j else "0" for j in range(n)] for i in range(n)]
        # The second input is correlated with the first, one sample late.
        lags = [[[*([x] if i == 0 else ["0"]), *(["0"] * (nu - 1)), "0"] for i in range(nu)] for x in num] + [[["0"] * (nu + 1)] * nu]
        if nu == 2:
            lags[0][1], lags[1][1] = ["0", "1", "0"], ["1/2", "0", "0"]
        v = [[["0"] * nu + ["1"]]]
        for s in range(2, n + 2):
            yield read_experiment(
                {"A": shift, "B": B, "C": unit, "D": [["0"] * nu] * n, "F": [["1"]] * n, "G": [["0"]] * n}
                | {"s": s, "past": n, "u_filter": {"num": lags, "den": den}, "v_filter": v}
            )


Drive = Callable[[dict[str, Any]], Experiment]


def experiments_in_order(drives: Sequence[Drive]) -> Iterator[Experiment]:
    """Small experiments, n = m = nu = 1, F = 1, D = 0: p = 1, 2; A = 0, 1/2; B, C, G with entries 0, 1, -1, 2; then the drives."""
    values = ("0", "1", "-1", "2")
    for p in (1, 2):
        for A, B, *columns in product(("0", "1/2"), *[values] * (1 + 2 * p)):
            C, G = columns[:p], columns[p:]
            system = {"A": [[A]], "F": [["1"]], "B": [[B]], "C": [[c] for c in C], "G": [[g] for g in G], "D": [["0"]] * p}
            for drive in drives:
                yield drive(system)


LIMITS = Material("limits", "population limits", _sources, _examined, 10)
AT_NILPOTENT = partial(examine_experiment, "at a nilpotent A, for one u, n and s each")
NILPOTENT = Material("limits at nilpotent A", "population limits at nilpotent A", _nilpotent, AT_NILPOTENT, 1)
