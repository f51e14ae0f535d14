"""These tests take systems, matrices and results as values, which do not change, and which compare, hash, pickle and print.

SAME        one system given in many ways
RECORDS     name -> a function from a system to a result
"""

from __future__ import annotations

import copy
import json
import pickle
from collections.abc import Callable
from dataclasses import FrozenInstanceError, fields, replace
from fractions import Fraction
from typing import Any

import flint
import pytest
import sympy
from hypothesis import given, settings
from sympy.polys.matrices import DomainMatrix

import faultspace.exact as exact
from faultspace.base.errors import InvalidInput
from faultspace.base.sheets import Shown
from faultspace.exact.algebra.fields import QQ, AlgebraicNumber, Field, NumberField, PrimeField, field_from_json
from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.pairs.polynomial import Exceptional
from faultspace.exact.structure.behavior import compare
from faultspace.exact.structure.fault_columns import fault_space
from faultspace.exact.structure.inversion import ambiguous_word
from faultspace.exact.structure.kernel_rows import KernelRepresentation, horner, kernel_representation
from faultspace.exact.structure.pencil import right_null_polynomial
from faultspace.exact.structure.record import analyze
from faultspace.exact.structure.signals import simulate
from faultspace.exact.structure.zero_output import zero_output_chain
from faultspace.exact.system.modular import image
from faultspace.exact.system.systems import FaultySystem, ResidualSystem, System, from_float_exactly, read_system
from tests.exact import checks
from tests.oracle.families import CUBIC, FIELDS, SQRT2
from tests.oracle.strategies import systems
from tests.thorough import examples

Json = Any
SQRT_TWO = NumberField((Fraction(-2), Fraction(0), Fraction(1)))
HALF = Fraction(1, 2)

SAME: dict[str, tuple[Any, ...]] = {
    "strings": ([["1/2", "3"], ["0", "-1"]], [["1"], ["0"]], [["1", "2/4"]], [["0"]]),
    "integers and Fractions": ([[HALF, 3], [0, -1]], [[1], [0]], [[1, HALF]], [[0]]),
    "tuples": (((HALF, 3), (0, -1)), ((1,), (0,)), ((1, HALF),), ((0,),)),
    "flint": ([[flint.fmpq(1, 2), flint.fmpz(3)], [0, -1]], [[1], [0]], [[1, flint.fmpq(2, 4)]], [[0]]),
    "sympy numbers": (
        [[sympy.Rational(1, 2), sympy.Integer(3)], [0, -1]],
        [[1], [0]],
        [[1, sympy.S.Half]],
        [[0]],
    ),
    "sympy matrices": (
        sympy.Matrix([[sympy.S.Half, 3], [0, -1]]),
        sympy.ImmutableMatrix([1, 0]),
        sympy.Matrix([[1, sympy.S.Half]]),
        sympy.zeros(1, 1),
    ),
    "DomainMatrix": tuple(
        DomainMatrix.from_Matrix(sympy.Matrix(rows)).convert_to(sympy.QQ)
        for rows in ([[sympy.S.Half, 3], [0, -1]], [[1], [0]], [[1, sympy.S.Half]], [[0]])
    ),
    "sparse DomainMatrix": tuple(
        DomainMatrix.from_Matrix(sympy.Matrix(rows)).convert_to(sympy.QQ).to_sparse()
        for rows in ([[sympy.S.Half, 3], [0, -1]], [[1], [0]], [[1, sympy.S.Half]], [[0]])
    ),
    "matrices of this room": tuple(Matrix.of(rows) for rows in ([[HALF, 3], [0, -1]], [[1], [0]], [[1, HALF]], [[0]])),
}
ONE_WAY = ResidualSystem.of(*SAME["strings"])

