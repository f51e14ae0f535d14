"""The oracle's quantities are tested against known facts, a second route each, and sheer enumeration over GF(2)."""

from __future__ import annotations

from itertools import pairwise, product
from random import Random
from typing import Any

import pytest
import sympy
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.thorough import examples

from . import behaviours, first_difference, inspect_slowly, polynomials, same_report
from .families import CUBIC, FIELDS, Q, adversarial, delay_line, paper_example, shift_register, system
from .fault_space import annihilated_columns, fault_space, fault_space_limit
from .fields import is_irreducible, parse_field
from .linear import Matrix, column_of, matrix, rank
from .pencil import (
    determinantal_divisors,
    infinite_zero_orders_of_pencil,
    invariant_zero_polynomial,
    left_minimal_indices_of_pencil,
    minors,
    normal_rank,
    pencil,
    right_minimal_indices_of_pencil,
)
from .quantities import (
    KNOWN,
    UNKNOWN,
    delay,
    infinite_zero_orders,
    is_controllable,
    is_left_invertible,
    is_observable,
    lag,
    left_minimal_indices,
    right_minimal_indices,
)
from .strategies import planted_systems, system_pairs, systems
from .structured import Structure, fed_back, random_system, similar
from .systems import System, parse_system, trajectory
from .windows import gap, observability, window_matrix, window_rank

FEW = settings(max_examples=examples(60), deadline=None)


def report(json: Any, *keys: str) -> tuple[Any, ...]:
    answers = inspect_slowly(json)
    return tuple(answers[key] for key in keys)


# Known facts.


def test_the_example_of_the_paper() -> None:
    answers = inspect_slowly(paper_example())
    assert answers["window_ranks"] == [2, 4, 5, 6, 7, 8]
    assert (answers["zeta"], answers["lag"], answers["fault_space_dimension"]) == (1, 2, 2)
    assert answers["infinite_zero_orders"] == [1] and answers["invariant_zero_polynomial"] == [["1", "0", "0"]]
    assert answers["fault_space_dimensions"] == [5, 5, 2, 2, 2, 2]
    assert answers["left_invertible"] and answers["observable"] and not answers["controllable"]
    # Z is spanned by [F; 0] and [0; C F].
    example = parse_system(paper_example())
    nothing = example.field.zero
    columns = [[*example.F.entries(), nothing, nothing], [nothing] * 3 + list((example.C @ example.F).entries())]
    assert fault_space_limit(example) == matrix(example.field, 2, 5, columns)
    assert is_irreducible(parse_field(CUBIC))
    # F is an eigenvector of A.
    a = example.field.parse(["0", "1", "0"])
    assert (example.A @ example.F).entries() == tuple(a * x for x in example.F.entries())


def test_one_state_that_lasts_one_sample() -> None:
    """A = 0, F = 1, C = [1; 0], G = [0; 1]: n samples are not enough."""
    known = system(Q, [[0]], [[1]], [[1], [0]], [[0], [1]], n=1, p=2, m=1)
    doubled = system(Q, [[0]], [[2]], [[1], [0]], [[0], [1]], n=1, p=2, m=1)
    assert report(known, "lag", "zeta", "fault_space_dimensions", "window_ranks") == (1, 0, [3, 1, 1, 1], [2, 3, 4, 5])
    assert first_difference(known, doubled) == 2 and first_difference(known, known) is None
    parsed = parse_system(known)
    # At s = 1 everything is a solution; at s = 2 the first block column alone would let (0, 1, 0) pass.
    field = parsed.field
    assert annihilated_columns(parsed, [field.integer(k) for k in (5, 3, -2)], 1) == [True]
    assert annihilated_columns(parsed, [field.integer(k) for k in (0, 1, 0)], 2) == [True, False]
    assert fault_space_limit(parsed).entries() == tuple(field.integer(k) for k in (1, 0, 1))


@pytest.mark.parametrize("n", [1, 2, 3, 4])
def test_shift_registers_need_the_last_sample(n: int) -> None:
    answers = inspect_slowly(shift_register(Q, n))
    assert (answers["delay_known_state"], answers["delay_unknown_state"], answers["lag"]) == (0, 0, n)
    register = parse_system(shift_register(Q, n))
    assert [gap(register, k) for k in range(n + 2)] == [2] * n + [1, 1]


