"""What a stranger may give to the public functions: systems for kernels, lists for matrices, numbers in range; else one line that helps."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable
from fractions import Fraction
from itertools import product
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest
import sympy

import faultspace as fs
from faultspace import exact
from faultspace.exact import Matrix, ResidualSystem, System

RESIDUAL = fs.System(A=[[0, 1], ["1/4", 0]], F=[[0], [1]], C=[[1, 0]], G=[[0]])
FAULTY = fs.System(A=[[0, 1], ["1/4", 0]], F=[[0], [1]], C=[[1, 0]], G=[[0]], B=[[1], [2]], D=[[3]])
KERNEL = exact.kernel_representation(RESIDUAL)
Q = exact.Rationals()
Anything = Any

COUNTED: dict[str, Callable[[Anything], object]] = {
    "left_inverse, known": lambda s: exact.left_inverse(RESIDUAL, s, known_state=True),
    "left_inverse, unknown": lambda s: exact.left_inverse(RESIDUAL, s, known_state=False),
    "Matrix.zero, rows": lambda s: Matrix.zero(Q, s, 2),
    "Matrix.zero, columns": lambda s: Matrix.zero(Q, 2, s),
    "Matrix.identity": lambda s: Matrix.identity(Q, s),
    "toeplitz_matrix": lambda s: exact.toeplitz_matrix(RESIDUAL, s),
    "observability_matrix": lambda s: exact.observability_matrix(RESIDUAL, s),
    "window_matrix": lambda s: exact.window_matrix(RESIDUAL, s),
    "rank of a window": KERNEL.rank,
    "gap of a window": KERNEL.gap,
    "rows within a window": lambda s: KERNEL.rows_within(s) if s is not None else KERNEL.rank(-1),
    "fault_space": lambda s: exact.fault_space(KERNEL, s) if s is not None else KERNEL.rank(-1),
    "fault_space_dimension": lambda s: exact.fault_space_dimension(KERNEL, s) if s is not None else KERNEL.rank(-1),
    "data_fault_space": lambda s: exact.data_fault_space(Matrix.of([[1], [2], [3]]), RESIDUAL.A, RESIDUAL.C, s),
    "n of a system": lambda s: fs.System(A=[[1]], F=[[1]], C=[[1]], G=[[0]], n=s if s is not None else -1),
}


def test_a_count_may_be_an_integer_of_numpy() -> None:
    assert [name for name, function in COUNTED.items() if str(function(np.int64(1))) != str(function(1))] == []


def test_entries_and_primes_may_be_integers_of_numpy_and_floats_may_not() -> None:
    one = fs.System(A=[[0, 1], [3, 0]], F=[[0], [1]], C=[[1, 0]], G=[[0]])
    A = np.array([[0, 1], [3, 0]])
    for kind in (np.int64, np.int32, np.uint8):
        assert fs.System(A=A.astype(kind), F=[[kind(0)], [kind(1)]], C=[[kind(1), 0]], G=[[kind(0)]]) == one
    assert exact.PrimeField(cast(Anything, np.int64(3))) == exact.PrimeField(3)
    assert Matrix.of(cast(Anything, [[np.int8(-1)]])) == Matrix.of([[-1]])
    assert exact.stratify(*(cast(Anything, np.int64(k)) for k in (1, 1, 0))).strata == exact.stratify(1, 1, 0).strata
    for wrong in (np.float64(1), np.bool_(True), np.array(1.0)):
        with pytest.raises(fs.errors.InvalidInput):
            fs.System(A=[[wrong]], F=[[1]], C=[[1]], G=[[0]])
    with pytest.raises(fs.errors.InvalidInput):
        fs.System(A=A.astype(float), F=[[0], [1]], C=[[1, 0]], G=[[0]])


TOO_LARGE = ("Matrix.zero, rows", "Matrix.identity", "toeplitz_matrix", "observability_matrix", "window_matrix", "left_inverse, known")


def taken(functions: dict[str, Callable[[Anything], Any]], values: Iterable[object], words: str) -> list[tuple[str, object]]:
    """Return the name of each function with each value that it does not refuse in these words."""
    found = []
    for (name, function), value in product(functions.items(), values):
        try:
            function(value)
        except fs.errors.InvalidInput as error:
            if re.search(words, str(error)):
                continue
        found.append((name, value))
    return found


def test_a_count_is_an_integer_from_zero_on() -> None:
    assert taken(COUNTED, [-1, -(10**30), True, 1.0, "1", None], r": got .*, expected an integer >= 0") == []


def test_a_matrix_that_no_memory_holds_is_not_begun() -> None:
    large = {name: COUNTED[name] for name in TOO_LARGE}
    assert taken(large, [10**9, 10**30], r"got a matrix of .* entries are supported") == []


def test_ranks_of_huge_windows_need_no_matrix() -> None:
    assert KERNEL.rank(10**30) == 10**30 and exact.fault_space(KERNEL, 10**30).basis == exact.fault_space(KERNEL).basis


OF_KERNELS: dict[str, Callable[[Anything], Any]] = {
    "delay_known_state": exact.delay_known_state,
    "delay_unknown_state": exact.delay_unknown_state,
    "fault_space": exact.fault_space,
    "fault_space_dimension": exact.fault_space_dimension,
    "behavior_name": exact.behavior_name,
    "fault_class": exact.fault_class,
    "feedback_class": exact.feedback_class,
    "zero_feedthrough": lambda s: exact.zero_feedthrough(s).pins_F,
    "exceptional": lambda s: exact.exceptional(s).b,
    "with_pair": lambda s: exact.with_pair(s if isinstance(s, System) or s in REFUSED else exact.fault_space(s), [[1]] * 3),
    "compare": lambda s: exact.compare(s, KERNEL).equivalent,
}
OF_PENCILS: dict[str, Callable[[Anything], Any]] = {
    "judge": lambda s: exact.judge(s, [[1]] * 3).good,
    "assign_zeros": lambda s: exact.assign_zeros(s, [1]).P,
    "recoverable_pair": lambda s: exact.recoverable_pair(s).delay,
    "good_columns": lambda s: exact.good_columns(s).chosen,
    "bad_pair": lambda s: type(exact.bad_pair(s)),
    "bad_set": lambda s: exact.bad_set(s).dimension,
    "bad_equations": lambda s: exact.bad_equations(s).equations,
}
OF_SYSTEMS: dict[str, Callable[[Anything], Any]] = {
    "observability_matrix": lambda s: exact.observability_matrix(s, 2),
    "toeplitz_matrix": lambda s: exact.toeplitz_matrix(s, 2),
    "window_matrix": lambda s: exact.window_matrix(s, 2),
    "reachability_matrix": exact.reachability_matrix,
    "left_inverse": lambda s: exact.left_inverse(s, 2, known_state=True),
    "simulate": lambda s: exact.simulate(s, [[1], [0]], [[1], [2]]).residuals,
    "analyze": lambda s: exact.analyze(s).to_json(),
    "kernel_representation": lambda s: exact.kernel_representation(s).to_json(),
    "certify": lambda s: fs.certify(s, "window-ranks"),
}
REFUSED: tuple[Any, ...] = (None, 3, "paper.json", {"A": [["1"]]}, [[1]], Matrix.of([[1]]))


@pytest.mark.parametrize("name", [*OF_KERNELS, *OF_PENCILS, *OF_SYSTEMS])
def test_every_function_of_a_system_takes_either_kind(name: str) -> None:
    function = {**OF_KERNELS, **OF_PENCILS, **OF_SYSTEMS}[name]
    expected = function(KERNEL if name in OF_KERNELS else exact.exceptional(KERNEL) if name in OF_PENCILS else RESIDUAL)
    assert function(RESIDUAL) == function(FAULTY) == expected


def test_what_is_no_system_is_told_so() -> None:
    every = {**OF_KERNELS, **OF_PENCILS, **OF_SYSTEMS}
    assert taken(every, REFUSED, r": got .*, expected a ResidualSystem or a FaultySystem") == []


@pytest.mark.parametrize("given", ["paper.json", Path("paper.json")])
def test_a_name_of_a_file_says_how_files_are_read(given: object, tmp_path: Path) -> None:
    with pytest.raises(fs.errors.InvalidInput, match=r"read_system\(json\.load\(open\(path\)\)\)"):
        fs.analyze(given)  # type: ignore[arg-type]
    with pytest.raises(fs.errors.InvalidInput, match=r"read_experiment\(json\.load\(open\(path\)\)\)"):
        fs.limit(given)  # type: ignore[arg-type]
    path = tmp_path / "paper.json"
    path.write_text(json.dumps(FAULTY.to_json()))
    assert exact.read_system(json.loads(path.read_text())) == FAULTY


def test_both_kinds_have_the_matrices_and_write_them_alike() -> None:
    for name in "AFCG":
        assert getattr(FAULTY, name) == getattr(RESIDUAL, name)
    assert (RESIDUAL.B.shape, RESIDUAL.D.shape, RESIDUAL.nu, FAULTY.nu) == ((2, 0), (1, 0), 0, 1)
    assert str(FAULTY) == f"{RESIDUAL}, B=[[1], [2]], D=[[3]]"
    assert ResidualSystem(RESIDUAL.A, RESIDUAL.F, RESIDUAL.C, RESIDUAL.G) == RESIDUAL


def test_lists_stand_for_matrices() -> None:
    one = Matrix.of([[1]])
    assert (exact.rank([[1, 2], [2, 4]]), exact.is_stable([["1/2"]])) == (1, True)  # type: ignore[arg-type]
    two: Any = [[2]]
    assert one + two == Matrix.of([[3]]) and one - two == Matrix.of([[-1]]) and one @ two == Matrix.of(two)
    assert exact.left_null_space([[1], [1]]) == Matrix.of([[-1, 1]])  # type: ignore[arg-type]
    assert exact.right_null_space([[1, 1]]).shape == (2, 1) and exact.row_echelon([[2, 2]]).pivots == (0,)  # type: ignore[arg-type]


WRONG: dict[str, tuple[Callable[[], object], str]] = {
    "a system for a matrix": (
        lambda: exact.is_stable(cast(Any, RESIDUAL)),
        r"expected a list of rows or a Matrix, one of the system's: try \.A",
    ),
    "nothing for a matrix": (lambda: exact.rank(None), "expected a list of rows"),  # type: ignore[arg-type]
    "shapes of a product": (lambda: Matrix.of([[1, 2]]) @ Matrix.of([[1]]), "@: got 1 x 2 and 1 x 1, expected as many columns"),
    "shapes of a sum": (lambda: Matrix.of([[1, 2]]) + Matrix.of([[1]]), r"\+: got 1 x 2 and 1 x 1, expected equal shapes"),
    "shapes of a difference": (lambda: Matrix.of([[1, 2]]) - Matrix.of([[1]]), "-: got 1 x 2 and 1 x 1, expected equal shapes"),
    "a number for A": (lambda: fs.System(A=1, F=[[1]], C=[[1]], G=[[0]]), r"^A: got 1, expected a list of rows, try \[\[1\]\]"),
    "a number for B": (lambda: fs.System(A=[[1]], F=[[1]], C=[[1]], G=[[0]], B=2, D=[[0]]), r"^B: got 2, expected a list of rows, try"),
    "a flat array": (lambda: fs.System(A=np.array([1]), F=[[1]], C=[[1]], G=[[0]]), "^A: got array.*expected a list of rows"),
    "floats in an array": (lambda: fs.System(A=np.eye(1), F=[[1]], C=[[1]], G=[[0]]), "^A: got .* see from_float_exactly"),
    "truth values in an array": (lambda: Matrix.of(np.array([[True]])), "expected a list of rows"),
    "a zero denominator": (lambda: Matrix.of([["1/0"]]), "the denominator is zero"),
    "a truth value": (lambda: Matrix.of([[True]]), "write 1 or 0"),
    "a root": (lambda: Matrix.of([[sympy.sqrt(2)]]), "minimal_polynomial"),
    "an exponent": (lambda: Matrix.of([["1e-3"]]), r'write "1/1000"'),
    "a large exponent": (lambda: Matrix.of([["1e99999999"]]), "expected a rational string such as .-3/4.$"),
}


@pytest.mark.parametrize("name", list(WRONG))
def test_a_message_says_what_to_try(name: str) -> None:
    call, words = WRONG[name]
    with pytest.raises(fs.errors.InvalidInput, match=words):
        call()


@pytest.mark.parametrize("kind", ["int64", "uint8", "object"])
def test_arrays_of_integers_are_exact(kind: str) -> None:
    made = fs.System(A=np.array([[2]], dtype=kind), F=[[1]], C=np.array([[1]], dtype=kind), G=[[Fraction(1, 2)]])
    assert str(made) == "A=[[2]], F=[[1]], C=[[1]], G=[[1/2]]"
