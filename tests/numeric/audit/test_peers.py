"""The peers: the registry needs none of them; one that is installed gets a vector right, and what is known to be wrong in it is found."""

from __future__ import annotations

import importlib.util
import shutil
import subprocess
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import SimpleNamespace

import pytest

from faultspace.base.errors import InvalidData
from faultspace.base.processes import STANDARD
from faultspace.numeric.audit.adapter import load, offered
from faultspace.numeric.audit.checks.catalogue import all_checks
from faultspace.numeric.audit.peers import FAULT_ID, HERE, JULIA, MATRIX_PENCILS, OCTAVE, PEERS, peer
from faultspace.numeric.audit.records import Broken, CheckResult, Status
from faultspace.numeric.audit.running import audit
from faultspace.numeric.audit.subjects.opening import InProcess
from faultspace.numeric.audit.subjects.subprocess_adapter import Exec

PACKAGES = ("sippy_unipi", "nfoursid", "ctrlsys", "control", "slycot")
OFFERED = {
    "sippy_unipi": ["identify"],
    "sippy_unipi-D": ["identify"],
    "nfoursid": ["identify"],
    "ctrlsys": ["identify", "structure"],
    "ctrlsys-C": ["identify"],
    "python-control": ["identify", "structure"],
    "python-control-alone": ["structure"],
    "slycot": ["structure"],
    "octave-control": ["identify", "structure"],
    "matrix-pencils": ["structure"],
    "fault_id": ["identify", "window_ranks", "fault_dimension", "fault_space"],
    "fault_id-threshold": ["identify", "window_ranks", "fault_dimension", "fault_space"],
}
RIGHT = [
    ("sippy_unipi", "exact-recovery[n2-u2-p2-no-D]"),
    ("sippy_unipi-D", "exact-recovery[n2-u2-p3]"),
    ("nfoursid", "exact-recovery[n2-u2-p3]"),
    ("ctrlsys", "finite-zeros[square-proper]"),
    ("ctrlsys", "infinite-zeros[chain-of-delays]"),
    ("ctrlsys-C", "exact-recovery[n2-u1-p1]"),  # B and D by N4SID
    ("python-control-alone", "finite-zeros[square-proper]"),
    ("python-control", "consistent-under-coloured-fault[coloured]"),
    ("python-control", "finite-zeros[square-proper]"),
    ("slycot", "infinite-zeros[chain-of-delays]"),
    ("slycot", "refuses-shapes[two-faults]"),
    ("octave-control", "exact-recovery[n2-u1-p2]"),
    ("octave-control", "finite-zeros[zero-outside]"),
    ("octave-control", "infinite-zeros[square-half-proper]"),
    ("matrix-pencils", "finite-zeros[zero-outside]"),
    ("matrix-pencils", "infinite-zeros[chain-of-delays]"),
    ("matrix-pencils", "refuses-shapes[two-faults]"),
    ("fault_id", "exact-recovery[n2-u1-p2]"),
    ("fault_id", "consistent-under-coloured-fault[coloured]"),
    ("fault_id", "fault-space[two-faults]"),
    ("fault_id", "window-ranks[two-faults]"),
    ("fault_id-threshold", "fault-dimension[one-fault]"),
]
WRONG = [
    ("sippy_unipi", "exact-recovery[n2-u2-p2-at-rest]", "fail"),  # no D by default
    ("nfoursid", "memory-grows-with-N[N3000-N12000]", "fail"),
    ("nfoursid", "other-units[n2-u1-p1]", "fail"),  # normal equations
    ("ctrlsys", "refuses-shapes[two-faults]", "fail"),  # an array smaller than told
    ("ctrlsys", "exact-recovery[n2-u1-p1]", "fail"),  # B and D of ib01bd
    ("octave-control", "long-window[n4-u2-p3-s20]", "broken"),  # IB01BD: parameter 30
    ("matrix-pencils", "finite-zeros[zeros-outside]", "fail"),  # the default tolerance
    ("matrix-pencils", "refuses-nan-model[two-faults]", "fail"),
    ("fault_id", "exact-recovery[n2-u2-p2-at-rest]", "fail"),  # n_u > 1: an interleaved reshape
    ("fault_id", "fault-space-long-window[two-faults]", "fail"),  # floor of a fractional range
    ("fault_id", "fault-space-1e6[two-faults]", "fail"),  # singular values above 1e-10
    ("fault_id", "fault-dimension-noisy[one-fault-in-noise]", "fail"),  # the default tolerance
    ("fault_id-threshold", "fault-dimension-1e-6[one-fault]", "fail"),  # the threshold 1
    ("fault_id-threshold", "window-ranks[two-faults]", "fail"),
]