@pytest.mark.parametrize("n", [1, 2, 3, 4])
def test_delay_lines(n: int) -> None:
    """r(k) = v(k-n): a delay of n, all n states at infinity; n_z = n + p since p = r."""
    keys = ("infinite_zero_orders", "zeta", "lag", "delay_known_state", "delay_unknown_state", "fault_space_dimensions")
    assert report(delay_line(Q, n), *keys) == ([n], n, 0, n, n, [n + 1] * (n + 3))


@pytest.mark.parametrize(
    "name, facts",
    [
        ("a0-infinite-zero", {"zeta": 1, "infinite_zero_orders": [1], "window_ranks": [1, 2, 3, 4]}),
        ("a0-zero-at-the-origin", {"zeta": 1, "invariant_zero_polynomial": ["0", "1"], "window_ranks": [1, 2, 3, 4]}),
        ("a0-idle-state", {"left_invertible": True, "fault_space_dimension": 2, "zeta": 1}),
        ("a0-all-zero", {"normal_rank": 0, "left_invertible": False, "fault_space": [["1", "0"]], "lag": 0}),
        ("a0-two-faults", {"normal_rank": 2, "zeta": 1, "lag": 0, "left_invertible": True}),
        (
            "unobservable",
            {"observable": False, "zeta": 1, "delay_known_state": 0, "invariant_zero_polynomial": ["-1", "1"]},
        ),
        ("uncontrollable", {"controllable": False, "observable": True}),
        ("not-left-invertible-same-column-twice", {"left_invertible": False, "right_minimal_indices": [0]}),
        ("not-left-invertible-silent-loop", {"left_invertible": False, "delay_known_state": None}),
        ("no-fault", {"left_invertible": True, "delay_known_state": 0, "delay_unknown_state": 0, "normal_rank": 0}),
        ("no-output", {"fault_space": [["1"]], "left_invertible": False, "right_minimal_indices": [1]}),
        ("states-only", {"fault_space_dimension": 2, "invariant_zero_polynomial": ["0", "0", "1"]}),
        ("outputs-only", {"left_minimal_indices": [0, 0], "fault_space": [], "window_ranks": [0, 0, 0]}),
        ("faults-only", {"right_minimal_indices": [0, 0], "delay_known_state": None, "fault_space": []}),
        ("nothing", {"normal_rank": 0, "invariant_zero_polynomial": ["1"], "window_ranks": [0, 0, 0], "lag": 0}),
    ],
)
def test_named_systems(name: str, facts: dict[str, Any]) -> None:
    answers = inspect_slowly(adversarial(Q)[name])
    assert {key: answers[key] for key in facts} == facts


def test_a_pair_from_the_fault_space_may_be_bad() -> None:
    """Two independent columns of Z make a pair of normal rank 1 < m = 2."""
    bad = system(Q, [[0]], [[1, 0]], [[1], [0]], [[0, 1], [0, 0]], n=1, p=2, m=2)
    good = adversarial(Q)["a0-two-faults"]
    field = parse_field(Q)
    for k in range(2):
        column = [field.integer(bad["F"][0][k]), *(field.integer(row[k]) for row in bad["G"])]
        assert all(annihilated_columns(parse_system(good), column, 3))
    assert report(bad, "normal_rank", "left_invertible") == (1, False)
    assert first_difference(good, bad) is not None


# A second route to each quantity.


@FEW
@given(planted_systems())
def test_planted_structure_is_found(case: tuple[Any, Structure]) -> None:
    json, structure = case
    planted = parse_system(json)
    assert (planted.n, planted.p, planted.m) == (structure.n, structure.p, structure.m)
    assert normal_rank(planted) == structure.normal_rank
    assert left_minimal_indices(planted) == list(structure.left)
    assert right_minimal_indices(planted) == list(structure.right)
    assert infinite_zero_orders(planted) == list(structure.infinite)
    assert invariant_zero_polynomial(planted) == structure.zero_polynomial(planted.field)


