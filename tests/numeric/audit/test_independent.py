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
# left to `faultspace audit`, which takes a minute. No check is known to be unfair to these two: none is listed as an expected failure.
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


def test_right_code_by_other_algorithms_passes() -> None:
    found = audit(str(HERE / "other.py"), only=[slug for slug in QUICK if slug != "space-of-record-noisy"])
    assert len({one.function for one in found}) == NINE - 1
    assert not found.failed, found.summary()


@pytest.mark.programs
@pytest.mark.skipif(shutil.which("octave-cli") is None, reason="octave-cli is not installed")
def test_right_code_in_octave_passes() -> None:
    found = audit(command=["sh", str(HERE / "octave.sh")], only=QUICK)
    assert len({one.function for one in found}) == NINE
    assert not found.failed, found.summary()


@pytest.mark.mutants
@pytest.mark.parametrize(
    ("line", "wrong", "function"),
    [
        ("reshape(s * p, m), gamma[:p]", "reshape(s * p, m) * 1.001, gamma[:p]", "identify"),
        ("power, d = power @ power, 2 * d", "power, d = power, 2 * d", "residual"),
        ("_rank(_triangle(_hankel(r, s))) for s", "_rank(_triangle(_hankel(r, s)), 1e-3) for s", "window_ranks"),
        ("np.hstack([u, y]), m)", "np.hstack([u, y]), 0)", "count_faults"),
        ("return p - inputs - len(found), False", "return p - inputs - len(found) + 1, False", "fault_dimension"),
        ("M = row @ C + M @ A", "M = row @ C", "fault_space"),
        ("z = target @ seen", "z = 0 * target @ seen", "reconstruct"),
        ("np.linalg.eigvals(X[c:, c:])]", "np.linalg.eigvals(X[c:, c:] * 1.001)]", "structure"),
    ],
)
def test_the_same_code_with_a_line_wrong_fails(tmp_path: Path, line: str, wrong: str, function: str) -> None:
    text = (HERE / "other.py").read_text("utf-8")
    assert text.count(line) >= 1
    (tmp_path / "wrong.py").write_text(text.replace(line, wrong), "utf-8")
    found = audit(str(tmp_path / "wrong.py"), only=[FIRST[function]])
    assert found.failed
