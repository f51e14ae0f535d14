"""The statements of the Rocq theory are read from its sources: the headlines, and the words that they use.

    Headline    a theorem of a file Headlines*.v: its name, its statement, its proof, its file
    Word        a definition, record or abbreviation of a file *Vocabulary.v, with the variables of the sections around it
    Statements  all headlines and words of a set of sources; `reached` says which words a statement uses, through other words too
    read        the Statements of the sources

Text is told in sentences (rocq/sentences.py), so that neither a comment nor a line break changes it. The rules that make this reading
complete are enforced here, by NotProved: the files of headlines hold theorems alone, the vocabularies definitions alone, both import no
other file of ours by name, and no file or module of ours has the name of one of MathComp's that they import. A variable that has the name
of a word counts as the word: too much is reached rather than too little.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from .build import NotProved
from .sentences import HEADLINES, NAME, sentences, short

VOCABULARY = re.compile(r"\w*Vocabulary\.v")
OPENING = re.compile(r"(?:From|Set|Unset|Import|Local Open Scope)\b")
REQUIRE = re.compile(r"From\s+faultspace\s+Require(?:\s+(Import|Export))?([\s\w]*)\.")
TOKEN = re.compile(rf"{NAME}(?:\.{NAME})*")
WORD = re.compile(rf"(?:Definition|Fixpoint|Record|Inductive|Variant|Notation)\s+({NAME})")
# A second word in one sentence, which would have no name here.
MUTUAL = re.compile(rf"\bwith\s+{NAME}(?:(?!=>|\bwith\b).)*:=")
# What may change how a text is read far away from where it stands, among what `sentences` lets stand at all.
FAR = re.compile(r'Canonical |Add |Notation "')


@dataclass(frozen=True)
class Headline:
    """A headline is a theorem as its file states it. `statement` is binders and proposition with their colon, `tactics` the sentences of
    its proof."""

    name: str
    statement: str
    tactics: str
    file: str


@dataclass(frozen=True)
class Word:
    """A word is what a name of a vocabulary means. `name` has its module before it, `text` the variables of its sections; `place` orders a
    file."""

    name: str
    text: str
    file: str
    place: int
    module: str

    @property
    def key(self) -> str:
        """The name of the word with its file, which tells it from all other words."""
        return f"{self.file.removesuffix('.v')}.{self.name}"


@dataclass(frozen=True)
class Statements:
    """The headlines by name, the words of each vocabulary by the names that stand for them, all that each vocabulary says, in its order,
    what each file opens with, and what may change the meaning of a text from afar. `imports`: the vocabularies that a file sees, the last
    one first.
    """

    headlines: Mapping[str, Headline]
    words: Mapping[str, Mapping[str, Word]]
    vocabularies: Mapping[str, tuple[str, ...]]
    openings: Mapping[str, str]
    imports: Mapping[str, tuple[str, ...]]
    far: tuple[str, ...]

    @cached_property
    def _uses(self) -> dict[str, tuple[Word, ...]]:
        return {word.key: self._named(word.text, word.file, word) for words in self.words.values() for word in words.values()}

    def reached(self, headline: Headline) -> list[Word]:
        """Return the words that the statement uses, and those that these use, by their keys. Raises NotProved where one is of no
        vocabulary."""
        found: dict[str, Word] = {}
        waiting = [*self._named(headline.statement, headline.file, None)]
        while waiting:
            word = waiting.pop()
            if word.key not in found:
                found[word.key] = word
                waiting += self._uses[word.key]
        return [found[key] for key in sorted(found)]

    def uses(self, word: Word) -> tuple[Word, ...]:
        """Return the words that the definition of a word names."""
        return self._uses[word.key]

    def named(self, text: str, file: str) -> tuple[Word, ...]:
        """Return the words that a text of this file names."""
        return self._named(text, file, None)

    def _named(self, text: str, file: str, inside: Word | None) -> tuple[Word, ...]:
        names = dict.fromkeys(TOKEN.findall(text))
        return tuple({word.key: word for name in names if (word := self._meant(name, file, inside)) is not None}.values())

    def _meant(self, name: str, file: str, inside: Word | None) -> Word | None:
        """Return the word that this name stands for in that file, or in that word of it."""
        first, _, rest = name.partition(".")
        if rest and f"{first}.v" in self.openings:
            return self.words.get(f"{first}.v", {}).get(rest)
        if inside is not None:
            own = self.words[inside.file]
            for candidate in ([f"{inside.module}.{name}"] if inside.module else []) + [name]:
                if candidate in own and own[candidate].place <= inside.place:
                    return own[candidate] if own[candidate].key != inside.key else None
        for vocabulary in self.imports[file]:
            if name in self.words[vocabulary]:
                return self.words[vocabulary][name]
        return None


def read(texts: Mapping[str, str]) -> Statements:
    """Read the statements of these sources, file name -> text. Raises NotProved where a file breaks the rules."""
    parted = {name: sentences(text) for name, text in texts.items()}
    files = sorted(name for name in texts if HEADLINES.fullmatch(name))
    vocabularies = sorted(name for name in texts if VOCABULARY.fullmatch(name))
    headlines: dict[str, Headline] = {}
    words: dict[str, dict[str, Word]] = {}
    for name in files:
        for headline in _headlines(name, parted[name]):
            if headline.name in headlines:
                raise NotProved(f"{name}: the headline {headline.name} is in {headlines[headline.name].file} already")
            headlines[headline.name] = headline
    for name in vocabularies:
        words[name] = _words(name, parted[name])
    openings = {name: _opening(parted[name]) for name in [*files, *vocabularies]}
    seen = {name: _imported(name, texts, parted) for name in openings}
    far = tuple(f"{name}: {one}" for name in sorted(texts) for one in parted[name] if name not in files and FAR.match(one))
    _refuse_namesakes(openings, parted)
    statements = Statements(headlines, words, {name: parted[name] for name in vocabularies}, openings, seen, far)
    others = {name.removesuffix(".v") for name in texts if name not in vocabularies}
    for headline in headlines.values():
        _refuse_outside(f"{headline.file}: the headline {headline.name}", headline.statement, others)
    for name in vocabularies:
        for word in words[name].values():
            _refuse_outside(f"{name}: the word {word.name}", word.text, others)
    return statements


def _opening(found: Sequence[str]) -> str:
    """Return what a file opens with, but for the files that it requires without importing them: these bring no name into sight."""
    return " ".join(one for one in found if OPENING.match(one) and not _only_required(one))


def _only_required(sentence: str) -> bool:
    m = REQUIRE.fullmatch(sentence)
    return m is not None and m[1] is None


def _imported(name: str, texts: Mapping[str, str], parted: Mapping[str, Sequence[str]]) -> tuple[str, ...]:
    """Return the vocabularies that a file imports, with those that they import, the last one first."""
    order = list[str]()
    for one in parted[name]:
        m = REQUIRE.fullmatch(one)
        if m is None or (m[1] is None and not VOCABULARY.fullmatch(name)):
            continue
        for module in m[2].split():
            file = f"{module}.v"
            if not VOCABULARY.fullmatch(file) or file not in texts:
                raise NotProved(f"{name} imports {module}, which is no vocabulary: a name of it could be in a statement and in no lock")
            order += [*reversed(_imported(file, texts, parted)), file]
    return tuple(dict.fromkeys(reversed(order)))


def _headlines(name: str, found: Sequence[str]) -> Iterator[Headline]:
    """Return the theorems of a file that holds nothing else."""
    waiting = iter(found)
    begun = False
    for one in waiting:
        if (OPENING.match(one) and not begun) or re.fullmatch(r"Include Headlines\w*\.", one):
            continue
        begun = True
        theorem = re.fullmatch(rf"Theorem ({NAME})(.*)\.", one)
        if theorem is None:
            raise NotProved(f"{name}: a file of headlines holds theorems alone, and this is none: {short(one)}")
        tactics = list[str]()
        for step in waiting:
            if step == "Qed.":
                break
            if not (step[0].islower() if tactics else step == "Proof."):
                raise NotProved(f"{name}: the proof of {theorem[1]} ends without Qed, or is no proof: {short(step)}")
            tactics.append(step)
        else:
            raise NotProved(f"{name}: the proof of {theorem[1]} ends without Qed: the file ends there")
        yield Headline(theorem[1], theorem[2], " ".join(tactics[1:]), name)


def _words(name: str, found: Sequence[str]) -> dict[str, Word]:
    """Return the words of a file that defines and does nothing else, by each name that stands for one: of a record its fields too."""
    words: dict[str, Word] = {}
    around: list[tuple[str, str, list[str]]] = []
    for place, one in enumerate(found):
        if OPENING.match(one) and not words and not around:
            continue
        if opened := re.fullmatch(rf"(Section|Module) ({NAME})\.", one):
            around.append((opened[1], opened[2], []))
        elif (closed := re.fullmatch(rf"End ({NAME})\.", one)) and around and around[-1][1] == closed[1]:
            around.pop()
        elif re.match(r"(?:Variables?|Implicit Types?)\b", one) and around and around[-1][0] == "Section":
            around[-1][2].append(one)
        elif (defined := WORD.match(one)) and not MUTUAL.search(one):
            module = ".".join(title for kind, title, _ in around if kind == "Module")
            text = " ".join([*(said for _, _, variables in around for said in variables), one])
            for title in [defined[1], *_fields(one)]:
                full = f"{module}.{title}" if module else title
                if full in words:
                    raise NotProved(f"{name}: {full} is defined twice")
                words[full] = Word(f"{module}.{defined[1]}" if module else defined[1], text, name, place, module)
        else:
            raise NotProved(f"{name}: a vocabulary defines words and does nothing else, and this does: {short(one)}")
    return words


def _fields(sentence: str) -> list[str]:
    """Return the constructor and the fields of a record, or the constructors of an inductive type."""
    if sentence.startswith("Record"):
        record = re.fullmatch(rf".*?:=\s*({NAME})?\s*\{{(.*)\}}\.", sentence)
        if record is None:
            raise NotProved(f"this record is written in a way that is not read here: {short(sentence)}")
        return [*filter(None, [record[1]]), *(field.split(":")[0].strip() for field in record[2].split(";"))]
    if re.match(r"Inductive|Variant", sentence):
        return re.findall(rf"\|\s*({NAME})", sentence.partition(":=")[2]) or re.findall(rf":=\s*({NAME})", sentence)
    return []


def _refuse_namesakes(openings: Mapping[str, str], parted: Mapping[str, Sequence[str]]) -> None:
    """Rocq takes the last module that has a name, so that one of ours could stand for MathComp's where that is imported by its name."""
    ours = {file.removesuffix(".v"): file for file in parted}
    for file, found in parted.items():
        ours |= {opened[1]: file for one in found if (opened := re.match(rf"(?:Module|Section) ({NAME})", one))}
    for file, opening in openings.items():
        for name in TOKEN.findall(opening):
            if (head := name.partition(".")[0]) != name and head in ours:
                raise NotProved(f"{file} imports {name}, and {ours[head]} has another {head}")


def _refuse_outside(what: str, text: str, others: set[str]) -> None:
    for name in TOKEN.findall(text):
        if "." in name and name.split(".")[0] in others:
            raise NotProved(f"{what} speaks of {name}, which is in no vocabulary")
