"""The tests of this room can fail: one part of the code is spoiled at a time, and a named test must notice.

    BROKEN          what is spoiled -> where, which expression or statement becomes which, the check that notices, on what, and the test
                    that runs the check
    homes           where a function is defined, whichever file that is
    spoil           puts the spoiled function in place of the original wherever it was imported
    noticed         a check passes, and fails once the function is spoiled

Parts are compared as syntax trees, so that a function may be formatted anew or move to another file. The part must occur exactly once in
the function, so that the table cannot grow stale in silence. Over Q a wrong shape makes
`kernel_representation` ask the next prime for ever; such lines are spoiled over prime fields, or looked at before that loop.
"""

from __future__ import annotations
import __future__

import ast
import inspect
import sys
import textwrap
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib import import_module
from pkgutil import walk_packages
from typing import Any

import pytest

from faultspace import exact
from faultspace.exact.structure.behavior import separation
from tests.exact import checks
from tests.exact.test_unlucky_primes import SLY
from tests.oracle.families import adversarial, paper_example, shift_register
from tests.thorough import sampled

Json = Any
Q, THREE = adversarial("Q"), adversarial({"prime": 3})
SEEN, DOUBLED = "a0-fault-and-state-seen", "a0-fault-and-doubled-state-seen"
HALF: Json = {"A": [["1/2"]], "F": [[]], "C": [["1"]], "G": [[]], "n": 1, "m": 0, "p": 1}
HALVES: Json = {"A": [["1/2", "1"], ["0", "1/3"]], "F": [["1"], ["0"]], "C": [["1", "0"], ["1", "1"]], "G": [["0"], ["0"]]}
ZERO_AT_ONE: Json = {"A": [["2"]], "F": [["1"]], "C": [["1"]], "G": [["1"]], "field": {"prime": 5}}
UNSEEN_MODE: Json = {"A": [["1", "0"], ["0", "2"]], "F": [["1"], ["0"]], "C": [["1", "0"], ["1", "0"]], "G": [["0"], ["1"]]}
FEEDTHROUGH_ONLY: Json = {"A": [["0"]], "F": [["1"]], "C": [["0"], ["0"]], "G": [["1"], ["0"]], "field": {"prime": 3}}
RATIOS: Json = {"A": [["0"]], "F": [["1"]], "C": [["1"], ["0"]], "G": [["0"], ["2"]], "field": {"prime": 3}}
NAMED_TEST = "test_structure.test_every_check_on_named_systems"


@dataclass(frozen=True)
class Broken:
    """`old` becomes `new` in the function (or Class.method) of that name; `check(*arguments)`, which `test` runs, must notice."""

    function: str
    old: str
    new: str
    check: Callable[..., Any]
    arguments: tuple[Json, ...]
    test: str = NAMED_TEST
    folder: str = ""  # where functions of that name are in more than one