@FEW
@given(systems())
def test_indices_and_zeros_by_two_routes(json: Any) -> None:
    """From the matrices of windows, and from the pencil; together they use up all states."""
    given_system = parse_system(json)
    left, right = left_minimal_indices(given_system), right_minimal_indices(given_system)
    infinite, finite = infinite_zero_orders(given_system), invariant_zero_polynomial(given_system)
    r = normal_rank(given_system)
    assert left == left_minimal_indices_of_pencil(given_system)
    assert right == right_minimal_indices_of_pencil(given_system)
    assert infinite == infinite_zero_orders_of_pencil(given_system)
    assert (len(left), len(right), len(infinite)) == (given_system.p - r, given_system.m - r, r)
    assert given_system.n == sum(left) + sum(right) + sum(infinite) + polynomials.degree(finite)
    assert len(determinantal_divisors(pencil(given_system))) - 1 == given_system.n + r


@FEW
@given(systems())
def test_windows_from_indices(json: Any) -> None:
    """The ranks of all windows and the dimensions of all fault spaces in terms of the left minimal indices."""
    answers = inspect_slowly(json)
    r, left = answers["normal_rank"], answers["left_minimal_indices"]
    windows = range(1, answers["n"] + 4)
    assert answers["window_ranks"] == [s * r + sum(min(s, eta) for eta in left) for s in windows]
    size = answers["n"] + answers["p"]
    dimensions = [size - sum(eta + 1 for eta in left if eta <= s - 1) for s in windows]
    assert answers["fault_space_dimensions"] == dimensions
    assert answers["fault_space_dimension"] == r + answers["zeta"] + sum(answers["right_minimal_indices"])
    assert same_report(answers, answers) and not same_report(answers, {**answers, "zeta": answers["zeta"] + 1})


@FEW
@given(systems())
def test_delays_by_ranks(json: Any) -> None:
    faulty = parse_system(json)
    known, unknown = delay(faulty, KNOWN), delay(faulty, UNKNOWN)
    invertible = normal_rank(faulty) == faulty.m
    assert is_left_invertible(faulty) == invertible == (known is not None)
    if invertible:
        assert known == max(infinite_zero_orders(faulty), default=0)
    finite = polynomials.degree(invariant_zero_polynomial(faulty))
    hidden = faulty.n - rank(observability(faulty, faulty.n))
    assert (unknown is not None) == (invertible and finite == hidden)
    if unknown is not None and known is not None:
        assert known <= unknown


@FEW
@given(systems(field={"prime": 5}))
def test_roots_of_the_zero_polynomial_lower_the_rank_of_the_pencil(json: Any) -> None:
    modular = parse_system(json)
    field, a = modular.field, pencil(modular)
    full = modular.n + normal_rank(modular)
    for k in range(5):
        x = field.integer(k)
        values = [[polynomials.evaluate(entry, x, field.zero) for entry in row] for row in a.rows]
        drops = rank(matrix(field, a.height, a.width, values)) < full
        assert drops == (not polynomials.evaluate(invariant_zero_polynomial(modular), x, field.zero))


@pytest.mark.parametrize("seed", range(8))
def test_sympy_finds_the_same_minors(seed: int) -> None:
    rng = Random(seed)
    rational = parse_system(random_system(rng, Q, rng.randint(1, 2), rng.randint(1, 2), rng.randint(1, 2)))
    q = sympy.Symbol("q")
    a = pencil(rational)

    def expression(entry: polynomials.Polynomial) -> Any:
        return sum((sympy.Rational(str(c)) * q**k for k, c in enumerate(entry)), sympy.Integer(0))

    theirs = sympy.Matrix(a.height, a.width, [expression(x) for row in a.rows for x in row])
    for order in minors(a):
        divisor = sympy.Integer(0)
        for (rows, columns), minor in order.items():
            value = theirs.extract(list(rows), list(columns)).det() if rows else sympy.Integer(1)
            assert sympy.expand(value - expression(minor)) == 0
            divisor = sympy.gcd(divisor, sympy.expand(value))
        ours = determinantal_divisors(a)
        k = len(next(iter(order))[0])
        if k < len(ours):
            assert sympy.Poly(divisor, q, domain="QQ").monic() == sympy.Poly(expression(ours[k]), q, domain="QQ")
        else:
            assert divisor == 0


# Behaviours.


