"""What is probably wrong: each suspicion is raised by the error that it is about, and by no other; a right answer raises none."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from faultspace.numeric.audit import reference
from faultspace.numeric.audit.adapter import guarded
from faultspace.numeric.audit.checks.catalogue import chosen
from faultspace.numeric.audit.diagnosing.explaining import SUSPICIONS, explained
from faultspace.numeric.audit.records import Check
from faultspace.numeric.audit.running import audit
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.method.space.by_ranks import noise_free_fault_space
from tests.thorough import every

MODEL = "exact-recovery[n3-u2-p2]"


def one(name: str, function: str) -> Check:
    """The check of that name which asks the function."""
    (check,) = chosen([function], [name])
    return check


def changed(change: Callable[..., Any]) -> Callable[..., Any]:
    """Our own identify, whose answer is changed."""
    return lambda *given: change(*reference.identify(*given))


def ranks_above(level: float) -> Callable[..., Any]:
    return lambda r, windows: [
        int(np.sum(np.linalg.svd(np.vstack([r[k : len(r) - s + 1 + k].T for k in range(s)]), compute_uv=False) > level))
        for s in range(1, windows + 1)
    ]


def not_silent(y: Any, u: Any, order: int, block_rows: int) -> Any:
    if np.max(np.abs(u)) < 1e-9:
        raise ValueError("the input is silent")
    return reference.identify(y, u, order, block_rows)


def without_initial_state(y: Any, u: Any, order: int, block_rows: int) -> Any:
    """B and D by a fit of the response from rest, which takes what the initial state does for theirs."""
    A, _, C, _ = reference.identify(y, u, order, block_rows)
    n, n_u, p = order, u.shape[1], y.shape[1]
    states, rows = np.zeros((n, n * n_u)), []
    for w in u:
        rows.append(np.hstack([C @ states, np.kron(w, np.eye(p))]))
        states = A @ states + np.kron(w, np.eye(n))
    found = np.linalg.lstsq(np.vstack(rows), y.ravel(), rcond=None)[0]
    return A, found[: n * n_u].reshape(n_u, n).T, C, found[n * n_u :].reshape(n_u, p).T


def late(y: Any, u: Any, A: Any, B: Any, C: Any, D: Any) -> Any:
    response = StateSpaceModel(A, B, C, D).simulate(u)
    return y - np.vstack([np.zeros((1, y.shape[1])), response[:-1]])


def columns(change: Callable[[Any, Any, Any], Any]) -> Callable[..., Any]:
    def fault_space(r: Any, A: Any, C: Any, n_v: int, block_rows: int) -> Any:
        Z = reference.fault_space(r, A, C, n_v, block_rows)
        return np.vstack(change(Z[: len(A)], Z[len(A) :], A))

    return fault_space


def structured(**changes: Callable[[Any], Any]) -> Callable[..., Any]:
    def structure(*given: Any) -> Any:
        found = reference.structure(*given)
        return replace(found, **{name: change(getattr(found, name)) for name, change in changes.items()})

    return structure


CASES: list[tuple[str, str, Callable[..., Any], str]] = [
    ("identify", MODEL, changed(lambda A, B, C, D: (A, B, C, 0 * D)), "D is ignored"),
    ("identify", MODEL, changed(lambda A, B, C, D: (A.T, B, C, D)), "A is transposed"),
    ("identify", MODEL, changed(lambda A, B, C, D: (A.T, C.T, B.T, D.T)), "transfer function is transposed"),
    ("identify", MODEL, changed(lambda A, B, C, D: (A, B.T, C.T, D)), "B and C are each transposed"),
    ("identify", MODEL, changed(lambda A, B, C, D: (A, B, C, -D)), "D has the wrong sign"),
    ("identify", MODEL, changed(lambda A, B, C, D: (A, B, -C, D)), "B or C has the wrong sign"),
    ("identify", MODEL, changed(lambda A, B, C, D: (A, -B, C, -D)), "response has the wrong sign"),
    ("identify", MODEL, changed(lambda A, B, C, D: (-A, B, C, D)), "A has the wrong sign"),
    ("identify", MODEL, changed(lambda A, B, C, D: (np.linalg.inv(A), B, C, D)), "A is inverted"),
    ("identify", MODEL, changed(lambda A, B, C, D: (A, B[:, ::-1], C, D[:, ::-1])), "Input channels are permuted"),
    ("identify", MODEL, changed(lambda A, B, C, D: (A, B, C[::-1], D[::-1])), "Output channels are permuted"),
    ("identify", MODEL, changed(lambda A, B, C, D: (A, B, C, D + 1)), "A, B and C are right and D is wrong"),
    ("identify", MODEL, changed(lambda A, B, C, D: (A, 2 * B, C, D + 1)), "A and C are right and B or D is wrong"),
    ("identify", MODEL, changed(lambda A, B, C, D: (A, np.linalg.solve(A, B), C, D - C @ np.linalg.solve(A, B))), "A and C are right"),
    ("identify", "exact-recovery[n1-u2-p1]", changed(lambda *M: tuple(one.astype(np.float32) for one in M)), "of single precision"),
    ("identify", "exact-recovery-1e-12[n3-u2-p2]", not_silent, "threshold is absolute"),
    ("residual", "residual-free-of-input[two-faults]", lambda *a: -reference.residual(*a), "wrong sign"),
    ("residual", "residual-free-of-input[two-faults]", lambda *a: reference.residual(*a).T.copy(), "transposed"),
    ("residual", "residual-free-of-input[two-faults]", lambda y, u, *s: y + StateSpaceModel(*s).simulate(u), "added"),
    ("residual", "residual-free-of-input[two-faults]", lambda y, u, A, B, C, D: reference.residual(y, u, A, B, C, 0 * D), "D is ignored"),
    ("residual", "residual-free-of-input[two-faults]", lambda y, u, A, B, C, D: reference.residual(y, u, A, B, C, -D), "D has the wrong"),
    ("residual", "residual-free-of-input[two-faults]", lambda y, u, A, *rest: reference.residual(y, u, A.T, *rest), "A is used transposed"),
    ("residual", "residual-free-of-input[two-faults]", lambda y, u, *s: reference.residual(y, u[:, ::-1], *s), "Input channels"),
    ("residual", "residual-free-of-input[two-faults]", lambda *a: reference.residual(*a)[:, ::-1], "Output channels"),
    ("residual", "residual-free-of-input[two-faults]", late, "one sample late"),
    ("residual", "residual-free-of-input[two-faults]", lambda y, *a: y.copy(), "Nothing is subtracted"),
    ("residual", "residual-free-of-input-1e-12[two-faults]", lambda *a: np.round(reference.residual(*a), 15), "threshold is absolute"),
    ("window_ranks", "window-ranks[two-faults]", lambda r, w: [0, *reference.window_ranks(r, w)[:-1]], "counted from 0"),
    ("window_ranks", "window-ranks[two-faults]", lambda r, w: [k + 1 for k in reference.window_ranks(r, w)], "one too large"),
    ("window_ranks", "window-ranks[two-faults]", lambda r, w: [k - 1 for k in reference.window_ranks(r, w)], "one too small"),
    ("window_ranks", "window-ranks[two-faults]", ranks_above(0.0), "Every rank is full"),
    ("window_ranks", "window-ranks-1e-12[two-faults]", ranks_above(1e-7), "threshold is absolute"),
    ("fault_dimension", "fault-dimension[two-faults]", lambda r: 3, "as many faults as outputs"),
    ("fault_dimension", "fault-dimension[two-faults]", lambda r: 1, "one fault too few"),
    ("fault_dimension", "fault-dimension[one-fault]", lambda r: 2, "rank R_2 - rank R_1"),
    ("fault_space", "fault-space[two-faults]", columns(lambda f, g, A: (g, f)), "columns are [g; f]"),
    ("fault_space", "fault-space[two-faults]", columns(lambda f, g, A: (f, -g)), "unlike signs"),
    ("fault_space", "fault-space[two-faults]", lambda *a: reference.fault_space(*a).T, "basis is transposed"),
    ("fault_space", "fault-space[two-faults]", columns(lambda f, g, A: (np.linalg.solve(A, f), g)), "f are one sample late"),
    ("fault_space", "fault-space[two-faults]", columns(lambda f, g, A: (A @ f, g)), "f are one sample early"),
    ("fault_space", "fault-space[two-faults]", columns(lambda f, g, A: (f, g[::-1])), "output parts g are permuted"),
    ("fault_space", "fault-space[two-faults]", lambda r, A, *rest: reference.fault_space(r, A.T, *rest), "A is used transposed"),
    ("fault_space", "fault-space[two-faults]", lambda *a: reference.fault_space(*a)[:, :1], "True columns are left out"),
    ("fault_space", "fault-space[two-faults]", lambda r, A, C, *_: np.eye(len(A) + len(C)), "The space is too large"),
    (
        "fault_space",
        "fault-space-shortest-window[two-faults]",
        lambda r, A, C, n_v, s: noise_free_fault_space(r, A, C, n_v=n_v, block_rows=s - 1).basis,
        "one block row too short",
    ),
    ("reconstruct", "fault-signal[two-faults]", lambda *a: -reference.reconstruct(*a), "wrong sign"),
    ("reconstruct", "fault-signal[two-faults]", lambda *a: reference.reconstruct(*a).T, "signal is transposed"),
    ("reconstruct", "fault-signal[two-faults]", lambda *a: reference.reconstruct(*a)[:, ::-1], "Fault channels are permuted"),
    ("reconstruct", "fault-signal[two-faults]", lambda *a: 2 * reference.reconstruct(*a), "off by one factor"),
    ("reconstruct", "fault-signal[two-faults]", lambda *a: 0 * reference.reconstruct(*a), "zero everywhere"),
    (
        "reconstruct",
        "fault-signal[two-faults]",
        lambda r, A, F, C, G, x0: reference.reconstruct(r, A, F, C, G, 0 * x0),
        "initial state is ignored",
    ),
    ("structure", "normal-rank[square-proper]", structured(left_invertible=lambda told: not told), "wrong way round"),
    ("structure", "normal-rank[square-proper]", structured(normal_rank=lambda rank: rank + 1), "one too large"),
    ("structure", "infinite-zeros[square-strictly-proper]", structured(infinite_zero_orders=lambda k: [i - 1 for i in k]), "too small"),
    ("structure", "infinite-zeros[square-strictly-proper]", structured(infinite_zero_orders=lambda k: [i + 1 for i in k]), "too large"),
    ("structure", "infinite-zeros[square-half-proper]", structured(infinite_zero_orders=lambda k: [0] * len(k)), "the order 0"),
    ("structure", "finite-zeros[square-proper]", structured(finite_zeros=lambda z: [-one for one in z]), "wrong sign"),
    ("structure", "finite-zeros[square-proper]", structured(finite_zeros=lambda z: [1 / one for one in z]), "inverted"),
    (
        "structure",
        "finite-zeros[square-proper]",
        lambda A, *rest: replace(reference.structure(A, *rest), finite_zeros=np.linalg.eigvals(A).tolist()),
        "poles",
    ),
]


@pytest.mark.parametrize(
    ("function", "name", "wrong", "words"), CASES[:: every()], ids=[f"{case[0]}: {case[3]}" for case in CASES[:: every()]]
)
def test_an_error_is_told_by_its_name(function: str, name: str, wrong: Callable[..., Any], words: str) -> None:
    check = one(name, function)
    assert words in explained(check, guarded(wrong))


def test_every_kind_of_initial_state_error_is_found_where_the_record_has_one() -> None:
    check = one("exact-recovery[n2-u1-p1]", "identify")
    assert "A and C are right" in explained(check, guarded(without_initial_state))


@pytest.mark.parametrize("function", [name for name in SUSPICIONS if name not in ("count_faults", "identified_fault_space")])
def test_nothing_is_said_of_an_answer_for_which_no_suspicion_stands(function: str) -> None:
    """An answer that is nobody's: random numbers of the right shape."""
    names = {
        "identify": MODEL,
        "residual": "residual-free-of-input[two-faults]",
        "window_ranks": "window-ranks[two-faults]",
        "fault_dimension": "fault-dimension[two-faults]",
        "fault_space": "fault-space[two-faults]",
        "reconstruct": "fault-signal[two-faults]",
        "structure": "finite-zeros[square-proper]",
    }
    random = np.random.default_rng(3)

    def nobodys(*given: Any) -> Any:
        answer = getattr(reference, function)(*given)
        if function == "structure":
            return replace(answer, finite_zeros=[complex(*random.normal(size=2)) for _ in answer.finite_zeros])
        if function == "window_ranks":
            return [9, 1, 7, 2, 8, 3, 9, 4][: len(answer)]
        if function == "fault_dimension":
            return 7
        parts = answer if isinstance(answer, tuple) else (answer,)
        made = tuple(random.normal(size=one.shape) for one in parts)
        return made if isinstance(answer, tuple) else made[0]

    assert explained(one(names[function], function), guarded(nobodys)) == ""


