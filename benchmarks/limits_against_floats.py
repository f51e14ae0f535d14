"""Float estimates from longer and longer records against the exact limits of PI-MOESP and PO-MOESP.

    python benchmarks/limits_against_floats.py [--largest 1000000] [--seeds 16] [--plot FILE]

chosen      one experiment of each family that the proofs draw from: of two states, the first with a limit that is not zero
expected    what is exact: L, and where its column space carries a model of order n, that model's characteristic polynomial
            and, if it is stable, D, CB, ..., CA^(n-1)B by output error
estimated   the same from the first N samples of a record: (1/N) Yf Pi Z' from its Hankel matrix's Gram, and the method's model of order n
compared    both over seeds: median error at each N, standard errors between mean and limit at the largest N
table, drawn   a sheet, and error against N with slope -1/2

Shorter records are the beginnings of the longest of their seed. A standard error is the standard deviation over seeds divided by the root
of their number; differences below ROUNDING times the size of the exact vector do not count: where y is the response of a model of order n
to u alone, estimates of the model are right at every N. Exit 1 where a limit is more than ERRORS standard errors away.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # run from a clone, installed or not


from benchmarks.sheets import Sheet, markdown
from faultspace.base.progress import evenly, working
from faultspace.exact.limits.experiments import Experiment
from faultspace.exact.limits.moesp import PopulationLimits, limit
from faultspace.numeric.method.model.displacement_gram import DisplacementGram
from faultspace.numeric.method.model.past_inputs import pi_moesp
from faultspace.numeric.method.model.past_outputs import po_moesp
from faultspace.proofs.evidence.experiments import FAMILIES
from tests.numeric.predicted_limits import floats, invariants, simulated

ERRORS = 5.0
ROUNDING = 1e-9
SHORTEST = 1000
DRAWN = 200  # experiments of a family, at most, to find one with n = 2
METHODS = ("PI-MOESP", "PO-MOESP")


@dataclass(frozen=True)
class Comparison:
    """`errors`: median over seeds of |estimate - exact| / |exact|, by N (|exact| = 1 where that is 0).

    `what` is "L" or "model"; `standard_errors` the largest over the entries at the largest N; `slope` of log error against log N, None
    where every error is rounding. `biased`: the limit of this method is not the range of O_s.
    """

    family: str
    method: str
    what: str
    rank: int
    order: int
    biased: bool
    errors: dict[int, float]
    standard_errors: float

    @property
    def slope(self) -> float | None:
        values = list(self.errors.values())
        if max(values) < ROUNDING:
            return None
        return float(np.polyfit(np.log(list(self.errors)), np.log(values), 1)[0])


def chosen(family: str) -> PopulationLimits:
    """Return the first experiment of the family, by seed, with a nonzero limit of PI-MOESP, of those with n = 2 where it has some."""
    drawn = [FAMILIES[family](Random(f"{family} {seed}")) for seed in range(DRAWN)]
    most = max(experiment.system.residual.n for experiment in drawn if experiment.system.residual.n <= 2)
    found_limits = (limit(experiment) for experiment in drawn if experiment.system.residual.n == most)
    return next(found for found in found_limits if found.past_inputs.rank)


def expected(found: PopulationLimits) -> dict[tuple[str, str], Any]:
    """Return the exact vectors by method and "L" or "model"."""
    result: dict[tuple[str, str], Any] = {}
    for method, one in zip(METHODS, (found.past_inputs, found.past_outputs), strict=True):
        result[method, "L"] = floats(one.matrix).ravel()
        limits = found.of_limit(one)
        if one.state is not None:
            monic = [float(c) for c in reversed(one.state.characteristic_polynomial)]
            parts = (limits["markov"] or [])[: found.experiment.system.residual.n + 1]
            result[method, "model"] = np.array(monic[1:] + [float(Fraction(x)) for part in parts for row in part for x in row])
    return result


def estimated(experiment: Experiment, y: Any, u: Any, wanted: dict[tuple[str, str], Any]) -> dict[tuple[str, str], Any]:
    """Estimates of the vectors of `expected` that are wanted, as long as those."""
    s, past, n = experiment.s, experiment.past, experiment.system.residual.n
    projected = sample_limits(y, u, s, past)
    result = {(method, "L"): matrix.ravel() for method, matrix in zip(METHODS, projected, strict=True)}
    for method, identify in zip(METHODS, (pi_moesp, po_moesp), strict=True):
        if (method, "model") in wanted:
            model = identify(y, u, order=n, block_rows=s, past_rows=past).model
            result[method, "model"] = invariants(model.A, model.B, model.C, model.D)[: len(wanted[method, "model"])]
    return result


def sample_limits(y: Any, u: Any, s: int, past: int) -> tuple[Any, Any]:
    """Return (1/N) Yf Pi Z' for Z = Up and Z = [Up; Yp], N the number of columns."""
    nu, p = u.shape[1], y.shape[1]
    gram = DisplacementGram(nu + p, past + s)
    gram.append(np.hstack([u, y]))
    blocks = (gram.gram() / gram.columns).reshape(past + s, nu + p, past + s, nu + p)

    def between(left: tuple[slice, slice], right: tuple[slice, slice]) -> Any:
        block = blocks[left[0], left[1], right[0], right[1]]
        return block.reshape(block.shape[0] * block.shape[1], -1)

    before, future, inputs, outputs = slice(past), slice(past, None), slice(nu), slice(nu, None)
    uf, yf, up, yp = (future, inputs), (future, outputs), (before, inputs), (before, outputs)

    def projected(*instruments: tuple[slice, slice]) -> Any:
        crossed, seen = (np.hstack([between(rows, z) for z in instruments]) for rows in (uf, yf))
        return seen - between(yf, uf) @ np.linalg.solve(between(uf, uf), crossed)

    return projected(up), projected(up, yp)


