"""Sentences that users had and that were false: the system or experiment that refutes each, decided anew, and the words, which are gone."""

from __future__ import annotations

import contextlib
import json
import re
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy

import faultspace as fs
from faultspace import exact, numeric
from faultspace.exact.system.systems import read_system
from faultspace.proofs.brought.claim_files import read_claims
from faultspace.proofs.rocq import terms
from faultspace.proofs.verdict.ledger import load
from faultspace.proofs.verdict.verdicts import Verdict, of_readings

ROOT = Path(__file__).parents[2]
PAPERS, LITERATURE = "faultspace/examples/papers.toml", "faultspace/examples/literature.toml"
CLAIMS, CHOICES = "faultspace/examples/claims.toml", "faultspace/examples/choices.toml"
GLOSSARY, CONCEPTS, CONSISTENCY = "docs/glossary.md", "docs/concepts.md", "docs/consistency.md"
README, SENTENCES, SPEED = "README.md", "proofs/verdict/cards.toml", "docs/speed.md"
PAST_OUTPUTS = "numeric/method/model/past_outputs.py"

UNMOVED: dict[str, Any] = {"A": [[0]], "F": [[0]], "C": [[1]], "G": [[0]]}  # a fault that nothing feels

# Strongly observable, so that [K11] has the delay of a known state: it asks for state and fault together.
LATER_UNKNOWN: dict[str, Any] = {"A": [[0, 0], [0, 0]], "F": [[0], [1]], "C": [[0, 1], [1, 0]], "G": [[0], [1]]}
DELAYS = {"delay_known_state": 0, "delay_unknown_state": 1, "invariant_zero_polynomial": ["1"]}

