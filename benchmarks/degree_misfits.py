"""This measures by what likelihood ratios of the total degree of kernel rows exceed their law where the degree suffices.

    OPENBLAS_NUM_THREADS=1 python benchmarks/degree_misfits.py [--systems 12] [--seed 1] [--samples 1001 10000] [--limit SECONDS]
        [--short 500 1000 2000]

The records are those of `space_at_the_bound_cells.py`; rows of the true degree and of all higher ones are fitted as `fault_space_by_rows`
does. SLACK of `numeric/method/rows/degree.py` stands for what is printed, for one degree more and for several: the 90 % quantile of the
ratio over that of its law, less one. The other columns say, for each kind of record, how often the ratio is beyond the 90 % quantile of its
law with the constants as they are set, and how often the stated probability is below 1 %, which is where a degree that suffices is refused.
`--short` repeats it on the same records for other values of SHORT of `numeric/method/rows/faint_faults.py`, the samples up to which the
spectra of faint faults have as few bands as the test of sphericity: what is printed is to depend on it little.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from unittest.mock import patch

import numpy as np
import scipy.stats

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # run from a clone, installed or not
sys.path.insert(0, str(Path(__file__).resolve().parent))

from space_at_the_bound_cells import CELLS, Cell

from benchmarks.counting_at_the_bound import one_in_ten, rate
from faultspace.numeric.method.rows import faint_faults, space
from faultspace.numeric.method.rows.degree import ENOUGH, SLACK, likelihood_ratio


def ratios(cell: Cell, seed: int, number: int, samples: int) -> list[tuple[int, int, int, float]]:
    """Return rows, degrees more, degrees of freedom and ratio, for each higher degree, of one record."""
    trial = cell.trial(seed, number, samples)
    n, p, records = trial.model.n, trial.model.p, [(trial.y, trial.u)]
    rows, degree, most, shares = p - trial.n_v, n - trial.zeta, n + space.BEYOND, np.ones(p)
    found = space.compared(records, space.pooled(records, -(-most // rows)), rows, most, shares, n)
    fits, channels = found.fits, found.data.moments.channels
    return [
        (rows, more, more * channels, likelihood_ratio(found.moments, fits[degree], fits[degree + more]))
        for more in range(1, len(fits) - degree)
    ]


def main() -> None:
    """Print the quantiles and rates for each value of SHORT."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--systems", type=int, default=12, help="records a cell")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--samples", type=int, nargs="+", default=[1001, 10000])
    parser.add_argument("--limit", type=float, default=float("inf"), help="seconds for all")
    parser.add_argument("--short", type=int, nargs="+", default=[faint_faults.SHORT], help="samples")
    options = parser.parse_args()
    end = time.monotonic() + options.limit
    found: dict[int, list[tuple[int, int, int, int, float]]] = {short: [] for short in options.short}
    records = [(number, samples, cell) for number in range(options.systems) for samples in options.samples for cell in CELLS]
    for number, samples, cell in records:
        if time.monotonic() < end:
            for short, kept in found.items():
                with patch.object(faint_faults, "SHORT", short):
                    kept += [(samples, *one) for one in ratios(cell, options.seed, number, samples)]
    for short, kept in found.items():
        print(f"SHORT = {short}{' (as set)' if short == faint_faults.SHORT else ''}")
        shown(kept)


def shown(found: list[tuple[int, int, int, int, float]]) -> None:
    """Print the quantile that SLACK stands for, and the rates of each kind of record, of (samples, *ratios)."""
    for name, several in (("one degree more", False), ("several degrees more", True)):
        chosen = [one for one in found if (one[2] > 1) == several]
        over = np.array([ratio / freedom / one_in_ten(freedom) for *_, freedom, ratio in chosen])
        print(f"{name}: SLACK {np.quantile(over, 0.9) - 1:.2f} (set: {SLACK[several]:g}), of {len(chosen)}")
        misfit = 1 + SLACK[several]
        for samples, rows in sorted({one[:2] for one in chosen}):
            here = [k for k, one in enumerate(chosen) if one[:2] == (samples, rows)]
            beyond = sum(over[k] > misfit for k in here)
            refused = sum(scipy.stats.chi2.sf(chosen[k][4] / misfit, chosen[k][3]) < ENOUGH for k in here)
            print(
                f"    N = {samples}, rows: {rows}: beyond one in ten {rate(beyond, len(here))}, below {ENOUGH:g} {rate(refused, len(here))}"
            )


if __name__ == "__main__":
    main()
