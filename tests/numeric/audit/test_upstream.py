"""What goes to those who do not have faultspace: files that a schema and readers know, and scripts that show a failure.

Implementations that were written from the pages alone take the place of somebody's code; a part of the checks takes the place of all.
"""

from __future__ import annotations

import contextlib
import copy
import hashlib
import importlib.util
import io
import json
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator, Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest

from faultspace.base.errors import InvalidData
from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import FUNCTIONS
from faultspace.numeric.audit.checks.catalogue import all_checks, chosen
from faultspace.numeric.audit.records import Check, Demand, Refused
from faultspace.numeric.audit.upstream.exporting import MANNERS, document, file_name, write_checks
from faultspace.numeric.audit.upstream.languages import LANGUAGES
from faultspace.numeric.audit.upstream.questions import GROWS, LONGEST, question
from faultspace.numeric.audit.upstream.reproducing import script
from tests.end_to_end.commands import call
from tests.thorough import every

HERE = Path(__file__).parent
READERS = Path(__file__).resolve().parents[3] / "numeric" / "audit" / "upstream" / "readers"
PART = (
    "*[n2-u2-p2-at-rest]*",
    "*[n1-u2-p1]*",
    "*[two-faults]*",
    "*[square-proper]*",
    *("refuses-nan-*", "refuses-infin*", "refuses-un*", "refuses-window*", "refuses-impossible*"),
    *("refuses-misfit[two-faults-*]-structure", "refuses-no-number[n3-u2-p2*"),
)
OCTAVE = ("octave-cli", "--no-gui", "--quiet", "--norc")
LONG = ("noisy", "coloured", "faults-of-record", "space-of-record")  # records that take seconds to draw or to identify


def firsts() -> list[Check]:
    """There is one check of each slug and function, but for those with long records, of what is kept by many of which one will do."""
    found: dict[tuple[str, str], Check] = {}
    for check in all_checks():
        if check.slug == "forgets-the-records" and check.function != "structure":
            continue
        if not any(word in check.slug for word in LONG) and check.function not in ("count_faults", "identified_fault_space"):
            found.setdefault((check.slug, check.function), check)
    return list(found.values())


