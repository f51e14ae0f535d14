"""The law of chi-squared, without `scipy.stats`, which takes half a second to load and is loaded by no common command."""

from scipy.special import chdtrc, gammaincinv


def chi_squared_tail(x: float, freedom: float) -> float:
    """Return the probability that a chi-squared variable of so many degrees of freedom exceeds x, as `scipy.stats.chi2.sf` does.

    It is 1 for x <= 0, and NaN where no degree of freedom is left or x is NaN.

    >>> round(chi_squared_tail(3.841458820694124, 1), 6)
    0.05
    """
    return float("nan") if not freedom > 0 or x != x else float(chdtrc(freedom, max(x, 0.0)))


def chi_squared_quantile(q: float, freedom: float) -> float:
    """Return what a chi-squared variable of so many degrees of freedom stays below with probability q, as `scipy.stats.chi2.ppf` does.

    It is NaN where q is no probability or no degree of freedom is left.

    >>> round(chi_squared_quantile(0.95, 1), 6)
    3.841459
    """
    return 2 * float(gammaincinv(freedom / 2, q)) if freedom > 0 else float("nan")
