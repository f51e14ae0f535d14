"""Strata, drop conditions and claims with indeterminate entries, against elimination over Fraction at single values.

naive_rank              Gaussian elimination over Fraction
window_ranks            ranks of [O_s T_s] built block by block from given matrices
sparse_values           values of which many are 0
"""

import random
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sympy import ZZ
from sympy.polys.rings import ring as polynomial_ring

from faultspace.base.errors import InvalidInput
from faultspace.exact.parametric.case_tree import Branch, NonlinearCondition, Polynomial, UnitProduct, evaluate, explore, factors
from faultspace.exact.parametric.generic_ranks import GenericRanks, generic_window_ranks
from faultspace.exact.parametric.identities import FlintWindow, IdentityFailure, SecondRoute, verify_cases, verify_identities
from faultspace.exact.parametric.pencil import finite_zeros, normal_rank, toeplitz_echelon
from faultspace.exact.parametric.pencil_identities import verify_echelon_rows, verify_finite_zeros, verify_normal_rank
from faultspace.exact.parametric.stratification import Stratification, indeterminates, stratify
from faultspace.proofs.evidence import parametric as parametric_claims
from faultspace.proofs.evidence.parametric import ClaimFailure, gap_claim, horner_identity, inclusion_claim, zero_count_claim

Values = tuple[Fraction, ...]
Rows = list[list[Fraction]]

EMPTY = [(0, 0, 0), (0, 0, 1), (0, 1, 0), (1, 0, 0), (0, 1, 1), (1, 0, 1), (1, 1, 0), (2, 0, 1), (0, 2, 2), (2, 2, 0)]
SMALL = [(1, 1, 1), (1, 2, 1), (1, 1, 2), (1, 2, 2), (2, 1, 1), (1, 3, 1), (2, 1, 2)]
LARGER = [(2, 2, 1)]
ALL = EMPTY + SMALL + LARGER

strata_of = cache(stratify)


def naive_rank(rows: Rows) -> int:
    """Gaussian elimination gives the rank."""
    rows, rank = [list(row) for row in rows], 0
    for column in range(len(rows[0]) if rows else 0):
        pivot = next((i for i in range(rank, len(rows)) if rows[i][column]), None)
        if pivot is None:
            continue
        rows[rank], rows[pivot] = rows[pivot], rows[rank]
        for i in range(rank + 1, len(rows)):
            factor = rows[i][column] / rows[rank][column]
            rows[i] = [x - factor * y for x, y in zip(rows[i], rows[rank], strict=True)]
        rank += 1
    return rank


def matrices(dimensions: tuple[int, int, int], values: Values) -> tuple[Rows, Rows, Rows, Rows]:
    """The result is A, C, F, G from the parameter values in the order of the module."""
    n, p, m = dimensions
    rest = iter(values)
    a, c, f, g = ([[next(rest) for _ in range(w)] for _ in range(h)] for h, w in ((n, n), (p, n), (n, m), (p, m)))
    return a, c, f, g


def multiply(left: Rows, right: Rows, width: int) -> Rows:
    """The result is the product of left and right."""
    return [[sum((x * y[j] for x, y in zip(row, right, strict=True)), Fraction()) for j in range(width)] for row in left]


def window(dimensions: tuple[int, int, int], values: Values, samples: int) -> Rows:
    """The result is [O_s T_s]."""
    n, _, m = dimensions
    a, c, f, g = matrices(dimensions, values)
    powers = [c]
    for _ in range(samples):
        powers.append(multiply(powers[-1], a, n))
    markov = [g, *(multiply(power, f, m) for power in powers)]
    rows = []
    for k in range(samples):
        for i in range(len(c)):
            blocks = [markov[k - j][i] if j <= k else [Fraction()] * m for j in range(samples)]
            rows.append([*powers[k][i], *(entry for block in blocks for entry in block)])
    return rows


def window_ranks(dimensions: tuple[int, int, int], values: Values) -> list[int]:
    """The result is rank [O_s T_s] for s = 1..n+3."""
    return [naive_rank(window(dimensions, values, s)) for s in range(1, dimensions[0] + 4)]