RECORDS: dict[str, Callable[[ResidualSystem], Any]] = {
    "system": lambda s: s,
    "with inputs": lambda s: FaultySystem(s, Matrix.identity(s.field, s.n), s.C),
    "matrix": lambda s: s.A,
    "field": lambda s: s.field,
    "image": image,
    "chain": zero_output_chain,
    "kernel representation": kernel_representation,
    "comparison": lambda s: compare(kernel_representation(s), kernel_representation(s.with_faults(s.F + s.F + s.F, s.G))),
    "fault space": lambda s: fault_space(kernel_representation(s)),
    "null polynomial": lambda s: right_null_polynomial(s.transposed()),
    "ambiguous word": lambda s: ambiguous_word(s, 1, known_state=False),
    "trajectory": lambda s: simulate(s, s.F.columns([0]), s.A.columns(range(s.m))),
    "Horner": lambda s: horner(s.C.transposed().columns([0]) @ s.C.columns([0]).transposed(), s),
    "structure": analyze,
}
FIELD_OBJECTS: dict[str, Field] = {name: field_from_json(f) for name, f in FIELDS.items()}


def example(field: Field) -> ResidualSystem:
    """The system has one fault, two outputs, three states and the entries 0, 1 and 2."""
    return ResidualSystem.of([[0, 1, 0], [0, 0, 1], [2, 1, 1]], [[1], [0], [1]], [[1, 0, 0], [0, 1, 0]], [[0], [0]], field=field)


@pytest.mark.parametrize("name", list(SAME))
def test_one_system_given_in_many_ways(name: str) -> None:
    found = ResidualSystem.of(*SAME[name])
    assert found == ONE_WAY and hash(found) == hash(ONE_WAY)
    assert found.to_json() == {"A": [["1/2", "3"], ["0", "-1"]], "F": [["1"], ["0"]], "C": [["1", "1/2"]], "G": [["0"]]}


@pytest.mark.parametrize("over", list(FIELD_OBJECTS))
@pytest.mark.parametrize("name", list(RECORDS))
def test_records_are_values(name: str, over: str) -> None:
    """Made twice they are equal with equal hashes, they survive pickling, and nothing can be assigned."""
    make, system = RECORDS[name], example(FIELD_OBJECTS[over])
    record = make(system)
    assert record is not None
    again = make(example(FIELD_OBJECTS[over]))
    assert again == record and hash(again) == hash(record)
    loaded = pickle.loads(pickle.dumps(record))
    assert loaded == record and hash(loaded) == hash(record) and type(loaded) is type(record)
    for place in fields(record):
        with pytest.raises(FrozenInstanceError):
            setattr(record, place.name, None)
    with pytest.raises((FrozenInstanceError, TypeError)):
        record.something_new = 1


def test_both_kinds_are_systems_and_nothing_else_is() -> None:
    """What `System` makes is an instance of it and equal to what the class of its kind makes; neither kind is the other."""
    rows = SAME["strings"]
    inputs: Json = {"B": [["1"], ["0"]], "D": [["2"]]}
    without, faulty = System(*rows), System(*rows, **inputs)
    assert (type(without), type(faulty)) == (ResidualSystem, FaultySystem)
    assert without == ONE_WAY == without.residual == faulty.residual
    assert faulty == FaultySystem(ONE_WAY, Matrix.of([[1], [0]]), Matrix.of([[2]])) == read_system({**ONE_WAY.to_json(), **inputs})
    assert all(isinstance(one, System) for one in (without, faulty, ONE_WAY)) and not isinstance(ONE_WAY.A, System)
    for one in (without, faulty):
        assert (one.n, one.m, one.p, one.field) == (2, 1, 1, QQ)
        assert replace(one) == copy.deepcopy(one) == one
    moved = replace(without, G=Matrix.of([[5]]))
    assert Matrix.of([[5]]) == moved.G and moved.A == ONE_WAY.A
    with pytest.raises(InvalidInput, match="G: got shape"):
        replace(without, G=Matrix.zero(QQ, 2, 2))


