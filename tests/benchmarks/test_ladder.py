"""The ladder benchmark measures what it says: the systems have their planted structure, all methods give the same ranks, limits hold.

METHODS     every method of the benchmark; those not installed are skipped and say why
"""

import sys
from math import log

import pytest
from scipy.stats import linregress

from benchmarks.ladder_cells import Budget, Cell, measure, ranks_from_indices, read_lines
from benchmarks.ladder_methods import METHODS, RUNNERS, Method
from benchmarks.ladder_run import Run, SystemCells, aims, disagreements, exponent, ratio
from benchmarks.ladder_systems import FAMILIES, Family
from benchmarks.ladder_tables import notes, sheets
from benchmarks.sheets import markdown
from faultspace.exact.algebra.matrices import Matrix, beside, rank, stacked
from faultspace.exact.structure.inversion import largest_output_nulling
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.system.systems import ResidualSystem
from faultspace.exact.system.windows import window_matrix

PLANTED = [family for family in FAMILIES if family.kind != "dense"]
QUICK = Budget(seconds=20, setup=20, repeats=1)


def system_of(family: Family, n: int) -> ResidualSystem:
    specimen = family.specimen(n)
    return ResidualSystem.of(specimen.A, specimen.F, specimen.C, specimen.G)


@pytest.mark.parametrize("n", [4, 10, 20])
@pytest.mark.parametrize("family", PLANTED, ids=str)
def test_the_planted_subspace_is_the_largest_output_nulling_one(family: Family, n: int) -> None:
    specimen, system = family.specimen(n), system_of(family, n)
    assert specimen.subspace is not None and specimen.feedback is not None
    plant, feedback = Matrix.of(specimen.subspace), Matrix.of(specimen.feedback)
    closed, seen = system.A + system.F @ feedback, system.C + system.G @ feedback
    assert rank(plant) == n // 2
    assert rank(beside(plant, closed @ plant)) == n // 2
    assert (seen @ plant).is_zero()
    largest = largest_output_nulling(system)
    assert largest.ncols == n // 2
    assert rank(beside(plant, largest)) == n // 2


@pytest.mark.parametrize("n", [4, 10, 20])
@pytest.mark.parametrize("family", FAMILIES, ids=str)
def test_families_have_the_shape_and_the_rank_they_name(family: Family, n: int) -> None:
    system = system_of(family, n)
    p, m = family.sizes(n)
    assert (system.n, system.p, system.m) == (n, p, m)
    assert (p == m + 1) == (family.shape == "tight")
    kernel = kernel_representation(system)
    assert kernel.normal_rank == (m - 1 if family.kind == "invisible" else m)
    visible = n if family.kind == "dense" else n - n // 2
    assert sum(kernel.left_minimal_indices) == visible
    faults_kept_apart = rank(stacked(system.F, system.G)) == m
    assert faults_kept_apart


def test_a_family_gives_the_same_system_every_time() -> None:
    assert FAMILIES[2].specimen(10) == FAMILIES[2].specimen(10)
    assert FAMILIES[2].specimen(10) != FAMILIES[4].specimen(10)


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.name)
def test_every_method_agrees_with_the_built_windows(method: Method, capsys: pytest.CaptureFixture[str]) -> None:
    if why := method.missing():
        pytest.skip(why)
    family = Family("invisible", "tight")
    system = family.specimen(4).to_json()
    if method.name in RUNNERS and method.name != "pari":  # PARI changes signal handlers: it gets a process
        RUNNERS[method.name](system)
        cell = read_lines(capsys.readouterr().out.splitlines(), system)
    else:
        cell = measure(method, system, QUICK)
    assert cell.outcome == "finished", cell.why
    assert tuple(cell.ranks[s] for s in range(1, 6)) == tuple(rank(window_matrix(system_of(family, 4), s)) for s in range(1, 6))


def test_a_method_over_the_limit_is_stopped_and_keeps_what_it_told() -> None:
    endless = "print('ready 0.0')\nprint('rank 1 2', flush=True)\nwhile True: pass"
    method = Method("endless", "never ends", sys.executable, lambda system: endless)
    cell = measure(method, FAMILIES[0].specimen(4).to_json(), Budget(seconds=0.3))
    assert cell.outcome == "limit"
    assert cell.ranks == {1: 2}
    assert 0 < cell.seconds < 5


def test_a_method_that_breaks_is_told_apart_from_one_without_memory() -> None:
    system = FAMILIES[0].specimen(4).to_json()
    for line, outcome in (("1 / 0", "failed"), ("raise MemoryError", "memory"), ("pass", "failed")):
        method = Method("broken", "breaks", sys.executable, lambda system, line=line: f"print('ready 0.0')\n{line}")  # type: ignore[misc]
        assert measure(method, system, QUICK).outcome == outcome


def made_up(cells: list[dict[str, Cell]]) -> Run:
    family = Family("planted", "wide")
    records = tuple(SystemCells(family, n, 8, 3, row) for n, row in zip((10, 20, 40, 80), cells, strict=False))
    return Run({"cores": "1", "ours": "1", "flint": "1"}, Budget(), {}, records)


def test_exponents_ratios_and_aims_are_computed_from_the_cells() -> None:
    ours = [Cell("finished", n**2 * 1e-6, {"produce": 0.0, "check": 0.0}, {1: 1}, 70.0) for n in (10, 20, 40, 80)]
    flint = [Cell("finished", n**3 * 1e-5, {}, {1: 1}) for n in (10, 20, 40)] + [Cell("limit", 1.0, {}, {1: 1})]
    run = made_up([{"ours": a, "flint": b} for a, b in zip(ours, flint, strict=True)])
    family = run.records[0].family
    for name, power in (("ours", 2), ("flint", 3)):
        slope = exponent(run, family, name)
        assert slope is not None and (slope.low, slope.value, slope.high) == pytest.approx((power, power, power))
    noisy = made_up([{"ours": Cell("finished", seconds, {}, {1: 1})} for seconds in (0.001, 0.004, 0.02, 0.06)])
    found, x = exponent(noisy, family, "ours"), [1, 2, 4, 8]
    wanted = linregress([log(n) for n in x], [log(seconds) for seconds in (0.001, 0.004, 0.02, 0.06)])
    assert found is not None and found.value == pytest.approx(wanted.slope)
    assert found.high - found.value == pytest.approx(wanted.stderr * 4.302652729749464)
    last = ratio(run.records[3], "flint")
    assert last is not None and last.at_least and last.value == pytest.approx(1.0 / 6.4e-3)
    assert [aim.met for aim in aims(run)] == [True, True]
    assert "> 156" in markdown(sheets(run), notes(run))


def test_a_wrong_rank_is_a_disagreement_even_when_the_method_was_stopped() -> None:
    good = Cell("finished", 1.0, {"produce": 0.5, "check": 0.5}, ranks_from_indices([1, 2], 3, 4))
    assert good.ranks == {1: 3, 2: 5, 3: 6, 4: 7}
    fine, wrong = Cell("limit", 1.0, {}, {1: 3}), Cell("limit", 1.0, {}, {1: 3, 2: 4})
    assert disagreements(made_up([{"ours": good, "flint": fine}])) == []
    assert len(disagreements(made_up([{"ours": good, "flint": wrong}]))) == 1
    assert len(disagreements(made_up([{"ours": good, "flint": Cell("failed", why="broken")}]))) == 1
