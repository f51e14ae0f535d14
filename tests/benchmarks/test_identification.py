"""The identification benchmark measures what it says: records are as described, errors are errors, limits hold, aims are judged right."""

import sys
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from benchmarks.identification_bounds import Rates, bound, exponent, flops
from benchmarks.identification_cells import RESULT, Cell, measure
from benchmarks.identification_data import FAULT_POLE, ORDER, POLES, Setting, errors, read, record, system, write
from benchmarks.identification_methods import METHODS, PREPARATIONS, Method
from benchmarks.identification_run import OURS, Run, aims
from benchmarks.identification_study import Comparison, sections
from benchmarks.identification_tables import MODELS, notes, sheets
from benchmarks.sheets import markdown
from faultspace.base.processes import Limits
from faultspace.numeric.method.model.models import StateSpaceModel

SETTING = Setting(2, 3, 5, 20_000)
NOISY = replace(SETTING, noise=0.01)
QUICK = Limits(seconds=60, memory=6000 << 20)
PEERS = [method for method in METHODS if method.needs and method.name not in ("fault-id", "nfoursid")]


def test_the_fault_is_as_strong_as_the_input_and_coloured() -> None:
    y, u = record(SETTING)
    true = system(SETTING.n_u, SETTING.p)
    driven = true.from_input.simulate(u)
    faulty = y - driven
    assert np.sqrt(np.mean(faulty**2)) == pytest.approx(np.sqrt(np.mean(driven**2)), rel=1e-9)
    # G v is v filtered by the fault's pole and the poles of A: far from white.
    assert np.mean(faulty[1:] * faulty[:-1]) > 0.3 * np.mean(faulty**2)
    assert sorted(true.from_input.poles, key=str) == pytest.approx(sorted(map(complex, POLES), key=str))
    assert 0 < FAULT_POLE < 1


def test_the_noise_is_40_decibel_below_and_equal_settings_give_equal_records() -> None:
    clean, noisy = record(SETTING)[0], record(NOISY)[0]
    driven = system(SETTING.n_u, SETTING.p).from_input.simulate(record(SETTING)[1])
    assert np.std(noisy - clean) == pytest.approx(0.01 * np.sqrt(np.mean(driven**2)), rel=0.02)
    assert np.array_equal(record(NOISY)[0], noisy)


def test_a_record_is_read_as_it_was_written(tmp_path: Path) -> None:
    write(NOISY, tmp_path)
    setting, y, u = read(tmp_path)
    assert setting == NOISY
    assert np.array_equal(y, record(NOISY)[0])
    assert np.array_equal(u, record(NOISY)[1])


def test_errors_do_not_see_coordinates_and_see_changes() -> None:
    true = system(2, 3).from_input
    T = np.random.default_rng(3).standard_normal((ORDER, ORDER))
    turned = StateSpaceModel(T @ true.A @ np.linalg.inv(T), T @ true.B, true.C @ np.linalg.inv(T), true.D)
    assert max(errors(turned, 2, 3)) < 1e-9
    wrong_D = StateSpaceModel(true.A, true.B, true.C, true.D + 1)
    assert errors(wrong_D, 2, 3)[0] < 1e-9 < 0.1 < errors(wrong_D, 2, 3)[1]
    slower = StateSpaceModel(0.9 * true.A, true.B, true.C, true.D)
    assert errors(slower, 2, 3)[0] == pytest.approx(0.1 * max(map(abs, POLES)), rel=1e-6)


# The other routes of compression are tried daily in `tests/numeric/test_compression.py`.
@pytest.mark.parametrize("name", [pytest.param(name, marks=pytest.mark.slow if name in ("ours-gram", "ours-qr") else ()) for name in OURS])
def test_ours_finish_with_little_memory_and_the_right_model(name: str, tmp_path: Path) -> None:
    method = next(each for each in METHODS if each.name == name)
    write(SETTING, tmp_path)
    cell = measure(method.command(SETTING, None), SETTING, tmp_path, QUICK)
    assert cell.outcome == "finished", cell.why
    assert cell.seconds > 0 and not cell.changed, cell
    if cell.megabytes is not None:
        assert cell.megabytes < 64
    assert (cell.eigenvalue_error is not None) == (name in MODELS)
    if cell.eigenvalue_error is not None and cell.markov_error is not None:
        assert cell.eigenvalue_error < 0.1 and cell.markov_error < 0.1


@pytest.mark.parametrize("method", PEERS, ids=lambda method: method.name)
def test_every_peer_that_is_installed_answers(method: Method, tmp_path: Path) -> None:
    if why := method.missing(None):
        pytest.skip(why)
    one = Setting(1, 1, 10, 5000)
    write(one, tmp_path)
    cell = measure(method.command(one, None), one, tmp_path, QUICK)
    assert cell.outcome == "finished", cell.why
    assert (cell.markov_error is not None) == (method.gives == "model")
    if cell.markov_error is not None:
        assert cell.markov_error < 1  # biased, but of this system


def test_every_python_method_has_its_preparation() -> None:
    assert {method.name for method in METHODS if method.needs != "octave"} == set(PREPARATIONS)


