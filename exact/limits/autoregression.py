"""This is what an ARX model of h lags converges to: the best prediction of y(k) from u(k) and the last h samples of y and u, exact.

    A(q) y(k) = B(q) u(k) + e(k),   A(q) = I + A_1 q^-1 + .. + A_h q^-h,   B(q) = B_0 + .. + B_h q^-h,   plant A^-1 B

Let y = G u + d, with d uncorrelated with u at every lag: open loop.

Excitation. Where the last h samples of d have a nonsingular covariance, A and B are unique if and only if u(k), .., u(k-h) have one: u is
persistently exciting of order h + 1. For let a combination of the regressors vanish. The part of d in it is uncorrelated with the rest, so
it vanishes alone, and with it the coefficients of all y; what remains is a combination of u. No rank is left that a colour of u could take
away, unlike with PI-MOESP, whose limit may lose rank although u excites s + past samples.

Limit. Where Abar(q) d is white, the roots of det Abar lie inside the unit circle, and Abar G = Bbar is a polynomial, both of degree h or
less, A = Abar and B = Bbar, so that the plant is G exactly, whatever colour u has: e = Abar d is then uncorrelated with all regressors, the
past of d among them. With a root outside it is not: 1 - 2 q^-1, too, makes d(k) = d(k-1) / 2 + e(k) white. Faults that act as innovations
of an observer which is deadbeat are such, F = K and G = I with A - K C nilpotent. For any other d the plant of the limit is not G, and
tends to it as h grows [LW92].

Reduction. The estimator of the library then takes the plant of n states that is nearest to A^-1 B in the norm |E|^2 = mean over the
circle of tr W E P E*, W = A* S^-1 A the inverse spectrum of the faults, S the covariance of e, P the spectrum of u [W89]. That plant is no
rational function of the data, and is not given here; but it is no farther from A^-1 B than G is, which has n states itself, so that it is
within 2 |A^-1 B - G| of G. And in open loop |A^-1 B - G|^2 = tr S^-1 Cov((A G - B) u) is a rational number: the `misfit`. So the bias of
the reduced plant, in the errors of prediction that it makes beside those that must be made, is at most 4 misfit; where the misfit is 0 the
reduced plant is G, whatever colour u has, as soon as u excites all of it.

    ARXLimit     A, B, the covariance of e, the misfit; `markov`
    arx_limit    of an Experiment
    longest_arx_limit   with the most lags, up to a number, for which it is unique
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from ...base.errors import InvalidInput, shorten
from ...base.sheets import Shown, counted, told
from ..algebra.fields import QQ
from ..algebra.matrices import Matrix, beside, rank, stacked
from ..algebra.notation import named_matrix
from .experiments import MAX_WINDOW_ROWS, Experiment
from .filters import Filter
from .lyapunov import solve
from .moments import covariances
from .process import Signal


@dataclass(frozen=True, repr=False)
class ARXLimit(Shown):
    """The limit of an ARX model of h lags: `outputs` has I, A_1, .., A_h (p x p), `inputs` has B_0, .., B_h (p x nu).

    `innovation` (p x p) is the covariance of e, and `open_loop` tells whether u is uncorrelated at all lags with what faults and noise do
    to the outputs. `misfit` is tr S^-1 Cov((A G - B) u), the power, in units of the innovations, of the errors of prediction that the
    plant's bias makes; None where the loop is not open, or S singular. The plant of n states that the estimator reduces this model to has
    at most four times that. Source: [LW92], [W89]. Raises nothing.

    >>> from faultspace.exact import arx_limit, read_experiment
    >>> system = {"A": [["1/2"]], "B": [[1]], "C": [[1]], "D": [[0]], "F": [["1/2"]], "G": [[1]]}
    >>> found = arx_limit(read_experiment({**system, "s": 1, "past": 1, "u_filter": [[[1, 0]]], "v_filter": [[[0, 1]]]}), 1)
    >>> found.outputs, found.inputs, found.innovation
    (([[1]], [[-1/2]]), ([[0]], [[1]]), [[1]])
    """

    outputs: tuple[Matrix, ...]
    inputs: tuple[Matrix, ...]
    innovation: Matrix
    open_loop: bool
    misfit: Fraction | None = None

    @property
    def title(self) -> str:
        """This says how many lags the model has, and whether it was in open loop."""
        loop = "in open loop" if self.open_loop else "with inputs that follow the faults"
        return f"the limit of an ARX model of {counted(self.lags, 'lag')}, {loop}"

    def sheet(self) -> Iterator[tuple[str, str]]:
        """The result has the coefficients of the outputs and of the inputs, and the covariance of what they leave."""
        for name, matrices in (("A", self.outputs[1:]), ("B", self.inputs)):
            for k, matrix in enumerate(matrices, start=int(name == "A")):
                yield from named_matrix(f"{name}_{k}", matrix)
        yield from named_matrix("covariance of e", self.innovation)
        yield "misfit of the plant", "not known" if self.misfit is None else str(self.misfit)

    def to_json(self) -> dict[str, Any]:
        """Return a JSON-ready dict of exact numbers."""
        return told(self, "lags", "open_loop", "outputs", "inputs", "innovation", "misfit")

    @property
    def lags(self) -> int:
        """The number h of lags."""
        return len(self.outputs) - 1

    def markov(self, count: int) -> list[Matrix]:
        """Return the first `count` Markov parameters of A^-1 B, p x nu each."""
        p, nu = self.inputs[0].shape
        result: list[Matrix] = []
        for k in range(count):
            following = self.inputs[k] if k <= self.lags else Matrix.zero(QQ, p, nu)
            for i in range(1, min(k, self.lags) + 1):
                following = following - self.outputs[i] @ result[k - i]
            result.append(following)
        return result


def arx_limit(experiment: Experiment, lags: int) -> ARXLimit:
    """Compute what an ARX model of so many lags converges to as the number of samples goes to infinity, exact in every number.

    Source: [LW92]; the module states what A and B need to be unique, and when the plant is the true one.

    Parameters
    ----------
    experiment : Experiment
    lags : int
        h >= 0, a number of samples, with (h + 1)(nu + p) at most 2048.

    Returns
    -------
    ARXLimit

    Raises
    ------
    InvalidInput
        For other lags, and where the limit is not unique, with what is missing.

    Examples
    --------
    >>> from faultspace.exact import arx_limit, read_experiment
    >>> system = {"A": [["1/2"]], "B": [[1]], "C": [[1]], "D": [[0]], "F": [[1]], "G": [[0]]}
    >>> found = arx_limit(read_experiment({**system, "s": 1, "past": 1, "u_filter": [[[1, 0]]], "v_filter": [[[0, 1]]]}), 2)
    >>> found.markov(3), found.open_loop
    ([[[0]], [[1]], [[1/2]]], True)
    """
    p, nu = experiment.system.residual.p, experiment.system.nu
    if type(lags) is not int or lags < 0 or (lags + 1) * (nu + p) > MAX_WINDOW_ROWS:
        raise InvalidInput(f"lags: got {shorten(lags)}, expected an integer >= 0 with (lags + 1)(nu + p) at most {MAX_WINDOW_ROWS}")
    known = covariances(experiment)
    u, y = known.process.u, known.process.y
    window = range(-lags, 1)
    width = p + nu
    joint = Signal(stacked(y.H, u.H), stacked(y.J, u.J))
    whole = known.windows(joint, joint, window, window)
    now = range(lags * width, lags * width + p)
    regressors = [i for i in range(whole.nrows) if i not in now]
    gram = whole.rows(regressors).columns(regressors)
    crossed = whole.rows(regressors).columns(now)
    if rank(gram) < gram.nrows:
        excited = rank(known.windows(u, u, window, window))
        if excited < nu * (lags + 1):
            why = (
                f"the covariance of {counted(lags + 1, 'sample')} of u has rank {excited} of {nu * (lags + 1)}: try an input of more noises"
            )
        else:
            why = (
                f"u excites {counted(lags + 1, 'sample')}, but faults and noise leave a "
                f"combination of outputs exact: try fewer lags, or noise"
            )
        raise InvalidInput(f"lags: got {lags}, for which the limit is not unique: {why}")
    coefficients = solve(gram, crossed).transposed()
    blocks = [coefficients.columns(range(i * width, (i + 1) * width)) for i in range(lags)][::-1]
    outputs = (Matrix.identity(QQ, p), *(-block.columns(range(p)) for block in blocks))
    inputs = (coefficients.columns(range(lags * width, lags * width + nu)), *(block.columns(range(p, width)) for block in blocks))
    innovation = whole.rows(now).columns(now) - coefficients @ crossed
    open_loop = _uncorrelated(experiment.u_filter, experiment.v_filter) or _unseen(experiment)
    misfit = _misfit(experiment, outputs, inputs, innovation) if open_loop else None
    return ARXLimit(outputs, inputs, innovation, open_loop, misfit)


def longest_arx_limit(experiment: Experiment, most: int) -> ARXLimit:
    """Compute the limit of an ARX model with the most lags, `most` or fewer, for which it is unique. Raises InvalidInput where none is.

    Without noise on every output, faults fewer than outputs leave a combination of more lags exact. Source: that of `arx_limit`.

    >>> from faultspace.exact import read_experiment
    >>> system = {"A": [["1/2"]], "B": [[1]], "C": [[1], [1]], "D": [[0], [0]], "F": [[1]], "G": [[0], [1]]}
    >>> given = {**system, "s": 2, "past": 2, "u_filter": [[[1, 0]]], "v_filter": [[[0, 1]]]}
    >>> longest_arx_limit(read_experiment(given), 3).lags
    1
    """
    for lags in range(most, 0, -1):
        with suppress(InvalidInput):
            return arx_limit(experiment, lags)
    return arx_limit(experiment, 0)


def _misfit(experiment: Experiment, outputs: tuple[Matrix, ...], inputs: tuple[Matrix, ...], innovation: Matrix) -> Fraction | None:
    """Return tr S^-1 Cov((A G - B) u): what the input alone drives through the experiment, seen through A and B."""
    p = innovation.nrows
    if rank(innovation) < p:
        return None
    silent = replace(experiment.v_filter, numerator=tuple(matrix - matrix for matrix in experiment.v_filter.numerator))
    known = covariances(replace(experiment, v_filter=silent, w_filter=None))
    u, y = known.process.u, known.process.y
    window = range(1 - len(outputs), 1)
    whole = known.windows(Signal(stacked(y.H, u.H), stacked(y.J, u.J)), Signal(stacked(y.H, u.H), stacked(y.J, u.J)), window, window)
    seen = beside(*(beside(outputs[-k], -inputs[-k]) for k in window))
    power = solve(innovation, seen @ whole @ seen.transposed())
    return sum((Fraction(int(power[i, i].p), int(power[i, i].q)) for i in range(p)), Fraction(0))


def _uncorrelated(u: Filter, v: Filter) -> bool:
    """This tells whether two filters of the same white noise give signals that are uncorrelated at all lags.

    The cross spectrum is the Laurent polynomial of the numerators over scalars: it vanishes where each coefficient does.
    """
    if v.channels == 0:
        return True
    for lag in range(1 - len(v.numerator), len(u.numerator)):
        total = Matrix.zero(QQ, u.channels, v.channels)
        for j, matrix in enumerate(u.numerator):
            if 0 <= j - lag < len(v.numerator):
                total = total + matrix @ v.numerator[j - lag].transposed()
        if not total.is_zero():
            return False
    return True


def _unseen(experiment: Experiment) -> bool:
    """This tells whether what faults and noise do to the outputs is uncorrelated with u at all lags.

    Both halves of the sequence of these covariances are H Phi^l K, so that each is zero where it is on as many lags as there are states.
    """
    system = experiment.system
    rest = replace(system, B=system.B - system.B, D=system.D - system.D)
    known = covariances(replace(experiment, system=rest))
    most = known.process.Phi.nrows
    return all(block.is_zero() for block in known.sequence(known.process.y, known.process.u, -most, most).values())
