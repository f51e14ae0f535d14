"""Certificates of population limits: random experiments against the oracle, what each refusal keeps out, size, experiments insisted on.

FORGED    refusal -> a certificate of something false that this refusal alone stops
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from importlib import resources
from inspect import signature
from random import Random
from typing import Any

import jsonschema
import pytest
from flint import fmpq

from faultspace.base.errors import InvalidInput
from faultspace.exact.algebra.fields import QQ
from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.limits import experiments as reading
from faultspace.exact.limits.experiments import Experiment, read_experiment
from faultspace.exact.limits.filters import Filter
from faultspace.exact.limits.inputs import InputLimit
from faultspace.exact.limits.moesp import PopulationLimits, limit
from faultspace.exact.limits.moments import covariances
from faultspace.proofs.trust import checker
from faultspace.proofs.trust import limit_certificates as limit_certificates_module
from faultspace.proofs.trust.limit_certificates import Certified
from faultspace.proofs.trust.structure_certificates import Unprovable
from tests.oracle import truth
from tests.proofs.examples import (
    LEADING,
    SEVEN_B,
    SEVEN_D,
    Certificate,
    experiment,
    experiments,
    forged_inputs,
    limit_certificates,
    spoiled,
    written,
)

MAKERS = (Certified.past_input_limit, Certified.past_input_and_output_limit, Certified.output_error_inputs, Certified.moesp_inputs)


def drawn(rng: Random) -> dict[str, Any]:
    """An experiment with n, nu, m, p up to 2, filters of lag up to 2, often singular in some way."""
    n, nu, m, p, q = rng.randint(0, 2), rng.randint(1, 2), rng.randint(0, 2), rng.randint(1, 2), rng.randint(1, 2)

    def table(height: int, width: int, *entries: object) -> list[list[object]]:
        return [[rng.choice(entries or (0, 0, 1, -1, "1/2", 2)) for _ in range(width)] for _ in range(height)]

    def filtered(height: int, width: int) -> object:
        num = [table(height, width) for _ in range(rng.randint(1, 3 if width == 1 else 2))]
        return rng.choice([num, num, {"num": num, "den": rng.choice([["1", "1/2"], [1, 0, "-1/3"], [1, "-1/4", 0]])}])

    shapes = {"A": (n, n), "B": (n, nu), "C": (p, n), "D": (p, nu), "F": (n, m), "G": (p, m)}
    data: dict[str, Any] = {name: table(*shape) for name, shape in shapes.items()}
    data["A"] = table(n, n, 0, "1/2", "-1/2", "1/3")
    data |= {"n": n, "nu": nu, "m": m, "p": p, "s": rng.randint(1, 3), "past": rng.randint(1, 2)}
    data |= {"u_filter": filtered(nu, q), "v_filter": filtered(m, q)}
    return data | ({"w_filter": filtered(p, 1)} if rng.random() < 0.3 else {})


def test_random_limits_are_certified_and_true() -> None:
    rng, made, refused, ranks = Random(8), 0, 0, set[tuple[bool, bool]]()
    for _ in range(60):
        try:
            found = limit(read_experiment(drawn(rng)))
        except InvalidInput:
            continue
        for maker in MAKERS:
            try:
                certificate = written(maker(Certified(found)))
            except Unprovable:
                refused += 1
                continue
            made += 1
            s = certificate["statement"]
            checker.verify(certificate)
            assert truth(certificate["kind"], s), s
            if "joint_rank" in s:
                ranks.add((s["joint_rank"] == s["observability_rank"], s["joint_rank"] == s["limit_rank"]))
                assert not truth(certificate["kind"], {**s, "limit_rank": s["limit_rank"] + 1})
            else:
                other = [["1"] * len(row) for row in s["D"]]
                assert truth(certificate["kind"], {**s, "D": other}) == (other == s["D"])
    assert made > 60 and refused > 5 and len(ranks) == 4


def test_every_limit_certificate_agrees_with_the_schema() -> None:
    text = resources.files("faultspace.proofs").joinpath("schemas", "certificate.schema.json").read_text("utf-8")
    schema = jsonschema.Draft202012Validator(json.loads(text))
    for about in experiments().values():
        for certificate in limit_certificates(about):
            schema.validate(written(certificate))
            for node in ("statement", "witness"):
                for key in certificate[node]:
                    without = {name: value for name, value in certificate[node].items() if name != key}
                    assert schema.is_valid(written({**certificate, node: without})) == (key in ("limit", "observability"))


def test_no_solution_that_is_only_one_has_no_certificate() -> None:
    unseen = limit(experiment(C=[[0]], s=1))
    for maker, reason in ((Certified.output_error_inputs, "not unique"), (Certified.moesp_inputs, "more than one")):
        with pytest.raises(Unprovable, match=reason):
            maker(Certified(unseen))
    # Two inputs of which the second repeats the first, three samples later: unique all the same, for one state and two samples.
    late = experiment(B=[[1, 0]], D=[[0, 1]], u_filter=[[[1], [0]], [[0], [0]], [[0], [0]], [[0], [1]]], v_filter=[[[0]], [[1]]], s=1)
    checker.verify(Certified(limit(late)).output_error_inputs())


# -- what each refusal keeps out -----------------------------------------------------------------------------------------


def unstable_filter() -> Certificate:
    """u(k) = e(k) - 2 u(k-1) has a solution of its Lyapunov equation, and no stationary covariance."""
    return Certified(limit(replace(experiment(), u_filter=Filter((Matrix.of([[1]]),), (fmpq(1), fmpq(2)))))).past_input_limit()


def unstable_system(monkeypatch: pytest.MonkeyPatch) -> Certificate:
    """Nor has the state of x+ = 2 x + u + v."""
    monkeypatch.setattr(reading, "is_stable", lambda _: True)
    return Certified(limit(experiment(A=[[2]]))).moesp_inputs()


def one_input_twice(monkeypatch: pytest.MonkeyPatch) -> Certificate:
    """u_1 = u_2 is the whole input: B = [0 1] does what B = [1 0] does."""
    about = experiment(B=[[1, 0]], D=[[0, 0]], u_filter=[[[1], [1]]], v_filter=[[[0]]])
    monkeypatch.setattr(limit_certificates_module, "_prime", lambda *_: 2**61 - 1)
    found = InputLimit(Matrix.of([[0, 1]]), Matrix.of([[0, 0]]))
    limits = PopulationLimits(about, covariances(about), None, None, None, found, None)  # type: ignore[arg-type]
    return Certified(limits).output_error_inputs()


def one_input_twice_as_instrument() -> Certificate:
    """The same u has no L, though [M K], [M V], [M K V] have ranks."""
    about = experiment(B=[[1, 0]], D=[[0, 0]], u_filter=[[[1], [1]]], v_filter=[[[0]]], s=1)
    ranks = {"limit_rank": 0, "observability_rank": 0, "joint_rank": 0}
    statement = {"experiment": about.to_json(), "instruments": "past-inputs", **ranks}
    witness = {"prime": 101, "covariance": [[]], "joint": [{"pivot": 0, "row": [1, -1, 0]}]}
    return {**LEADING, "statement": statement, "witness": witness}


def unseen_state(monkeypatch: pytest.MonkeyPatch) -> Certificate:
    """With C = 0 every B predicts the same."""
    monkeypatch.setattr(limit_certificates_module, "_prime", lambda *_: 2**61 - 1)
    return forged_inputs(experiment(C=[[0]], v_filter=[[[0]]]), [[5]], [[0]])


def plain_least_squares() -> Certificate:
    """Return the nearest Toeplitz matrix, without the projection: as if O_s spanned nothing."""
    found = limit(experiments()["coloured"])
    W = found.blocks.yf_uf @ Matrix(QQ, 2, 2, found.blocks.uf_uf.flint.inv())
    B, D = [[str(W[1, 0])]], [[str((W[0, 0] + W[1, 1]) / 2)]]
    certificate = written(Certified(found).moesp_inputs())
    return spoiled(certificate, ("statement.B", B), ("statement.D", D), ("witness.inverse", [["0", "0"]]))


def too_few_rows() -> Certificate:
    """Ranks that are stated one too large, with one row less to show for them."""
    larger = [(f"statement.{name}_rank", lambda rank: rank + 1) for name in ("limit", "observability", "joint")]
    return spoiled(LEADING, *larger, ("witness.joint", lambda rows: rows[1:]))


# Refusal -> something false that this refusal alone stops. What single mutations do not bring about is made here by hand.
FORGED: dict[str, Callable[..., Certificate]] = {
    "the denominator is not stable": unstable_filter,
    "an eigenvalue is not inside the unit circle": unstable_system,
    "the covariance of the inputs may be singular": one_input_twice,
    "the covariance of the inputs may be singular (as an instrument)": one_input_twice_as_instrument,
    "the observability matrix may lose rank": unseen_state,
    "the inverse does not project on the observability matrix": plain_least_squares,
    "the rank modulo the prime is smaller": too_few_rows,
    "the error is correlated with the past inputs": lambda: SEVEN_B,
    "the error is correlated with the present input": lambda: SEVEN_D,
}


@pytest.mark.parametrize("refusal", FORGED)
def test_each_refusal_alone_keeps_something_false_out(refusal: str, monkeypatch: pytest.MonkeyPatch) -> None:
    with monkeypatch.context() as patch:
        maker = FORGED[refusal]
        certificate = written(maker(patch) if "monkeypatch" in signature(maker).parameters else maker())
    reason = refusal.split(" (")[0]
    assert not truth(certificate["kind"], certificate["statement"])
    with pytest.raises(checker.Rejected, match=reason):
        checker.verify(certificate)
    strict = checker.require
    monkeypatch.setattr(checker, "require", lambda condition, why, *error: strict(condition or reason in why, why, *error))
    checker.verify(certificate)


# -- work, and whom a statement is about ------------------------------------------------------------------------------------


def larger(n: int, nu: int, s: int) -> Experiment:
    """Return an experiment with two faults that lead the input, three outputs."""
    rng = Random(n)

    def table(height: int, width: int, bottom: int) -> list[list[str]]:
        return [[f"{rng.randint(-9, 9)}/{bottom}" for _ in range(width)] for _ in range(height)]

    late = [[[int(i == j and lag == 1) for j in range(nu)] for i in range(nu)] for lag in (0, 1)]
    data = {"A": table(n, n, 40), "B": table(n, nu, 3), "C": table(3, n, 2), "D": table(3, nu, 2), "F": table(n, 2, 2), "G": table(3, 2, 3)}
    return read_experiment(data | {"s": s, "past": s, "u_filter": late, "v_filter": [table(2, nu, 2), table(2, nu, 2)]})


def test_ten_states_four_inputs_and_twelve_block_rows_are_within_the_work() -> None:
    for certificate in limit_certificates(larger(10, 4, 12)):
        words = checker.verify(written(certificate)).statement
        assert checker._meter.get().work < checker.MAX_WORK / 2
        assert len(words) < 10_000
        assert "of the stationary process" in words and "are Schur stable" in words


def test_too_long_windows_are_too_much_work() -> None:
    with pytest.raises(checker.Rejected, match="units of work"):
        checker.verify(spoiled(LEADING, ("statement.experiment.s", 4096), ("statement.experiment.past", 4096)))


def test_an_experiment_insisted_on_means_all_of_it_and_a_system_its_matrices() -> None:
    own = LEADING["statement"]["experiment"]
    system = {name: own[name] for name in "AFCG"}
    for about in (own, system, {**system, "B": [["9"]], "D": [["9"]]}, {**own, "w_filter": [[[]]]}, {**own, "field": "Q", "nu": 1}):
        checker.verify(LEADING, [about])
    others = [{**own, "s": 3}, {**own, "past": 2}, {**own, "B": [[2]]}, {**own, "D": [[2]]}, {**own, "w_filter": [[[1]]]}]
    others += [{**own, name: [[["1"]], [["1/3"]]]} for name in ("u_filter", "v_filter")] + [{**system, "A": [["1/3"]]}]
    for other in others:
        with pytest.raises(checker.Rejected, match="the statement is not about"):
            checker.verify(LEADING, [other])