# The words that stood in a file, a system, and what is true of it, which contradicts them.
SYSTEMS: list[tuple[str, str, dict[str, Any], dict[str, Any]]] = [
    ("or unknown ([K11])", GLOSSARY, LATER_UNKNOWN, DELAYS),
    ("[K11] for an unknown one", "exact/structure/inversion.py", LATER_UNKNOWN, DELAYS),
    ("[MZ10], [K11]", "numeric/method/signal/pair_zeros.py", LATER_UNKNOWN, DELAYS),
    (
        "decoupling zeros among them",
        "numeric/audit/RULES.md",
        {"A": [["1/2"]], "F": [[0]], "C": [[1], [0]], "G": [[0], [1]]},
        {"invariant_zero_polynomial": ["1"], "left_invertible": True},
    ),
    (
        "a combination of faults whose effect on the outputs is k samples late",
        GLOSSARY,
        {
            "A": [[0, 0, 0, 0], [0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]],
            "F": [[1, 0], [0, 1], [0, 0], [0, 0]],
            "C": [[0, 1, 0, 0], [1, 0, 1, 1]],
            "G": [[1, 0], [0, 0]],
        },
        {"infinite_zero_orders": [0, 3]},
    ),
    (
        "every finite zero is an unobservable mode",
        PAPERS,
        {"A": [[1, 0], [0, 0]], "F": [[1], [0]], "C": [[1, 0]], "G": [[1]]},
        {"invariant_zero_polynomial": ["0", "0", "1"], "left_invertible": True, "delay_unknown_state": None},
    ),
    (
        '"The inputs can be estimated from the outputs with an error',
        PAPERS,
        {"A": [[2]], "F": [[0]], "C": [[0]], "G": [[1]]},
        {"invariant_zero_polynomial": ["-2", "1"], "delay_unknown_state": 0},
    ),
    (
        '"Without feedthrough and with C F of rank m the input is found one sample late if the state is known;',
        PAPERS,
        {"A": [[0, 0], [0, 2]], "F": [[1], [0]], "C": [[1, 0]], "G": [[0]]},
        {"invariant_zero_polynomial": ["-2", "1"], "delay_unknown_state": 1},
    ),
    (
        "before the fault of a sample is determined",  # v(k) = r(k) - r(k - 1) from k = 1 on
        GLOSSARY,
        {"A": [[1]], "F": [[1]], "C": [[1]], "G": [[1]]},
        {"delay_unknown_state": None},
    ),
    (
        "equations N(q) r = 0 that the outputs obey whatever the faults are",  # q r = r is obeyed by r = 0, of which q^0 is the equation
        GLOSSARY,
        {"A": [], "F": [], "C": [[]], "G": [[]], "n": 0, "m": 0, "p": 1},
        {"left_minimal_indices": [0], "window_ranks": [0, 0, 0]},
    ),
    (
        "it is the number of independent windows that a long and rich record shows",  # one record shows x(0), 0, 0, ...
        CONCEPTS,
        {"A": [[0, 0], [0, 0]], "F": [[], []], "C": [[1, 0], [0, 1]], "G": [[], []], "m": 0, "n": 2, "p": 2},
        {"window_ranks": [2] * 5},
    ),
    *(
        (words, file, UNMOVED, {"left_invertible": False, "left_minimal_indices": [1], "right_minimal_indices": [0], "zeta": 0, **facts})
        for words, file, facts in (
            ('"With one input and one output n less the number of finite zeros is the delay', LITERATURE, {"delay_known_state": None}),
            ('"Without feedthrough C F has full column rank iff every infinite zero', LITERATURE, {"infinite_zero_orders": []}),
            ('iff there are no zeros and no right minimal indices."', LITERATURE, {"n": 1}),
            ('"Without invariant zeros every input is found exactly', PAPERS, {"delay_unknown_state": None}),
            ('"The rank grows by the number of faults at every window', CLAIMS, {"window_ranks": [1] * 4}),
        )
    ),
    (
        "rank C F = rank F, which an observer without delay needs",  # x(k+1) = x(k) / 2 + r(k), from any estimate
        LITERATURE,
        {"A": [["1/2"]], "F": [[1]], "C": [[0]], "G": [[1]]},
        {"invariant_zero_polynomial": ["-1/2", "1"], "delay_unknown_state": 0},
    ),
    (
        'has as many zeros as the system."',  # the choice P = I of A = 0, F = C = 1, G = 0, whose zeta is 1
        CHOICES,
        {"A": [[0]], "F": [[1, 0]], "C": [[1]], "G": [[0, 1]]},
        {"normal_rank": 1, "zeta": 0},
    ),
    (
        "the printed s >= n - 1",  # the review has s >= n, too, and that is enough
        README,
        {"A": [[0, 1], [0, 0]], "F": [[0], [1]], "C": [[1, 0], [0, 0]], "G": [[0], [1]]},
        {"window_ranks": [2, 4, 5, 6, 7], "lag": 2},
    ),
    (
        "If there are no zeros and one fault, F and G are known",  # true of left-invertible systems; here F = 0 explains as much
        CONCEPTS,
        {"A": [[0, 1], [0, 0]], "F": [[0], [1]], "C": [[0, 0]], "G": [[0]]},
        {"zeta": 0, "fault_space_dimension": 2, "left_invertible": False},
    ),
    (
        "that grow or decay like the powers of q",  # a zero at 1: they stay
        GLOSSARY,
        {"A": [[2]], "F": [[1]], "C": [[1]], "G": [[1]]},
        {"invariant_zero_polynomial": ["-1", "1"]},
    ),
    (
        "whose zeros hold all decoupling zeros",  # the system zeros do; -4, which no input moves, is no invariant zero
        LITERATURE,
        {
            "A": [[(1, 1, 3, -4, -1, 3)[i] if i == j else 0 for j in range(6)] for i in range(6)],
            "F": [[0, -1], [-1, 0], [1, -1], [0, 0], [0, 1], [-1, -1]],
            "C": [[1, 0, 0, 1, 0, 0], [0, 1, 0, 1, 0, 1], [0, 0, 1, 0, 0, 1]],
            "G": [[0, 0]] * 3,
        },
        {"invariant_zero_polynomial": ["-2", "-1", "1"], "left_invertible": True},
    ),
    (
        "iff all finite zeros are unobservable modes",  # 0 is one such mode, and a zero twice
        "exact/pairs/no_feedthrough.py",
        {"A": [[0, 0, 0], [0, 0, 0], [0, 1, 0]], "F": [[0], [0], [1]], "C": [[0, 0, 1]], "G": [[0]]},
        {"invariant_zero_polynomial": ["0", "0", "1"], "left_invertible": True, "delay_unknown_state": None},
    ),
]


def text(file: str) -> str:
    return " ".join((ROOT / file).read_text("utf-8").split())


