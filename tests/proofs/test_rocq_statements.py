"""The statements are read whole from the sources: files of headlines hold theorems alone, and all words are in the vocabularies."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from faultspace.proofs.rocq.build import NotProved
from faultspace.proofs.rocq.sentences import refused, sentences
from faultspace.proofs.rocq.sources import sources
from faultspace.proofs.rocq.statements import VOCABULARY, read

TINY = {
    "Vocabulary.v": "Section A.\nVariable (a : nat).\nDefinition one := a.+1.\nEnd A.\nRecord pair := Pair { left : nat; right : nat }.\n"
    "Module M.\nDefinition one := 2.\nDefinition two := one.\nEnd M.\n",
    "Headlines.v": "From faultspace Require Import Vocabulary.\nFrom faultspace Require Other.\n"
    "Theorem good : one 0 = left (Pair 1 1).\nProof. exact: Other.good. Qed.\n"
    "Theorem better : M.two = 2.\nProof. by []. Qed.\n",
    "Other.v": "Definition extra := 1.\n",
}


def test_every_word_of_the_vocabularies_is_used_by_a_headline() -> None:
    statements = read(sources())
    assert len(statements.headlines) > 90 and len(statements.words["Vocabulary.v"]) > 60
    reached = {word.key for headline in statements.headlines.values() for word in statements.reached(headline)}
    assert {word.key for words in statements.words.values() for word in words.values()} == reached


def test_every_word_has_a_sentence_that_says_what_it_is() -> None:
    """A comment stands before it, or before the words just above it."""
    for name, text in sources().items():
        if VOCABULARY.fullmatch(name):
            for block in re.split(r"\n\s*\n", text):
                if re.search(r"^(?:Definition|Fixpoint|Record|Inductive)", block, re.MULTILINE):
                    assert re.match(r"(?:Section \w+\.\nVariables.*\n)?\(\*\* \w|\(\*\* ", block), f"{name}: {block[:100]}"


def test_the_words_that_a_statement_reaches() -> None:
    statements = read(TINY)
    named = {name: [word.key for word in statements.reached(headline)] for name, headline in statements.headlines.items()}
    assert named == {"good": ["Vocabulary.one", "Vocabulary.pair"], "better": ["Vocabulary.M.one", "Vocabulary.M.two"]}
    texts = {word.key: word.text for word in statements.reached(statements.headlines["good"])}
    assert texts["Vocabulary.one"] == "Variable (a : nat). Definition one := a.+1."


@pytest.mark.parametrize(
    "added",
    [
        "Definition hidden := 1.",
        "Notation hidden := 1.",
        'Notation "a <= b" := (b <= a).',
        "Local Notation hidden := 1.",
        "Let hidden := 1.",
        "Lemma helper : True. Proof. exact I. Qed.",
        "Fixpoint hidden (n : nat) := n.",
        "Ltac hidden := idtac.",
        "Axiom hidden : False.",
        "Coercion hidden : nat >-> bool.",
        "Canonical hidden.",
        "Import Other.",
        "From faultspace Require Import Other.",
        "Theorem bad : False. Admitted.",
        "Theorem bad : False. Proof. Admitted.",
        "Theorem bad : False. Proof. Abort.",
        "Theorem bad : True. Proof. exact I. Defined.",
        "Theorem bad : True. Proof. exact I.",
        "Theorem bad : True. Proof. exact I. Qed. Print Assumptions bad.",
        "Theorem bad : Other.extra = 1. Proof. by []. Qed.",
        "Theorem good : True. Proof. exact I. Qed.",
    ],
)
def test_a_file_of_headlines_holds_theorems_alone(added: str) -> None:
    with pytest.raises(NotProved, match=r"theorems alone|ends without Qed|is no vocabulary|in no vocabulary|already"):
        read({**TINY, "Headlines.v": f"{TINY['Headlines.v']}{added}\n"})


@pytest.mark.parametrize(
    "added",
    [
        "Lemma helper : True. Proof. exact I. Qed.",
        'Notation "a <= b" := (b <= a).',
        "Canonical hidden.",
        "Axiom hidden : False.",
        "Open Scope nat_scope.",
        "Definition one := 3.",
        "Definition three := Other.extra.",
        "Variable a : nat.",
        "Fixpoint even n := if n is m.+1 then odd m else true with odd n := if n is m.+1 then even m else false.",
        "Definition hidden : nat. Proof. exact 1. Defined.",
        "#[global] Definition hidden := 1.",
        "Program Definition hidden := 1.",
    ],
)
def test_a_vocabulary_defines_words_alone(added: str) -> None:
    with pytest.raises(NotProved, match=r"defines words and does nothing else|defined twice|in no vocabulary"):
        read({**TINY, "Vocabulary.v": f"{TINY['Vocabulary.v']}{added}\n"})


def test_sentences_are_told_without_comments_and_line_breaks() -> None:
    text = '(* a. (* b. *) c. *) Definition x :=\n  1. (* d. *)\nNotation "a . b" := (a (* e. *) b).\n'
    assert sentences(text) == ("Definition x := 1.", 'Notation "a . b" := (a b).')


@pytest.mark.parametrize(
    "text",
    [
        "Lemma a : False. Admitted.",
        "Axiom a : False.",
        "Parameters a b : nat.",
        "Conjecture a : False.",
        "Hypothesis a : False.",
        "Section s.\nVariable a : nat.\nEnd s.\nVariables b : nat.",
        "Unset Guard Checking.",
        "#[bypass_check(guard)] Fixpoint f (n : nat) : nat := f n.",
        "Unset Universe Checking.",
        "Unset Typing Flags.",
        "Lemma a : False. Proof. admit. Abort.",
        'Redirect "file" Print a.',
        'Extraction "file" a.',
        'Declare ML Module "m".',
    ],
)
def test_what_is_assumed_or_reaches_outside_is_noticed(text: str) -> None:
    assert refused("Other.v", text)
    assert not refused("Other.v", f"(* {text} (* nested *) *) Section s.\nHypothesis a : nat.\nEnd s.")


def _resolved(folder: Path, file: str) -> list[tuple[int, str, str]]:
    """Returns where in a source (in bytes) coqc saw a name of ours, the file and the name, by the record that it keeps."""
    lines = (folder / file).with_suffix(".glob").read_text("utf-8").splitlines()
    found = [re.fullmatch(r"R(\d+):\d+ faultspace\.(\w+) (\S+) (\S+) (?:def|rec|ind|proj|constr|abbrev)", line) for line in lines]
    return [(int(m[1]), m[2], m[4].partition(":")[0] if m[3] == "<>" else f"{m[3]}.{m[4]}") for m in found if m]


@pytest.mark.programs
@pytest.mark.timeout(900)
def test_the_words_of_a_statement_are_those_that_rocq_sees_in_it(theory: Path) -> None:
    """Every name that Rocq resolves to one of ours, in a statement or in a word, is one that the reading reaches."""
    texts = sources()
    statements, seen = read(texts), 0
    for file in sorted({headline.file for headline in statements.headlines.values()}):
        text, names = texts[file].encode(), _resolved(theory, file)
        for m in re.finditer(rb"^Theorem (\w+)(.*?)\.\nProof\.", text, re.MULTILINE | re.DOTALL):
            headline = statements.headlines[m[1].decode()]
            reached = {word.key for word in statements.reached(headline)}
            for at, module, name in names:
                if m.start(2) <= at < m.end(2):
                    word = statements.words[f"{module}.v"].get(name)
                    assert word is not None and word.key in reached, (headline.name, module, name)
                    seen += 1
    for file, words in statements.words.items():
        text, names = texts[file].encode(), _resolved(theory, file)
        for m in re.finditer(rb"^(?:Def|Fix|Rec|Not)\w+ (\w+).*?(?=\n\n|\n\(\*|\n[DFRNES])", text, re.MULTILINE | re.DOTALL):
            own = [word for name, word in words.items() if name.split(".")[-1] == m[1].decode() and m[1].decode() in word.text]
            reached = {word.key for one in own for word in statements.uses(one)} | {word.key for word in own}
            for at, module, name in names:
                if m.end(1) < at < m.end() and name != m[1].decode():  # that is how a recursion names itself
                    assert statements.words[f"{module}.v"][name].key in reached, (file, m[1], module, name)
                    seen += 1
    assert seen > 1000
