"""The locks refuse each headline and each word that is changed, and name it; and nothing that is only written in another way."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import replace
from importlib import resources
from pathlib import Path
from types import SimpleNamespace

import pytest

from docs.tools.pages import statements
from faultspace.proofs import verification
from faultspace.proofs.brought import claiming
from faultspace.proofs.brought import theorems as proofs_in_the_language
from faultspace.proofs.rocq import locks as rocq_locks
from faultspace.proofs.rocq.build import BrokenTheory, NotProved, compile_file
from faultspace.proofs.rocq.locks import held, kept, made, written
from faultspace.proofs.rocq.sources import THEORY, sources
from faultspace.proofs.rocq.statements import Headline, read
from faultspace.proofs.rocq.theorems import parted
from faultspace.proofs.verdict.ledger import load
from faultspace.proofs.verdict.verdicts import Verdict
from tests.proofs.test_rocq_headlines import CHANGES

TEXTS = sources()
STATEMENTS = read(TEXTS)
LOCKED = kept()
NOT_AS_READ = "what stands under {} in the ledger, or in the language of claims, is not what was read with the theorems"
WORDS = sorted({word.key: word for words in STATEMENTS.words.values() for word in words.values()}.items())


def changed(file: str, old: str, new: str) -> dict[str, str]:
    """Returns our sources with one text of one file changed."""
    assert TEXTS[file].count(old) >= 1 and old != new, (file, old)
    return {**TEXTS, file: TEXTS[file].replace(old, new, 1)}


def source(headline: Headline) -> str:
    """Returns the statement as it stands in its file, with its line breaks."""
    m = re.search(rf"^Theorem {headline.name}\b(.*?)\.\nProof\.", TEXTS[headline.file], re.MULTILINE | re.DOTALL)
    assert m is not None
    return m[0]


def with_hypothesis(headline: Headline) -> str:
    """Returns the statement with one hypothesis more: that S is observable, where it speaks of one S, and a trivial one elsewhere."""
    binders, stated = parted(headline.statement)
    more = "observable S" if "(S : system" in binders else "(0 < 1)%N"
    return f"Theorem {headline.name} {binders} : {more} -> ({stated}).\nProof."


def test_the_statements_are_those_that_are_locked() -> None:
    locks = held(TEXTS)
    assert locks == kept() and set(locks.theorems) == set(STATEMENTS.headlines)
    assert all(re.fullmatch("[0-9a-f]{64}", lock.sha256) for lock in locks.theorems.values())


def test_the_file_of_the_locks_is_current() -> None:
    """A change that is wanted is locked by python -m faultspace.proofs.rocq.locks."""
    assert THEORY.joinpath("locks.json").read_text("utf-8") == written(made(TEXTS))


def test_readings_theorems_and_locks_stand_side_by_side() -> None:
    text, locks = statements(), made(TEXTS)
    rows = [line for line in text.splitlines() if line.startswith("| ") and re.search(r"`[0-9a-f]{64}` \|$", line)]
    listed = {name: row for row in rows if (name := re.split(r"` ?Theorem ", row)[1].split()[0])}
    assert set(listed) == set(locks.theorems) and all(lock.sha256 in listed[name] for name, lock in locks.theorems.items())
    for row in rows:
        assert len(re.split(r"(?<!\\)\|", row)) == 6, row[:200]
    for claim in load():
        for reading in claim.readings:
            if reading.theorems:
                row = next(row for row in rows if row.startswith(f"| {claim.id}: {reading.id} |"))
                assert " ".join(reading.statement.split())[:40] in row and f"Theorem {reading.theorems[0]} " in row


def restated(statement: Callable[[Headline], str]) -> list[str]:
    """Return what the locks say is different where every headline is stated in this way; of each only its own lock can say it."""
    texts = dict(TEXTS)
    for headline in STATEMENTS.headlines.values():
        texts[headline.file] = texts[headline.file].replace(source(headline), statement(headline), 1)
    with pytest.raises(NotProved, match="the statements are not as locked: the headline "):
        held(texts)
    return [*rocq_locks.differences(LOCKED, made(texts))]


@pytest.mark.mutants
def test_changed_headlines_are_not_as_locked() -> None:
    said = restated(lambda one: f"Theorem {one.name}{one.statement.replace(*CHANGES[one.name])}.\nProof.")
    assert len(said) == len(CHANGES) == len(STATEMENTS.headlines)
    assert all(one.startswith(f"the headline {name} says") for one, name in zip(said, sorted(CHANGES), strict=True))


@pytest.mark.mutants
def test_headlines_with_one_hypothesis_more_are_not_as_locked() -> None:
    said = restated(with_hypothesis)
    more = r"the headline {} says .*(?:observable S|\(0 < 1\)%N) -> "
    assert all(re.match(more.format(name), one) for one, name in zip(said, sorted(STATEMENTS.headlines), strict=True))


@pytest.mark.programs
@pytest.mark.mutants
@pytest.mark.timeout(900)
def test_the_hypothesis_is_one_that_proofs_alone_do_not_refuse(theory: Path) -> None:
    """With the same lemma and one name more in the proof, Rocq accepts it, and closed: what refuses it is the lock."""
    headline = STATEMENTS.headlines["proposition_3_normal_rank"]
    opening = TEXTS[headline.file].split("(** ** ")[0]
    weakened = with_hypothesis(headline).replace("Proof.", f"Proof. move=> _; {headline.tactics} Qed.")
    said = compile_file(theory, "Weakened.v", f"{opening}\n{weakened}\nPrint Assumptions {headline.name}.\n")
    assert said.strip() == "Closed under the global context"
    with pytest.raises(BrokenTheory, match="does not compile"):
        compile_file(theory, "Weakened.v", f"{opening}\n{with_hypothesis(headline)} {headline.tactics} Qed.\n")


@pytest.mark.mutants
def test_changed_words_are_not_as_locked() -> None:
    texts = dict(TEXTS)
    for number, (_, word) in enumerate(WORDS):
        start = re.search(rf"^(?:Definition|Fixpoint|Record|Notation) {word.name.split('.')[-1]}\b", texts[word.file], re.MULTILINE)
        assert start is not None
        begin, end = texts[word.file][: start.start()], texts[word.file][start.start() :]
        old, new = ("{", f"{{ extra{number} : nat;") if end.startswith("Record") else (":=", ":= (*only a comment*) id")
        texts[word.file] = begin + end.replace(old, new, 1)
    with pytest.raises(NotProved, match="the statements are not as locked: the word "):
        held(texts)
    said = [*rocq_locks.differences(LOCKED, made(texts))]
    assert [key for key, _ in WORDS if not any(one.startswith(f"the word {key} says") for one in said)] == []


@pytest.mark.parametrize(
    "file, old, new, reason",
    [
        ("Vocabulary.v", "(K : fieldType) (n m p : nat).", "(K : realFieldType) (n m p : nat).", "the word Vocabulary."),
        ("Vocabulary.v", "Implicit Types (S : system)", "Implicit Types (S : nat)", "the word Vocabulary."),
        ("Vocabulary.v", "Local Open Scope ring_scope.", "Local Open Scope nat_scope.", "what Vocabulary.v opens with"),
        ("Vocabulary.v", "Import GRing.Theory.", "Import GRing.Theory Num.Theory.", "what Vocabulary.v opens with"),
        ("HeadlinesMore.v", "Local Open Scope ring_scope.", "Local Open Scope nat_scope.", "what HeadlinesMore.v opens with"),
        ("Lists.v", "Canonical number_rmorphism", "Canonical number_morphism", "may change how statements are read"),
        ("Basics.v", "Local Open Scope", "Coercion f : a >-> b.\nLocal Open Scope", "Basics.v has Coercion"),
        ("Basics.v", "Local Open Scope", 'Notation "a %| b" := True.\nLocal Open Scope', "may change how statements are read"),
        ("Lag.v", "Set Implicit", "Axiom absurd : False.\nSet Implicit", "Lag.v has Axiom"),
        ("Gap.v", "Qed.", "Admitted.", "Gap.v has Admitted"),
        ("Gap.v", "Qed.", "Qed.\nUnset Guard Checking.", "Gap.v has Unset Guard"),
    ],
)
def test_what_else_may_change_a_statement_is_noticed(file: str, old: str, new: str, reason: str) -> None:
    with pytest.raises(NotProved, match=re.escape(reason)):
        held(changed(file, old, new))


def test_a_headline_or_word_that_comes_or_goes_is_noticed() -> None:
    locks = kept()
    fewer = replace(locks, theorems={name: lock for name, lock in locks.theorems.items() if name != "theorem_1"})
    with pytest.raises(NotProved, match="the headline theorem_1 has no lock"):
        held(TEXTS, fewer)
    start = TEXTS["Headlines.v"].index("Theorem theorem_1 ")
    end = TEXTS["Headlines.v"].index("Qed.\n", start) + len("Qed.\n")
    with pytest.raises(NotProved, match="the headline theorem_1 is locked and is not there"):
        held({**TEXTS, "Headlines.v": TEXTS["Headlines.v"][:start] + TEXTS["Headlines.v"][end:]})
    with pytest.raises(NotProved, match=r"the lock of theorem_1 is not the SHA-256"):
        held(TEXTS, replace(locks, theorems={**locks.theorems, "theorem_1": replace(locks.theorems["theorem_1"], sha256="0" * 64)}))
    with pytest.raises(NotProved, match=r"the word Vocabulary\.more is locked and is not there, which 0 headlines use"):
        held(TEXTS, replace(locks, words={**locks.words, "Vocabulary.more": "Definition more := 1."}))
    with pytest.raises(NotProved, match="more than they need"):
        held(TEXTS, replace(locks, far=(*locks.far, locks.far[0])))
    with pytest.raises(NotProved, match=r"the word Vocabulary\.gap is not locked"):
        held(TEXTS, replace(locks, words={key: text for key, text in locks.words.items() if key != "Vocabulary.gap"}))


def test_a_reading_is_locked_with_its_theorems(monkeypatch: pytest.MonkeyPatch) -> None:
    """Words that say more, theorems of another reading and its check were PROVED with exit 0, as was any theorem that is true."""
    claims = load()
    readings = [one for claim in claims for one in claim.readings]
    for claim in claims:
        for one, other in zip(claim.readings, readings[::-1], strict=False):
            changes = {"statement": f"{one.statement} Always."}, {"theorems": other.theorems}, {"check": other.check}, {"hypotheses": ()}
            for spoilt in (replace(one, **change) for change in changes):
                forged = replace(claim, readings=tuple(spoilt if kept is one else kept for kept in claim.readings))
                ledger = [forged if kept is claim else kept for kept in claims]
                monkeypatch.setattr(rocq_locks, "load", lambda ledger=ledger: ledger)
                said = [*rocq_locks.differences(LOCKED, replace(LOCKED, readings=made({}).readings))]
                assert said == ([] if spoilt == one else [NOT_AS_READ.format(f"{claim.id}.{one.id}")])


def test_what_makes_a_claims_verdict_of_its_readings_is_locked(monkeypatch: pytest.MonkeyPatch) -> None:
    """A claim with alternatives was AMENDED, as expected, where the ledger said that these are parts that all must hold."""
    claims = load()
    for claim in claims:
        changes = {"in_parts": not claim.in_parts}, {"reference": "ours"}, {"expected": "IDENTITY"}, {"uses": (claim.id,)}
        for spoilt in (replace(claim, **change) for change in changes):
            ledger = [spoilt if kept is claim else kept for kept in claims]
            monkeypatch.setattr(rocq_locks, "load", lambda ledger=ledger: ledger)
            said = [*rocq_locks.differences(LOCKED, replace(LOCKED, readings=made({}).readings))]
            assert said == ([] if spoilt == claim else [NOT_AS_READ.format(claim.id)])


@pytest.mark.parametrize("place", [0, len(load())])
def test_a_claim_with_the_name_of_something_else_has_no_lock_of_its_own(monkeypatch: pytest.MonkeyPatch, place: int) -> None:
    """One without readings had the lock of a reading, of a hypothesis dropped or of a theorem, where it stood before them."""
    claims = [*load()]
    for name in (f"{claims[0].id}.{claims[0].readings[0].id}", *(one for one in made(TEXTS).readings if ": " in one)):
        forged = [*claims[:place], replace(claims[0], id=name, statement="forged", readings=()), *claims[place:]]
        monkeypatch.setattr(rocq_locks, "load", lambda forged=forged: forged)
        with pytest.raises(NotProved, match="one name twice"):
            rocq_locks._readings()
        monkeypatch.undo()


@pytest.mark.parametrize(
    ("file", "old", "new", "name"),
    [
        ("theorems.toml", 'conclusion = "lag <= n"', 'conclusion = "zeta <= 50"', "theorems.toml: lag-at-most-n"),
        ("theorems.toml", 'names = ["proposition_3"]', 'names = ["lag_at_most_n"]', "theorems.toml: growth"),
        ("ledger.toml", "for s in windows(max(delay_known, n))", "for s in windows(n + 99)", "ledger.toml: assumption-4--n-known"),
    ],
)
def test_what_the_language_says_of_theorems_is_locked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, file: str, old: str, new: str, name: str
) -> None:
    """`claim` took what was written there for what Rocq has proved, and `verify` what it decided there for the reading."""
    for package, path, _ in rocq_locks.IN_THE_LANGUAGE:
        (place := tmp_path.joinpath(package, *path)).parent.mkdir(parents=True)
        text = resources.files(package).joinpath(*path).read_text("utf-8")
        place.write_text(text.replace(old, new, 1) if path[-1] == file else text, "utf-8")
        assert path[-1] != file or old in text
    monkeypatch.setattr(rocq_locks, "resources", SimpleNamespace(files=lambda package: tmp_path / package))
    with pytest.raises(NotProved, match=re.escape(NOT_AS_READ.format(name))):
        held(TEXTS)
    monkeypatch.setattr(proofs_in_the_language, "_locks", proofs_in_the_language._locks.__wrapped__)
    with pytest.raises(NotProved):
        claiming.claim("zeta <= n", box={"total": 3}, ablation=False)


@pytest.mark.parametrize("theorems", [True, False])
def test_a_run_is_in_error_where_a_reading_is_not_as_locked(monkeypatch: pytest.MonkeyPatch, theorems: bool) -> None:
    """Also a reading that no theorem says; what was forged is the first of the claim."""
    claims = load()
    claim = next(one for one in claims if one.id == "example-v")
    first, *others = (one if theorems else replace(one, theorems=()) for one in claim.readings)
    forged = replace(claim, readings=(replace(first, statement="Every window is long enough."), *others))
    for module in rocq_locks, verification:
        monkeypatch.setattr(module, "load", lambda: [forged if one.id == forged.id else one for one in claims])
    monkeypatch.setattr(verification, "_believed", lambda: None)
    report = verification.verify("example-v", jobs=1)
    assert not report.as_expected
    assert {one.outcome.verdict for one in report.claims[0].readings} == {Verdict.ERROR}
    assert NOT_AS_READ.format(f"example-v.{first.id}") in report.machine


def test_comments_and_line_breaks_change_nothing() -> None:
    spread = {name: re.sub(r"(?<=[\w)]) (?=[:=(])", "  (* a. comment *)\n ", text) for name, text in TEXTS.items()}
    texts = {**TEXTS, **{name: spread[name] for name in ("Vocabulary.v", "CertificatesVocabulary.v")}}
    assert texts["Vocabulary.v"] != TEXTS["Vocabulary.v"] and held(texts) == held(TEXTS)
    more = "Lemma a_new_lemma : True. Proof. by []. Qed.\nLemma gap_le_outputs"
    assert held(changed("Gap.v", "Lemma gap_le_outputs", more)) == held(TEXTS)


@pytest.mark.parametrize("text", ["", "{}", "[]", '{"theorems": {"a": {}}}', '{"theorems": 1, "words": {}, "openings": {}, "far": []}'])
def test_locks_that_cannot_be_read_are_no_locks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    monkeypatch.setattr(rocq_locks, "THEORY", tmp_path)
    with pytest.raises(NotProved, match="cannot be read: FileNotFoundError"):
        kept()
    (tmp_path / "locks.json").write_text(text, "utf-8")
    with pytest.raises(NotProved, match="cannot be read"):
        held(TEXTS)


def test_the_command_locks_a_wanted_change(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    wanted = changed("Headlines.v", "(lag S <= n)%N", "(lag S <= n.+1)%N")
    monkeypatch.setattr(rocq_locks, "THEORY", tmp_path)
    monkeypatch.setattr(rocq_locks, "sources", lambda: wanted)
    (tmp_path / "locks.json").write_text(written(made(TEXTS)), "utf-8")
    assert rocq_locks.main() == 0
    assert "the headline lag_at_most_n says" in capsys.readouterr().out
    data = json.loads((tmp_path / "locks.json").read_text("utf-8"))
    assert held(wanted) == kept() and "n.+1" in data["theorems"]["lag_at_most_n"]["statement"]
    assert rocq_locks.main() == 0 and capsys.readouterr().out == "nothing is different\n"
    monkeypatch.setattr(rocq_locks, "sources", lambda: {**wanted, "Headlines.v": "Definition a := 1.\n"})
    assert rocq_locks.main() == 1 and "theorems alone" in capsys.readouterr().err
