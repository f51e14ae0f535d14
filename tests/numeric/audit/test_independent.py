"""Implementations written from the pages of the audit alone: right code passes by whatever algorithm, and with one line wrong it does not.

`independent/README.md` says what was unclear to whoever wrote them.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from faultspace.numeric.audit.running import audit

HERE = Path(__file__).parent / "independent"
# One slug for each thing that a function owes. All vectors of each are asked, so that none is picked; most views of them, and growth, are
# left to `faultspace audit`, which takes a minute. No check is known to be unfair to these three: none is listed as an expected failure.
QUICK = [
    "exact-recovery",
    "consistent-under-coloured-fault",
    "residual-free-of-input",
    "residual-free-of-input-other-units",
    "window-ranks",
    "window-ranks-unexciting",
    "fault-dimension",
    "fault-dimension-noisy",
    "fault-space",
    "fault-space-at-the-lag",
    "fault-signal",
    "normal-rank",
    "infinite-zeros",
    "finite-zeros",
    "faults-of-record",
    "space-of-record-noisy",
    "refuses-nan-output",
    "refuses-nan-residual",
    "refuses-nan-model",
    "refuses-short-data",
    "refuses-short-residual",
    "refuses-shapes",
    "refuses-unexciting-input",
    "refuses-unexciting-fault",
    "refuses-window-at-the-lag",
    "refuses-same-fault-twice",
    "deterministic",
    "inputs-untouched",
]
NINE = 9  # functions that an implementation may have
FIRST = {
    "identify": "exact-recovery",
    "residual": "residual-free-of-input",
    "window_ranks": "window-ranks",
    "fault_dimension": "fault-dimension",
    "fault_space": "fault-space",
    "reconstruct": "fault-signal",
    "structure": "finite-zeros",
    "count_faults": "faults-of-record",
}


@pytest.mark.parametrize(("name", "missing"), [("plain.py", set[str]()), ("other.py", {"space-of-record-noisy"})])
def test_right_code_by_other_algorithms_passes(name: str, missing: set[str]) -> None:
    found = audit(str(HERE / name), only=[slug for slug in QUICK if slug not in missing])
    assert len({one.function for one in found}) == NINE - len(missing)
    assert not found.failed, found.summary()


@pytest.mark.programs
@pytest.mark.skipif(shutil.which("octave-cli") is None, reason="octave-cli is not installed")
def test_right_code_in_octave_passes() -> None:
    found = audit(command=["sh", str(HERE / "octave.sh")], only=QUICK)
    assert len({one.function for one in found}) == NINE
    assert not found.failed, found.summary()


@pytest.mark.mutants
@pytest.mark.parametrize(
    ("name", "line", "wrong", "function"),
    [
        ("plain.py", "A = np.linalg.lstsq(gamma[:-p], gamma[p:]", "A = 1.001 * np.linalg.lstsq(gamma[:-p], gamma[p:]", "identify"),
        ("plain.py", "x = A @ x + driven[k]", "x = A @ (x + driven[k])", "residual"),
        ("plain.py", "sigma > (_rounding(matrix) if", "sigma > (1e10 * _rounding(matrix) if", "window_ranks"),
        ("plain.py", "return int(steps[-1]), False", "return int(steps[0]), False", "fault_dimension"),
        ("plain.py", "for j in range(s)])", "for j in range(1)])", "fault_space"),
        ("plain.py", "x = A @ x + F @ v[k]", "x = A @ x", "reconstruct"),
        ("plain.py", "D = np.vstack([D[:rank], B[free:]])", "D = np.vstack([D[:rank], 0 * B[free:]])", "structure"),
        ("plain.py", "return int(together - m)", "return int(together)", "count_faults"),
        ("other.py", "reshape(s * p, m), gamma[:p]", "reshape(s * p, m) * 1.001, gamma[:p]", "identify"),
        ("other.py", "power, d = power @ power, 2 * d", "power, d = power, 2 * d", "residual"),
        ("other.py", "return p - inputs - len(found), False", "return p - inputs - len(found) + 1, False", "fault_dimension"),
        ("other.py", "M = row @ C + M @ A", "M = row @ C", "fault_space"),
        ("other.py", "z = target @ seen", "z = 0 * target @ seen", "reconstruct"),
        ("other.py", "np.linalg.eigvals(X[c:, c:])]", "np.linalg.eigvals(X[c:, c:] * 1.001)]", "structure"),
    ],
)
def test_the_same_code_with_a_line_wrong_fails(tmp_path: Path, name: str, line: str, wrong: str, function: str) -> None:
    text = (HERE / name).read_text("utf-8")
    assert text.count(line) >= 1
    (tmp_path / "wrong.py").write_text(text.replace(line, wrong), "utf-8")
    found = audit(str(tmp_path / "wrong.py"), only=[FIRST[function]])
    assert found.failed
