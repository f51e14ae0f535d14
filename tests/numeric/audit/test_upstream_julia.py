"""What goes to those who work in Julia: the reader of exported checks and the scripts, run where Julia is found.

Answers are those of our own reference, as they are or spoilt, handed to Julia as data.
"""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import FUNCTIONS
from faultspace.numeric.audit.checks.catalogue import chosen
from faultspace.numeric.audit.peers import JULIA
from faultspace.numeric.audit.records import Demand
from faultspace.numeric.audit.upstream.exporting import write_checks
from faultspace.numeric.audit.upstream.questions import question
from faultspace.numeric.audit.upstream.reproducing import script
from tests.numeric.audit.test_upstream import PART, SCRIPTED, run, spoilt


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A part of the checks stands there."""
    written = tmp_path_factory.mktemp("checks")
    write_checks(written, PART, lambda name, done, total: None)
    return written


pytestmark = pytest.mark.programs
julia = pytest.mark.skipif(shutil.which(JULIA[0]) is None, reason="Julia is not installed")

REPLAY = """
import JSON
answers = JSON.parsefile(joinpath(@__DIR__, "answers.json"))
function read_answer(x)
    x isa AbstractVector && return Any[read_answer(one) for one in x]
    x isa AbstractDict || return x
    haskey(x, "shape") && return reshape(Float64.(x["entries"]), Tuple(Int.(x["shape"])))
    haskey(x, "parts") && return Tuple(map(read_answer, x["parts"]))
    return haskey(x, "re") ? complex(x["re"], x["im"]) : Dict(k => read_answer(v) for (k, v) in x)
end
replayed(_...) = (x = popfirst!(answers); x === nothing ? error("refused") : read_answer(x))
identify = residual = window_ranks = fault_dimension = fault_space = reconstruct = structure = replayed
"""


def for_julia(answer: Any) -> Any:
    """What REPLAY reads an answer from."""
    if isinstance(answer, np.ndarray):
        return {"shape": answer.shape, "entries": answer.T.ravel().tolist()}
    if isinstance(answer, complex):
        return {"re": answer.real, "im": answer.imag}
    if isinstance(answer, tuple) and isinstance(answer[0], np.ndarray):
        return {"parts": [for_julia(one) for one in answer]}
    if isinstance(answer, (list, tuple)):
        return [for_julia(one) for one in answer]
    if isinstance(answer, dict):
        return {name: for_julia(one) for name, one in answer.items()}
    return for_julia(vars(answer)) if hasattr(answer, "normal_rank") else answer


@julia
def test_the_reader_in_julia_passes_what_is_right_and_fails_what_is_wrong(folder: Path, tmp_path: Path) -> None:
    if run(*JULIA, "-e", "import JSON", cwd=tmp_path).returncode != 0:
        pytest.skip("Julia has no package JSON")
    (tmp_path / "checks").mkdir()
    for file in (folder / "checks").glob("*--two-faults--fault_dimension.json"):
        shutil.copy(file, tmp_path / "checks")
    (tmp_path / "mine.jl").write_text('fault_dimension(r) = all(isfinite, r) ? 2 : error("no")\n', "utf-8")
    ran = run(*JULIA, str(folder / "read_checks.jl"), str(tmp_path), "mine.jl", cwd=tmp_path)
    failed = [line for line in ran.stdout.splitlines() if line.startswith("failed: ")]
    assert failed == ["failed: refuses-short-residual[two-faults]-fault_dimension"], ran.stdout + ran.stderr


@julia
@pytest.mark.slow
@pytest.mark.parametrize("wrong", [False, True])
def test_the_reader_in_julia_agrees_with_our_own_comparisons(folder: Path, tmp_path: Path, wrong: bool) -> None:
    """It is played the reference's answers, as they are or spoilt, one after the other: it passes all, and fails all that compare one."""
    if run(*JULIA, "-e", "import JSON", cwd=tmp_path).returncode != 0:
        pytest.skip("Julia has no package JSON")
    answers, due = list[Any](), set[str]()
    some = tmp_path / "some" / "checks"
    some.mkdir(parents=True)
    seen: dict[tuple[str, str, int], int] = {}
    for file in sorted((folder / "checks").iterdir()):
        one = json.loads(file.read_text("utf-8"))
        if one["demand"] == "free" or one["growth"] is not None or one["asks"] in ("count_faults", "identified_fault_space"):
            continue
        compares = one["demand"] == "must-hold" and one["manner"] is None and not one["may_refuse"]
        if wrong and not compares:
            continue
        key = (one["asks"], one["demand"], len(one["calls"]))
        seen[key] = seen.get(key, 0) + 1
        if seen[key] > 8:
            continue
        shutil.copy(file, some)
        due.add(one["name"])
        for called in one["calls"]:
            given = [as_given(side) for side in called["arguments"]]
            try:
                answer = getattr(reference, one["asks"])(*given)
                answers.append(for_julia(spoilt(answer) if wrong else answer))
            except (ValueError, ArithmeticError, TypeError):
                answers.append(None)
                break
            if wrong:
                break
    (tmp_path / "answers.json").write_text(json.dumps(answers), "utf-8")
    (tmp_path / "mine.jl").write_text(REPLAY, "utf-8")
    ran = run(*JULIA, str(folder / "read_checks.jl"), str(tmp_path / "some"), "mine.jl", cwd=tmp_path)
    failed = {line.removeprefix("failed: ") for line in ran.stdout.splitlines() if line.startswith("failed: ")}
    assert f"{len(due)} checks, {len(failed)} failed" in ran.stdout, ran.stdout + ran.stderr
    assert failed == (due if wrong else set()) and len(due) > 30