BROKEN: dict[str, Broken] = {
    # the recursion
    "the next subspace forgets F": Broken(
        "_chain",
        "beside(system.A @ subspace, system.F)",
        "beside(system.A @ subspace, Matrix.zero(system.field, system.n, system.m))",
        checks.check_window_ranks,
        (Q["delay-line-2"],),
    ),
    "the outputs are those of W_k only": Broken(
        "_chain",
        "beside(system.C @ subspace, system.G)",
        "beside(system.C @ subspace, Matrix.zero(system.field, system.p, system.m))",
        checks.check_window_ranks,
        (Q[SEEN],),
    ),
    "the recursion stops one step early": Broken(
        "_chain",
        "successor.ncols == subspace.ncols",
        "successor.ncols >= subspace.ncols - 1",
        checks.check_window_ranks,
        (Q[SEEN],),
    ),
    "W_k is not restricted to zero output": Broken(
        "_chain",
        "states @ right_null_space(outputs)",
        "states",
        checks.check_window_ranks,
        (Q["shift-register-2"],),
    ),
    "from rest starts anywhere": Broken(
        "chain_from_rest",
        "Matrix.zero(system.field, system.n, 0)",
        "Matrix.identity(system.field, system.n)",
        checks.check_window_ranks,
        (THREE["delay-line-2"],),
    ),
    "the profile is that of the columns": Broken(
        "row_profile",
        "matrix.transposed()",
        "matrix",
        checks.check_window_ranks,
        (FEEDTHROUGH_ONLY | {"C": [["0"], ["1"]], "G": [["0"], ["0"]]},),
    ),
    "the null space has the wrong sign": Broken(
        "right_null_space",
        "(-echelon.matrix)",
        "echelon.matrix",
        checks.check_window_ranks,
        (THREE["not-left-invertible-same-column-twice"],),
    ),
    # the Horner check
    "Horner drops the states": Broken(
        "horner_states",
        "coefficients.rows([k]) @ C + states[-1] @ A",
        "coefficients.rows([k]) @ C",
        checks.check_kernel_rows,
        (THREE["shift-register-2"],),
    ),
    "Horner takes the transpose of A": Broken(
        "horner_states",
        "states[-1] @ A",
        "states[-1] @ A.transposed()",
        checks.check_kernel_rows,
        (THREE["shift-register-2"],),
    ),
    "Horner drops the feedthrough": Broken(
        "horner",
        "coefficients @ system.G + stacked(*later) @ system.F",
        "stacked(*later) @ system.F",
        checks.check_kernel_rows,
        (THREE[SEEN],),
    ),
    "Horner looks at the state only": Broken(
        "Horner.vanishes",
        "self.at_state.is_zero() and self.at_fault.is_zero()",
        "self.at_state.is_zero()",
        checks.check_comparison,
        (Q[SEEN], Q[DOUBLED]),
        "test_behavior.test_different_pairs_are_drawn",
    ),
    "the exact check accepts everything": Broken(
        "_all_annihilate",
        "bool(state.is_zero())",
        "True",
        checks.check_report,
        (SLY["C vanishes"][0],),
        "test_unlucky_primes.test_sly_systems",
    ),
    # the relations
    "relations over GF(p) have the wrong sign": Broken(
        "relations_over_prime_field",
        "-solution[0, column]",
        "solution[0, column]",
        checks.check_kernel_rows,
        (THREE[SEEN],),
    ),
    "relations over Q have the wrong sign": Broken(
        "integer_relations",
        "-value * scale**k",
        "value * scale**k",
        checks.check_relations,
        (Q[SEEN],),
    ),
    "relations over Q(a) have the wrong sign": Broken(
        "integer_relations",
        "-value * scale**k",
        "value * scale**k",
        checks.check_relations,
        (paper_example(),),
    ),
    "relations forget the common denominator": Broken(
        "integer_relations",
        "bottom * scale**mu",
        "bottom",
        checks.check_relations,
        (HALF,),
        "test_structure.test_every_check_on_drawn_systems",
    ),
    "relations take one power of the denominator for another": Broken(
        "integer_relations",
        "scale**k",
        "scale**(k + 1)",
        checks.check_relations,
        (HALVES,),
        "test_structure.test_every_check_on_drawn_systems",
    ),
    # the pencil
    "the pencil has the wrong sign of F": Broken(
        "pencil_parts",
        "-system.F",
        "system.F",
        checks.check_finite_zeros,
        (ZERO_AT_ONE,),
        "test_structure.test_every_check_on_drawn_systems",
        folder="structure",
    ),
    "the pencil has no feedthrough": Broken(
        "pencil_parts",
        "system.G",
        "Matrix.zero(system.field, system.p, system.m)",
        checks.check_infinite_zeros,
        (Q["a0-zero-at-the-origin"],),
    ),
    "the pencil is not reversed": Broken(
        "reversed_pencil",
        "_linear(parts.slope, parts.constant)",
        "_linear(parts.constant, parts.slope)",
        checks.check_infinite_zeros,
        (Q["delay-line-2"],),
    ),
    "infinite zeros are forgotten": Broken(
        "infinite_zero_orders",
        "[k]",
        "[0]",
        checks.check_infinite_zeros,
        (Q["delay-line-2"],),
    ),
    "one minor is taken for all": Broken(
        "_gcd_of_minors",
        "len(result) != degree + 1",
        "not result",
        checks.check_finite_zeros,
        (UNSEEN_MODE,),
        "test_structure.test_every_check_on_drawn_systems",
    ),
    "what v moves counts among the zeros": Broken(
        "zero_dynamics_polynomial",
        "column_basis(nulling @ common)",
        "Matrix.zero(system.field, system.n, 0)",
        checks.check_finite_zeros,
        (THREE["not-left-invertible-silent-loop"],),
    ),
    "the null vector has no states": Broken(
        "right_null_polynomial",
        "stacked(*states)",
        "stacked(*states) - stacked(*states)",
        checks.check_right_indices,
        (THREE["not-left-invertible-silent-loop"],),
    ),
    "right indices are the left ones": Broken(
        "right_minimal_indices",
        "system.transposed()",
        "system",
        checks.check_right_indices,
        (THREE[SEEN],),
    ),
    "an elimination step is not recorded": Broken(
        "smith_diagonal",
        "_add_column(left_inverse, k, i, factor)",
        "None",
        checks.check_diagonals,
        (Q[SEEN],),
    ),
    # problem (11)
    "the first block column only": Broken(
        "column_conditions",
        "beside(stacked(*horner_states(coefficients, A, C)[1:]), coefficients)",
        "beside(horner_states(coefficients, A, C)[1], coefficients.rows([0]))",
        checks.check_fault_spaces,
        (Q[SEEN],),
    ),
    "the rows of window n only": Broken(
        "KernelRepresentation.rows_within",
        "window is None or row.degree < window",
        "row.degree < (self.system.n if window is None else window)",
        checks.check_fault_spaces,
        (Q[SEEN],),
    ),
    "the rows of one window more": Broken(
        "KernelRepresentation.rows_within",
        "row.degree < window",
        "row.degree <= window",
        checks.check_fault_spaces,
        (Q[SEEN],),
    ),
    "the basis is not reduced": Broken(
        "from_kernel_rows",
        "row_echelon(right_null_space(conditions).transposed()).matrix",
        "right_null_space(conditions).transposed()",
        checks.check_fault_spaces,
        (RATIOS,),
        "test_fault_space.test_every_window",
    ),
    "the limit is promised one sample early": Broken(
        "fault_space",
        "kernel.lag + 1",
        "kernel.lag",
        checks.check_fault_spaces,
        (Q["shift-register-3"],),
    ),
    # comparison
    "separating words forget v": Broken(
        "separation",
        "fault[k][j] = one",
        "pass",
        checks.check_comparison,
        (THREE[SEEN], THREE[DOUBLED]),
        "test_behavior.test_drawn_pairs",
    ),
    "words are a sample short": Broken(
        "separation",
        "Separation(row.degree + 1, x0, v, row)",
        "Separation(row.degree, x0, v, row)",
        checks.check_comparison,
        (Q[SEEN], Q[DOUBLED]),
        "test_behavior.test_different_pairs_are_drawn",
    ),
    # inversion
    "the unknown state's delay comes late": Broken(
        "_first_determined",
        "return delay",
        "return delay + 1",
        checks.check_inversion,
        (Q["delay-line-2"],),
    ),
    "the known state's delay comes early": Broken(
        "delay_known_state",
        "return delay",
        "return max(delay - 1, 0)",
        checks.check_inversion,
        (Q["delay-line-2"],),
    ),
    "an ambiguous word may have v(0) = 0": Broken(
        "ambiguous_word",
        "offset = 0 if known_state else system.n",
        "offset = 0",
        checks.check_inversion,
        (Q["unobservable-in-part"],),
    ),
    "a left inverse finds v(1)": Broken(
        "left_inverse",
        "beside(skipped, Matrix.identity(system.field, system.m), Matrix.zero(system.field, system.m, system.m * delay))",
        "beside(skipped, Matrix.zero(system.field, system.m, system.m * delay), Matrix.identity(system.field, system.m))",
        checks.check_inversion,
        (Q[SEEN],),
    ),
}