PAIRS: dict[str, Callable[[Exceptional], Any]] = {
    "pencil": lambda pencil: pencil,
    "verdict": lambda pencil: exact.judge(pencil, [[0]] * pencil.n_z),
    "good columns": exact.good_columns,
    "bad pair, or none": exact.bad_pair,
    "zero assignment": lambda pencil: exact.assign_zeros(pencil, list(pencil.fixed)),
    "recovery": exact.recoverable_pair,
    "bad set": exact.bad_set,
}
NAMED: dict[str, Callable[[KernelRepresentation], Any]] = {
    "kernel representation": lambda kernel: kernel,
    "fault space": exact.fault_space,
    "fault space of a short window": lambda kernel: exact.fault_space(kernel, 0),
    "without feedthrough": exact.zero_feedthrough,
    "behaviour": exact.behavior_name,
    "fault class": exact.fault_class,
    "feedback class": exact.feedback_class,
}


def public_records(field: Field) -> dict[str, Any]:
    """Return one of each record that a public function makes over the field."""
    system = example(field)
    kernel = kernel_representation(system)
    found = {name: RECORDS[name](system) for name in ("system", "with inputs", "comparison", "trajectory", "structure")}
    found |= {name: make(exact.exceptional(kernel)) for name, make in PAIRS.items()} | {name: make(kernel) for name, make in NAMED.items()}
    unobservable = ResidualSystem.of([[1]], [[1]], [[0]], [[1]], field=field)
    found["bad pair"] = exact.bad_pair(exact.exceptional(kernel_representation(unobservable)))
    if field == QQ:
        found["generic ranks"], found["strata"] = exact.generic_window_ranks(1, 2, 1, [1, 2]), exact.stratify(1, 1, 1)
        found["equations"] = exact.bad_equations(exact.exceptional(kernel))
        stable = FaultySystem(ResidualSystem.of([["1/2"]], [[1]], [[1]], [[0]]), Matrix.of([[1]]), Matrix.of([[0]]))
        found["experiment"] = exact.Experiment(stable, 2, 2, exact.Filter.of([[[1, 0]]]), exact.Filter.of([[[0, 1]]]))
    return found


@pytest.mark.parametrize("over", list(FIELD_OBJECTS))
def test_public_records_are_read_by_people_and_programs(over: str) -> None:
    """Each has a short repr, a summary that begins with its title, a table for notebooks, and JSON that can be written."""
    for name, record in public_records(FIELD_OBJECTS[over]).items():
        assert Shown in type(record).__mro__, name
        assert repr(record) == f"<{type(record).__name__}: {record.title}>" and len(repr(record)) < 140 and "\n" not in repr(record), name
        lines = record.summary().splitlines()
        assert lines[0] == record.title, name
        assert record._repr_html_().count("<tr>") == len(list(record.sheet())), name
        assert json.loads(json.dumps(record.to_json())) == record.to_json(), name


@pytest.mark.parametrize("over", list(FIELD_OBJECTS))
def test_what_is_read_out_is_a_copy(over: str) -> None:
    matrix = example(FIELD_OBJECTS[over]).A
    table, listed = matrix.elements(), matrix.to_json()
    table[0][0] = table[0][1]
    listed[0][0] = "7"
    assert matrix == example(FIELD_OBJECTS[over]).A
    with pytest.raises(TypeError):
        matrix[0, 0] = 1  # type: ignore[index]


@pytest.mark.parametrize("over", list(FIELD_OBJECTS))
def test_equality_sees_every_entry_the_shape_and_the_field(over: str) -> None:
    field = FIELD_OBJECTS[over]
    system = example(field)
    for name in "AFCG":
        part = getattr(system, name)
        for i in range(part.nrows):
            for j in range(part.ncols):
                rows = part.elements()
                rows[i][j] = rows[i][j] + field.element(1)
                changed = Matrix.from_elements(field, part.nrows, part.ncols, rows)
                other = ResidualSystem(**{**{k: getattr(system, k) for k in "AFCG"}, name: changed})
                assert other != system and changed != part
    assert Matrix.zero(field, 0, 2) != Matrix.zero(field, 2, 0) != Matrix.zero(field, 0, 0)
    assert Matrix.zero(field, 0, 2) == Matrix.of([], field, shape=(0, 2))
    assert Matrix.zero(field, 1, 1) != Matrix.zero(PrimeField(7), 1, 1)
    assert system.A.__eq__("A") is NotImplemented and system.__eq__(0) is NotImplemented


