"""Forgeries of the theory: whatever is said in a vocabulary, in a file of headlines or in a file of proofs, the locks do not hold.

Each is made by a rule from texts of ours, and put before `held`, which every run asks. None of them may be taken for the locked sources.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from faultspace.proofs.rocq.build import BrokenTheory, NoRocq, NotProved, compiled_again
from faultspace.proofs.rocq.export import translated
from faultspace.proofs.rocq.locks import held
from faultspace.proofs.rocq.recompute import proved
from faultspace.proofs.rocq.sentences import HEADLINES, refusals, refused, sentences
from faultspace.proofs.rocq.sources import beyond, sources
from faultspace.proofs.rocq.statements import VOCABULARY, read
from tests.proofs.examples import INVERTIBLE
from tests.thorough import every

TEXTS = sources()
VOCABULARIES = sorted(name for name in TEXTS if VOCABULARY.fullmatch(name))
OF_HEADLINES = sorted(name for name in TEXTS if HEADLINES.fullmatch(name))
OF_PROOFS = ("Gap.v", "Stability.v", "Lists.v")  # the second has a `*)` that ends no comment

FALSE = "Definition archimedean (K : fieldType) := False."
MODULES = [
    f"Module Num. Module Theory. {FALSE} End Theory. End Num.",
    f"Module Num.\nModule Theory.\n{FALSE}\nEnd Theory.\nEnd Num.",
    "Module GRing.\nModule Theory.\nDefinition left_invertible (n : nat) := False.\nEnd Theory.\nEnd GRing.",
    "Module GRing.\nModule Theory.\nNotation mulmxA := I.\nEnd Theory.\nEnd GRing.",
    'Module GRing.\nModule Theory.\nNotation "a = b" := True.\nEnd Theory.\nEnd GRing.',
    "Module Order.\nModule Theory.\nDefinition lt := 0.\nEnd Theory.\nEnd Order.",
    "Module MovingAverage.\nDefinition more := 0.\nEnd MovingAverage.",
    "Module Vocabulary.\nDefinition state := 0.\nEnd Vocabulary.",
    "Module Export Hidden.\nDefinition rank := 0.\nEnd Hidden.",
    "Module Hidden := GRing.",
    "Module Type Hidden.\nParameter a : False.\nEnd Hidden.",
    "Section GRing.\nDefinition unused := 0.\nEnd GRing.",
]
WORDS = [f"Definition {name} := 0." for name in ("mxrank", "horner", "unused", "size", "eqxx", "nat_of_ord", "K", "mulmx", "row_mx")]
WORDS += ["Notation unused := 0.", "Notation rank M := 0.", "Record unused := Unused { mxrank : nat }.", "Fixpoint size (n : nat) := 0."]
FROM_AFAR = [
    'Notation "a <= b" := True.', 'Local Notation "a <= b" := True.', 'Infix "+" := minus.', 'Reserved Notation "a \\+ b".',
    'Notation "a <= b" := True : ring_scope.', "Coercion id : nat >-> bool.", "Identity Coercion f : a >-> b.", "SubClass a := nat.",
    "Canonical hidden : nat.", "Canonical Structure hidden := 0.", "Arguments mxrank : clear implicits.", "Bind Scope nat_scope with nat.",
    "Delimit Scope nat_scope with R.", "Declare Scope ring_scope.", "Open Scope nat_scope.", "Close Scope ring_scope.",
    "Local Open Scope nat_scope.", "Hint Resolve I : core.", "Instance a : b.", "Existing Instance a.", "Existing Class a.",
    "Set Universe Polymorphism.", "Unset Universe Checking.", "Set Asymmetric Patterns.", "Set Default Proof Mode \"Noedit\".",
    "Global Set Implicit Arguments.", "#[export] Set Implicit Arguments.", "Generalizable All Variables.", "Number Notation nat a b : c.",
    "Obligation Tactic := idtac.", "Tactic Notation \"exact\" constr(t) := idtac.", "Ltac exact := idtac.", "Ltac2 a := ().",
    "Strategy expand [mxrank].", "Opaque mxrank.", "Transparent mxrank.", "Typeclasses Opaque a.", "Create HintDb a.",
    "Include Num.Theory.", "Import Num.Def.", "Export GRing.", "Require Import Gap.", "Require Gap.", "From faultspace Require Import Gap.",
    "From faultspace Require Gap.", "From faultspace Require Export Gap.", "From Coq Require Import Classical.", "From Coq Require Reals.",
    "Universe u.", "Constraint u < v.", "Scheme a := Induction for b Sort Prop.", "Derive a SuchThat b As c.", "Function f (n : nat) := 0.",
    "Combined Scheme a from b.", "Register a as b.", "Print Grammar tactic.", "Context (bad : False).", "Variable bad : False.",
]  # fmt: skip
ASSUMED = [
    "Axiom bad : False.", "Axioms a b : False.", "Parameter bad : False.", "Parameters a : False.", "Conjecture bad : False.",
    "Variable bad : False.", "Variables bad : False.", "Hypothesis bad : False.", "Hypotheses bad : False.", "Context (bad : False).",
    "Primitive bad := #int63_add.", "Lemma bad : False. Admitted.", "Lemma bad : False. Proof. Admitted.",
    "Lemma bad : False. Proof. admit. Admitted.", "Lemma bad : False. Proof. give_up. Qed.", "Admit Obligations.", "Next Obligation.",
    "Lemma bad : False. Proof. native_compute. Qed.", "Lemma bad : False. Proof. exact_no_check I. Qed.",
    "Lemma bad : False. Proof. vm_cast_no_check I. Qed.", "Lemma bad : False. Proof. native_cast_no_check I. Qed.",
    "Lemma bad : False. Proof. exact (ltac:(exact_no_check I)). Qed.", "Definition bad : False := ltac:(admit).",
    "Lemma bad : False. Proof. ltac2:(()). Qed.", "Lemma bad : False. Proof using Type. exact I. Qed.", "Lemma bad : False. Proof I.",
    "Lemma bad : False. Proof. exact I. Save.", "Lemma bad : False. Proof. exact I. Save bad.", "Lemma bad : False. Abort.",
    "Program Definition bad : False := _.", "#[program] Definition bad : False := _.",
    "#[bypass_check(guard)] Fixpoint f (n : nat) := f n.",
    "Unset Guard Checking.", "Unset Positivity Checking.", "Unset Universe Checking.", "Set Typing Flags.", "Set Definitional UIP.",
    "From faultspace Require Export Gap.", "From mathcomp Require Export all_algebra.",
    "CoInductive bad := Bad.", "Inductive bad := Bad (_ : bad -> False).", "Symbol bad : False.", "Rewrite Rule a := b.",
    'Declare ML Module "stolen".', 'Add LoadPath "/tmp".', 'Add Rec LoadPath "/tmp".', 'Add ML Path "/tmp".',
    'Load "stolen".', 'Cd "/tmp".',
    'Redirect "stolen" Check True.', 'Extraction "stolen" nat.', 'Separate Extraction nat.', "Drop.", "Quit.",
    "Back 1.", "Undo.", "Reset a.",
    "Time Axiom bad : False.", "Fail Fail Axiom bad : False.", "Timeout 9 Axiom bad : False.", "Succeed Check I.", "Comments a.",
    "Instructions Axiom bad : False.", "Local Axiom bad : False.", "Global Axiom bad : False.", "Monomorphic Axiom bad : False.",
    "Polymorphic Axiom bad : False.", "Cumulative Inductive a := .", "#[local] Axiom bad : False.", "#[deprecated] Axiom bad : False.",
    "Time Notation a := b.", "Time Definition a := 0.", "Local Definition a := 0.", "Let Fixpoint f (n : nat) := 0.",
    "Record a := A { b :> nat }.", "Section s. Variable f :> nat -> bool. End s.", "Section s. Variables (f g :> nat -> bool). End s.",
    "Section s.", "Module m.", "End s.", "Goal False.", "Eval compute in 0.", "Check I.", "Print Assumptions a.", "Existing Class a.",
    "Record a := A { b:> nat }.", "Record a := A { #[canonical=no] b :> nat }.", "Section s. Variables (f g:> nat -> bool). End s.",
    'Fixpoint f (n : nat) := n where "a <= b" := (f a b).', 'Fixpoint f (n : nat) := n where"a <= b" := (f a b).',
    'Local Notation "a =. b" := (a = b). Definition y := 0 =. Section s. Variable bad : False. Definition z := 0 =. End s.',
    "Notation \"'Qed.' a\" := a.",
]  # fmt: skip
# Ways to put a sentence where a reading by lines, or one that is not Rocq's, does not look for it.
HIDINGS = [
    "{}", "Lemma a : True. Proof. exact I. Qed. {}", "Lemma a : True.\nProof. exact I. {}\nQed.", "(* a *) {}", "(* (* a *) *) {}",
    '(* " *) " *) {}', '(* "(*" *) {}', "Lemma a : True.\nProof. by move=> *). {}", "Definition a := (x ^*). {} (* *)",
    'Definition a := "(*". {} Definition b := "*)".', "Definition a := 0.(* *){}", "Definition a := 0\n.\n\n {}", "Definition a := 0.\t{}",
    "Lemma a : True. Proof.\n- exact I. {} Qed.", "Lemma a : True. Proof. all: exact I. 1: {} Qed.", "Lemma a : True. Proof. {{ {} }} Qed.",
    "Lemma a : True. Proof. exact I... {} Qed.", "Definition a := 0.. {}", "Definition a := 0.\x0c{}", "Definition a := 0.\xa0{}",
    "Lemma a : True. Proof. refine ?[x]. [x]: {{ {} Qed.", "Lemma a : True. Proof. refine ?[x]. - [ x ] :{{ {} Qed.",
    "Lemma a : True. Proof. exact I. 1: {{ {} Qed.", "Definition a := `(* 0. {} (* *).",
    "Definition a := 0. {} (* no end", 'Definition a := 0. {} "no end', "Definition a := 0.\v{}",
]  # fmt: skip


def added(file: str, text: str, *, first: bool = False) -> dict[str, str]:
    """Return our sources with a text added at the end of one file, or before its first definition or theorem."""
    if not first:
        return {**TEXTS, file: f"{TEXTS[file]}\n{text}\n"}
    place = re.search(r"^(?:Definition|Notation|Section|Theorem|Lemma|Record|Fixpoint|\(\*\* \*\*)", TEXTS[file], re.MULTILINE)
    assert place is not None
    return {**TEXTS, file: f"{TEXTS[file][: place.start()]}{text}\n{TEXTS[file][place.start() :]}"}


def forgeries() -> Iterator[tuple[str, dict[str, str]]]:
    """Yield each forgery with what it is."""
    for text in (*MODULES, *WORDS, *FROM_AFAR):
        # A file of headlines may require a file without importing it, as all of them do: no name of it comes into sight.
        for k, file in enumerate((*VOCABULARIES, *(() if text == "From faultspace Require Gap." else OF_HEADLINES))):
            yield f"{file}: {text}", added(file, text, first=k % 2 == 1)
    for text in ASSUMED:
        for file in (*OF_PROOFS, "Vocabulary.v", "Headlines.v"):
            yield f"{file}: {text}", added(file, text)
    for hiding in HIDINGS:
        for text in ("Variable bad : False.", "Axiom bad : False.", "Admit Obligations.", "Time Notation a := b.", 'Load "stolen".'):
            for file in ("Gap.v", "Stability.v", "ExampleVocabulary.v", "HeadlinesSpectra.v"):
                yield f"{file}: {hiding} {text}", added(file, hiding.format(text))
    for name in ("Num", "GRing", "Order", "Z", "Hidden"):  # a file that others need but do not import brings its own name, and loads
        module = f"(** A file. *)\nModule Theory.\n{FALSE}\nEnd Theory.\nDefinition add := 0.\n"
        for file in (*VOCABULARIES, "HeadlinesMeans.v"):
            if name in ("Num", "GRing") or VOCABULARY.fullmatch(file):
                required = TEXTS[file].replace("Set Implicit", f"From faultspace Require {name}.\nSet Implicit", 1)
                yield f"{name}.v, required by {file}", {**TEXTS, f"{name}.v": module, file: required}
    for name in ("HiddenVocabulary.v", "HeadlinesHidden.v"):
        yield name, {**TEXTS, name: "Definition hidden := 0.\n" if "Voc" in name else "Theorem hidden : True.\nProof. by []. Qed.\n"}
    for file in VOCABULARIES:  # the same words in another order: a name may then be MathComp's, or ours, where it was the other
        blocks = re.split(r"\n\n", TEXTS[file])
        places = [k for k, block in enumerate(blocks) if re.match(r"\(\*\* .*\*\)\n(?:Definition|Fixpoint)", block, re.DOTALL)]
        for one, other in zip(places[::2], places[1::2], strict=False):
            swapped = list(blocks)
            swapped[one], swapped[other] = blocks[other], blocks[one]
            yield f"{file}: blocks {one} and {other} change places", {**TEXTS, file: "\n\n".join(swapped)}


FORGERIES = dict(forgeries())


def test_no_forgery_is_taken_for_what_is_locked() -> None:
    """The refusal is one line, of words of ours: the run ends with it."""
    believed = []
    tried = list(FORGERIES.items())[:: every(2)]
    for what, texts in tried:
        try:
            held(texts)
            believed.append(what)
        except NotProved as error:
            assert "\n" not in str(error) and len(str(error)) < 1500, what
    assert believed == [] and len(tried) > 400


def test_the_theory_itself_is_not_refused_and_is_read_whole() -> None:
    assert refusals(TEXTS) == {}
    assert sum(len(sentences(text)) for text in TEXTS.values()) > 10000
    assert len(sentences(TEXTS["Stability.v"])) > 200, "a `*)` that ends no comment hides nothing"
    assert [*refusals(beyond())] == ["RealAlgebraicNumbers.v"], "it needs more of MathComp than the theory may"


@pytest.mark.parametrize("hiding", HIDINGS)
def test_what_is_hidden_is_refused_by_the_sentence_alone(hiding: str) -> None:
    """Without the locks, too: a file of proofs has none."""
    assert refused("Other.v", hiding.format("Axiom bad : False."))
    assert refused("Other.v", hiding.format("Time Notation a := b."))


@pytest.mark.programs
@pytest.mark.timeout(600)
def test_rocq_cuts_sentences_where_we_do() -> None:
    """Each hiding that coqc accepts at all, with a definition in it that a last sentence uses: so Rocq has read it, and so have we."""
    try:
        compiled_again({"Plain.v": "Definition a := 0.\n"})
    except (NoRocq, AssertionError) as reason:
        pytest.skip(f"coqc is not there: {reason}")
    seen = 0
    for hiding in HIDINGS:
        text = f"{hiding.format('Definition hidden := 1.')}\nDefinition seen := hidden.\n"
        try:
            compiled_again({"Hiding.v": text})
        except BrokenTheory:
            continue
        seen += 1
        if not refused("Hiding.v", text):
            assert "Definition hidden := 1." in sentences(text), hiding
    assert seen >= 5


@pytest.mark.programs
@pytest.mark.parametrize("around", ["{}", "Module Certified.\n{}End Certified.\n"])
def test_a_file_of_proofs_cannot_say_what_is_proved_of_a_certificate(theory: Path, tmp_path: Path, around: str) -> None:
    """It has no lock, and a name that it brings is taken for the one that was there: for the statement about the system, too."""
    right = translated(INVERTIBLE)
    false = replace(right, statement=f"~ {right.statement}", check="granted l", lemma="granted_sound")
    forged = around.format("Module C0.\nDefinition said : Prop := True.\nDefinition l := 0.\nEnd C0.\n")
    forged += "Definition granted (l : nat) := true.\nLemma granted_sound (l : nat) : granted l = true -> True. Proof. by []. Qed.\n"
    assert held({**TEXTS, "FieldInputs.v": f"{TEXTS['FieldInputs.v']}\n{forged}"}) == held(TEXTS), "or the forgery is no danger any more"
    for compiled in theory.glob("*.vo"):
        if compiled.stem != "FieldInputs":
            (tmp_path / compiled.name).symlink_to(compiled)
    head = "From mathcomp Require Import all_ssreflect.\nSet Implicit Arguments.\n"
    (tmp_path / "FieldInputs.vo").write_bytes(compiled_again({"FieldInputs.v": head + forged})["FieldInputs.v"])
    with pytest.raises(NotProved, match="does not compile"):
        proved([false], tmp_path)


def test_what_a_vocabulary_says_is_in_the_lock_of_every_headline_that_imports_it() -> None:
    statements = read(TEXTS)
    for file in VOCABULARIES:
        assert sum(file in statements.imports[headline.file] for headline in statements.headlines.values()) > 0
        with pytest.raises(NotProved, match=rf"the word {file[:-2]}\.unused is not locked"):
            held(added(file, "Definition unused := 0."))
