r"""What a headline supposes: its statement taken apart, as text.

    premises    the premises of a statement
    together    the statement that all premises of a headline can be met together, for every field or for some
    Instance    a theorem NAME_instance of the theory: that all premises of the headline NAME hold together of something
    instances   headline -> its Instance; raises NotProved where one says something else

A statement is `binders : P -> ... -> [/\ Q, R & forall x, P' -> Q']`. All of P and P' are premises. Nothing is parsed beyond that.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from faultspace.proofs.rocq.build import NotProved
from faultspace.proofs.rocq.statements import Headline, Statements

BINDER = re.compile(r"(?:let|forall|exists2?|fun)\b")
CONNECTIVES = ("->", "<->", "/\\", "\\/")
FIELD = re.compile(r"\(K : \w+\)")
INSTANCE = re.compile(r"^Theorem (\w+)_instance\b(.*?)\.\nProof\.", re.MULTILINE | re.DOTALL)
TYPED = re.compile(r"\(([\w']+) : (?:[^()]|\((?:[^()]|\([^()]*\))*\))*\)")
OPENS, CLOSES = "([{", ")]}"


def premises(headline: Headline) -> tuple[str, ...]:
    """Return what it supposes, as texts of Rocq, those of its conjuncts and of what it says to exist included."""
    _, proposition = _cut(headline.statement, " : ")
    return tuple(dict.fromkeys(_taken_apart(proposition)))


def together(headline: Headline) -> tuple[str, ...]:
    """Return the statement, binders and all, that there is what the headline is about and that it meets all its premises, those within the
    conclusion included: for every field first, then for some field, then for every field with one example for each conjunct that has
    premises of its own, which may contradict those of another. Nothing where it has no premise.

    A premise that speaks of what the conclusion says to exist, or of what is bound there, is left out, for that is not chosen but proved.
    """
    binders, proposition = _cut(headline.statement, " : ")
    met = _met(proposition)
    if not met:
        return ()
    binders = binders.strip()
    field = FIELD.match(binders)
    rest = binders[field.end() :] if field else binders
    bound, apart = _bound(rest, met), " /\\ ".join(_closed(_bound(rest, chain)) for chain in _chains(proposition))
    if not field:
        return (f": {bound}", f": {apart}")
    joined = f" {bound.removeprefix('exists ')}" if bound.startswith("exists ") else f", {bound}"
    return (f"{field[0]} : {bound}", f": exists {field[0]}{joined}", f"{field[0]} : {apart}")


@dataclass(frozen=True)
class Instance:
    """`file` and `line` tell where it stands, `statement` is what it says, binders and all."""

    file: str
    line: int
    statement: str


def instances(statements: Statements, texts: Mapping[str, str]) -> dict[str, Instance]:
    """Return them by headline. What each says is `together` of the headline, where a name may have its type besides, which the headline
    leaves to be inferred. Raises NotProved where one says something else, or is of no headline."""
    found: dict[str, Instance] = {}
    for file, text in texts.items():
        for match in INSTANCE.finditer(text):
            name, said = match[1], " ".join(match[2].split())
            wanted = together(statements.headlines[name]) if name in statements.headlines else ()
            if not any(said == one or _without_types(said, one) == one for one in wanted):
                raise NotProved(
                    f"{file}: {name}_instance does not say that the premises of {name} can be met: {' or '.join(wanted) or 'it has none'}"
                )
            found[name] = Instance(file, text[: match.start()].count("\n") + 1, said)
    return found


def _without_types(said: str, wanted: str) -> str:
    return TYPED.sub(lambda one: one[0] if one[0] in wanted else one[1], said)


def _met(text: str) -> str:
    """Return what says that all premises in the text hold of something; "" where it has none."""
    text = _bare(text.strip())
    if begun := BINDER.match(text):
        bound, rest = _cut(text, " in " if begun[0] == "let" else ",")
        if begun[0].startswith("exists"):
            return " /\\ ".join(_closed(one) for one in dict.fromkeys(_given(text, ())))
        met = _met(rest)
        return _within(bound, met) if met else ""
    premise, rest = _cut(text, "->")
    conjuncts = _conjuncts(text)
    parts = [premise.strip(), _met(rest)] if rest else [_met(one) for one in conjuncts] if len(conjuncts) > 1 else []
    *first, last = [one for one in parts if one] or [""]
    loose = not BINDER.match(last) and any(last.startswith(("->", "<->", "\\/"), k) for k, _ in _outside(last))
    return " /\\ ".join([*(_closed(one) for one in first), f"({last})" if loose and first else last])


def _given(text: str, bound: tuple[str, ...]) -> list[str]:
    """Return the premises in the text that name nothing of what is bound there, or of `bound`."""
    text = _bare(text.strip())
    if begun := BINDER.match(text):
        binders, rest = _cut(text, " in " if begun[0] == "let" else ",")
        names = [binders.split()[1]] if begun[0] == "let" else [name for one in _groups(binders[begun.end() :]) for name in one[0].split()]
        return _given(rest, (*bound, *names)) if begun[0] != "exists2" else []
    premise, rest = _cut(text, "->")
    if rest:
        return [*([] if any(_says(premise, name) for name in bound) else [premise.strip()]), *_given(rest, bound)]
    conjuncts = _conjuncts(text)
    return [one for conjunct in conjuncts if len(conjuncts) > 1 for one in _given(conjunct, bound)]


def _chains(text: str) -> list[str]:
    """Return for each conjunct with premises what says that its premises, and those before it, hold of something."""
    text = _bare(text.strip())
    if begun := BINDER.match(text):
        bound, rest = _cut(text, " in " if begun[0] == "let" else ",")
        if begun[0].startswith("exists"):
            return [met] if (met := _met(text)) else []
        return [_within(bound, one) for one in _chains(rest)]
    premise, rest = _cut(text, "->")
    if rest:
        return [" /\\ ".join([_closed(premise.strip()), one]) for one in _chains(rest)] or [premise.strip()]
    conjuncts = _conjuncts(text)
    return [one for conjunct in conjuncts if len(conjuncts) > 1 for one in _chains(conjunct)]


def _within(bound: str, met: str) -> str:
    """Return that this holds of some "forall x", or of "let x := a" as it is told, where it speaks of that."""
    if bound.startswith("let"):
        return f"{bound} in {met}" if _says(met, bound.split()[1]) else met
    return _bound(bound.removeprefix("forall"), met)


def _bound(binders: str, met: str) -> str:
    """Return that there are these, of which what follows holds; a name that stands nowhere there is left out."""
    said, kept = met, list[str]()
    for names, colon, kind in reversed(_groups(binders)):
        if used := " ".join(name for name in names.split() if _says(said, name)):
            kept.insert(0, f"({used}{colon}{kind})" if colon else used)
            said = f"{kept[0]} {said}"
    return f"exists {' '.join(kept)}, {met}" if kept else met


def _groups(binders: str) -> list[tuple[str, str, str]]:
    """Return the binders one by one: names, and " : " and their type where they have one."""
    found = re.findall(r"\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\)|[^\s()]+", binders)
    return [one.removeprefix("(").removesuffix(")").partition(" : ") if one.startswith("(") else (one, "", "") for one in found]


def _says(text: str, name: str) -> bool:
    """Return whether it names that, also as a size: 'M_n, 'rV[K]_n."""
    return re.search(rf"((?<![\w'])|(?<=[MV\]]_)){re.escape(name)}(?![\w'])", text) is not None


def _closed(text: str) -> str:
    """Return the text, in brackets where a connective or a binder stands outside of brackets."""
    open_ = any(_binder(text, k) or text.startswith(CONNECTIVES, k) for k, _ in _outside(text))
    return f"({text})" if open_ else text


def _taken_apart(text: str) -> Iterator[str]:
    """Yield the premises in the text."""
    text = _bare(text.strip())
    if begun := BINDER.match(text):
        _, rest = _cut(text, " in " if begun[0] == "let" else ",")
        if begun[0] == "exists2":
            first, rest = _cut(rest, "&")
            yield from _taken_apart(first)
        yield from _taken_apart(rest)
        return
    premise, rest = _cut(text, "->")
    if rest:
        yield _bare(premise.strip())
        yield from _taken_apart(rest)
        return
    conjuncts = _conjuncts(text)
    if len(conjuncts) > 1:
        for one in conjuncts:
            yield from _taken_apart(one)


def _conjuncts(text: str) -> list[str]:
    r"""Return the conjuncts of [/\ P, Q & R] or of P /\ Q; the text itself where it is neither."""
    if text.startswith("[/\\") and _closing(text) == len(text) - 1:
        return _listed(text[3:-1])
    found = []
    while _cut(text, "<->")[1] == _cut(text, "\\/")[1] == "" and (rest := _cut(text, "/\\"))[1]:
        found.append(rest[0])
        text = rest[1]
    return [*found, text]


def _listed(text: str) -> list[str]:
    """Return what commas and & part, but for the comma of a quantifier and the & of exists2."""
    found, begun, of_binders, of_exists2 = [], 0, 0, 0
    for k, letter in _outside(text):
        if binder := _binder(text, k):
            of_binders += binder != "let"
            of_exists2 += binder == "exists2"
        elif letter in ",&" and (pending := of_binders if letter == "," else of_exists2):
            of_binders, of_exists2 = (pending - 1, of_exists2) if letter == "," else (of_binders, pending - 1)
        elif letter in ",&":
            found.append(text[begun:k])
            begun = k + 1
    return [*found, text[begun:]]


def _cut(text: str, mark: str) -> tuple[str, str]:
    """Return what stands before the mark and what behind it, outside of brackets; all and "" where it does not stand there.

    A connective that follows a quantifier is inside of what that says.
    """
    for k, _ in _outside(text):
        if text.startswith(mark, k) and not (mark == "->" and text[k - 1 : k] == "<"):
            return text[:k], text[k + len(mark) :]
        if mark in CONNECTIVES and _binder(text, k):
            break
    return text, ""


def _outside(text: str) -> Iterator[tuple[int, str]]:
    """Yield the places outside of brackets with their letters."""
    depth = 0
    for k, letter in enumerate(text):
        depth += (letter in OPENS) - (letter in CLOSES)
        if depth == 0:
            yield k, letter


def _binder(text: str, k: int) -> str:
    """Return let, forall, exists or exists2 where one begins there; else ""."""
    found = None if k and (text[k - 1].isalnum() or text[k - 1] in "_'") else BINDER.match(text, k)
    return found[0] if found else ""


def _bare(text: str) -> str:
    """Return the text without brackets around all of it."""
    while text.startswith("(") and _closing(text) == len(text) - 1:
        text = text[1:-1].strip()
    return text


def _closing(text: str) -> int:
    """Return where the bracket closes that the text begins with."""
    return next((k for k, letter in _outside(text) if letter in CLOSES), -1)