@settings(max_examples=examples(60))
@given(systems())
def test_written_and_read_again(given: Json) -> None:
    system = checks.read(given)
    written = system.to_json()
    assert read_system(written) == system
    assert read_system(given) == system
    assert read_system(written).to_json() == written
    assert ("n" in written) == (0 in (system.n, system.m, system.p))
    assert ("field" in written) == (system.field != QQ)
    inputs = {"B": system.A.to_json(), "D": system.C.to_json()}
    nu = {"nu": system.n} if 0 in (system.n, system.m, system.p) else {}
    faulty = read_system({**written, **inputs, **nu})
    assert isinstance(faulty, FaultySystem) and faulty.residual == system and faulty.nu == system.n
    assert (faulty.B, faulty.D, faulty.field) == (system.A, system.C, system.field)
    assert read_system(faulty.to_json()) == faulty
    assert pickle.loads(pickle.dumps(faulty)) == faulty


@pytest.mark.parametrize("empty", [[], [[], []]], ids=str)
def test_empty_rows_may_be_left_out(empty: Json) -> None:
    """[] and the right number of empty rows are both read, the latter is written."""
    found = read_system({"A": [["0", "1"], ["0", "0"]], "F": empty, "C": [["1", "0"], ["0", "1"]], "G": empty, "n": 2, "m": 0, "p": 2})
    assert found.residual.F.shape == found.residual.G.shape == (2, 0)
    assert found.to_json()["F"] == found.to_json()["G"] == [[], []]


def test_sympy_there_and_back() -> None:
    assert ONE_WAY.A.to_sympy() == sympy.ImmutableMatrix([[sympy.S.Half, 3], [0, -1]])
    assert Matrix.of(ONE_WAY.A.to_sympy()) == ONE_WAY.A
    a = sympy.Symbol("a")
    assert Matrix.of([[["1/2", -3], 5]], SQRT_TWO).to_sympy() == sympy.ImmutableMatrix([[sympy.S.Half - 3 * a, 5]])
    assert Matrix.of([[-1, 4]], PrimeField(3)).to_sympy() == sympy.ImmutableMatrix([[2, 1]])
    assert Matrix.of(sympy.zeros(0, 3)).shape == (0, 3) and Matrix.of(sympy.zeros(3, 0)).shape == (3, 0)


def test_domain_matrices_over_other_domains() -> None:
    integers = DomainMatrix.from_Matrix(sympy.Matrix([[1, -2]]))
    assert integers.domain == sympy.ZZ and Matrix.of(integers) == Matrix.of([[1, -2]])
    residues = integers.convert_to(sympy.GF(5))
    assert Matrix.of(residues, PrimeField(5)) == Matrix.of([[1, 3]], PrimeField(5))
    algebraic = DomainMatrix.from_Matrix(sympy.Matrix([[1 + sympy.sqrt(2), 3], [0, sympy.sqrt(2) / 2]]), extension=True)
    assert Matrix.of(algebraic, SQRT_TWO) == Matrix.of([[[1, 1], 3], [0, [0, "1/2"]]], SQRT_TWO)
    assert Matrix.of(algebraic.to_sparse(), SQRT_TWO) == Matrix.of(algebraic, SQRT_TWO)