def distance(estimates: Any, exact: Any) -> float:
    """Return standard errors of the mean between the mean and the exact vector, the largest over entries."""
    table = np.asarray(estimates)
    error = table.std(axis=0, ddof=1) / np.sqrt(len(table))
    return float(np.max(np.abs(table.mean(axis=0) - exact) / np.maximum(error, ROUNDING * size(exact))))


def size(exact: Any) -> float:
    """The unit is its Euclidean norm, and 1 for zero."""
    return float(np.linalg.norm(exact)) or 1.0


def compared(family: str, found: PopulationLimits, lengths: list[int], seeds: int) -> Iterator[Comparison]:
    """There is one Comparison for each exact vector."""
    exact = expected(found)
    tables: dict[tuple[str, str], dict[int, list[Any]]] = {key: {N: [] for N in lengths} for key in exact}
    for seed in range(seeds):
        y, u = simulated(found.experiment, lengths[-1], seed)
        for N in lengths:
            values = estimated(found.experiment, y[:N], u[:N], exact)
            for key in exact:
                tables[key][N].append(values[key])
    for (method, what), by_length in tables.items():
        limit = found.past_inputs if method == METHODS[0] else found.past_outputs
        vector = exact[method, what]
        errors = {N: float(np.median(np.linalg.norm(np.array(rows) - vector, axis=1))) / size(vector) for N, rows in by_length.items()}
        far = distance(by_length[lengths[-1]], vector)
        order = found.experiment.system.residual.n
        yield Comparison(family, method, what, limit.rank, order, not limit.equals_observability_range, errors, far)


def table(rows: list[Comparison]) -> Sheet:
    """The table has a line for each comparison."""
    lengths = list(rows[0].errors)
    head = ["family", "method", "rank L", "n", "range of O_s", "compared", *(f"N = {N:.0e}".replace("e+0", "e") for N in lengths)]
    lines = []
    for row in rows:
        cells = [row.family, row.method, str(row.rank), str(row.order), "no" if row.biased else "yes", row.what]
        cells += [f"{row.errors[N]:.2g}" for N in lengths]
        lines.append([*cells, "right at every N" if row.slope is None else f"{row.slope:.2f}", f"{row.standard_errors:.1f}"])
    return Sheet("floats against the exact limits", [*head, "slope", "standard errors"], lines)


def drawn(rows: list[Comparison], file: Path) -> None:
    """Draw two panels, L and model: a colour for each family, dashed for PO-MOESP, grey for slope -1/2."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    colours = dict(zip(dict.fromkeys(row.family for row in rows), pyplot.colormaps["tab10"].colors, strict=False))  # type: ignore[attr-defined]
    figure, panels = pyplot.subplots(1, 2, figsize=(12, 5.5), sharey=True, layout="constrained")
    titles = {"L": "(1/N) Yf Pi Z' against the exact L", "model": "model of order n, where L carries one"}
    for ax, (what, title) in zip(panels, titles.items(), strict=True):
        drawn_rows = [row for row in rows if row.what == what and row.slope is not None]
        for row in drawn_rows:
            dashed = row.method == METHODS[1]
            label = row.family if what == "L" and not dashed else None
            style = "s--" if dashed else "o-"
            ax.loglog(list(row.errors), list(row.errors.values()), style, color=colours[row.family], label=label, markersize=4)
        lengths = np.array(list(rows[0].errors), float)
        top = 2 * max((max(row.errors.values()) for row in drawn_rows), default=1.0)
        label = "slope -1/2" if what == "L" else None
        ax.loglog(lengths, top * np.sqrt(lengths[0] / lengths), color="0.6", linewidth=4, zorder=0, label=label)
        ax.set_title(title)
        ax.set_xlabel("samples N")
        ax.grid(True, which="major", alpha=0.3)
    panels[0].set_ylabel("relative error, median over seeds")
    figure.legend(loc="outside lower center", ncols=3, fontsize="small", title="solid: PI-MOESP, dashed: PO-MOESP", frameon=False)
    figure.savefig(file, dpi=120)
    pyplot.close(figure)


def main(arguments: list[str] | None = None) -> int:
    """Prints the table; 0 where every limit is met."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--largest", type=int, default=10**6, help="samples of the longest record (default 1e6)")
    parser.add_argument("--seeds", type=int, default=16, help="records a family (default 16)")
    parser.add_argument("--plot", type=Path, metavar="FILE", help="error against N, in a format that matplotlib writes")
    options = parser.parse_args(arguments)
    if options.largest < SHORTEST or options.seeds < 3:
        parser.error(f"got --largest {options.largest} --seeds {options.seeds}, needed at least {SHORTEST} samples and 3 seeds")
    lengths = [N for N in (SHORTEST * 10**k for k in range(8)) if options.largest > N] + [options.largest]
    rows: list[Comparison] = []
    with working("floats against limits") as tell:
        heard = evenly(tell)
        for done, family in enumerate(FAMILIES):
            heard("floats against limits", done, len(FAMILIES))
            rows += compared(family, chosen(family), lengths, options.seeds)
    print(markdown([table(rows)], []))
    if options.plot:
        drawn(rows, options.plot)
    far = [row for row in rows if not row.standard_errors < ERRORS]
    for row in far:
        print(f"{row.family}: {row.method}, {row.what}: {row.standard_errors:.1f} standard errors from the limit", file=sys.stderr)
    return 1 if far else 0


if __name__ == "__main__":
    sys.exit(main())