EXCLUDING = ("sippy_unipi", "sippy_unipi-D", "ctrlsys", "ctrlsys-C", "octave-control")


@cache
def few_block_rows() -> tuple[str, ...]:
    """Return the checks that hand `identify` no more block rows than states and want an answer, as they call it."""
    orders = list[tuple[int, int]]()

    def identify(y: object, u: object, order: int, block_rows: int) -> None:
        orders.append((order, block_rows))

    few, asked = [], InProcess(SimpleNamespace(identify=identify))
    for check in all_checks():
        if check.function == "identify" and not check.slug.startswith("refuses-"):
            orders.clear()
            asked.perform(check)
            if any(order >= block_rows for order, block_rows in orders):
                few.append(check.name)
    return tuple(few)


@cache
def _in_julia(name: str) -> dict[str, CheckResult]:
    """All that the tests ask of such a peer, of one process: it takes half a minute to start."""
    checks = [two for who, two in RIGHT if who == name] + [two for who, two, _ in WRONG if who == name]
    with Exec(peer(name).command or (), replace(STANDARD, passed=(MATRIX_PENCILS,))) as program:
        return {record.name: record for record in audit(program, only=checks)}


def _asked(name: str, *checks: str) -> dict[str, CheckResult]:
    """Records by name; skips where the peer is not here."""
    one = peer(name)
    if one.version() is None:
        pytest.skip(f"{name}: {one.needs}")
    if one.language == "Julia":
        return _in_julia(name)
    if one.adapter is not None:
        return {record.name: record for record in audit(load(one.adapter), only=checks)}
    with Exec(one.command or ()) as program:
        return {record.name: record for record in audit(program, only=checks)}


def test_the_registry_is_well_formed() -> None:
    assert len({one.name for one in PEERS}) == len(PEERS) and set(OFFERED) == {one.name for one in PEERS}
    for one in PEERS:
        assert (one.adapter is None) != (one.command is None)
        assert one.language == ("Python" if one.command is None else "Julia" if one.command[0] == JULIA[0] else "Octave")
        assert one.needs and "\n" not in one.needs and peer(one.name) is one
        place = importlib.util.find_spec(one.adapter.partition(":")[0]) if one.adapter else None
        assert place is not None if one.adapter else Path((one.command or ())[len(JULIA if one.language == "Julia" else OCTAVE)]).is_file()
    with pytest.raises(InvalidData, match="nfoursid"):
        peer("nobody")


@pytest.mark.parametrize("name", sorted({check for _, check in RIGHT} | {check for _, check, _ in WRONG}))
def test_what_is_said_of_peers_names_checks_that_are_there(name: str) -> None:
    """The tests below skip where a peer is not installed, and would do so with the name of a check that is gone."""
    assert name in {other for check in all_checks() for other in check.names}


def test_the_registry_imports_no_peer() -> None:
    code = f"import sys, faultspace.numeric.audit.peers; print([name for name in {PACKAGES} if name in sys.modules])"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, text=True)
    assert run.stdout.strip() == "[]"


@pytest.mark.programs
@pytest.mark.parametrize("name", OFFERED)
def test_what_a_peer_offers(name: str) -> None:
    one = peer(name)
    if one.version() is None:
        pytest.skip(f"{name}: {one.needs}")
    if one.adapter is not None:
        assert sorted(offered(load(one.adapter))) == sorted(OFFERED[name])
    else:
        with Exec(one.command or (), replace(STANDARD, passed=(MATRIX_PENCILS,))) as program:
            assert sorted(offered(program)) == sorted(OFFERED[name])


@pytest.mark.programs
@pytest.mark.parametrize(("name", "check"), RIGHT)
def test_a_peer_gets_right_what_it_can(name: str, check: str) -> None:
    record = _asked(name, check)[check]
    assert record.verdict == Status.PASS, record


@pytest.mark.programs
@pytest.mark.parametrize(("name", "check", "verdict"), WRONG)
def test_a_known_error_is_found(name: str, check: str, verdict: str) -> None:
    record = _asked(name, check)[check]
    assert record.verdict == verdict, record