def sparse_values(rng: random.Random, count: int) -> Values:
    """These are values of which about half are 0."""
    return tuple(Fraction(rng.choice([0, 0, 0, 1, -1, 2, 3]), rng.choice([1, 1, 2])) for _ in range(count))


def check_point(stratification: Stratification, values: Values) -> None:
    """One stratum holds the point, and its ranks and relations are those of the matrices there."""
    stratum = stratification.locate(values)
    ranks = window_ranks(stratification.dimensions, values)
    assert [stratum.window_rank(s) for s in range(1, len(ranks) + 1)] == ranks


@pytest.mark.parametrize("dimensions", ALL)
def test_ranks_at_random_values(dimensions: tuple[int, int, int]) -> None:
    stratification = strata_of(*dimensions)
    rng = random.Random(repr(dimensions))
    for _ in range(40):
        check_point(stratification, sparse_values(rng, stratification.entries.parameters))


@pytest.mark.parametrize("dimensions", ALL)
def test_ranks_at_random_points_of_every_stratum(dimensions: tuple[int, int, int]) -> None:
    stratification = strata_of(*dimensions)
    rng = random.Random(repr(dimensions))
    for stratum in stratification.strata:
        for _ in range(3):
            while True:
                free = tuple(Fraction(rng.randint(-9, 9), rng.randint(1, 3)) for _ in range(stratification.entries.parameters))
                try:
                    point = stratum.branch.point(free)
                    break
                except ValueError:
                    continue
            assert stratification.locate(point) is stratum
            check_point(stratification, point)


@pytest.mark.parametrize("dimensions", [(1, 1, 1), (1, 2, 1), (1, 1, 2), (0, 2, 2), (2, 1, 0)])
def test_every_value_of_a_grid_has_one_stratum(dimensions: tuple[int, int, int]) -> None:
    stratification = strata_of(*dimensions)
    met = set()
    for values in product([Fraction(-1), Fraction(0), Fraction(1)], repeat=stratification.entries.parameters):
        check_point(stratification, values)
        met.add(id(stratification.locate(values)))
    assert len(met) == len(stratification.strata)


@given(st.data())
def test_ranks_at_drawn_values(data: st.DataObject) -> None:
    stratification = strata_of(*data.draw(st.sampled_from(SMALL + LARGER)))
    entry = st.sampled_from([Fraction(0), Fraction(1)]) | st.fractions(-3, 3, max_denominator=4)
    count = stratification.entries.parameters
    check_point(stratification, data.draw(st.tuples(*[entry] * count)))


@pytest.mark.parametrize("dimensions", SMALL + LARGER)
def test_relations_hold_at_points_of_their_stratum(dimensions: tuple[int, int, int]) -> None:
    stratification = strata_of(*dimensions)
    _, p, _ = dimensions
    rng = random.Random(5)
    seen = 0
    for _ in range(30):
        values = sparse_values(rng, stratification.entries.parameters)
        at = dict(zip(stratification.parameters, values, strict=True))
        for row in stratification.locate(values).rows:
            if row.kind != "relation":
                with pytest.raises(ValueError, match="independent"):
                    _ = row.relation
                continue
            pivot, terms = row.relation
            lines = window(dimensions, values, row.degree + 1)
            assert pivot.subs(at) != 0
            assert all(key < (row.degree, row.output) for key in terms)
            for column, entry in enumerate(lines[row.degree * p + row.output]):
                right = sum(f.subs(at) * lines[k * p + i][column] for (k, i), f in terms.items())
                assert pivot.subs(at) * entry == right
            seen += 1
    assert seen


def test_the_counterexample_to_a_window_below_n() -> None:
    # A = [[0,1],[0,0]], C = [[1,0],[0,0]], F = [0;1], G = [0;1]: left index 2, gap(1) = 2, gap(2) = 1.
    stratum = strata_of(2, 2, 1).locate(tuple(map(Fraction, (0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1))))
    assert stratum.left_minimal_indices == (2,)
    assert (stratum.gap(1), stratum.gap(2), stratum.normal_rank) == (2, 1, 1)


