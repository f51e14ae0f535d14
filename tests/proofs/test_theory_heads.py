"""Each file of the theory opens with a comment that says what it is for, and with a dictionary of the names that it defines for others."""

from __future__ import annotations

import re

from faultspace.proofs.rocq.sentences import sentences
from faultspace.proofs.rocq.sources import sources

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
