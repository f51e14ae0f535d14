"""The words of the glossary in the page of a run: where a section uses one first, it leads to what the word means.

FORMS       a word of the glossary -> how it stands in a sentence
place       the name that a place about this word has in an address
first_use   where a text uses a word first
linked      a section of the page, with these links
anchor      a name that an address can hold
Link        a text with the place it leads to
source      the keys such as [G25] of a text, as links to the section of sources
prose       Markdown of ours as HTML
"""

from __future__ import annotations

import re
from collections.abc import Collection, Container, Mapping
from dataclasses import dataclass

from markdown_it import MarkdownIt
from markupsafe import Markup, escape

# Words of every day are listed as far as they mean on our pages what the glossary says: a pencil is also what one writes with.
FORMS: Mapping[str, str] = {
    "Additive fault": "additive faults?",
    "Fault matrices": "fault matri(?:ces|x)",
    "Residual": "residuals?",
    "Output behaviour": "output behaviours?",
    "Feedthrough": "feedthroughs?",
    "Observable": "observable|(?<!strong )observability(?! matri| index)",
    "Markov parameters": "Markov parameters",
    "Window": "(?-i:windows?|Window)(?! ranks?)",
    "Observability matrix": "observability matri(?:x|ces)",
    "Toeplitz matrix": "Toeplitz matri(?:x|ces)",
    "Window rank": "window ranks?",
    "Rank gap": "rank gaps?",
    "Persistency of excitation": "persistently exciting|persistency of excitation",
    "Kernel representation": "kernel representations?",
    "Left minimal indices": "left minimal ind(?:ices|ex)",
    "Right minimal indices": "right minimal ind(?:ices|ex)",
    "Lag": "lags?",
    "System pencil": "system pencils?|(?<=the )pencil",
    "Normal rank": "normal rank",
    "Left-invertible": "left-invertible",
    "Inversion delay": "inversion delays?",
    "Output-nulling subspace": "output-nulling subspaces?",
    "Finite zero": "finite zeros?",
    "Infinite zero": "infinite zeros?",
    "Zeta": "zeta",
    "Number of faults": "number of faults",
    "Problem 11": r"problem (?:11|\(11\))",
    "Fault space": "fault spaces?",
    "Choice of a pair": "(?<!your )choices?",
    "Angle of a space": "angles?",
    "PI-MOESP and PO-MOESP": "P[IO]-MOESP",
    "Population limit": "population limits?",
    "Consistent": "consistent|consistency",
    "Cramer-Rao bound": "Cramer-Rao bounds?",
    "Healthy samples": "healthy (?:samples?|records?)",
    "Onset": "onsets?",
    "Operating point": "operating points?",
    "Claim and reading": "readings?",
    "Certificate": "certificates?",
    "Counterexample": "counterexamples?",
}
_PATTERNS = {word: re.compile(rf"(?<![\w-])(?:{form})(?![\w-])", re.IGNORECASE) for word, form in FORMS.items()}
_TAG = re.compile(r"(<[^>]*>)")  # the templates escape every > that is no end of a tag
_NAME = re.compile(r"</?([a-zA-Z0-9]+)")
# What is a link or a heading already, what is no sentence, and what HTML has no links in.
_CLOSED = frozenset(
    ("a", "caption", "code", "dt", "figcaption", "h1", "h2", "h3", "h4", "math", "option", "pre", "script", "style", "summary", "svg", "th")
)


def place(word: str) -> str:
    """Return what stands behind # in an address."""
    return re.sub(r"[^\w\- ]", "", word.lower()).replace(" ", "-")


def first_use(word: str, text: str) -> re.Match[str] | None:
    """Return the first use of a word of FORMS in what is text alone."""
    return _PATTERNS[word].search(text)


def linked(section: str, words: Collection[str]) -> str:
    """Return the HTML of a section with a link from the first use of each of these words, in each article anew."""
    parts, left, depth = _TAG.split(section), set(words), 0
    for at, part in enumerate(parts):
        if at % 2 == 1:
            named = _NAME.match(part)
            name = named.group(1) if named else ""
            if name == "article":
                left = set(words)
            elif name in _CLOSED:
                depth += -1 if part.startswith("</") else 1
        elif depth == 0 and part.strip():
            parts[at] = _of_text(part, left)
    return "".join(parts)


def _of_text(text: str, left: set[str]) -> str:
    """Return a piece of text with its links, and take the words that have one now from those that are left."""
    uses = sorted((use.start(), use.end(), word) for word in left if (use := first_use(word, text)))
    pieces, done = [], 0
    for begin, end, word in uses:
        if begin >= done:
            pieces += [text[done:begin], f'<a class="word" href="#word-{place(word)}">{text[begin:end]}</a>']
            left.discard(word)
            done = end
    return "".join([*pieces, text[done:]])


KEY = re.compile(r"\[([A-Z][A-Za-z]{0,3}[0-9]{2})\]")
RELATIVE = re.compile(r"\[([^\]]+)\]\((?!https?:|#)[^)]*\)")  # to a file of the tree, which a page that stands alone does not have
_MARKDOWN = MarkdownIt("commonmark", {"html": False})


@dataclass(frozen=True)
class Link:
    """`href` begins with # where it leads to a place in the page."""

    text: str
    href: str


def anchor(kind: str, name: str) -> str:
    """Return the name of a place."""
    return f"{kind}-{re.sub(r'[^A-Za-z0-9_.-]+', '-', name)}"


def cited(text: str, keys: Container[str]) -> Markup:
    """Return the text with those keys as links that have an entry among the sources."""

    def link(found: re.Match[str]) -> str:
        key = found.group(1)
        return f'<a href="#{anchor("source", key)}">[{key}]</a>' if key in keys else found.group()

    return Markup(KEY.sub(link, str(escape(text))))


def prose(text: str) -> Markup:
    """Return one paragraph without the paragraph's own tags; links into the tree are left as their words, CHANGELOG is the section here."""
    text = RELATIVE.sub(lambda found: "[CHANGELOG](#withdrawn)" if found.group(1) == "CHANGELOG" else found.group(1), text)
    return Markup(_MARKDOWN.renderInline(text))