def test_a_cell_is_stopped_at_the_limits_and_failures_are_told(tmp_path: Path) -> None:
    def cell(code: str) -> Cell:
        return measure([sys.executable, "-c", code], SETTING, tmp_path, Limits(seconds=1, memory=500 << 20))

    assert cell("while True: pass").outcome == "limit"
    assert cell("x = bytearray(2**30)").outcome == "memory"
    failed = cell("raise ValueError('no such window')")
    assert failed.outcome == "failed" and "no such window" in failed.why
    assert cell("print('something else')").outcome == "failed"
    finished = cell(f"print('{RESULT}' + '{{\"seconds\": 2.5}}')")
    assert (finished.outcome, finished.seconds, finished.megabytes) == ("finished", 2.5, None)
    unusable = cell(f'print(\'{RESULT}\' + \'{{"seconds": 1, "A": [[NaN]], "B": [[1]], "C": [[1]], "D": [[1]]}}\')')
    assert unusable.outcome == "failed" and "NaN" in unusable.why


def test_flops_and_exponents() -> None:
    # 4 lags of 2 x 2 correlations, a multiplication and an addition each; a Hankel matrix of 6 rows.
    small = Setting(1, 1, 2, 1000)
    assert flops("ours-gram", small) == 2 * 1000 * 4 * 4
    assert flops("ours-qr", small) == 2 * flops("plain Gram", small) == 2 * 1000 * 36
    assert bound("ours-qr", small, Rates(1e9, 1e3)) == pytest.approx(72e-6)
    assert exponent([(x, 3 * x**1.7) for x in (1.0, 2.0, 4.0, 9.0)]) == pytest.approx(1.7)
    assert exponent([(1.0, 1.0), (2.0, 2.0)]) is None


def run_of(setting: Setting, cells: dict[str, Cell], study: Comparison | None = None) -> Run:
    everything = {method.name: Cell("failed", why="x") for method in METHODS} | cells
    return Run(
        {}, Limits(), {}, {"sippy": "the Python package sippy_unipi is not installed"}, {setting: everything}, {}, Rates(1e9, 1e9), study
    )


def done(seconds: float, megabytes: float = 1.0) -> Cell:
    return Cell("finished", seconds, megabytes)


@pytest.mark.parametrize(("peer", "met"), [(11.0, True), (9.0, False)])
def test_the_fastest_peer_of_the_same_kind_counts(peer: float, met: bool) -> None:
    big = Setting(2, 3, 20, 1000)
    cells = {"ours": done(1.0), "ours-gram": done(0.1), "moen4": done(peer), "fault-id": done(50.0), "ctrlsys-C": done(0.5)}
    found = {aim.words.split(": ")[1]: aim.met for aim in aims(run_of(big, cells), MODELS)}
    assert found["model 10 times faster than the fastest peer"] is met
    assert found["factor 10 times faster than the fastest peer"] is False


@pytest.mark.parametrize(("megabytes", "met"), [(63.0, True), (65.0, False)])
def test_memory_the_bounds_and_the_cholesky_are_judged(megabytes: float, met: bool) -> None:
    big, small = Setting(2, 3, 20, 1000), Setting(1, 1, 10, 1000)
    least = bound("ours-qr", big, Rates(1e9, 1e9))
    found = aims(run_of(big, {"ours": done(1.0, megabytes), "ours-qr": done(3.9 * least)}), MODELS)
    assert [aim.met for aim in found if "memory" in aim.words] == [met]
    assert [aim.met for aim in found if "ours-qr within" in aim.words] == [True]
    cells = {"ours": done(2.0), "ours-gram": done(1.0), "ours-moesp": done(1.2), "ctrlsys-C": done(1.1), "ctrlsys": done(3.0)}
    found = aims(run_of(small, cells), MODELS)
    assert [aim.met for aim in found if "no slower" in aim.words] == [True, False, True]


def test_the_study_is_judged_and_absent_peers_have_a_row() -> None:
    study = Comparison(ours=0.4, error=0.5, author=4.0, author_error=0.7)
    run = run_of(SETTING, {"ours": done(1.0)}, study)
    assert [aim.met for aim in aims(run, MODELS) if "study" in aim.words] == [False]
    text = markdown(sheets(run), notes(run))
    assert any(line.startswith("| sippy ") and "not installed" in line for line in text.splitlines())


def test_the_code_of_a_live_script_is_read_without_its_text(tmp_path: Path) -> None:
    space = 'xmlns:w="http://schemas.openxmlformats.org/wordprocessingml/2006/main"'
    paragraph = '<w:p><w:pPr><w:pStyle w:val="{}"/></w:pPr><w:r><w:t><![CDATA[{}]]></w:t></w:r></w:p>'
    body = paragraph.format("text", "words") + paragraph.format("code", "a = 1 < 2;") + paragraph.format("code", "b = 3;")
    with zipfile.ZipFile(tmp_path / "x.mlx", "w") as archive:
        archive.writestr("matlab/document.xml", f"<w:document {space}><w:body>{body}</w:body></w:document>")
    assert sections(tmp_path / "x.mlx") == ["a = 1 < 2;", "b = 3;"]
