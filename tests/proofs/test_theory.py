"""The theory lies in folders of topics: they are small, import each other one way as the README says, and no import is idle.

Each file of the theory opens with a comment that says what it is for, and with a dictionary of the names that it defines for others. The
sources of the theory say nothing that MathComp 2 has not: tests compile it with MathComp 1, and these read its text. What MathComp 2 has
and MathComp 1 has not, the compilation finds. What is found here is by notation and by name, so a statement that means something else
there, or a proof that fails there, is not: that takes Coq 8.20, and `proofs/theory/README.md` says how.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

from faultspace.proofs.rocq.sentences import sentences
from faultspace.proofs.rocq.sources import THEORY, needs, paths, sources

MOST_FILES = 14
Arrows = dict[str, set[str]]


def arrows(texts: Mapping[str, str], where: Mapping[str, str]) -> Arrows:
    """Returns folder -> the other folders that its files import from."""
    folder = {name: path.partition("/")[0] for name, path in where.items()}
    result: Arrows = {one: set() for one in folder.values()}
    for name, required in needs(texts).items():
        result[folder[name]] |= {folder[one] for one in required} - {folder[name]}
    return result


def stands_on(graph: Arrows) -> Arrows:
    """Returns folder -> those of the folders that it imports on which no other one of them stands, directly or by way of others."""
    below: Arrows = {}
    for one in TopologicalSorter(graph).static_order():
        below[one] = graph[one].union(*(below[other] for other in graph[one]))
    return {one: {other for other in imported if not any(other in below[third] for third in imported)} for one, imported in graph.items()}


def rows() -> list[tuple[str, set[str]]]:
    """Returns the README's table of folders: each with those that it says it stands on."""
    _, _, section = THEORY.joinpath("README.md").read_text("utf-8").partition("## The folders")
    found = re.findall(r"^\| `(\w+)` \| [^|]+ \|([^|]*)\|$", section, re.MULTILINE)
    return [(folder, {*re.findall(r"`(\w+)`", below)}) for folder, below in found]


def test_a_folder_holds_few_files_and_no_file_lies_outside() -> None:
    assert not [one.name for one in THEORY.iterdir() if one.name.endswith(".v")]
    held = Counter(path.partition("/")[0] for path in paths().values())
    assert {folder: files for folder, files in held.items() if files > MOST_FILES} == {}
    assert sum(held.values()) > 100


def test_folders_import_each_other_one_way() -> None:
    TopologicalSorter(arrows(sources(), paths())).prepare()


def test_an_import_the_other_way_is_noticed() -> None:
    texts = sources()
    upward = {**texts, "Gap.v": f"From faultspace Require Import Theorem3.\n{texts['Gap.v']}"}
    with pytest.raises(CycleError):
        TopologicalSorter(arrows(upward, paths())).prepare()


def test_the_readme_says_which_folder_stands_on_which() -> None:
    listed = rows()
    assert dict(listed) == stands_on(arrows(sources(), paths()))
    assert len(listed) == len(dict(listed))
    for k, (folder, below) in enumerate(listed):
        assert below <= {name for name, _ in listed[k + 1 :]}, f"the row of {folder} stands above those on which it stands"


def test_what_stands_in_between_is_not_told_twice() -> None:
    assert stands_on({"a": {"b", "c"}, "b": {"c"}, "c": set()}) == {"a": {"b"}, "b": {"c"}, "c": set()}


def test_a_new_file_is_found_where_it_lies(tmp_path: Path) -> None:
    for path in ("topic/Old.v", "another/New.v", "another/notes.txt", "Outside.v"):
        (tmp_path / path).parent.mkdir(exist_ok=True)
        (tmp_path / path).write_text("", "utf-8")
    assert paths(tmp_path) == {"New.v": "another/New.v", "Old.v": "topic/Old.v"}
    (tmp_path / "topic" / "New.v").write_text("", "utf-8")
    with pytest.raises(ValueError, match=r"one name: New\.v"):
        paths(tmp_path)


