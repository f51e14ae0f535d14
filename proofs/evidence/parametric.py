"""The rank formulas and theorem 1 are shown as identities: for all parameter values at stated dimensions.

Each function takes a `Stratification`, checks one statement on every stratum, expands what it relies on by FLINT, and
returns a record of what it covered. A stratum on which a statement fails raises ClaimFailure, which names it.

    gap_claim           rank [O_s T_s] = s r + sum min(s, eta_i), and the gap is r from s = n on
    inclusion_claim     theorem 1: n + 1 samples decide inclusion on all windows
    zero_count_claim    theorem 2: rank [O_s T_s] = n + s m - zeta for left-invertible systems, exactly from s = lag on
    horner_identity     a relation that annihilates a system on its own samples is annihilated with all its shifts
    Identity, ClaimFailure
"""

from __future__ import annotations

from dataclasses import dataclass

from ...exact.parametric.case_tree import Branch, refine
from ...exact.parametric.identities import FlintWindow, IdentityFailure, SecondRoute, verify_cases, verify_identities
from ...exact.parametric.pencil import Echelon, FiniteZeros, NormalRank, finite_zeros, normal_rank, toeplitz_echelon
from ...exact.parametric.pencil_identities import verify_echelon_rows, verify_finite_zeros, verify_normal_rank
from ...exact.parametric.stratification import Row, Stratification, Stratum, combined, indeterminates, times


class ClaimFailure(ValueError):
    """The statement fails on a stratum: a refutation by any of its points."""

    def __init__(self, stratum: Stratum, statement: str) -> None:
        super().__init__(f"{statement} fails where {stratum.equations} vanish and {stratum.inequations} do not")
        self.stratum = stratum
        self.statement = statement


@dataclass(frozen=True)
class Identity:
    """A statement was shown for all parameter values on so many `strata`, by `expanded` identities that FLINT multiplied out.

    `zeros` has the triples (n_f, n_inf, lag) that were met, where zeros were counted.
    """

    strata: int
    expanded: int
    zeros: tuple[tuple[int, int, int], ...] = ()


@dataclass(frozen=True)
class _Zeros:
    normal_rank: NormalRank
    finite: FiniteZeros | None
    infinite: Echelon | None


def gap_claim(stratification: Stratification) -> Identity:
    """Proposition 3 with window n and the window formula; needs windows up to n + 3, else ValueError.

    The normal rank is that of the pencil, less n, decided by minors; the eta_i are the places where the gap falls.
    """
    entries = stratification.entries
    n, p, _ = stratification.dimensions
    _needs_windows(stratification, n + 3)
    rows = verify_identities(stratification).expanded
    refined = refine(stratification.cases(), lambda branch, stratum: normal_rank(entries, branch))
    route = SecondRoute(entries.ring)
    window = FlintWindow(route, entries, 1)
    verify_cases(route, [branch for branch, _ in refined])
    gap_windows = tuple(range(n, n + 3))
    for branch, (stratum, found) in refined:
        _verify_within(branch, stratum)
        verify_normal_rank(window, entries, branch, found)
        r = found.rank - n
        gaps = [stratum.gap(s) for s in range(stratification.windows)]
        if any(gaps[s] != r for s in gap_windows):
            raise ClaimFailure(stratum, f"gap(s) = {r} for s = {gap_windows}")
        # The number of indices equal to s is how much the gap falls between s - 1 and s, from gap(-1) = p on.
        falls = [before - after for before, after in zip([p, *gaps], gaps, strict=False)]
        indices = [s for s, fall in enumerate(falls) for _ in range(fall)]
        if min(falls, default=0) < 0 or len(indices) != p - r or tuple(indices) != stratum.left_minimal_indices:
            raise ClaimFailure(stratum, "the gap falls p - r times")
        for s in range(1, stratification.windows + 1):
            if stratum.window_rank(s) != s * r + sum(min(s, index) for index in indices):
                raise ClaimFailure(stratum, f"rank = s r + sum min(s, eta_i) at s = {s}")
    return Identity(len(stratification.strata), rows + route.expanded)


def inclusion_claim(stratification: Stratification) -> Identity:
    """Theorem 1 with n + 1 samples, on windows up to `stratification.windows` (at least n + 2, else ValueError).

    If all behaviours of an inner system on n + 1 samples are behaviours of the outer one, every basic relation of the
    outer system, of degree at most n, annihilates the inner one on n + 1 samples; by the Horner identity so do its shifts;
    they generate all relations of the outer system, so its behaviours on every window contain those of the inner one. Inner systems with
    m and m + 1 faults are looked at.
    """
    n, p, m = stratification.dimensions
    _needs_windows(stratification, n + 2)
    rows = verify_identities(stratification).expanded
    for stratum in stratification.strata:
        basic = [row for row in stratum.rows if row.kind == "relation"]
        if any(row.degree > n for row in basic):
            raise ClaimFailure(stratum, f"every basic relation has degree at most {n}")
        for s in range(1, stratification.windows + 1):
            # A shift ends, with a unit, in the row (degree + shift, output): where these differ the shifts are independent.
            last_rows: list[Row] = [(k, row.output) for row in basic for k in range(row.degree, s)]
            nullity = s * p - stratum.window_rank(s)
            if len(set(last_rows)) != len(last_rows) or len(last_rows) != nullity:
                raise ClaimFailure(stratum, f"the shifts of basic relations generate all relations of {s} samples")
    expanded = sum(
        horner_identity(n, p, faults, degree, stratification.windows - degree) for faults in (m, m + 1) for degree in range(n + 1)
    )
    return Identity(len(stratification.strata), rows + expanded)


