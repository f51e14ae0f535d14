"""The tail of chi-squared is that of scipy's statistics, bit for bit, and commands do without loading those."""

from __future__ import annotations

import math
import subprocess
import sys

import numpy as np
import pytest
import scipy.stats

from faultspace.base.chi_squared import chi_squared_tail


@pytest.mark.parametrize("freedom", [1, 2, 3.7, 40, 100_000])
def test_the_tail_is_that_of_scipy(freedom: float) -> None:
    points = [-math.inf, -1.0, -0.0, 0.0, 5e-324, math.inf, *np.random.default_rng(3).uniform(0, 4 * freedom, 50).tolist()]
    assert [chi_squared_tail(x, freedom) for x in points] == scipy.stats.chi2.sf(points, freedom).tolist()
    assert math.isnan(chi_squared_tail(math.nan, freedom))


@pytest.mark.parametrize("x", [-1.0, 0.0, 1.0, math.inf])
def test_no_freedom_has_no_tail(x: float) -> None:
    assert all(math.isnan(chi_squared_tail(x, freedom)) for freedom in (0, -1, math.nan))


def test_identify_is_imported_without_the_statistics() -> None:
    source = "import sys, faultspace.cli.identifying; print([name for name in sys.modules if name.startswith('scipy.stats')])"
    assert subprocess.run([sys.executable, "-c", source], capture_output=True, text=True, check=True).stdout == "[]\n"