def used(theory: Path, name: str) -> set[str]:
    """Returns the files of ours whose names coqc met in this one, by the record that it keeps. Where MathComp has a lemma of `versions`,
    its own is met."""
    lines = (theory / name).with_suffix(".glob").read_text("utf-8")
    met = {*re.findall(r"^R\d+:\d+ mathcomp\.\S+ \S+ (\w+) ", lines, re.MULTILINE)}
    own = {f"{module}.v" for module in re.findall(r"^R\d+:\d+ faultspace\.(\w+) \S+ \S+ (?!lib$)", lines, re.MULTILINE)}
    return (own | {file for file, names in named_by_versions().items() if names & met}) - {name}


@cache
def named_by_versions() -> dict[str, set[str]]:
    """Returns the files of the folder `versions`, each with the lemmas that it has."""
    texts = sources()
    return {
        name: {*re.findall(r"^Lemma (\w+)", texts[name], re.MULTILINE)} for name, path in paths().items() if path.startswith("versions/")
    }


@pytest.mark.timeout(900)
@pytest.mark.programs
def test_every_file_requires_what_it_uses_and_nothing_else(theory: Path) -> None:
    required = needs(sources())
    idle = {name: sorted(required[name] - used(theory, name)) for name in required}
    assert {name: files for name, files in idle.items() if files} == {}
    missing = {name: sorted(used(theory, name) - required[name]) for name in required}
    assert {name: files for name, files in missing.items() if files} == {}


TEXTS = sources()
DEFINES = re.compile(r"(?:Definition|Fixpoint|Inductive|CoInductive|Variant|Record|Structure|Notation)\s+([A-Za-z_][\w']*)")
MEANS = " == "


def head(text: str) -> str:
    """Return the comment that the file opens with, without its marks; "" where it opens with something else."""
    opening = re.match(r"\(\*\* ((?:(?!\(\*).)*?)\s*\*\)\n", text, re.DOTALL)
    return opening[1] if opening else ""


def dictionary(text: str) -> list[str]:
    """Return the lines of the dictionary: the last paragraph of the head, where it tells the meaning of something."""
    lines = head(text).rpartition("\n\n")[2].splitlines()
    return lines if any(MEANS in line for line in lines) else []


def told(text: str) -> set[str]:
    """Return the names whose meaning the dictionary tells: what stands before the two equality signs, without arguments."""
    entries = re.sub(r",\n", ", ", "\n".join(dictionary(text))).splitlines()
    return {one.split()[0] for entry in entries if MEANS in entry for one in entry.partition(MEANS)[0].split(", ")}


def defined(text: str) -> set[str]:
    """Return the names that a file defines and does not keep: an abbreviation within a section ends with it."""
    found, sections = set[str](), 0
    for sentence in sentences(text):
        sections += sentence.startswith("Section ")
        if (ended := re.match(r"End (\w+)\.", sentence)) and f"Module {ended[1]}." not in sentences(text):
            sections -= 1
        if (name := DEFINES.match(sentence)) and not (sections and sentence.startswith("Notation")):
            found.add(name[1])
    return found


def test_every_file_opens_with_what_it_is_for_and_the_names_that_it_defines() -> None:
    assert len(TEXTS) > 100
    for file, text in TEXTS.items():
        assert re.search(r"\w.*[.:]", head(text)), f"{file} does not open with a comment (** ... *)"
        assert defined(text) <= told(text), f"{file}: its head does not tell {', '.join(sorted(defined(text) - told(text)))}"
        body = text[text.index("*)") :]
        assert not [name for name in told(text) if not re.search(rf"(?<![\w']){re.escape(name)}(?![\w'])", body)], file
        assert len({line.index(MEANS) for line in dictionary(text) if MEANS in line}) <= 1, f"{file}: {MEANS} is not aligned"


SMALL = """(** What it is for.

        one x, two == the first and
                      the second
         three, four,
               five == more *)
Section Small.
Notation short := one.
Definition one x := x.
End Small.
Notation two := one.
Local Notation kept := one.
Module Inside.
Fixpoint three k := k.
End Inside.
Record four := Four { field : nat }.
Let hidden := one.
Lemma five : one = one.
"""


def test_what_a_file_defines_and_what_its_head_tells() -> None:
    assert defined(SMALL) == {"one", "two", "three", "four"}
    assert told(SMALL) == {"one", "two", "three", "four", "five"}
    assert told(SMALL.replace(" == ", " is ")) == told("(** No dictionary. *)\n") == set()
    assert head("From mathcomp Require Import ssreflect.\n") == head("(* one *)\n") == ""


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
