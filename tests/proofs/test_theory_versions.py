"""The sources of the theory say nothing that MathComp 2 has not: tests compile it with MathComp 1, and these read its text.

What MathComp 2 has and MathComp 1 has not, the compilation finds. What is found here is by notation and by name, so a statement that means
something else there, or a proof that fails there, is not: that takes Coq 8.20, and `proofs/theory/README.md` says how.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import pytest

from faultspace.proofs.rocq.sentences import sentences
from faultspace.proofs.rocq.sources import sources

GONE = Path(__file__).with_name("gone_in_mathcomp_2.txt")
# Names of MathComp 1 that mean something of ours here.
OWN = {"silent", "hidden"}
NAME = re.compile(r"[A-Za-z_][\w']*")
# Notations and words of MathComp 1 alone: [fieldType of T], [rmorphism of f], [linear of f as g], [ringMixin of T], and packed morphisms.
ALONE = re.compile(
    r"\[\s*(?:\w+(?:Type|Mixin)|additive|rmorphism|linear|lrmorphism|scalar|quotient)\s+of\b"
    r"|(?:[:=]=?|\(|,)\s*@?(?:Additive|RMorphism|Linear|LRMorphism|Scalar)\b(?!\.)"
    r"|(?<!\{)\b(?:rmorphism|lrmorphism)\s+[A-Za-z(@]"
)


def gone() -> set[str]:
    """Returns the names that MathComp 2 has no more."""
    lines = GONE.read_text("utf-8").split("\n")
    return {line for line in lines if line and not line.startswith("#")}


def old_words(texts: Mapping[str, str], names: set[str]) -> dict[str, list[str]]:
    """Returns file -> what it says that MathComp 2 does not have."""
    found = {}
    for file, text in texts.items():
        bare = re.sub('"[^"]*"', "", " ".join(sentences(text)))
        said = sorted({*NAME.findall(bare)} & names) + [" ".join(one.split()) for one in ALONE.findall(bare)]
        if said:
            found[file] = said
    return found


def test_no_file_says_what_mathcomp_2_has_not() -> None:
    assert old_words(sources(), gone() - OWN) == {}


def test_own_names_are_ours() -> None:
    for name in OWN:
        assert name in gone()
        assert any(re.search(rf"\b(?:Definition|Fixpoint|Lemma|Fact|Theorem|have|pose|Let) {name}\b", text) for text in sources().values())


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("Check [fieldType of rat].", "[fieldType of"),
        ("Check [finType of 'I_2 * 'I_3].", "[finType of"),
        ("Check [ rmorphism  of idfun].", "[ rmorphism of"),
        ("Canonical f := RMorphism f_is_rmorphism.", ":= RMorphism"),
        ("Canonical f := @Additive _ _ f f_is_additive.", ":= @Additive"),
        ("Lemma f_is : rmorphism f.", "rmorphism f"),
        ("Check rat_fieldType.", "rat_fieldType"),
        ("Proof. exact: (map_mx0 (@polyC_additive K)). Qed.", "polyC_additive"),
        ("Proof. by rewrite ler_add. Qed.", "ler_add"),
        ("Proof. by rewrite rmorphX. Qed.", "rmorphX"),
        ("Proof. by rewrite -ltr_pdivl_mulr. Qed.", "ltr_pdivl_mulr"),
    ],
)
def test_what_mathcomp_2_has_not_is_seen(text: str, said: str) -> None:
    assert old_words({"New.v": text}, gone() - OWN) == {"New.v": [said]}
    assert not old_words({"New.v": f"(* {text} *)"}, gone() - OWN)


@pytest.mark.parametrize(
    "text",
    [
        "Check [the fieldType of rat : Type].",
        "Check [the {rmorphism _ -> _} of idfun].",
        "Section Linear.",
        "Variable f : {rmorphism K -> L}.",
        "exact: (GRing.RMorphism.class f).",
        "Check [tuple of s]. Check [seq x | x <- s].",
        "Fact value_linear : linear f.",
    ],
)
def test_what_both_have_is_left_alone(text: str) -> None:
    assert not old_words({"New.v": text}, gone() - OWN)
