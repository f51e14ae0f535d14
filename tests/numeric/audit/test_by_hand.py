"""What was found by hand is found again: the lines of by_hand.md print what stands behind them, where their package is installed.

shown    (the line, what it prints) of a block: the words of its comment as far as the first that is no number, of Octave as of Python
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest

from faultspace.numeric.audit.peers import FAULT_ID
from tests.house.test_blocks import ROOT, Block, blocks

PAGE = ROOT / "numeric" / "audit" / "peers" / "by_hand.md"
FOUND = [one for one in blocks(PAGE.read_text("utf-8")) if not one.reason]
NUMBERS = re.compile(r"^[-+\d.e\s\[\],]+")
OF_FAULT_ID = ("estimate_input_matrices", "dist_subspaces")


def shown(block: Block) -> list[tuple[str, list[str]]]:
    parts = [re.split(r"\s{2,}[#%] ", line) for line in block.text.splitlines()]
    return [(line, re.findall(r"-?\d+\.?\d*", NUMBERS.match(told)[0])) for line, told in parts]  # type: ignore[index]


def agree(printed: list[float], told: list[str]) -> bool:
    """To half a unit of the last digit behind the point that the page has; whole numbers are as they stand."""
    places = [len(one.partition(".")[2]) for one in told]
    near = [abs(a - float(b)) <= (0.5 * 10.0**-k if k else 0.0) for a, b, k in zip(printed, told, places, strict=False)]
    return len(near) == len(told) > 0 and all(near)


def test_there_is_something_to_run() -> None:
    assert {one.kind for one in FOUND} == {"octave", "python"} and len(FOUND) >= 6
    assert shown(FOUND[0])[0][1] == ["8"]
    assert agree([42.96], ["43.0"]) and not agree([42.94], ["43.0"]) and not agree([8.1], ["8"]) and not agree([], ["8"])


@pytest.mark.programs
@pytest.mark.parametrize("block", [one for one in FOUND if one.kind == "octave"], ids=lambda block: block.text[:30])
def test_octave_prints_it(block: Block) -> None:
    if shutil.which("octave-cli") is None:
        pytest.skip("GNU Octave is not installed")
    folder = os.environ.get(FAULT_ID, "")
    if any(name in block.text for name in OF_FAULT_ID) and not folder:
        pytest.skip(f"{FAULT_ID} names no clone of ggleizer/fault_id")
    # As peers/fault_id.m: what MATLAB calls the last singular vectors, and its economy-sized QR.
    before = (
        'function [Q, R] = qr(X, varargin), [Q, R] = builtin("qr", X, 0); end\n'
        "function [U, S, V] = svds(M, k, varargin), [U, S, V] = svd(M); V = V(:, end-k+1:end); end\n"
        f"addpath({folder!r}); randn('seed', 1);\n".replace("addpath('');", "")
    )
    for line, told in shown(block):
        *first, last = line.split("; ")
        program = f"1;\n{before}{'; '.join(first)};\nprintf('%.6f ', {last});\n" if first else f"1;\n{before}printf('%.6f ', {last});\n"
        before += "".join(f"{one};\n" for one in first)
        ran = subprocess.run(["octave-cli", "--quiet", "--norc", "--eval", program], capture_output=True, text=True, timeout=60)
        assert agree([float(one) for one in ran.stdout.split()], told), (line, ran.stdout, ran.stderr)


def given() -> dict[str, Any]:
    """A second-order system with one input, 500 samples, which begins in (9, -5)."""
    u = np.random.default_rng(0).standard_normal((500, 1))
    y = np.zeros((500, 1))
    x = np.array([9.0, -5.0])
    for k in range(500):
        y[k] = x[0]
        x = np.array([[1.2, -0.5], [1.0, 0.0]]) @ x + np.array([1.0, 0.0]) * u[k]
    return {"y": y, "u": u}


@pytest.mark.parametrize("block", [one for one in FOUND if one.kind == "python"], ids=lambda block: block.text[:40])
def test_python_prints_it(block: Block) -> None:
    names: dict[str, Any] = {"np": np, **given()}
    if "ctrlsys" in block.text:
        if find_spec("ctrlsys") is None:
            pytest.skip("ctrlsys is not installed")
        import ctrlsys

        names |= {"ctrlsys": ctrlsys}
    else:
        if find_spec("sippy_unipi") is None:
            pytest.skip("sippy_unipi is not installed")
        from sippy_unipi import system_identification

        names |= {"system_identification": system_identification, "y": names["y"].T, "u": names["u"].T}
    for line, told in shown(block):
        assert agree(np.ravel(eval(line, names)).astype(float).tolist(), told), line