FIRSTS = firsts()
# What a process has one of, and long records: no script shows them, the audit does.
UNSCRIPTED = set(MANNERS) - {"deterministic", "inputs-untouched"}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A part of the checks stands there."""
    written = tmp_path_factory.mktemp("checks")
    assert write_checks(written, PART, lambda name, done, total: None) == len(chosen(FUNCTIONS, PART)) > 100
    return written


def read(folder: Path) -> Iterator[dict[str, Any]]:
    for file in sorted((folder / "checks").iterdir()):
        yield json.loads(file.read_text("utf-8"))


def begun(value: Any) -> Any:
    """Return a document with the first rows of its arrays, whose numbers are looked at one by one, and are alike."""
    if isinstance(value, dict):
        return {name: begun(one) for name, one in value.items()}
    return [begun(one) for one in value[:5]] if isinstance(value, list) else value


def test_every_file_keeps_the_schema_and_the_schema_refuses_others(folder: Path) -> None:
    schema = json.loads((folder / "schema.json").read_text("utf-8"))
    validator = jsonschema.Draft202012Validator(schema)
    documents = list(map(begun, read(folder)))
    for one in documents:
        validator.validate(one)
        assert len(one["recipe"]) > 20 and one["effect"]
    wrong: tuple[dict[str, Any], ...] = ({"demand": "may-hold"}, {"recipe": ""}, {"calls": [{"arguments": []}]}, {"extra": 1})
    for change in wrong:
        with pytest.raises(jsonschema.ValidationError):
            validator.validate({**documents[0], **change})


def test_checksums_are_of_every_file(folder: Path) -> None:
    lines = (folder / "SHA256SUMS").read_text("utf-8").splitlines()
    sums = {name: digest for digest, name in (line.split("  ") for line in lines)}
    files = {str(one.relative_to(folder)) for one in folder.rglob("*") if one.is_file()} - {"SHA256SUMS"}
    assert set(sums) == files
    assert all(hashlib.sha256((folder / name).read_bytes()).hexdigest() == digest for name, digest in sums.items())


def test_floats_are_the_rationals_beside_them_rounded_once(folder: Path) -> None:
    seen = 0

    def compared(floats: Any, rationals: Any) -> None:
        nonlocal seen
        if isinstance(floats, list):
            for pair in zip(floats, rationals, strict=True):
                compared(*pair)
        elif isinstance(floats, (int, float)) and not isinstance(floats, bool):
            exact = Fraction(rationals)
            assert exact.numerator / exact.denominator == floats
            seen += 1

    for one in read(folder):
        for called in one["calls"]:
            for side in [*called["arguments"], *called["expected"]]:
                if side["rationals"] is not None:
                    compared(side["floats"], side["rationals"])
    assert seen > 10000


def test_rationals_are_there_wherever_a_record_is_short() -> None:
    lacking = [
        (check.full_name, one.name)
        for check in FIRSTS[:: every()]
        if check.slug not in GROWS
        for called in question(check).calls
        for one in called.arguments
        if isinstance(one.value, np.ndarray) and one.exact is None and len(one.value) <= LONGEST
    ]
    assert lacking == []


def as_floats(value: Any) -> Any:
    """Whatever kind of numbers an array is of."""
    return np.asarray(value, dtype=float)


@pytest.mark.parametrize("check", [one for one in FIRSTS if one.slug not in GROWS][1 :: every()], ids=lambda one: one.full_name)
def test_what_is_asked_is_what_the_check_asks_and_what_is_due_does_not_depend_on_the_answer(check: Check) -> None:
    """The obvious twin: our own reference in place of the stand-in."""
    heard: list[tuple[Any, ...]] = []

    def asked(*arguments: Any) -> Any:
        heard.append(copy.deepcopy(arguments))
        try:
            answer = getattr(reference, check.function)(*arguments)
        except (ValueError, ArithmeticError, TypeError) as error:
            raise Refused(str(error)) from error
        if answer is None:
            raise Refused("undecided")
        return answer

    sides = []
    with contextlib.suppress(Refused):
        sides = [one.sides for one in check.measure(asked) if one.sides is not None and one.sides.of not in ("dimension", "residual")]
    found = question(check)
    assert len(found.calls) == len(heard)
    for call_, arguments in zip(found.calls, heard, strict=True):
        assert all(
            np.array_equal(as_floats(one.value), as_floats(given), equal_nan=True)
            for one, given in zip(call_.arguments, arguments, strict=True)
        )
    due = {(one.sides.of, str(one.sides.truth), str(one.sides.bounds)) for call_ in found.calls for one in call_.due}
    assert {(one.of, str(one.truth), str(one.bounds)) for one in sides} <= due
    assert due or check.kind is Demand.MUST_REFUSE or found.measured


def test_every_check_says_how_it_is_compared() -> None:
    documents = [document(check) for check in FIRSTS[:: every()]]
    assert [one["name"] for one in documents if len(one["recipe"]) < 20] == []
    unknown = {one["manner"] for one in documents} - {None, *MANNERS}
    assert unknown == set(), "give each a text in upstream/recipes.py"
    assert len({file_name(one) for one in all_checks()}) == len(list(all_checks()))


def test_growth_is_a_recipe_that_gives_the_record() -> None:
    from faultspace.numeric.audit.checks.growth import question as grown

    (check,) = (one for one in all_checks() if one.slug == "time-grows-with-N" and one.function == "window_ranks")
    growth = document(check)["growth"]
    A, B, C, D = ([[float(Fraction(x)) for x in row] for row in growth["system"][name]] for name in "ABCD")
    state, drawn, length = int(growth["signs"].split(" from ")[1].split(";")[0]), list[float](), 50
    for _ in range(length * len(B[0])):
        state = (6364136223846793005 * state + 1442695040888963407) % 2**64
        drawn.append(1.0 if state >> 63 else -1.0)
    signs = np.array(drawn).reshape(len(B[0]), length).T
    x, out = np.zeros(len(A)), []
    for w in signs:
        out.append(np.array(C) @ x + np.array(D) @ w)
        x = np.array(A) @ x + np.array(B) @ w
    r, windows = grown("window_ranks", length)
    assert np.allclose(out, r, rtol=0, atol=1e-12 * np.max(np.abs(r))) and growth["other_arguments"] == {"windows": windows}


# -- readers -----------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["read_checks.py", "read_checks.m", "read_checks.jl"])
def test_a_reader_has_at_most_60_lines_and_needs_nothing_of_ours(name: str) -> None:
    text = (READERS / name).read_text("utf-8")
    assert len(text.splitlines()) <= 60 and "faultspace" not in text


def run(*command: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True, timeout=280, check=False)


def without_ours(python: str, folder: Path, file: Path) -> subprocess.CompletedProcess[str]:
    """Run the reader in Python, isolated from this tree."""
    return run(python, "-I", "read_checks.py", ".", str(file), cwd=folder)


def test_the_reader_in_python_passes_an_independent_implementation_and_fails_a_broken_one(folder: Path, tmp_path: Path) -> None:
    minimal = HERE / "independent" / "other.py"
    right = without_ours(sys.executable, folder, minimal)
    assert right.returncode == 0, right.stdout + right.stderr
    asked = int(right.stdout.split(" checks, 0 failed")[0].split()[-1])
    assert asked > 100
    broken = tmp_path / "broken.py"
    spoiling = "\n\nkept = identify\ndef identify(*a):\n    A, B, C, D = kept(*a)\n    return A, B, C, D + 1e-6\n"
    broken.write_text(minimal.read_text("utf-8") + spoiling, "utf-8")
    wrong = without_ours(sys.executable, folder, broken)
    assert wrong.returncode == 1 and "failed: exact-recovery[n2-u2-p2-at-rest]-identify" in wrong.stdout
    assert "-window_ranks" not in wrong.stdout


def test_the_reader_in_python_agrees_with_our_own_comparisons(folder: Path) -> None:
    """The reference passes all of them; with each answer spoilt it fails all that compare one."""
    spec = importlib.util.spec_from_file_location("read_checks", READERS / "read_checks.py")
    assert spec is not None and spec.loader is not None
    reader: Any = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(reader)
    compared = 0
    for one in read(folder):
        if one["demand"] == "free" or one["growth"] is not None or one["asks"] in ("count_faults", "identified_fault_space"):
            continue
        function = getattr(reference, one["asks"])
        assert reader.passes(one, function), one["name"]
        if one["demand"] == "must-hold" and one["manner"] is None and not one["may_refuse"]:
            compared += 1
            assert not reader.passes(one, lambda *given, function=function: spoilt(function(*given))), one["name"]
    assert compared > 50


def spoilt_by_one(answer: Any) -> Any:
    return tuple(one + 1 for one in answer)


def spoilt(answer: Any) -> Any:
    """It is a thousandth off, or one where numbers are whole; nothing of it is right."""
    if isinstance(answer, tuple) and isinstance(answer[0], np.ndarray):
        return tuple(spoilt(one) for one in answer)
    if isinstance(answer, np.ndarray):
        return answer + 1e-3 * (np.max(np.abs(answer), initial=0.0) + 1.0) * (1 + np.arange(answer.size).reshape(answer.shape) % 2)
    if isinstance(answer, (tuple, list)):
        return [one + 1 for one in answer]
    if isinstance(answer, int):
        return answer + 1
    return {
        "normal_rank": answer.normal_rank + 1,
        "left_invertible": not answer.left_invertible,
        "finite_zeros": [*answer.finite_zeros, 7.0],
        "infinite_zero_orders": [*answer.infinite_zero_orders, 1],
    }


octave = pytest.mark.skipif(shutil.which(OCTAVE[0]) is None, reason="GNU Octave is not installed")


@pytest.mark.programs
@octave
def test_the_reader_in_octave_passes_a_minimal_implementation_and_fails_a_broken_one(folder: Path) -> None:
    ran = f"addpath('{HERE / 'minimal'}'); mine = minimal();"
    right = run(*OCTAVE, "--eval", f"{ran} exit(numel(read_checks('.', mine)));", cwd=folder)
    assert right.returncode == 0 and " 0 failed" in right.stdout, right.stdout + right.stderr
    assert int(right.stdout.split(" checks, 0 failed")[0].split()[-1]) > 40
    broken = f"{ran} f = mine.fault_dimension; mine = struct('fault_dimension', @(r) f(r) + 1); read_checks('.', mine);"
    wrong = run(*OCTAVE, "--eval", broken, cwd=folder)
    assert "failed: fault-dimension[two-faults]-fault_dimension" in wrong.stdout


@pytest.mark.skipif(shutil.which("matlab") is None, reason="MATLAB is not installed")
def test_the_reader_in_matlab_passes_a_minimal_implementation(folder: Path) -> None:
    batch = f"addpath('{HERE / 'minimal'}'); exit(numel(read_checks('.', minimal())));"
    assert run("matlab", "-batch", batch, cwd=folder).returncode == 0


# -- scripts -----------------------------------------------------------------------------------------------------------------------


def executed(text: str, replacing: Mapping[str, Any] | None = None) -> tuple[int, str]:
    """Run a script in Python here, with other functions in place of what it imports, and return its code and what it printed."""
    head, _, rest = text.partition("# -- the question\n")
    names: dict[str, Any] = {"__name__": "script"}
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        try:
            exec(compile(head, "head", "exec"), names)
            names |= replacing or {}
            exec(compile(rest, "script", "exec"), names)
        except SystemExit as ended:
            if isinstance(ended.code, str):
                print(ended.code)
            return (int(ended.code) if isinstance(ended.code, int) else 1), said.getvalue()
        except Exception as error:  # an interpreter shows it, and ends with 1
            return 1, f"{said.getvalue()}{type(error).__name__}: {error}"
    raise AssertionError("a script ends with a code")


@pytest.mark.parametrize("check", [one for one in FIRSTS if one.slug not in GROWS][:: every()], ids=lambda one: one.full_name)
def test_a_script_in_python_says_right_of_what_is_right_and_wrong_of_what_is_wrong(check: Check) -> None:
    long_model = (check.slug, check.function) == ("right-on-long-records", "identify")
    if check.slug in UNSCRIPTED and not long_model and not any(call_.due for call_ in question(check).calls):
        with pytest.raises(InvalidData, match="no script of it"):
            script(check.full_name, FUNCTIONS, "python")
        return
    text = script(check.full_name, FUNCTIONS, "python")
    if check.slug == "form-objects":  # where the audit takes a TypeError for a refusal, a script shows it
        code, said = executed(text)
        assert code == 0 or "TypeError" in said
        return
    assert executed(text)[0] == 0
    if check.kind is Demand.MUST_REFUSE:
        code, said = executed(text, {check.function: lambda *given: 1})
        assert code == 1 and "WRONG" in said
    elif check.kind is Demand.MUST_HOLD and check.slug not in ("deterministic", "inputs-untouched"):
        function = getattr(reference, check.function)
        # Of a long record whole numbers are asked, within a half.
        wrong = spoilt_by_one if long_model else spoilt
        code, said = executed(text, {check.function: lambda *given: wrong(function(*given))})
        refused = said.startswith("refused") and question(check).may_refuse  # where to refuse is an answer, ours does
        assert code == int(not refused)
        assert refused or ("got" in said and "expected" in said)


def test_scripts_of_manners_and_growth_notice_what_they_are_for() -> None:
    calls = iter(range(10))
    text = script("deterministic[one-fault]-fault_dimension", FUNCTIONS, "python")
    assert executed(text, {"fault_dimension": lambda r: next(calls)})[0] == 1

    def writing(r: Any) -> int:
        r[0, 0] = 7.0
        return 1

    text = script("inputs-untouched[one-fault]-fault_dimension", FUNCTIONS, "python")
    assert executed(text, {"fault_dimension": writing})[0] == 1
    text = script("memory-grows-with-N*-fault_dimension", FUNCTIONS, "python")
    assert executed(text, {"fault_dimension": lambda r: float(np.sum(np.ones((len(r), len(r)), dtype=np.int8)))})[0] == 1
    assert executed(text, {"fault_dimension": lambda r: 1})[0] == 0
    with pytest.raises(InvalidData, match="Python alone"):
        script("memory-grows-with-N*-fault_dimension", FUNCTIONS, "octave")


def _literal(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return "[" + "; ".join(" ".join(repr(float(x)) for x in row) for row in np.atleast_2d(value)) + "]"
    if isinstance(value, complex):
        return f"complex({value.real!r}, {value.imag!r})"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_literal, value)) + "]" if value else "zeros(0, 1)"
    return str(value).lower()


def _octave_function(name: str, answer: Any) -> str:
    """Return a function in Octave that gives this answer, whatever it is asked."""
    if name == "structure":
        fields = [f"answer.{key} = {_literal(value)};" for key, value in vars(answer).items()]
        return f"function answer = {name}(varargin)\n  {' '.join(fields)}\nend\n"
    if name == "identify":
        parts = " ".join(f"{key} = {_literal(value)};" for key, value in zip("ABCD", answer, strict=True))
        return f"function [A, B, C, D] = {name}(varargin)\n  {parts}\nend\n"
    return f"function answer = {name}(varargin)\n  answer = {_literal(answer)};\nend\n"


SCRIPTED = (
    *("exact-recovery[n2-u2-p2-at-rest]-identify", "residual-free-of-input[two-faults]-residual", "window-ranks[two-faults]-window_ranks"),
    *("fault-dimension[two-faults]-fault_dimension", "fault-space[two-faults]-fault_space", "fault-signal[two-faults]-reconstruct"),
    *("normal-rank[square-proper]-structure", "infinite-zeros[square-proper]-structure", "finite-zeros[square-proper]-structure"),
    *("refuses-nan-output[n3-u2-p2]-identify", "deterministic[n2-u1-p1]-identify"),
)


def _ours(check: Check) -> Any:
    """Return what our own code answers, or None where it refuses, as it must or may."""
    try:
        arguments = [one.value for one in question(check).calls[0].arguments]
        return None if check.kind is Demand.MUST_REFUSE else getattr(reference, check.function)(*arguments)
    except InvalidData:
        return None


@pytest.mark.programs
@octave
@pytest.mark.parametrize("name", SCRIPTED)
def test_a_script_in_octave_says_right_of_what_is_right_and_wrong_of_what_is_wrong(name: str, tmp_path: Path) -> None:
    (check,) = chosen(FUNCTIONS, [name])
    (tmp_path / "bug.m").write_text(script(name, FUNCTIONS, "octave"), "utf-8")
    answer = _ours(check)
    if answer is None:
        right = f"function [A, B, C, D] = {check.function}(varargin)\n  error('no');\nend\n"
        wrong = _octave_function("identify", (np.eye(2),) * 4)
    else:
        spoilt_answer = spoilt(answer)
        if isinstance(spoilt_answer, dict):
            spoilt_answer = type(answer)(**spoilt_answer)
        right, wrong = (_octave_function(check.function, one) for one in (answer, spoilt_answer))
    cases = [(right, 0)] if check.slug == "deterministic" else [(right, 0), (wrong, 1)]
    for text, code in cases:
        (tmp_path / f"{check.function}.m").write_text(text, "utf-8")
        ran = run(*OCTAVE, "bug.m", cwd=tmp_path)
        assert ran.returncode == code and ("WRONG" in ran.stdout) == bool(code), ran.stdout + ran.stderr


OCTAVE_ALONE = re.compile(
    r"\bend(if|for|while|function|switch)\b|\bend_try_catch\b|\bunwind_protect\b|\bprintf\b|\buntil\b|#|\+=|-=|\*\*|!|\"|\)\("
)


def matlab_too(text: str) -> list[str]:
    """Return what of a text, strings and comments aside, only Octave understands, as far as these words and signs tell."""
    code = re.sub(r"%[^\n]*", "", re.sub(r"(?<![\w)\]}.'])'[^'\n]*'", "''", text))
    return [one.group() for one in OCTAVE_ALONE.finditer(code)]


@pytest.mark.parametrize("name", SCRIPTED)
def test_a_script_for_matlab_is_the_one_that_octave_runs(name: str) -> None:
    """There is no MATLAB where this was made: what the two share is run in Octave, and the texts have nothing of Octave alone."""
    matlab, octave_text = (script(name, FUNCTIONS, language).splitlines() for language in ("matlab", "octave"))
    differ = [(one, other) for one, other in zip(matlab, octave_text, strict=True) if one != other]
    assert all(one.startswith("%") and other.startswith("%") for one, other in differ) and len(differ) <= 2
    assert matlab_too("\n".join(matlab)) == []


def test_the_reader_for_matlab_is_the_one_that_octave_runs() -> None:
    assert matlab_too((READERS / "read_checks.m").read_text("utf-8")) == []
    assert matlab_too('if a != b, printf("d", a); endif # no\n') == ["!", "printf", '"', '"', "endif", "#"]


@pytest.mark.parametrize("language", sorted(LANGUAGES))
def test_a_script_holds_its_data_and_says_what_it_shows(language: str) -> None:
    text = script("fault-space[two-faults]", FUNCTIONS, language)
    assert "fault-space[two-faults]-fault_space" in text and "import faultspace" not in text.split("-- the question")[1]
    (check,) = chosen(FUNCTIONS, ["fault-space[two-faults]"])
    r = question(check).calls[0].arguments[0].value
    assert all(repr(float(x)) in text for x in r.ravel())


def test_the_command_prints_a_script_that_imports_the_adapter(tmp_path: Path) -> None:
    mine = tmp_path / "mine.py"
    mine.write_text("class Mine:\n    def fault_dimension(self, r):\n        return 1\n", "utf-8")
    printed = call("audit", f"{mine}:Mine", "--reproduce", "fault-dimension[two-faults]")
    assert printed.code == 0 and "from mine import Mine" in printed.out
    code, said = executed(printed.out)
    assert code == 1 and "WRONG" in said
    refusing = printed.out.replace("from mine import Mine", "Mine = type('Mine', (), {'fault_dimension': lambda self, r: None})")
    assert executed(refusing)[0] == 1 and "WRONG: an answer is due" in executed(refusing)[1]
    unknown = call("audit", f"{mine}:Mine", "--reproduce", "exact-recovery")
    assert unknown.code == 2 and "exact-recovery" in unknown.err and unknown.out == ""