@pytest.mark.parametrize(("words", "file", "system", "facts"), SYSTEMS, ids=[one[0][:40] for one in SYSTEMS])
def test_what_a_system_refutes_is_not_said(words: str, file: str, system: dict[str, Any], facts: dict[str, Any]) -> None:
    found = fs.analyze(read_system(system)).to_json()
    assert {key: found[key] for key in facts} == facts
    assert words not in text(file)


EXPERIMENTS: list[tuple[str, tuple[str, ...], dict[str, Any], dict[str, Any]]] = [
    (
        "what this does to the poles of an experiment is computed exactly",
        (README, SENTENCES),
        {
            **{"A": [["1/2", "1/3"], ["-1/4", "2/5"]], "B": [["1"], ["-2"]], "C": [["1", "0"], ["1", "1"]], "D": [["0"], ["1"]]},
            **{"F": [["1"], ["0"]], "G": [["0"], ["1"]], "s": 3, "past": 3, "u_filter": [[["1", "0"]]]},
            "v_filter": {"num": [[["0", "1"]]], "den": ["1", "-3/4"]},
        },
        {"limit_rank": 3, "A_characteristic_polynomial": None},
    ),
    (
        "past outputs as instruments stay biased whatever N is",  # not under a white fault
        (SPEED,),
        {
            **{"A": [["1/2"]], "B": [["1"]], "C": [["1"]], "D": [["0"]], "F": [["1"]], "G": [["1"]]},
            **{"s": 2, "past": 2, "u_filter": [[["1", "0"]]], "v_filter": [[["0", "1"]]]},
        },
        {"equals_observability_range": True, "A_characteristic_polynomial": ["-1/2", "1"]},
    ),
    (
        "The model is biased where a fault or a disturbance is coloured",  # v(k) = e(k) + e(k-1) / 2, which is seen a sample later
        (PAST_OUTPUTS,),
        {
            **{"A": [["1/2"]], "B": [["1"]], "C": [["1"]], "D": [["0"]], "F": [["1"]], "G": [["0"]]},
            **{"s": 2, "past": 2, "u_filter": [[["1", "0"]]], "v_filter": [[["0", "1"]], [["0", "1/2"]]]},
        },
        {"equals_observability_range": True, "A_characteristic_polynomial": ["-1/2", "1"]},
    ),
    (
        "One sign only: with white u the limit lies in the range",
        (CONSISTENCY,),
        {
            **{"A": [["1/2"]], "B": [["1"]], "C": [["1"], ["2"]], "D": [["0"], ["0"]], "F": [["1"]], "G": [["1"], ["0"]]},
            **{"s": 2, "past": 3, "u_filter": [[["1"]]], "v_filter": [[["0"]], [["2"]]]},
        },
        {"limit_rank": 2, "within_observability_range": False},
    ),
    (
        "the range is always found",
        (CONSISTENCY,),
        {
            **{"A": [["1/2"]], "B": [["0"]], "C": [["1"]], "D": [["0"]], "F": [["0"]], "G": [["0"]]},
            **{"s": 2, "past": 3, "u_filter": [[["1"]]], "v_filter": [[["0"]]]},
        },
        {"limit_rank": 0, "contains_observability_range": False},
    ),
]


@pytest.mark.parametrize(("words", "files", "experiment", "facts"), EXPERIMENTS, ids=[one[0][:40] for one in EXPERIMENTS])
def test_what_an_experiment_refutes_is_not_said(
    words: str, files: tuple[str, ...], experiment: dict[str, Any], facts: dict[str, Any]
) -> None:
    found = fs.limit(experiment).to_json()
    outputs = found["past_outputs"] if files[0] in (README, SPEED, PAST_OUTPUTS) else found
    assert {key: outputs[key] for key in facts} == facts
    assert not [file for file in files if words in text(file)]


def test_excitation_of_order_l_is_not_enough_for_almost_every_state_with_two_inputs() -> None:
    for x0 in ([0, 0], [1, 2], [Fraction(3, 7), -5]):
        columns = [[*x0, 1, 0], *([0, 1, 1, 0] if k % 2 else [1, 0, 0, 1] for k in range(20))]
        assert sympy.Matrix(columns).rank() == 3 < 4, "x(k+1) = u(k), u = e1, e2, e1, ..."
    assert "order L is enough for almost every initial state," not in text(LITERATURE)