def test_one_state_one_output_one_fault_by_hand() -> None:
    a11, c11, f11, g11 = strata_of(1, 1, 1).parameters
    found = {(s.equations, s.inequations, s.left_minimal_indices) for s in strata_of(1, 1, 1).strata}
    assert found == {
        ((), (g11,), ()),
        ((g11,), (c11, f11), ()),
        ((g11, f11), (c11,), (1,)),
        ((g11, c11), (), (0,)),
    }
    assert a11.name == "a11"


@pytest.mark.parametrize("dimensions", [(-1, 1, 1), (1, 10, 1), (1, 1, True), (1.0, 1, 1)])
def test_bad_dimensions_are_refused(dimensions: tuple[int, int, int]) -> None:
    with pytest.raises(InvalidInput, match=r": got .*, expected an integer from 0 to 9"):
        stratify(*dimensions)


def test_bad_windows_and_values_are_refused() -> None:
    with pytest.raises(InvalidInput, match="windows"):
        stratify(1, 1, 1, 0)
    with pytest.raises(ValueError, match="values: got 1, expected 4"):
        strata_of(1, 1, 1).locate((Fraction(1),))
    with pytest.raises(ValueError, match="needs windows up to 4"):
        gap_claim(stratify(1, 1, 1, 3))
    with pytest.raises(ValueError, match="window: got 0, expected an integer >= 1"):
        generic_window_ranks(1, 1, 1, [0])


def test_a_case_tree_out_of_reach_says_so() -> None:
    with pytest.raises(NonlinearCondition, match="linear in no parameter"):
        stratify(3, 1, 0)


@pytest.mark.parametrize("dimensions", ALL)
def test_every_identity_is_expanded_again(dimensions: tuple[int, int, int]) -> None:
    stratification = strata_of(*dimensions)
    checked = verify_identities(stratification)
    windows = dimensions[0] + 3
    ranks = sum(stratum.window_rank(windows) for stratum in stratification.strata)
    assert checked.independent == ranks
    assert checked.relations == windows * dimensions[1] * len(stratification.strata) - ranks


def broken_stratifications() -> dict[str, Stratification]:
    """Each of these stratifications of (1, 2, 1) has one thing wrong."""
    good = stratify(1, 2, 1)
    ring = good.entries.ring
    place = next(k for k, s in enumerate(good.strata) if s.left_minimal_indices == (1,) and len(s.equations) > 0)
    stratum = good.strata[place]
    number = next(k for k, row in enumerate(stratum.rows) if row.kind == "relation")
    row = stratum.rows[number]
    pivot_number = next(k for k, row in enumerate(stratum.rows) if row.kind == "fault")
    pivot_row = stratum.rows[pivot_number]

    def with_row(at: int, **changes: object) -> Stratification:
        rows = tuple(replace(r, **changes) if k == at else r for k, r in enumerate(stratum.rows))  # type: ignore[arg-type]
        return with_stratum(replace(stratum, rows=rows))

    def with_stratum(changed: object) -> Stratification:
        return replace(good, strata=(*good.strata[:place], changed, *good.strata[place + 1 :]))  # type: ignore[arg-type]

    (first_key, first), *others = row.coefficients
    column = next(k for k, c in enumerate(row.congruences) if any(c.cofactors))
    congruence = row.congruences[column]
    cofactors = (congruence.cofactors[0] + 1, *congruence.cofactors[1:])
    changed = replace(congruence, cofactors=cofactors)
    branch = stratum.branch
    (g, vanishes), *rest = branch.decisions
    return {
        "coefficient of a relation": with_row(number, coefficients=((first_key, first + 1), *others)),
        "relation left out": with_stratum(replace(stratum, rows=stratum.rows[:-1])),
        "relation doubled": with_stratum(replace(stratum, rows=(*stratum.rows, row))),
        "relation called a state row": with_row(number, kind="state"),
        "fault row called a relation": with_row(pivot_number, kind="relation"),
        "pivot that is not one": with_row(pivot_number, pivot_value=UnitProduct(2)),
        "leading coefficient 0": with_row(number, leading=UnitProduct(0)),
        "unit that does not exist": with_row(number, leading=UnitProduct(1, ((99, 1),))),
        "residual": with_row(pivot_number, state=(pivot_row.state[0] + ring.gens[0],)),
        "cofactor": with_row(number, congruences=(*row.congruences[:column], changed, *row.congruences[column + 1 :])),
        "congruence left out": with_row(number, congruences=row.congruences[:-1]),
        "remainder": with_row(number, congruences=(replace(row.congruences[0], remainder=ring.one), *row.congruences[1:])),
        "degree": with_row(number, degree=row.degree + 1),
        "stratum left out": replace(good, strata=good.strata[1:]),
        "all strata left out": replace(good, strata=()),
        "stratum doubled": replace(good, strata=(*good.strata, good.strata[0])),
        "decision turned": with_stratum(replace(stratum, branch=replace(branch, decisions=((g, not vanishes), *rest)))),
        "equation added": with_stratum(replace(stratum, branch=replace(branch, equations=(*branch.equations, branch.equations[0])))),
        "unit left out": with_stratum(replace(stratum, branch=replace(branch, units=branch.units[1:]))),
    }


