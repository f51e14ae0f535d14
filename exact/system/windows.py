"""The matrices of a window of s samples, built in full as they are defined.

observability_matrix   O_s, s block rows C, CA, ..., CA^(s-1)                        ps x n
toeplitz_matrix        T_s, G on the diagonal, C A^(i-j-1) F below                    ps x ms
window_matrix          [O_s T_s], from (x(0), v(0), ..., v(s-1)) to the samples        ps x (n + ms)
reachability_matrix    [F, AF, ..., A^(n-1) F]                                         n x nm
"""

from __future__ import annotations

from ..algebra.matrices import Matrix, beside, stacked
from ..algebra.validation import fits, natural
from .systems import System, residual_of


def observability_matrix(system: System, s: int) -> Matrix:
    """Return O_s, the s block rows C, C A, ..., C A^(s-1), which take x(0) to the outputs of s samples.

    Source: [G25] Theorem 2 after [SB21]; [K80].

    Parameters
    ----------
    system : System
        Of n states and p outputs.
    s : int
        A number of samples >= 0.

    Returns
    -------
    Matrix, shape (p s, n)

    Raises
    ------
    InvalidInput
        For what is no system, for s that is no integer >= 0, and for a window of more than 2^27 entries.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, observability_matrix
    >>> observability_matrix(ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]]), 3)
    [[1], [1/2], [1/4]]
    """
    system = residual_of(system)
    fits(natural(s, "s") * system.p, system.n, "s")
    blocks = [Matrix.zero(system.field, 0, system.n)]
    row = system.C
    for _ in range(s):
        blocks.append(row)
        row = row @ system.A
    return stacked(*blocks)


def toeplitz_matrix(system: System, s: int) -> Matrix:
    """Return T_s, G on the diagonal and C A^(i-j-1) F below, the response to the fault from rest.

    Source: [G25] Theorem 2 after [SB21].

    Parameters
    ----------
    system : System
        Of m faults and p outputs.
    s : int
        A number of samples >= 0.

    Returns
    -------
    Matrix, shape (p s, m s)

    Raises
    ------
    InvalidInput
        For what is no system, for s that is no integer >= 0, and for a window of more than 2^27 entries.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, toeplitz_matrix
    >>> toeplitz_matrix(ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]]), 3)
    [[0, 0, 0], [1, 0, 0], [1/2, 1, 0]]
    """
    system = residual_of(system)
    fits(natural(s, "s") * system.p, s * system.m, "s")
    markov = [system.G]
    state = system.F
    for _ in range(1, s):
        markov.append(system.C @ state)
        state = system.A @ state
    nothing = Matrix.zero(system.field, system.p, system.m)
    rows = [beside(*(markov[i - j] if j <= i else nothing for j in range(s))) for i in range(s)]
    return stacked(Matrix.zero(system.field, 0, system.m * s), *rows)


def window_matrix(system: System, s: int) -> Matrix:
    """Return [O_s T_s], whose column space is the set of outputs that s samples can show.

    It takes (x(0), v(0), ..., v(s-1)) to (r(0), ..., r(s-1)); for ranks at many s ask `kernel_representation(system).rank`, which builds no
    such matrix. Source: [G25] Theorem 2 after [SB21].

    Parameters
    ----------
    system : System
    s : int
        A number of samples >= 0.

    Returns
    -------
    Matrix, shape (p s, n + m s)

    Raises
    ------
    InvalidInput
        For what is no system, for s that is no integer >= 0, and for a window of more than 2^27 entries.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, rank, window_matrix
    >>> built = window_matrix(ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]]), 2)
    >>> built, rank(built)
    ([[1, 0, 0], [1/2, 1, 0]], 2)
    """
    return beside(observability_matrix(system, s), toeplitz_matrix(system, s))


def reachability_matrix(system: System) -> Matrix:
    """Return [F, A F, ..., A^(n-1) F], whose column space is what the fault can reach from rest.

    (A, F) is controllable iff the rank is n. Source: [K80].

    Parameters
    ----------
    system : System
        Of n states and m faults.

    Returns
    -------
    Matrix, shape (n, n m)

    Raises
    ------
    InvalidInput
        For what is no system.

    Examples
    --------
    >>> from faultspace.exact import ResidualSystem, reachability_matrix
    >>> reachability_matrix(ResidualSystem.of([[0, 1], [0, 0]], [[0], [1]], [[1, 0]], [[0]]))
    [[0, 1], [1, 0]]
    """
    system = residual_of(system)
    blocks = [Matrix.zero(system.field, system.n, 0)]
    column = system.F
    for _ in range(system.n):
        blocks.append(column)
        column = system.A @ column
    return beside(*blocks)
