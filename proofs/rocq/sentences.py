r"""The sentences of a source of the theory, cut as Rocq's own lexer cuts them, and each judged by the command that it begins with.

    sentences    those of a text, without comments and with single spaces; raises NotProved where Rocq might read another text
    refusals     file -> what no source of the theory may say: commands that are not among ours, proofs left open, words of WORDS

Lines mean nothing to Rocq: a second command may stand behind a full stop, a comment may hide in a comment, a string may hold a full stop.
So a text is cut by the rules of Rocq's lexer. A sentence ends with a full stop before a blank or the end; comments are nested, and strings
within them are strings. Where a notation could make Rocq cut a text in another place, as with two full stops or with a comment that does
not stand after a blank, the text is refused: no token of Rocq holds a blank, so after one there is no doubt.

A notation, too, may make Rocq go on where a sentence ends for us: so no token of one ends with a full stop.

A sentence within a proof is a tactic, which begins with a small letter, behind a bullet or the number of a goal. Any other begins with one
of the commands below, each in the one form in which the theory uses it. What is not among them is refused, whatever it may do. For Rocq an
opened brace is a sentence of its own, behind which any command may stand: so none is opened, by the number or by the name of a goal.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cache

from .build import NotProved

HEADLINES = re.compile(r"Headlines\w*\.v")
NAME = r"[A-Za-z_][\w']*"
NAMES = rf"{NAME}(?:\.{NAME})*(?:[ ]{NAME}(?:\.{NAME})*)*"
BLANKS = " \t\r\n"
PIECE = re.compile(rf'"[^"]*"|"|\(\*|\*\)|\.+(?=[{BLANKS}]|\Z)')
# Rocq takes some signs for letters and some for blanks; none of them is needed.
OTHER = re.compile(rf"[^ -~{BLANKS}]")
COMMANDS = re.compile(
    rf"""(?:Theorem|Lemma|Corollary|Fact|Definition|Fixpoint|Let)\ (?!(?:Co)?Fixpoint\b){NAME}\b.*
    |(?:Local\ )?Notation\ (?:{NAME}(?:\ {NAME})*\ :=|"[^"]*"\ :=).*
    |Record\ {NAME}\b.*|Canonical\ {NAME}\ :.*|Implicit\ Types?\ .*|Add\ Ring\ {NAME}\ :\ {NAME}
    |(?:Variables?|Hypothes[ie]s)\ .*|(?:Section|Module|End)\ {NAME}
    |From\ Coq\ Require\ Import\ (?:ZArith|Ring)|From\ (?:mathcomp|faultspace)\ Require(?:\ Import)?\ (?!Export\b){NAMES}
    |Import\ {NAMES}|Include\ Headlines\w*
    |Set\ Implicit\ Arguments|Unset\ Strict\ Implicit|Unset\ Printing\ Implicit\ Defensive
    |Local\ (?:Open|Close)\ Scope\ \w+""",
    re.VERBOSE,
)
TACTIC = re.compile(r"(?:(?:[-+*]+|[0-9, ]+:) ?)?[a-z].*")
# Words that leave something open, that the kernel does not judge, or that write and load; in no term and in no tactic of the theory.
WORDS = re.compile(
    r"(?<![\w'])(?:admit|give_up|proof_admitted|native_compute|native_cast_no_check|vm_cast_no_check|exact_no_check|bypass_check"
    r"|type-in-type|ltac2)(?![\w'])"
)
# A field or a variable that is a coercion, too, which is told by a sign alone.
COERCION = re.compile(rf"(?:Record|Variables?|Hypothes[ie]s)\b(?:.*[({{;\]])? ?(?:{NAME} )*{NAME} ?::?>")
# A notation within a definition, and one with a token after which Rocq goes on where a sentence ends for us.
NOTATION = re.compile(r""".*\bwhere ?"|(?:Local )?Notation "[^"]*\.[ '"]""")


@cache
def sentences(text: str) -> tuple[str, ...]:
    """Return the sentences of a source, each to its full stop, without comments and with single spaces. Raises NotProved."""
    return tuple(_cut(text))


def _cut(text: str) -> Iterator[str]:
    if (other := OTHER.search(text)) is not None:
        raise NotProved(f"a sign is not one of ASCII: {other[0]!a}")
    said, depth, begun = "", 0, 0
    for match in PIECE.finditer(text):
        piece, start, end = match[0], match.start(), match.end()
        if piece == '"':
            raise NotProved(f"a string does not end: {short(text[start:])}")
        if piece == "(*":
            if not depth:
                if start and text[start - 1] not in BLANKS:
                    raise NotProved(f"a comment begins behind another sign: {short(text[max(0, start - 20) :])}")
                said += text[begun:start]
            depth += 1
        elif depth:
            depth -= piece == "*)"
            begun = end
        elif piece == ".":
            yield " ".join((said + text[begun:end]).split())
            said, begun = "", end
        elif piece[0] == ".":
            raise NotProved(f"a sentence ends with more than one full stop: {short(text[max(0, start - 20) :])}")
    if depth or (said + text[begun:]).strip():
        raise NotProved(f"{'a comment' if depth else 'a sentence'} does not end: {short((said + text[begun:]).strip())}")


def refusals(texts: Mapping[str, str]) -> dict[str, tuple[str, ...]]:
    """Return file -> what no source may say; nothing for files that say no such thing."""
    return {name: found for name, text in texts.items() if (found := refused(name, text))}


@cache
def refused(name: str, text: str) -> tuple[str, ...]:
    """Return what `refusals` finds in one file."""
    try:
        return tuple(_refused(name, sentences(text)))
    except NotProved as error:
        return (str(error),)


def _refused(name: str, found: tuple[str, ...]) -> Iterator[str]:
    within, proving = list[tuple[str, str]](), False
    for sentence in found:
        command, *rest = sentence[:-1].split(" ")
        yield from WORDS.findall(sentence)
        if proving or sentence == "Proof.":
            proving = sentence not in ("Qed.", "Defined.")
            if proving and sentence != "Proof." and not TACTIC.fullmatch(sentence):
                yield short(sentence)
        elif not COMMANDS.fullmatch(sentence[:-1]) or COERCION.match(sentence) or NOTATION.match(sentence):
            yield short(sentence)
        elif command in ("Section", "Module"):
            within.append((command, rest[0]))
        elif command == "End":
            if not within or within.pop()[1] != rest[0]:
                yield f"{sentence} without what it ends"
        elif command in ("Variable", "Variables", "Hypothesis", "Hypotheses") and not any(kind == "Section" for kind, _ in within):
            yield f"{short(sentence)} outside of a section"
        elif command == "Include" and not HEADLINES.fullmatch(name):
            yield short(sentence)
    if proving or within:
        yield "the file ends within a proof, a section or a module"


def short(text: str, most: int = 80) -> str:
    """Return the beginning of a text, in one line."""
    line = " ".join(text[: 2 * most].split())
    return line if len(line) <= most else f"{line[:most]}..."