BROKEN = broken_stratifications()


@pytest.mark.parametrize("name", BROKEN)
def test_a_broken_stratification_is_caught(name: str) -> None:
    with pytest.raises(IdentityFailure):
        verify_identities(BROKEN[name])


def test_units_with_new_factors_are_derived_and_checked() -> None:
    ring, x, y, z = polynomial_ring("x,y,z", ZZ)

    def run(branch: Branch) -> tuple[bool, ...]:
        return branch.is_zero(x * y + z), branch.is_zero(z), branch.is_zero(x)

    cases = explore(Branch(ring, 3), run)
    route = SecondRoute(ring)
    verify_cases(route, [branch for branch, _ in cases])
    derived = [unit for branch, _ in cases for unit in branch.units if unit.source is not None]
    assert derived
    for values in product([Fraction(-1), Fraction(0), Fraction(1), Fraction(2)], repeat=3):
        here = [answer for branch, answer in cases if branch.contains(values)]
        assert here == [(values[0] * values[1] + values[2] == 0, values[2] == 0, values[0] == 0)]
    branch = next(branch for branch, _ in cases if any(unit.source is not None for unit in branch.units))
    number = next(k for k, unit in enumerate(branch.units) if unit.source is not None)
    unit = branch.units[number]
    for wrong in (replace(unit, complement=unit.complement + 1), replace(unit, source=number), replace(unit, congruence=None)):
        units = (*branch.units[:number], wrong, *branch.units[number + 1 :])
        broken = [replace(b, units=units) if b is branch else b for b, _ in cases]
        with pytest.raises(IdentityFailure):
            verify_cases(route, broken)


def test_factors_multiply_to_the_polynomial() -> None:
    _, x, y = polynomial_ring("x,y", ZZ)
    f = -6 * (x - y) ** 3 * (y - x) * (x * y + 1)
    constant, powers = factors(f)
    total = constant
    for factor, exponent in powers:
        assert factor.LC > 0
        total = total * factor**exponent
    assert total == f
    assert evaluate(f, (2, 3)) == -6 * (2 - 3) ** 3 * (3 - 2) * 7
    with pytest.raises(ValueError, match="indeterminates"):
        evaluate(f, (2,))


def drops_agree(generic: GenericRanks, stratification: Stratification) -> int:
    """On every stratum the drop conditions hold exactly where the window rank is below the generic one.

    Strata are split further where a condition is neither zero nor a unit. The result is the number of cases compared.
    """
    assert generic.dimensions == stratification.dimensions
    ring = stratification.entries.ring
    compared = 0
    for window in generic.windows:
        factors = [ring.from_dict(dict(f)) for f in window.factors]
        remaining = [ring.from_dict(dict(f)) for f in window.remaining]

        def drops(branch: Branch, factors: list[Polynomial] = factors, remaining: list[Polynomial] = remaining) -> bool:
            return any(branch.is_zero(f) for f in factors) or all(branch.is_zero(f) for f in remaining)

        for stratum in stratification.strata:
            for branch, found in explore(stratum.branch, drops):
                compared += 1
                assert found is (stratum.window_rank(window.samples) < window.rank), (window.samples, branch.decisions)
    return compared