def homes(function: str, folder: str = "") -> list[tuple[Any, str]]:
    """These are the owners (module or class) of functions of that name in the room and among the slow twins, each with the function's own
    name.
    """
    owner_name, _, name = function.rpartition(".")
    found = []
    for place in [*(one.name for one in walk_packages(exact.__path__, "faultspace.exact.")), "tests.exact.slow_pairs"]:
        if folder not in place.split(".")[:-1] and folder:
            continue
        module = import_module(place)
        owner = getattr(module, owner_name, None) if owner_name else module
        if getattr(getattr(owner, name, None), "__module__", None) == place:
            found.append((owner, name))
    return found


def fragment(text: str) -> ast.AST:
    """The result is the expression or statement that the text is."""
    (statement,) = ast.parse(text).body
    return statement.value if isinstance(statement, ast.Expr) else statement


class Exchange(ast.NodeTransformer):
    """This puts `new` in the place of every node that reads like `old`, and counts them."""

    def __init__(self, old: str, new: str) -> None:
        self.old, self.new, self.count = ast.dump(fragment(old)), new, 0

    def visit(self, node: ast.AST) -> Any:
        """The result is the node, or what stands in its place."""
        if ast.dump(node) == self.old:
            self.count += 1
            return fragment(self.new)
        return super().visit(node)