@pytest.mark.programs
@pytest.mark.parametrize("name", EXCLUDING)
def test_what_the_documents_exclude_is_not_promised(name: str) -> None:
    """Windows without more block rows than states, and a coloured fault, under which each is biased."""
    if peer(name).version() is None:
        pytest.skip(f"{name}: {peer(name).needs}")
    coloured, *few = audit(peer=name, only=["consistent-under-coloured-fault[coloured]", *few_block_rows()])
    assert coloured.verdict == Status.FAIL and coloured.not_promised and not coloured.failed
    assert len(few) == 10 and all(one.not_promised and not one.failed for one in few), few


def test_the_reshape_spares_the_poles() -> None:
    """What is wrong in fault_id for two inputs is B and D alone; the adapter does nothing to A and C."""
    record = _asked("fault_id", "exact-recovery[n2-u2-p2-at-rest]")["exact-recovery[n2-u2-p2-at-rest]"]
    assert "Markov" in record.detail and "eigenvalues" not in record.detail and "polynomial" not in record.detail


def test_what_is_not_offered_is_declined() -> None:
    record = _asked("python-control", "normal-rank[square-proper]")["normal-rank[square-proper]"]
    assert record.verdict == Status.NOT_OFFERED and "normal_rank" in record.detail


@pytest.mark.programs
def test_a_missing_clone_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(FAULT_ID, str(tmp_path))
    assert peer("fault_id").version() is None
    if peer("octave-control").version() is None:
        pytest.skip(peer("octave-control").needs)
    with pytest.raises(InvalidData, match=f"set {FAULT_ID}"):
        Exec(peer("fault_id").command or ())


@pytest.mark.programs
def test_numbers_pass_through_octave_to_the_last_bit() -> None:
    """jsondecode and jsonencode would not do that."""
    if peer("octave-control").version() is None:
        pytest.skip(peer("octave-control").needs)
    program = f"source('{HERE / 'json_lines.m'}'); function a = same(q), a.r = q.r; end; answer_questions(struct('residual', @same))"
    rows = [[1 / 3, -2 / 7e11], [1e-300 / 3, float("inf")], [2**53 + 2.0, -0.1]]
    with Exec([*OCTAVE, "--eval", program]) as echo:
        question = {"call": "residual", "r": rows}
        assert echo._ask({**question})["r"] == [[1 / 3, -2 / 7e11], [1e-300 / 3, "Infinity"], [2**53 + 2.0, -0.1]]


@pytest.mark.skipif(shutil.which(JULIA[0]) is None, reason="Julia is not installed")
@pytest.mark.programs
def test_numbers_pass_through_julia_to_the_last_bit_and_its_errors_are_told_apart() -> None:
    """Of a matrix without rows JSON does not tell the columns: F has those of G, G those of F, C and A those of A."""
    program = f"""include("{HERE / "json_lines.jl"}")
        structure(A, F, C, G) = size(G) == (1, 1) ? error("no \\"such\\" thing") : size(G) == (2, 1) ? G[3, 1] :
            (normal_rank = size(F, 2), finite_zeros = [complex.(vec(A)); 1.0im], infinite_zero_orders = [size(C, 2)],
             left_invertible = true)
        answer_questions((structure = structure,), "{{\\"call\\": \\"structure\\", \\"A\\": [], \\"F\\": [], \\"C\\": [], \\"G\\": []}}")"""
    question = {"call": "structure", "C": [], "F": [[], []], "G": []}
    with Exec([*JULIA, "-e", program]) as echo:
        numbers = [[1 / 3, -2 / 7e11], [1e-300 / 3, float("inf")]]
        expected = [[1 / 3, 0.0], [1e-300 / 3, 0.0], [-2 / 7e11, 0.0], ["Infinity", 0.0], [0.0, 1.0]]
        answer = echo._ask({**question, "A": numbers})
        assert (answer["finite_zeros"], answer["normal_rank"], answer["infinite_zero_orders"]) == (expected, 0, [2])
        assert echo._ask({**question, "A": [], "F": [], "G": [[1, 2, 3]]})["normal_rank"] == 3
        assert echo._ask({**question, "A": [], "F": [], "G": [[1]]}) == {"refused": 'no "such" thing'}
        with pytest.raises(Broken, match="BoundsError"):
            echo._ask({**question, "A": [], "F": [], "G": [[1], [2]]})