@pytest.mark.parametrize("dimensions", EMPTY + SMALL + LARGER)
def test_drop_conditions_and_strata_agree(dimensions: tuple[int, int, int]) -> None:
    n, p, m = dimensions
    stratification = strata_of(*dimensions)
    generic = generic_window_ranks(n, p, m, range(1, n + 2))
    open_stratum = next(stratum for stratum in stratification.strata if not stratum.equations)
    assert [w.rank for w in generic.windows] == [open_stratum.window_rank(w.samples) for w in generic.windows]
    assert drops_agree(generic, stratification) >= len(generic.windows) * len(stratification.strata)
    rng = random.Random(7)
    for _ in range(30):
        values = sparse_values(rng, stratification.entries.parameters)
        ranks = window_ranks(dimensions, values)
        for w in generic.windows:
            drops = any(evaluate(f, values) == 0 for f in w.factors) or all(evaluate(f, values) == 0 for f in w.remaining)
            assert drops == (ranks[w.samples - 1] < w.rank)
            assert not (drops and w.never_drops)


def test_a_wrong_drop_condition_is_caught() -> None:
    generic = generic_window_ranks(1, 2, 1, [2])
    (only,) = generic.windows
    c11, g11 = only.factors[0].ring.gens[1], only.factors[0].ring.gens[4]
    for wrong in (replace(only, factors=(c11,)), replace(only, remaining=(g11,)), replace(only, rank=2)):
        with pytest.raises(AssertionError):
            drops_agree(replace(generic, windows=(wrong,)), strata_of(1, 2, 1))


def test_drop_conditions_of_one_state_two_outputs_one_fault() -> None:
    generic = generic_window_ranks(1, 2, 1, [1, 2])
    _, c11, c21, f11, g11, g21 = strata_of(1, 2, 1).parameters
    first, second = generic.windows
    assert (first.rank, first.common_factors, first.conditions) == (2, (c11 * g21 - c21 * g11,), (1,))
    assert (second.rank, second.common_factors) == (3, (c11 * g21 - c21 * g11,))
    assert set(second.conditions) == {g11, g21, c11 * f11, c21 * f11}


@pytest.mark.parametrize("dimensions", ALL)
def test_the_gap_is_the_normal_rank_from_n_on(dimensions: tuple[int, int, int]) -> None:
    claim = gap_claim(strata_of(*dimensions))
    assert claim.strata == len(strata_of(*dimensions).strata)
    assert claim.expanded >= verify_identities(strata_of(*dimensions)).expanded + claim.strata  # a minor of the pencil on each, at least


@pytest.mark.parametrize("dimensions", [(1, 1, 1), (2, 1, 1), (2, 2, 1), (2, 2, 0)])
def test_a_window_below_n_is_not_enough(dimensions: tuple[int, int, int]) -> None:
    assert any(stratum.gap(dimensions[0] - 1) != stratum.normal_rank for stratum in strata_of(*dimensions).strata)


@pytest.mark.parametrize("dimensions", ALL)
def test_n_plus_1_samples_decide_inclusion(dimensions: tuple[int, int, int]) -> None:
    n, p, _ = dimensions
    stratification = strata_of(*dimensions)
    claim = inclusion_claim(stratification)
    # Some relation has degree n, so that n samples would not be enough.
    assert max(max(stratum.left_minimal_indices, default=0) for stratum in stratification.strata) == (n if p > 0 else 0)
    assert claim.expanded > verify_identities(stratification).expanded


@pytest.mark.parametrize("dimensions", [d for d in ALL if d not in LARGER])
def test_rank_counts_zeros(dimensions: tuple[int, int, int]) -> None:
    n, p, m = dimensions
    claim = zero_count_claim(strata_of(*dimensions))
    assert (claim.strata > 0) == (p >= m)
    for finite, infinite, lag in claim.zeros:
        assert 0 <= finite + infinite <= n
        assert 0 <= lag <= n
        # n = sum of left indices + zeros, as there are no right indices.
        assert lag <= n - finite - infinite
        assert p > m or finite + infinite == n