def test_the_words_of_a_claim_of_literature_hold_where_its_numbers_do() -> None:
    """Where one has been refuted by hand, the words are those of the numbers that are compared."""
    claims = {one.id: one for one in read_claims((ROOT / LITERATURE).read_text("utf-8"))}
    assert "at least as many zeros as uncontrollable modes" in claims["decoupling-zeros-of-tall-systems"].statement
    assert "Fitch" not in text(PAPERS), "arXiv 1509.06226 has two authors"
    assert claims["past-and-future"].statement.startswith("In a minimal system"), "A = C = 1, B = D = 0, x(0) = 0: 1 + 1 - 2 dimensions"
    assert "With such an excitation" in claims["lemma-uncontrollable"].statement, "u = 0"


STEMS = {
    **{"left_invertible": ("invert", "left inverse"), "observable": ("observ",), "minimal": ("minimal",)},
    **{"controllable": ("controll",), "is_zero(G)": ("feedthrough",)},
}
BACK = ("Then ", "It ", "Under the same conditions ", "Where the system is observable, that rank ")  # of the statement before


@pytest.mark.parametrize("name", ["literature", "papers", "claims", "choices", "records"])
def test_what_is_not_refuted_has_its_hypotheses_in_its_words(name: str) -> None:
    for one in read_claims((ROOT / f"faultspace/examples/{name}.toml").read_text("utf-8")):
        if "REFUTED" in {str(verdict) for verdict in one.expected.values()} or one.statement.startswith(BACK):
            continue
        for hypothesis in one.hypotheses:
            stems = STEMS.get(hypothesis.label.removeprefix("inputs.").removeprefix("chosen."), ("",))
            assert any(stem in one.statement.lower() for stem in stems) or one.id == "delay-by-controllability", (one.id, hypothesis.label)


def test_places_in_the_review_are_those_where_it_has_the_claim() -> None:
    references = {one.id: one.reference for one in load()}
    assert all("'If this is right'" in references[one] for one in ("zero-feedthrough", "trajectory-recovered"))
    assert "'Reading between the lines'" in references["canonical-form"] and "(i)" not in references["theorem-3-i"]
    assert {one for one, place in references.items() if "section" in place.lower()} == {"example-v"}


def test_a_claim_is_amended_only_where_every_reading_of_it_or_of_a_part_is_refuted() -> None:
    claims = {one.id: one for one in load()}
    for one in claims.values():
        assert of_readings([(each, Verdict(each.expected)) for each in one.readings], in_parts=one.in_parts) == one.expected, one.id
    windows = {"language.assumption-4--n-minus-1-known", "language.assumption-4--n-known"}  # the review prints both
    for name in ("assumption-4", "proposition-3", "settle-2"):
        assert windows <= {each.check for each in claims[name].readings if not each.repair}, name
    allowed = {"one-sided", "n-minus-1", "n", "excitation", "excitation-at-s", "excitation-of-both", "window-n"}
    for name in ("assumption-2", "proposition-3", "settle-2", "problem-11"):
        assert {each.id for each in claims[name].readings if not each.repair} <= allowed, "a reading that no words of the review allow"
    assert {one.id for one in claims.values() if one.expected == "AMENDED"} == {
        *("assumption-2", "proposition-1", "problem-11", "zero-feedthrough", "past-outputs")
    }


def test_theorems_are_cited_with_what_they_suppose() -> None:
    """The bound on singular values is of independent entries, and a Hankel matrix has others; not every signal has time averages."""
    ratios = []
    for seed in range(10):
        errors = np.random.default_rng(seed).standard_normal(1000)
        windows = np.lib.stride_tricks.sliding_window_view(errors, 200)
        ratios.append(np.linalg.norm(windows, 2) / sum(np.sqrt(windows.shape)))
    assert max(ratios) > 1.1 > np.linalg.norm(np.random.default_rng(1).standard_normal((801, 200)), 2) / sum(np.sqrt((801, 200)))
    assert "white noise of the estimated level could reach" not in text("numeric/method/ranks/rank_gap.py")
    assert "singular values of E lie within" not in text("numeric/method/ranks/hankel_ranks.py")

    power = np.array([k.bit_length() % 2 for k in range(1, 2**16)])  # its mean up to 2^j has no limit: 1/3 and 2/3 in turn
    means = np.cumsum(power) / np.arange(1, 2**16)
    assert abs(means[2**14 - 2] - means[2**15 - 2]) > 0.3
    assert "where it exists: quasi-stationary signals in Ljung's sense" not in text(CONSISTENCY)

    assert "as long as lags^3 / N stays bounded [LR85]" not in text("numeric/method/model/arx_windows.py"), "it has to vanish"
    assert "[VV07] calls R.T the L" not in text("numeric/method/model/sequential_qr.py"), "it has an RQ factorisation"
    assert "[K80] 6.3" not in text(LITERATURE), "polynomial matrices: indices of observability stand elsewhere"