def test_the_example_of_the_paper_through_sympy() -> None:
    """The example has a cubic field, and its F is given as a DomainMatrix over QQ<a>."""
    x = sympy.Symbol("x")
    field = field_from_json(CUBIC)
    domain = sympy.QQ.algebraic_field(sympy.CRootOf(4 * x**3 - x**2 - 3 * x + 1, 0))
    a = domain([1, 0])
    F = Matrix.of(DomainMatrix([[domain.one], [a], [a**2]], (3, 1), domain), field)
    assert F.to_json() == [["1"], [["0", "1", "0"]], [["0", "0", "1"]]]
    A = Matrix.of([[0, 1, 0], [0, 0, 1], ["-1/4", "3/4", "1/4"]], field)
    assert (A @ F).to_json() == [[["0", "1", "0"]], [["0", "0", "1"]], [["-1/4", "3/4", "1/4"]]]


@pytest.mark.parametrize("value", [0.5, -3.0, 0.1, 1e-300, 0.0, 7])
def test_a_float_is_the_dyadic_rational_that_it_is(value: float) -> None:
    found = from_float_exactly(value)
    assert isinstance(found, Fraction) and float(found) == value
    assert found.denominator & (found.denominator - 1) == 0
    assert Matrix.of([[found]])[0, 0] == flint.fmpq(found.numerator, found.denominator)


def test_from_float_exactly_is_not_rounded() -> None:
    assert from_float_exactly(0.1) == Fraction(3602879701896397, 36028797018963968)


def test_printing() -> None:
    assert str(ONE_WAY) == "A=[[1/2, 3], [0, -1]], F=[[1], [0]], C=[[1, 1/2]], G=[[0]]"
    over = ResidualSystem.of([[[0, 1]]], [[1]], [[1]], [[0]], field=SQRT_TWO)
    assert str(over) == "A=[[a]], F=[[1]], C=[[1]], G=[[0]] over Q(a) with a^2 - 2 = 0"
    assert str(Matrix.zero(QQ, 0, 3)) == "[0 x 3]" and repr(ONE_WAY.G) == "[[0]]"
    assert [str(f) for f in (QQ, PrimeField(5))] == ["Q", "GF(5)"]


def test_elements_of_a_number_field() -> None:
    a = SQRT_TWO.element([0, 1])
    assert a * a == 2 and a * a == SQRT_TWO.element("2") and a != 2 and a != "a"
    assert isinstance(a + 1, AlgebraicNumber) and a + 1 - 1 == a
    assert SQRT_TWO.write(a * a) == "2" and SQRT_TWO.write(a / 2) == ["0", "1/2"]
    assert hash(a * a * a) == hash(a + a) and len({a, a * 1, -a, a - a - a}) == 2
    assert SQRT_TWO.element(a) is a


def test_equal_elements_have_equal_hashes() -> None:
    assert SQRT_TWO.element(2) == 2 and hash(SQRT_TWO.element(2)) == hash(2)
    assert len({SQRT_TWO.element("1/2"), flint.fmpq(1, 2)}) == 1


def test_roots_of_different_polynomials_are_different() -> None:
    """sqrt 2 is not sqrt 3, and there is no field to add them in."""
    other = NumberField((Fraction(-3), Fraction(0), Fraction(1)))
    two, three = SQRT_TWO.element([0, 1]), other.element([0, 1])
    assert two != three
    with pytest.raises((TypeError, ValueError)):
        two + three


def test_a_multiple_of_the_minimal_polynomial_names_the_same_field() -> None:
    assert field_from_json({"minimal_polynomial": ["-4", "0", "2"]}) == field_from_json(SQRT2)


@pytest.mark.parametrize("name, field", list(FIELD_OBJECTS.items()))
def test_fields_are_values(name: str, field: Field) -> None:
    assert field_from_json(FIELDS[name]) == field and hash(field_from_json(FIELDS[name])) == hash(field)
    assert field_from_json(field.to_json()) == field
    assert [other for other in FIELD_OBJECTS if FIELD_OBJECTS[other] == field] == [name]
    assert field.characteristic in (0, 2, 3, 5) and field.degree == len(field.block(field.element(1)))