def spoil(monkeypatch: pytest.MonkeyPatch, broken: Broken) -> None:
    """The function with one part exchanged for another stands wherever the original stood."""
    ((owner, name),) = homes(broken.function, broken.folder)
    original = inspect.getattr_static(owner, name)
    tree = ast.parse(textwrap.dedent(inspect.getsource(original)))
    exchange = Exchange(broken.old, broken.new)
    spoiled = ast.fix_missing_locations(exchange.visit(tree))
    assert exchange.count == 1, f"{broken.function} has {exchange.count} times: {broken.old}"
    namespace = dict(vars(sys.modules[original.__module__]))
    exec(compile(spoiled, "<spoiled>", "exec", __future__.annotations.compiler_flag), namespace)
    of_this_room = [module for key, module in sys.modules.items() if key.startswith(("faultspace.exact.", "tests.exact."))]
    places = [owner] if "." in broken.function else of_this_room
    for place in places:
        for key in [key for key, value in vars(place).items() if value is original]:
            monkeypatch.setattr(place, key, namespace[name])


@pytest.fixture(autouse=True)
def nothing_kept() -> Iterator[None]:
    """What was found before is not kept beyond a test, and what broken code finds goes with it."""
    separation.cache_clear()
    yield
    separation.cache_clear()


def noticed(monkeypatch: pytest.MonkeyPatch, broken: Broken, fails: type[Exception] | tuple[type[Exception], ...] = AssertionError) -> None:
    """Assert that a check passes, and fails so once a function is spoiled."""
    broken.check(*broken.arguments)
    spoil(monkeypatch, broken)
    separation.cache_clear()
    with pytest.raises(fails):
        broken.check(*broken.arguments)


@pytest.mark.parametrize("name", sampled(BROKEN, 4))
def test_it_is_noticed(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    noticed(monkeypatch, BROKEN[name])


def test_the_named_tests_run_the_checks() -> None:
    """Each test exists and calls the check by name, or all of SINGLE_CHECKS and the check is one of them."""
    for name, broken in BROKEN.items():
        module, _, function = broken.test.partition(".")
        source = inspect.getsource(getattr(import_module(f"tests.exact.{module}"), function))
        by_name = f"checks.{broken.check.__name__}(" in source or f"checks.{broken.check.__name__}," in source
        assert by_name or ("checks.SINGLE_CHECKS" in source and broken.check in checks.SINGLE_CHECKS), name


def test_a_stale_line_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    stale = Broken("window_matrix", "no_such_part", "", checks.check_window_ranks, (shift_register("Q", 1),))
    with pytest.raises(AssertionError, match=r"window_matrix has 0 times: no_such_part"):
        spoil(monkeypatch, stale)