def horner_identity(n: int, p: int, m: int, degree: int, shifts: int) -> int:
    """Expand, with all entries of N_0..N_degree and of a system (n, p, m) indeterminate, for each shift k = 1..shifts:

        [0, N_0, ..., N_degree] [O T] = [d A^k, d A^(k-1) F, ..., d F, e],   [d, e] = [N_0, ..., N_degree] [O T],

    so that [d, e] = 0 makes the left side 0. Both sides are expanded in sympy's ring and again by FLINT; returns the number
    of entries compared by each. Raises IdentityFailure if one differs.
    """
    names = [f"n{j}_{i + 1}" for j in range(degree + 1) for i in range(p)]
    entries = indeterminates(n, p, m, more=names)
    weights = dict(
        zip(
            [(j, i) for j in range(degree + 1) for i in range(p)],
            entries.ring.gens[entries.parameters + 1 :],
            strict=True,
        )
    )
    route = SecondRoute(entries.ring)
    window = FlintWindow(route, entries, degree + 1 + shifts)
    base = combined(entries, weights.items(), degree + 1)
    flint_base = [sum((route(f) * window.rows[row][column] for row, f in weights.items()), window.zero) for column in range(len(base))]
    for shift in range(1, shifts + 1):
        samples = degree + 1 + shift
        left = combined(entries, (((j + shift, i), f) for (j, i), f in weights.items()), samples)
        state = base[:n]
        base = times(state, entries.A, n, entries.ring) + times(state, entries.F, m, entries.ring) + base[n:]
        if left != base:
            raise IdentityFailure(f"a relation of degree {degree} shifted by {shift} is not what Horner's rule says")
        state = flint_base[:n]
        flint_base = window.times(state, window.A, n) + window.times(state, window.F, m) + flint_base[n:]
        for column, right in enumerate(flint_base):
            shifted = ((window.rows[j + shift, i], f) for (j, i), f in weights.items())
            route.equal(sum((line[column] * route(f) for line, f in shifted), window.zero), right, f"shift {shift}")
    return route.expanded


def zero_count_claim(stratification: Stratification) -> Identity:
    """Theorem 2 with zeta the zeros of the pencil, finite and infinite, where r = m; needs windows up to n + 2, else ValueError."""
    entries = stratification.entries
    n, _, m = stratification.dimensions
    _needs_windows(stratification, n + 2)
    rows = verify_identities(stratification).expanded
    samples = n + 2

    def zeros(branch: Branch, _: Stratum) -> _Zeros:
        found = normal_rank(entries, branch)
        if found.rank < n + m:
            return _Zeros(found, None, None)
        return _Zeros(found, finite_zeros(entries, branch), toeplitz_echelon(entries, branch, samples))

    refined = refine(stratification.cases(), zeros)
    route = SecondRoute(entries.ring)
    window = FlintWindow(route, entries, samples)
    verify_cases(route, [branch for branch, _ in refined])
    values = set()
    strata = set()
    for branch, (stratum, found) in refined:
        _verify_within(branch, stratum)
        verify_normal_rank(window, entries, branch, found.normal_rank)
        if found.finite is None or found.infinite is None:
            continue
        verify_finite_zeros(window, entries, branch, found.finite)
        verify_echelon_rows(window, entries, branch, found.infinite)
        # rank T_(s+1) - rank T_s is the number of infinite zero orders that are at most s. Where it has reached m, all
        # orders are known to be counted in s m - rank T_s.
        if found.infinite.rank(samples) - found.infinite.rank(samples - 1) != m:
            raise ClaimFailure(stratum, f"rank T_{samples} - rank T_{samples - 1} = {m}")
        finite, infinite = found.finite.degree, samples * m - found.infinite.rank(samples)
        lag = max(stratum.left_minimal_indices, default=0)
        for s in range(1, stratification.windows + 1):
            if (stratum.window_rank(s) == n + s * m - finite - infinite) != (s >= lag):
                raise ClaimFailure(stratum, f"rank [O_s T_s] = n + s m - zeta exactly from s = {lag} on, at s = {s}")
        values.add((finite, infinite, lag))
        strata.add(id(stratum))
    return Identity(len(strata), rows + route.expanded, tuple(sorted(values)))


def _verify_within(branch: Branch, stratum: Stratum) -> None:
    """Raise IdentityFailure unless the branch is part of the stratum."""
    decisions = stratum.branch.decisions
    if branch.decisions[: len(decisions)] != decisions:
        raise IdentityFailure("a branch is not part of the stratum it belongs to")


def _needs_windows(stratification: Stratification, least: int) -> None:
    if stratification.windows < least:
        raise ValueError(f"the claim needs windows up to {least} (the stratification has {stratification.windows})")