def as_given(side: Mapping[str, Any]) -> Any:
    """An argument as a reader in Python reads it."""
    words = {"NaN": np.nan, "Infinity": np.inf, "-Infinity": -np.inf}

    def number(x: Any) -> Any:
        return [number(one) for one in x] if isinstance(x, list) else words.get(x, x) if isinstance(x, str) else x

    found = number(side["floats"])
    return found if side["shape"] is None else np.array(found, dtype=float).reshape(side["shape"])


def _in_julia(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, np.ndarray):
        return f"reshape(Float64[{', '.join(map(repr, map(float, value.T.ravel())))}], {value.shape})"
    if isinstance(value, complex):
        return f"complex({value.real!r}, {value.imag!r})"
    if isinstance(value, tuple) and isinstance(value[0], np.ndarray):
        return f"({', '.join(map(_in_julia, value))})"
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(_in_julia, value))}]"
    fields = value if isinstance(value, dict) else vars(value) if hasattr(value, "normal_rank") else None
    return repr(value) if fields is None else f"({', '.join(f'{name} = {_in_julia(one)}' for name, one in fields.items())})"


@julia
@pytest.mark.slow
def test_scripts_in_julia_say_right_of_what_is_right_and_wrong_of_what_is_wrong(tmp_path: Path) -> None:
    """All run in one process, each in a module of its own: Julia takes long to start."""
    cases, due = list[str](), list[int]()

    def case(name: str, answers: str, code: int) -> None:
        """Answers are values in Julia, one a call."""
        check = next(iter(chosen(FUNCTIONS, [name])))
        text = re.sub(r"\bexit\((.*?)\)( end)?$", r"throw(Main.Ended(\1))\2", script(name, FUNCTIONS, "julia"), flags=re.MULTILINE)
        place = tmp_path / f"case{len(cases)}.jl"
        place.write_text(f"answers = Any[{answers}]\n{check.function}(given...) = popfirst!(answers)()\n{text}", "utf-8")
        cases.append(f'    ("{name}", "{place}")')
        due.append(code)

    for name in SCRIPTED:
        (check,) = chosen(FUNCTIONS, [name])
        asked = question(check).calls
        if check.kind is Demand.MUST_REFUSE:
            case(name, '() -> error("no")', 0)
            case(name, "() -> (zeros(2, 2), zeros(2, 2), zeros(2, 2), zeros(2, 2))", 1)
            continue
        found = [getattr(reference, check.function)(*(one.value for one in call_.arguments)) for call_ in asked]
        found += found[:1] * (check.slug == "deterministic")
        case(name, ", ".join(f"() -> {_in_julia(one)}" for one in found), 0)
        wrong = [found[0], spoilt(found[0])] if check.slug == "deterministic" else [spoilt(one) for one in found]
        case(name, ", ".join(f"() -> {_in_julia(one)}" for one in wrong), 1)
        if check.slug != "deterministic":
            case(name, '() -> error("no")', 1)
    case("inputs-untouched[one-fault]-fault_dimension", "() -> 1", 0)
    case("inputs-untouched[one-fault]-fault_dimension", "() -> (Main.at[].r[1, 1] = 7.0; 1)", 1)
    lines = ["struct Ended <: Exception; code; end", "const at = Ref{Module}()", "for (name, place) in [", ",\n".join(cases), "]"]
    lines += [
        "    code = try (m = Module(); at[] = m; Core.eval(m, :(include(path) = Base.include($m, path))); Base.include(m, place); nothing)"
    ]
    lines += ["    catch problem", "        while problem isa LoadError; problem = problem.error; end"]
    lines += [
        "        problem isa Ended ? Int(problem.code) : sprint(showerror, problem)",
        "    end",
        '    println("ended ", name, ": ", code)',
        "end",
    ]
    (tmp_path / "all.jl").write_text("\n".join(lines) + "\n", "utf-8")
    ran = run(*JULIA, "all.jl", cwd=tmp_path)
    parts = re.split(r"^ended .*: (.*)$", ran.stdout, flags=re.MULTILINE)
    assert parts[1::2] == [str(one) for one in due], ran.stdout[-3000:] + ran.stderr
    assert [("WRONG" in one) for one in parts[:-1:2]] == [bool(one) for one in due]