@pytest.mark.slow
@pytest.mark.timeout(120)
def test_rank_counts_zeros_with_two_states_and_two_outputs() -> None:
    claim = zero_count_claim(strata_of(2, 2, 1))
    assert claim.zeros == ((0, 0, 2), (0, 1, 1), (0, 2, 0), (1, 0, 1), (1, 1, 0), (2, 0, 0))


def test_a_stratum_where_a_claim_fails_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    # Said of an earlier window, or with zeros counted wrongly, the statements are false, and the functions notice.
    stratification = strata_of(1, 2, 1)
    rank = type(stratification.strata[0]).window_rank
    monkeypatch.setattr(type(stratification.strata[0]), "window_rank", lambda self, s: rank(self, s) + (s == 2))
    for claim in (gap_claim, inclusion_claim, zero_count_claim):
        with pytest.raises(ClaimFailure, match="fails where") as failure:
            claim(stratification)
        assert failure.value.stratum in stratification.strata


def test_a_wrong_shift_is_no_identity(monkeypatch: pytest.MonkeyPatch) -> None:
    assert horner_identity(1, 1, 1, 1, 2) == (1 + 3) + (1 + 4)
    monkeypatch.setattr(parametric_claims, "times", lambda row, matrix, width, ring: [ring.zero] * width)
    with pytest.raises(IdentityFailure, match="Horner"):
        horner_identity(1, 1, 1, 1, 2)


def test_statements_about_the_pencil_can_fail() -> None:
    entries = indeterminates(1, 2, 1)
    stratum = next(s for s in strata_of(1, 2, 1).strata if s.normal_rank == 1)
    route = SecondRoute(entries.ring)
    flint_window = FlintWindow(route, entries, 3)

    def all_found(branch: Branch) -> tuple[object, ...]:
        return normal_rank(entries, branch), finite_zeros(entries, branch), toeplitz_echelon(entries, branch, 3)

    branch, _ = explore(stratum.branch, all_found)[0]
    rank, zeros, echelon = normal_rank(entries, branch), finite_zeros(entries, branch), toeplitz_echelon(entries, branch, 3)
    verify_normal_rank(flint_window, entries, branch, rank)
    verify_finite_zeros(flint_window, entries, branch, zeros)
    verify_echelon_rows(flint_window, entries, branch, echelon)
    one, q = entries.ring.one, entries.q
    for wrong in (
        replace(rank, rank=rank.rank - 1),
        replace(rank, power=rank.power + 1),
        replace(rank, unit=UnitProduct(7)),
        replace(rank, witness=((0,), (0,))),
    ):
        with pytest.raises(IdentityFailure):
            verify_normal_rank(flint_window, entries, branch, wrong)
    for wrong_zeros in (
        replace(zeros, degree=zeros.degree + 1),
        replace(zeros, divisor=zeros.divisor * q, degree=zeros.degree + 1),
        replace(zeros, bezout=tuple(f + one for f in zeros.bezout)),
        replace(zeros, quotients=tuple(f + one for f in zeros.quotients)),
        replace(zeros, minors=zeros.minors[1:]),
    ):
        with pytest.raises(IdentityFailure):
            verify_finite_zeros(flint_window, entries, branch, wrong_zeros)
    first = echelon.rows[0]
    for wrong_row in (
        replace(first, leading=UnitProduct(3)),
        replace(first, residual=tuple(f + one for f in first.residual)),
        replace(first, coefficients=(((1, 0), one),)),
        replace(first, pivot=None) if first.pivot is not None else replace(first, pivot=0),
    ):
        with pytest.raises(IdentityFailure):
            verify_echelon_rows(flint_window, entries, branch, replace(echelon, rows=(wrong_row, *echelon.rows[1:])))
    with pytest.raises(ValueError, match="eliminated for"):
        echelon.rank(4)