OVERSAID = (
    *("the review calls", "the review's section", "the review's sentence"),  # the caption that it quotes does, and the paper has sections
    *(" as printed", "as the paper has it", "every packaged", "no packaged tool", "ranks 6 and 7"),
    *("every claim of the paper", "for all systems and dimensions"),
)


@pytest.mark.parametrize("words", OVERSAID)
def test_words_that_say_more_than_is_known_are_gone(words: str) -> None:
    """The paper's text was not at hand, tools that were not measured have no past outputs, and the review speaks of no ranks 6 and 7."""
    folders = ["docs", "docs/start", "docs/tutorials", "faultspace", "faultspace/cli", "faultspace/review", "faultspace/review/templates"]
    folders += ["faultspace/review/view", "faultspace/examples", "proofs/verdict", "proofs/claims", "proofs/evidence"]
    folders += ["numeric/method/model", "exact/limits"]
    pages = [page for folder in folders for page in (ROOT / folder).iterdir() if page.suffix in (".md", ".py", ".toml", ".html")]
    shown = [ROOT / README, *(page for page in pages if page.name != "history.md")]
    assert len(shown) > 100
    assert [page.name for page in shown if words in page.read_text("utf-8").lower()] == []


def test_a_counterexample_need_not_be_of_the_box_nor_a_certificate_of_one_system() -> None:
    (answer,) = fs.claim("lag <= 1", box={"n": [1, 1], "m": [1, 1], "p": [1, 1]}).answers
    assert answer.tried.exhausted and answer.counterexample is not None and answer.counterexample.system.n == 2
    (answer,) = fs.claim("n <= 1", box={"n": [0, 2], "m": [0, 1], "p": [0, 1]}, most=3).answers
    assert answer.counterexample is not None and answer.counterexample.system.n == 2 and "outside the box" not in answer.summary()
    assert "the smallest one of a stated box of systems is shown" not in text(GLOSSARY)
    about = [json.loads(file.read_text("utf-8"))["statement"] for file in (ROOT / "proofs/certificates").glob("behaviour-equality-*.json")]
    assert about and all({"first", "second"} <= set(one) for one in about)
    for file in (GLOSSARY, "docs/decisions.md", "docs/tutorials/read-a-certificate.md"):
        assert "statement about one system" not in text(file) and "Certificates speak of one system" not in text(file)


def test_what_rocq_states_of_a_certificate_is_spelled_out() -> None:
    """The pages named two words of files of proofs, which the statements have no more."""
    words = set(re.findall(r"[a-z_]+", terms.determines("S", "true", "l") + terms.AT_FIRST))
    for word in ("determines", "unit_fault"):
        assert word not in words
        assert not [page for page in ("docs/checking.md", "proofs/trust/FORMAT.md") if f"`{word}`" in text(page)]


def test_what_has_no_example_is_not_said_to_have_one() -> None:
    without = {name for name in dir(fs) if ">>>" not in (getattr(fs, name).__doc__ or "")}
    assert without == {"__version__", "exact", "numeric", "proofs"}, "README says it of functions and classes alone"
    assert "every one has a docstring with an example" not in text(README)


