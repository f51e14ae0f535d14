"""The law of chi-squared and the taper are those of scipy, bit for bit, and the command is imported without those folders of scipy's
and without joblib."""

from __future__ import annotations

import math
import subprocess
import sys

import numpy as np
import pytest
import scipy.signal
import scipy.stats

from faultspace.base.chi_squared import chi_squared_quantile, chi_squared_tail
from faultspace.numeric.method.space.tapered_moments import cosine_taper

IDENTIFIED = """
import sys
import faultspace.cli.identifying
print([name for name in sys.modules if name.startswith(('scipy.stats._stats', 'scipy.signal', 'joblib'))])
"""


@pytest.mark.parametrize("freedom", [1, 2, 3.7, 40, 100_000])
def test_the_tail_is_that_of_scipy(freedom: float) -> None:
    points = [-math.inf, -1.0, -0.0, 0.0, 5e-324, math.inf, *np.random.default_rng(3).uniform(0, 4 * freedom, 50).tolist()]
    assert [chi_squared_tail(x, freedom) for x in points] == scipy.stats.chi2.sf(points, freedom).tolist()
    assert math.isnan(chi_squared_tail(math.nan, freedom))


@pytest.mark.parametrize("freedom", [1, 2, 3.7, 40, 100_000])
def test_the_quantile_is_that_of_scipy(freedom: float) -> None:
    levels = [0.0, 1e-300, 0.5, 0.999, 1.0, -0.1, 1.1, math.nan]
    assert np.array_equal([chi_squared_quantile(q, freedom) for q in levels], scipy.stats.chi2.ppf(levels, freedom), equal_nan=True)


@pytest.mark.parametrize("x", [-1.0, 0.0, 1.0, math.inf])
def test_no_freedom_has_no_law(x: float) -> None:
    assert all(math.isnan(chi_squared_tail(x, freedom)) for freedom in (0, -1, math.nan))
    assert all(math.isnan(chi_squared_quantile(0.5, freedom)) for freedom in (0, -1, math.nan))


@pytest.mark.parametrize("length", [2, 3, 19, 20, 21, 22, 1000, 4097])
@pytest.mark.parametrize("edges", [0.1, 0.5, 0.999])
def test_the_taper_is_that_of_scipy(length: int, edges: float) -> None:
    assert cosine_taper(length, edges).tobytes() == scipy.signal.windows.tukey(length, edges).tobytes()


def test_the_command_is_imported_without_statistics_and_filters() -> None:
    assert subprocess.run([sys.executable, "-c", IDENTIFIED], capture_output=True, text=True, check=True).stdout == "[]\n"