@FEW
@given(systems(), st.integers(0, 2**32))
def test_coordinates_and_feedback_leave_the_behaviour(json: Any, seed: int) -> None:
    first, rng = parse_system(json), Random(seed)
    for second in (similar(rng, first), fed_back(rng, first)):
        assert behaviours.equivalent(first, second) and behaviours.first_difference(first, second) is None
        assert left_minimal_indices(second) == left_minimal_indices(first)
        assert infinite_zero_orders(second) == infinite_zero_orders(first)
        assert invariant_zero_polynomial(second) == invariant_zero_polynomial(first)
    assert fault_space_limit(fed_back(rng, first)).height == fault_space_limit(first).height


@FEW
@given(system_pairs(largest=2))
def test_first_differences(pair: tuple[Any, Any]) -> None:
    first, second = (parse_system(json) for json in pair)
    difference = behaviours.first_difference(first, second)
    longest = behaviours.conclusive_window(first, second) + 1
    equal = [behaviours.equal_on(first, second, s) for s in range(1, longest + 1)]
    assert equal == [difference is None or s < difference for s in range(1, longest + 1)]
    assert behaviours.equivalent(first, second) == (difference is None)
    # n + 1 samples suffice with n the larger state dimension, and so does one more than the larger lag.
    assert difference is None or difference <= max(first.n, second.n) + 1
    assert difference is None or difference <= max(lag(first), lag(second)) + 1
    assert behaviours.included(first, second) == all(behaviours.included_on(first, second, s) for s in range(1, longest + 1))


@FEW
@given(systems(), st.integers(0, 2**32))
def test_words_and_hankel_matrices(json: Any, seed: int) -> None:
    """What a system does is a word of it; R_s = [O_s T_s] [X; V_s]."""
    faulty, rng = parse_system(json), Random(seed)
    field, samples, s = faulty.field, rng.randint(0, 4), rng.randint(0, 4)
    x0 = [field.integer(rng.randint(-1, 1)) for _ in range(faulty.n)]
    v = [[field.integer(rng.randint(-1, 1)) for _ in range(faulty.m)] for _ in range(samples)]
    _, outputs = trajectory(faulty, x0, v)
    assert behaviours.is_word(faulty, outputs)
    excitation = behaviours.excitation(faulty, x0, v, s)
    assert behaviours.residual_hankel(faulty, x0, v, s) == window_matrix(faulty, s) @ excitation
    assert excitation.width == max(0, samples - s + 1)


def test_a_word_that_is_none() -> None:
    delay = parse_system(shift_register(Q, 1))
    field = delay.field
    outputs = [column_of(field, [field.zero, field.one]), column_of(field, [field.zero, field.zero])]
    assert not behaviours.is_word(delay, outputs) and behaviours.is_word(delay, outputs[:1])


# Sheer enumeration over GF(2).


def bits(length: int) -> list[tuple[int, ...]]:
    return list(product((0, 1), repeat=length))


def run(s: System, x0: tuple[int, ...], v: list[tuple[int, ...]]) -> tuple[int, ...]:
    """The result is the output of a system over GF(2) in plain integers."""
    a, f, c, g = ([[x.value for x in row] for row in block.rows] for block in (s.A, s.F, s.C, s.G))
    state, outputs = list(x0), []

    def times(rows: list[list[int]], vector: Any) -> list[int]:
        return [sum(x * y for x, y in zip(row, vector, strict=True)) for row in rows]

    for fault in v:
        outputs += [(x + y) % 2 for x, y in zip(times(c, state), times(g, fault), strict=True)]
        state = [(x + y) % 2 for x, y in zip(times(a, state), times(f, fault), strict=True)]
    return tuple(outputs)


def all_runs(s: System, samples: int) -> list[tuple[tuple[int, ...], list[tuple[int, ...]], tuple[int, ...]]]:
    """These are all initial states and fault signals, with the output."""
    signals = [list(v) for v in product(bits(s.m), repeat=samples)]
    return [(x0, v, run(s, x0, v)) for x0 in bits(s.n) for v in signals]


def tiny_systems() -> list[System]:
    """These are all systems over GF(2) with n + p + m at most 3, but those with nothing except states."""
    found = []
    for n, p, m in product(range(4), repeat=3):
        if n + p + m > 3 or p == m == 0:
            continue
        for entries in product((0, 1), repeat=n * n + n * m + p * n + p * m):
            rest = list(entries)
            blocks = []
            for height, width in ((n, n), (n, m), (p, n), (p, m)):
                blocks.append([[rest.pop(0) for _ in range(width)] for _ in range(height)])
            found.append(parse_system(system({"prime": 2}, *blocks, n=n, p=p, m=m)))
    return found


