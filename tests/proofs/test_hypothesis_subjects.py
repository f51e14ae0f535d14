"""What the ablations are made of: changes of state, polynomials of given zeros, limits, aimed samples."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import combinations_with_replacement, product
from random import Random

import pytest

from faultspace.exact.algebra.fields import PrimeField
from faultspace.exact.algebra.matrices import Matrix, column_basis, rank
from faultspace.exact.algebra.polynomials import divide, gcd, monic
from faultspace.exact.limits.moesp import limit
from faultspace.exact.pairs.assignment import ZeroAssignment, assign_zeros
from faultspace.exact.pairs.bad_variety import _codimension, _index_lists
from faultspace.exact.pairs.polynomial import Exceptional, polynomial_at
from faultspace.exact.structure.behavior import compare
from faultspace.exact.structure.fault_columns import fault_space, with_pair
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.structure.pencil import zero_dynamics_polynomial
from faultspace.exact.system.systems import ResidualSystem
from faultspace.exact.system.windows import observability_matrix, reachability_matrix, window_matrix
from faultspace.proofs.evidence.corpus import examine
from faultspace.proofs.evidence.exhaustive import all_systems
from faultspace.proofs.evidence.experiments import examine_experiment
from faultspace.proofs.evidence.families import adversarial
from faultspace.proofs.evidence.pairs_by_polynomial import pencil_of
from faultspace.proofs.hypotheses import pencils
from faultspace.proofs.hypotheses.aimed_experiments import (
    BOTH_STATES,
    FAMILIES,
    ONE_OUTPUT,
    RANK_DROPS,
    UNREAD,
    WHITE,
    _drawn,
    drop,
    experiment,
    small_experiments,
)
from faultspace.proofs.hypotheses.changes_of_state import columns_moved, equivalent_pairs, moved, similarity
from faultspace.proofs.hypotheses.consistency import Driven, consistency, consistency_coloured, driven
from faultspace.proofs.hypotheses.facets import HIDDEN_ZEROS, HYPOTHESES, aimed_systems
from faultspace.proofs.hypotheses.pairs import Compared, columns_in_space, same_model, theorem_3_i
from faultspace.proofs.hypotheses.systems import signal_from_unknown_state
from faultspace.proofs.hypotheses.windowed import Windowed
from faultspace.proofs.verdict.workbench import Workbench


def of(A: object, F: object, C: object, G: object, **more: object) -> ResidualSystem:
    return ResidualSystem.of(A, F, C, G, **more)  # type: ignore[arg-type]


# -- changes of state ------------------------------------------------------------------------------------------------------


def test_a_change_of_state_is_found_again_and_where_there_is_none_that_is_said() -> None:
    first = of([[1, 2], [0, 3]], [[1], [1]], [[1, 0]], [[0]])
    second = moved(first, Matrix.of([[2, 1], [1, 1]]))
    T = similarity(first, second)
    assert T is not None and first.A @ T == T @ second.A and first.C @ T == second.C and rank(T) == 2
    assert similarity(first, of([[1, 2], [0, 4]], [[1], [1]], [[1, 0]], [[0]])) is None
    assert similarity(first, of([[1]], [[1]], [[1]], [[0]])) is None


@pytest.mark.parametrize("field", [None, PrimeField(2), PrimeField(3)])
def test_similarity_where_many_states_are_hidden(field: PrimeField | None) -> None:
    """C = 0: similar as matrices; the equations have solutions that are not invertible, 0 among them."""
    more = {} if field is None else {"field": field}
    zero, jordan = [[0, 0], [0, 0]], [[0, 1], [0, 0]]

    def hidden(A: list[list[int]]) -> ResidualSystem:
        return of(A, [[0], [0]], [[0, 0]], [[1]], **more)

    assert similarity(hidden(jordan), hidden([[0, 0], [1, 0]])) is not None
    assert similarity(hidden(zero), hidden(zero)) is not None
    assert similarity(hidden(zero), hidden(jordan)) is None and similarity(hidden(jordan), hidden(zero)) is None
    assert similarity(hidden([[1, 1], [0, 1]]), hidden([[1, 0], [0, 1]])) is None


def test_columns_of_an_equivalent_system_lie_in_z_after_the_change_and_mostly_not_before() -> None:
    as_they_are = others = 0
    for first, second in equivalent_pairs(40):
        if compare(kernel_representation(first), kernel_representation(second)).first_difference is None:
            T = columns_moved(first, second)
            assert T is not None and rank(T) == first.n and columns_in_space(first, moved(second, T))
            as_they_are += columns_in_space(first, second)
            others += 1
    assert others > 25 and as_they_are < others / 2


def test_columns_of_another_system_do_not_lie_in_z_whatever_the_change() -> None:
    first = of([[0]], [[1]], [[1], [0]], [[0], [1]])
    other = of([[0]], [[0]], [[1], [0]], [[0], [1]])
    T = columns_moved(first, other)
    assert T is None or not columns_in_space(first, moved(other, T))


def test_extreme_pairs_have_a_change_that_puts_the_columns_into_z() -> None:
    """Every named system is set against itself fed back and in another basis, and with a whole basis of Z as its fault columns."""
    random = Random(0)
    for _, system in adversarial():
        if system.n > 4 or not system.n:
            continue
        K = Matrix.of([[random.randint(-2, 2) for _ in range(system.n)] for _ in range(system.m)], shape=(system.m, system.n))
        T = Matrix.of([[int(i == j) + int(j > i) * random.randint(-2, 2) for j in range(system.n)] for i in range(system.n)])
        space = fault_space(kernel_representation(system))
        everything = with_pair(space, Matrix.identity(system.field, space.dimension))
        for other in (system, everything):
            k = Matrix.zero(system.field, other.m, system.n) if other is everything else K
            second = moved(ResidualSystem(other.A + other.F @ k, other.F, other.C + other.G @ k, other.G), T)
            change = columns_moved(system, second)
            assert change is not None and columns_in_space(system, moved(second, change)), system


@pytest.mark.parametrize("dimensions", [(2, 1, 2, 1), (2, 2, 1, 1), (3, 1, 1, 1), (2, 2, 2, 0)])
def test_every_system_of_a_box_has_a_change_that_puts_its_columns_into_z(dimensions: tuple[int, int, int, int]) -> None:
    """Over GF(q): each system against the first one with the same outputs, q, n, p, m; the changes compose."""
    n = dimensions[1]
    first_with: dict[str, ResidualSystem] = {}
    for system in all_systems(*dimensions):
        first = first_with.setdefault(str(column_basis(window_matrix(system, 2 * n + 1))), system)
        T = columns_moved(first, system)
        assert T is not None and columns_in_space(first, moved(system, T)), (first, system)


def test_feedback_is_put_right_by_no_change_of_state_where_the_model_is_asked_for() -> None:
    first = of([[0]], [[1]], [["1"], ["0"]], [["0"], ["0"]])
    pair = Compared(first, of([["1/2"]], [[1]], [["1"], ["0"]], [["0"], ["0"]]), None, True, 1, frozenset())
    assert pair.similarity is None and not pair.degenerate
    assert not same_model().holds(pair) and theorem_3_i().holds(pair)
    moved_only = Compared(first, of([[0]], [[-2]], [["-1/2"], ["0"]], [["0"], ["0"]]), None, True, 1, frozenset())
    assert same_model().holds(moved_only) and not columns_in_space(of([[0]], [[1]], [[1], [0]], [[0], [1]]), first)


# -- polynomials -----------------------------------------------------------------------------------------------------------


def test_polynomials_of_every_kind_are_asked_for() -> None:
    pencil = pencil_of(of([[0, 1], [0, 0]], [[0, 1], [1, 0]], [[1, 0], [0, 1]], [[0, 0], [0, 0]]))
    found = list(pencils.wanted(pencil))
    assert pencil.zeta == 2 and {len(f) - 1 for f in found} == {0, 1, 2} and all(found)
    assert any(len(f) == 3 and f[0] == f[1] == 0 for f in found), "a zero constant term"
    assert any(f[-1] != 1 for f in found), "not monic"
    assert any(len(f) == 3 and len(gcd(f, (f[1], 2 * f[2]))) > 1 and f[0] != 0 for f in found), "a repeated root"


def test_what_a_system_reaches_and_an_unobservable_one_does_not() -> None:
    assert pencils.every_polynomial_is_reached(pencil_of(of([[0, 1], [0, 0]], [[0], [1]], [[1, 0]], [[0]])))
    assert not pencils.every_polynomial_is_reached(pencil_of(of([[-1, -1], [1, 1]], [[-1], [-1]], [[-1, -1]], [[-1]])))


def test_a_wrong_assignment_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    pencil = pencil_of(of([[0, 1], [0, 0]], [[0], [1]], [[1, 0]], [[0]]))
    assert pencils.every_polynomial_is_reached(pencil)
    for degree in (1, 2):  # the one of degree 1 is not the last, whose zeros are looked for by another route as well

        def shifted(pencil: Exceptional, desired: list[object], degree: int = degree) -> ZeroAssignment:
            wrong = [*desired[:-1], str(2 * Fraction(str(desired[-1])))] if len(desired) == degree + 1 else desired
            return assign_zeros(pencil, wrong)

        monkeypatch.setattr(pencils, "assign_zeros", shifted)
        assert not pencils.every_polynomial_is_reached(pencil)


def test_no_pair_of_an_unobservable_system_lacks_its_unobservable_modes() -> None:
    """A refused polynomial is reached by no P because D(q; P) is divisible by the modes, as it is for many P."""
    pencil, random = pencil_of(of([[-1, -1], [1, 1]], [[-1], [-1]], [[-1, -1]], [[-1]])), Random(1)
    for _ in range(40):
        P = Matrix.of([[random.randint(-3, 3)] for _ in range(pencil.n_z)])
        D = polynomial_at(pencil, P)
        assert not D or not divide(D, pencil.fixed)[1]


def test_the_codimension_is_two_for_all_degrees_of_the_kernel() -> None:
    """With (A, C) observable, r <= 4 and 1 <= zeta <= 6, the degrees k_1 <= ... <= k_r, of sum zeta, decide the codimension."""
    tried = 0
    for r, zeta in product(range(1, 5), range(1, 7)):
        for degrees in (k for k in combinations_with_replacement(range(zeta + 1), r) if sum(k) == zeta):
            assert min(_codimension(degrees, indices) for indices in _index_lists(degrees[1:])) >= 2, degrees
            tried += 1
    assert tried > 60
    assert min(_codimension((0, 0), indices) for indices in _index_lists((0,))) == 1, "zeta = 0: the determinant of P"


# -- zeros -----------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("system", HIDDEN_ZEROS)
def test_unobservable_modes_count_with_multiplicity(system: ResidualSystem) -> None:
    """Every finite zero is an unobservable mode, and yet the outputs do not determine v: there are more zeros than modes."""
    zeros, modes = zero_dynamics_polynomial(system), pencil_of(system).fixed
    common, rest = modes, monic(zeros)
    while len(rest) > 1 and len(common := gcd(rest, modes)) > 1:
        rest = divide(rest, common)[0]
    assert len(rest) == 1 and len(zeros) > len(modes)
    here = Windowed(examine("test", system), 0)
    claim = signal_from_unknown_state()
    assert "as many finite zeros as unobservable modes" in claim.violated(here) and not claim.holds(here)
    assert "observable" in claim.violated(here) and "left-invertible" not in claim.violated(here)


def test_aimed_systems_lack_what_they_are_to_lack_and_nothing_else() -> None:
    found = list(aimed_systems(30))
    lacking = [[name for name, meets in HYPOTHESES.items() if not meets(system)] for system in found]
    assert lacking == [[name] for name in HYPOTHESES for _ in range(30)]
    assert len({str(system) for system in found}) > 100


# -- limits ----------------------------------------------------------------------------------------------------------------


def subject(given: object) -> Driven:
    return driven(examine_experiment("test", given))  # type: ignore[arg-type]


@pytest.mark.parametrize("given", RANK_DROPS)
def test_a_coloured_input_loses_rank_although_all_else_is_as_it_should_be(given: object) -> None:
    found = subject(given)
    d = found.record
    residual = d.experiment.system.residual
    assert d.within and d.limit_rank == 1 and residual.n == 2 and not found.model_right and not found.degenerate
    assert consistency().violated(found) == {"u white"}
    assert consistency_coloured().violated(found) == {"u autoregressive of order at most s"}
    assert not consistency().holds(found) and not consistency_coloured().holds(found)
    # the hypotheses once more, from their definitions
    assert rank(observability_matrix(residual, d.experiment.s - 1)) == 2 <= d.experiment.past
    B = d.experiment.system.B
    assert rank(reachability_matrix(ResidualSystem(residual.A, B, residual.C, d.experiment.system.D))) == 2


@pytest.mark.parametrize(("t", "d", "a", "b", "s"), [("5/3", "7/9", "3/2", "3/4", 3), ("7/4", "4/5", "5/3", "3/4", 2)])
def test_the_rank_drops_on_a_hypersurface_only(t: str, d: str, a: str, b: str, s: int) -> None:
    C = ONE_OUTPUT if s == 3 else BOTH_STATES
    T, D, one, two = (Fraction(x) for x in (t, d, a, b))
    assert one * two * D * (T * T - D if s == 3 else T) == 1 + two
    assert limit(drop(t, d, a, b, s, C)).past_inputs.rank == 1
    beside = drop(t, d, str(one + Fraction(1, 100)), b, s, C)
    assert limit(beside).past_inputs.rank == 2
    longer = replace(drop(t, d, a, b, s, C), past=3)
    assert limit(longer).past_inputs.rank == 2


def test_a_limit_from_which_a_cannot_be_read_is_not_right() -> None:
    found = subject(UNREAD)
    d = found.record
    assert d.equal and d.limit_rank == d.experiment.system.residual.n and d.inputs_right, "what used to be called right"
    assert not found.model_right and consistency().violated(found) == {"(A, C) observable on s - 1"}
    assert subject(replace(UNREAD, s=3)).model_right and consistency().holds(subject(replace(UNREAD, s=3)))


def test_a_limit_of_higher_rank_is_no_witness_where_b_and_d_are_right() -> None:
    """u white, v(k) = u(k-1): rank n + 1, and yet the n leading left singular vectors span the range of O_s, and B and D are right."""
    system = {"A": [["1/2", "2"], ["0", "0"]], "B": [["2/21"], ["8/21"]], "C": BOTH_STATES, "F": [["-1"], ["1"]], "D": [["0"], ["0"]]}
    v = {"num": [[["0", "0"]], [["1", "0"]]], "den": ["1"]}
    found = subject(experiment(system | {"G": [["0"], ["0"]]}, 2, 3, WHITE, v))
    assert found.record.limit_rank == 3 and not found.model_right and found.record.inputs_right
    assert found.degenerate.startswith("the limit has a rank above n")
    bench = Workbench("quick", 1, lambda stage, done, total: None)
    row = "v(k), u(k-l) uncorrelated, l >= 1"
    shown = consistency().over_q(bench, (row,)).subject
    assert shown is not None and not shown.degenerate and not shown.record.inputs_right and consistency().violated(shown) == {row}


@pytest.mark.parametrize(("order", "s", "is_so"), [(1, 1, True), (2, 2, True), (3, 2, False), (2, 1, False), (2, 3, True)])
def test_whether_an_input_is_autoregressive(order: int, s: int, is_so: bool) -> None:
    den = ["1", "1/3", "-1/4", "1/5"][: order + 1]
    u = type(UNREAD.u_filter).of([[["1", "0"]]], den)
    assert subject(replace(UNREAD, s=s, u_filter=u)).autoregressive is is_so


def test_a_moving_average_is_not_autoregressive_and_white_noise_is() -> None:
    moving = type(UNREAD.u_filter).of([[["1", "0"]], [["1/2", "0"]]], ["1"])
    assert not subject(replace(UNREAD, s=3, u_filter=moving)).autoregressive
    assert subject(UNREAD).autoregressive and consistency().hypotheses["u white"](subject(UNREAD))


def test_each_family_of_experiments_lacks_its_hypothesis_with_windows_of_many_lengths() -> None:
    windows = set()
    for family in FAMILIES:
        for seed in range(4):
            found = subject(_drawn(Random(f"{family} {seed}"), family))
            windows.add((found.record.experiment.s - found.record.experiment.system.residual.n, found.record.experiment.past))
            lacked = {"all": set(), "u white": {"u white"}}.get(family, {family})
            if family == "u autoregressive of order at most s":
                assert consistency_coloured().violated(found) == {family}
            elif family == "u white":
                assert consistency_coloured().violated(found) == set() and consistency_coloured().holds(found)
            else:
                assert consistency().violated(found) == lacked, (family, seed)
            if family == "all":
                assert consistency().holds(found)
    assert len(windows) > 6


def test_the_small_experiments_are_not_degenerate() -> None:
    assert all(not subject(small).degenerate for small in list(small_experiments())[::17])