def test_nothing_is_said_of_refusals_and_manners() -> None:
    for name in ("refuses-nan-residual", "deterministic[one-fault]"):
        assert explained(one(name, "fault_dimension"), guarded(lambda r: 9)) == ""


@settings(max_examples=15, deadline=None)
@given(st.permutations(range(3)), st.permutations(range(2)))
def test_any_order_of_channels_is_found(inputs: list[int], outputs: list[int]) -> None:
    check = one("exact-recovery[n2-u3-p2]", "identify")
    wrong = changed(lambda A, B, C, D: (A, B[:, inputs], C[outputs], D[outputs][:, inputs]))
    words = explained(check, guarded(wrong))
    if sorted(inputs) == list(inputs) and sorted(outputs) == list(outputs):
        assert words == "" or "permuted" not in words  # it was right
    elif sorted(inputs) == list(inputs):
        assert "Output channels are permuted" in words
    elif sorted(outputs) == list(outputs):
        assert "Input channels are permuted" in words


def test_an_audit_explains_the_first_of_each_fold_and_no_right_one() -> None:
    found = audit(
        SimpleNamespace(fault_dimension=lambda r: r.shape[1]), only=["fault-dimension*[two-faults]", "fault-dimension*[one-fault]"]
    )
    told = [result for result in found if result.explanation]
    assert told and all(result.failed and "as many faults as outputs" in result.explanation for result in told)
    assert len(found.causes) == 1 and len(found.causes[0].results) == len(found.failed)
    assert not any(result.explanation for result in audit(reference, only=["fault-dimension[two-faults]"]))