def larger_systems() -> list[System]:
    rng = Random(5)
    return [parse_system(random_system(rng, {"prime": 2}, 2, rng.randint(1, 2), rng.randint(1, 2))) for _ in range(30)]


@pytest.mark.parametrize("enumerated", [tiny_systems(), larger_systems()], ids=["all tiny", "some larger"])
def test_ranks_and_delays_by_enumeration(enumerated: list[System]) -> None:
    for s in enumerated:
        runs = all_runs(s, s.n + 1)
        for samples in range(1, s.n + 2):
            words = {output[: samples * s.p] for _, _, output in runs}
            assert len(words) == 2 ** window_rank(s, samples)
        for initial_state in (KNOWN, UNKNOWN):
            least = None
            for last in range(s.n, -1, -1):
                first_faults: dict[tuple[int, ...], set[tuple[int, ...]]] = {}
                for x0, v, output in runs:
                    if initial_state == UNKNOWN or not any(x0):
                        first_faults.setdefault(output[: (last + 1) * s.p], set()).add(v[0])
                if all(len(different) == 1 for different in first_faults.values()):
                    least = last
            assert delay(s, initial_state) == least


@pytest.mark.parametrize("enumerated", [tiny_systems(), larger_systems()], ids=["all tiny", "some larger"])
def test_fault_spaces_by_enumeration(enumerated: list[System]) -> None:
    """z solves problem (11) iff every output of (A, f, C, g) from x(0) = 0 is a word of the system."""
    for s in enumerated:
        samples = s.n + 1
        words = {output for _, _, output in all_runs(s, samples)}
        solutions = set()
        for z in bits(s.n + s.p):
            column = [[s.field.integer(x)] for x in z]
            f, g = matrix(s.field, s.n, 1, column[: s.n]), matrix(s.field, s.p, 1, column[s.n :])
            other = System(s.field, s.A, f, s.C, g)
            signals = [list(v) for v in product(bits(1), repeat=samples)]
            if all(run(other, (0,) * s.n, v) in words for v in signals):
                solutions.add(z)
        basis = fault_space(s, samples)
        spanned = {combination(basis, weights) for weights in bits(basis.height)}
        assert spanned == solutions
        assert basis == fault_space_limit(s)


def combination(basis: Matrix, weights: tuple[int, ...]) -> tuple[int, ...]:
    """The result is the linear combination of the rows over GF(2)."""
    columns = basis.T.rows
    return tuple(sum(w * x.value for w, x in zip(weights, column, strict=True)) % 2 for column in columns)


@FEW
@given(systems())
def test_observability_and_controllability_by_chains(json: Any) -> None:
    """The rank of O_s and of its dual grow until they repeat, at the latest at s = n."""
    s = parse_system(json)
    ranks = [rank(observability(s, k)) for k in range(s.n + 3)]
    steps = [b - a for a, b in pairwise(ranks)]
    assert steps == sorted(steps, reverse=True) and steps[s.n :] == [0, 0]
    assert is_observable(s) == (ranks[-1] == s.n)
    dual = System(s.field, s.A.T, s.C.T, s.F.T, s.G.T)
    assert is_controllable(s) == is_observable(dual)


@pytest.mark.parametrize("description", FIELDS.values(), ids=FIELDS.keys())
def test_seeds_determine_systems(description: Any) -> None:
    drawn = [random_system(Random(seed), description, 2, 2, 1) for seed in range(30)]
    assert drawn == [random_system(Random(seed), description, 2, 2, 1) for seed in range(30)]
    ranks = {normal_rank(parse_system(json)) for json in drawn}
    assert ranks == {0, 1}, "degenerate systems are part of the mixture"


@FEW
@given(systems())
def test_reports_survive_another_spelling_of_numbers(json: Any) -> None:
    assume(isinstance(json["field"], dict) and "minimal_polynomial" in json["field"])
    answers = inspect_slowly(json)
    shorter = {
        **answers,
        "invariant_zero_polynomial": [c[0] if not any(x != "0" for x in c[1:]) else c for c in answers["invariant_zero_polynomial"]],
    }
    assert same_report(answers, shorter)