def test_a_claim_that_is_proved_is_not_refuted_either(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The exit code is 0 where NOT REFUTED is expected and it is PROVED; the page said 1."""
    from faultspace.cli.command_line import main

    file = tmp_path / "claims.toml"
    file.write_text('[claim.lag]\nconclusion = "lag <= n"\nbox = { total = 3 }\nexpected = "NOT REFUTED"\n')
    assert main(["claim", str(file), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["claims"][0]["verdict"] == "PROVED"
    assert "PROVED serving for NOT REFUTED" in text("docs/your-claims.md")


def test_tools_and_limits_are_told_as_they_are() -> None:
    methods = (ROOT / "benchmarks/identification_methods.py").read_text("utf-8")
    assert re.search(r'Method\("fault-id", .*"past inputs"', methods), "the author's program was measured, and has no past outputs"
    files = ("proofs/verdict/ledger.toml", "exact/limits/column_space.py", PAST_OUTPUTS)
    assert not [file for file in (README, SENTENCES, CONSISTENCY, *files) if "every subspace tool" in text(file)]
    experiment = json.loads((ROOT / "faultspace/examples/independent-fault.json").read_text("utf-8"))
    assert "L" not in fs.limit(experiment).to_json() and "`faultspace limit` prints it" not in text(CONSISTENCY)


def test_what_the_audit_says_of_its_checks() -> None:
    from faultspace.numeric.audit.checks.catalogue import all_checks
    from faultspace.numeric.audit.checks.growth import LENGTHS

    assert any(check.claim is None for check in all_checks()) and "each check names the claim it rests on" not in text("docs/your-code.md")
    assert f"Records have up to {2 * LENGTHS[1]} samples" in text("numeric/audit/PROTOCOL.md"), "time is looked at there where it leaps"


def test_windows_that_are_too_short_are_not_taken_for_noise() -> None:
    """The answer is that of windows of 2 and 3 samples, by ranks: as many faults as outputs on one vector, the gap at 1 on another."""
    from faultspace.numeric.audit import reference

    class Short:
        @staticmethod
        def fault_dimension(r: Any) -> int:
            _, two, three = reference.window_ranks(r, 3)
            return three - two

    words = [record.explanation for record in fs.audit(Short, only=["fault-dimension"]).failed]
    assert any(words) and all("too short" in one for one in words if "as outputs" in one or "R_2" in one)
    assert "Nothing of that is guessed" not in text("numeric/audit/README.md")


def test_fields_of_claims_are_prime() -> None:
    with pytest.raises(fs.errors.InvalidInput, match="prime q up to 97"):
        fs.claim("lag <= n", fields=["GF(4)"])
    assert "may name finite fields" not in text("docs/your-claims.md")


def test_what_the_exact_branch_says_of_its_answers() -> None:
    """Shapes are those of the pair; all columns are the limit on no sample, too; names and spaces can stay the same."""
    one, many = exact.ResidualSystem.of([[0]], [[1]], [[1]], [[0]]), exact.ResidualSystem.of([[0]], [[1, 1]], [[1]], [[0, 0]])
    recovery = exact.recoverable_pair(exact.exceptional(many))
    assert recovery.left_inverse.nrows == 1 < many.m and "m x p(delay + 1)" not in text("exact/pairs/assignment.py")
    none, limit = exact.fault_space(one, 0), exact.fault_space(one)
    assert none.basis == limit.basis and none.window == 0 < limit.exact_from and "may include" in str(none.warning)
    assert "is the least window at which the limit is reached" not in text("exact/structure/fault_columns.py")
    other = exact.ResidualSystem.of([[0]], [[2]], [["1/2"]], [[0]])  # in another basis of the state
    assert exact.feedback_class(one) == exact.feedback_class(other)
    assert "a change of basis of the state changes the class" not in text("exact/pairs/canonical_form.py")
    direct = exact.ResidualSystem.of([[0]], [[0]], [[0]], [[1]])
    data = exact.simulate(direct, [[0]], [[1], [0]])  # [X; V_1] has rank 1 of 2
    assert exact.data_fault_space(data.residuals, direct.A, direct.C, s=1) == exact.fault_space(direct, 1).basis
    assert "excites less leaves more null rows" not in text("exact/structure/signals.py")


def test_what_exists_for_some_system_is_not_said_of_each() -> None:
    system = exact.ResidualSystem.of([[0]], [[1]], [[1]], [[0]])
    assert "reason" in exact.bad_pair(exact.exceptional(system)).to_json(), "no P of full column rank is bad"
    page = text("docs/your-claims.md")
    assert "they say that something exists for each system" not in page
    windows = {one.id: one for one in load()}["sharp-windows"].readings
    assert {one.id for one in windows if one.statement.startswith(("Some system", "It can be chosen"))} == {
        one.id for one in windows if f"claim.sharp-windows--{one.id}" not in text("faultspace/examples/ledger.toml")
    }
    assert "`sharp-windows` in part | sums over lists" not in page, "what is not said there is that a system exists"


def least(accepted: Callable[[int], object]) -> int:
    """Return the least number of samples that is not refused."""
    for samples in range(1, 400):
        with contextlib.suppress(fs.errors.InvalidData):
            accepted(samples)
            return samples
    raise AssertionError("every number is refused")


def test_docstrings_say_what_is_refused() -> None:
    draw = np.random.default_rng(1)
    y, u = draw.standard_normal((400, 3)), draw.standard_normal((400, 1))
    assert [least(lambda N, p=p: numeric.healthy_reference(y[:N, :p])) for p in (1, 2)] == [256, 256]  # type: ignore[misc]
    assert "fewer than 64 samples a channel, channels" not in text("numeric/plant/healthy/healthy_model.py")
    assert least(lambda N: numeric.count_faults(y[:N, :2], u[:N], order=1)) == 2 * 3 * (2 + 1) + 2, "rows of degree 2, not 4"
    assert "rows of degree order + 3, outputs" not in text("numeric/method/rows/fault_count.py")
    A, C = np.diag([0.1, 0.8]), np.array([[1.0, 1.0], [1.0, 2.0], [3.0, 1.0]])
    assert least(lambda N: numeric.fault_space_by_rows(y[:N], u[:N], A, C, n_v=1)) == 2 * 4 * (2 + 1) + 2, "two rows, degrees 1 and 2"
    assert "too short for rows of degree n + 1" not in text("numeric/method/rows/space_by_rows.py")
    one, three = (numeric.StateSpaceModel(np.eye(n) / 2, np.ones((n, 1)), np.ones((p, n)), np.zeros((p, 1))) for n, p in ((1, 1), (3, 2)))
    assert least(lambda N: numeric.residual(y[:N, :1], u[:N], one)) == least(lambda N: numeric.residual(y[:N, :2], u[:N], three)) == 2
    assert "fewer than n samples" not in text("numeric/method/model/residuals.py")


def test_what_is_said_of_lags_constants_and_faults_without_effect() -> None:
    draw = np.random.default_rng(1)
    y, u = draw.standard_normal((400, 2)), draw.standard_normal((400, 1))
    assert numeric.arx_reduction(y, u, order=7, lags=4).order == 7
    with pytest.raises(fs.errors.InvalidData, match=r"^lags: got 2; order 7 with 2 outputs needs 4 or more: pass more lags$"):
        numeric.arx_reduction(y, u, order=7, lags=2)  # 400 samples do not "carry 2 lags"
    assert numeric.fault_dimension(np.hstack([y[:, :1], np.ones((400, 1))])).channel_scales.shape == (2,), "one constant output is taken"
    assert "NaN, constant or too few" not in text("numeric/method/ranks/rank_gap.py")
    unseen = numeric.reconstruct_fault(y, np.diag([0.5, 0.3]), [[0.0], [1.0]], [[1.0, 0.0], [0.0, 0.0]], np.zeros((2, 1)))
    assert unseen.delay is None and "a fault without any effect" not in text("numeric/method/signal/reconstruction.py")


def test_what_is_said_of_modes_and_autoregressions() -> None:
    from faultspace.numeric.plant.report.physical import modes

    grows, turns = modes([2.0, -0.5], 1.0)
    page = text("numeric/plant/report/physical.py")
    assert grows.damping == -1.0 and "`damping`, 1 for a pole that does not oscillate" not in page
    assert turns.frequency > 0.51 and "told as an oscillation at the Nyquist frequency" not in page

    system = {"A": [["1/2"]], "B": [[0]], "C": [[1]], "D": [[1]], "F": [["1/2"]], "G": [[1]]}  # y = u + d, d(k) = d(k-1) / 2 + e(k)
    found = exact.arx_limit(exact.read_experiment({**system, "s": 1, "past": 1, "u_filter": [[[1, 0]]], "v_filter": [[[0, 1]]]}), 1)
    assert found.outputs[1] == exact.Matrix.of([["-1/2"]]), "1 - 2 q^-1 makes d white as well"
    assert "Where Abar(q) d is white, and Abar G" not in text("exact/limits/autoregression.py")
