"""The words of the glossary in the page of a run: each is there, and the first use of one leads to it."""

from __future__ import annotations

import re

import pytest

from faultspace.review.computed import texts
from faultspace.review.view.words import FORMS, first_use, linked, place
from tests.end_to_end.commands import ROOT

LINK = re.compile(r'<a class="word" href="#word-([\w-]+)">(.*?)</a>')


def found(section: str, words: tuple[str, ...] = tuple(FORMS)) -> list[tuple[str, str]]:
    return LINK.findall(linked(section, words))


def test_every_entry_of_the_glossary_is_read() -> None:
    text = (ROOT / "docs" / "glossary.md").read_text("utf-8")
    assert [one.name for one in texts.words()] == re.findall(r"^### (.+)$", text, re.MULTILINE) == list(FORMS)
    lag = next(one for one in texts.words() if one.name == "Lag")
    assert lag.symbol.startswith("lag, the largest eta") and lag.meaning.startswith("The lag is the least L") and lag.source == "[W91]"
    markov = next(one for one in texts.words() if one.name == "Markov parameters")
    assert markov.symbol.endswith("for inputs") and markov.meaning.startswith("The Markov parameters are")
    assert len({place(word) for word in FORMS}) == len(FORMS)


def test_a_package_without_the_text_has_no_links(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(texts, "tree_text", lambda name: "")
    assert texts.words() == [] and linked("<p>The lag.</p>", ()) == "<p>The lag.</p>"


def test_the_first_use_leads_to_the_word_and_the_next_does_not() -> None:
    assert linked("<p>The Lag and the lag.</p>", FORMS) == '<p>The <a class="word" href="#word-lag">Lag</a> and the lag.</p>'
    assert found("<p>The lag.</p><article><p>The lag.</p></article><article><p>The lag.</p></article>") == [("lag", "lag")] * 3


def test_the_longer_of_two_words_is_meant() -> None:
    assert found("<p>The window rank of a window</p>") == [("window-rank", "window rank"), ("window", "window")]
    assert found("<p>the observability matrix, and observability</p>") == [
        ("observability-matrix", "observability matrix"),
        ("observable", "observability"),
    ]
    assert found("<p>PI-MOESP, lagging, un-lag, a pencil, problem (11)</p>") == [
        ("pi-moesp-and-po-moesp", "PI-MOESP"),
        ("problem-11", "problem (11)"),
    ]


@pytest.mark.parametrize("tag", ["a", "code", "h2", "h3", "summary", "caption", "svg", "option", "pre", "th", "math"])
def test_nothing_is_changed_where_no_link_can_be(tag: str) -> None:
    inside = f'<{tag} title="lag"><b>lag</b> zeta</{tag}>'
    assert linked(inside, FORMS) == inside
    assert found(f"{inside}<p>the lag</p>") == [("lag", "lag")]


def test_without_the_links_the_text_is_as_it_was() -> None:
    section = "<h2>Lag</h2><p>The residual &amp; its <em>lag</em> &lt;lag&gt; a<br>zeta, certificates <code>lag</code>.</p>"
    assert LINK.sub(r"\2", linked(section, FORMS)) == section and len(found(section)) == 4


@pytest.mark.parametrize("word", FORMS)
def test_each_word_is_found_in_its_own_entry(word: str) -> None:
    entry = next(one for one in texts.words() if one.name == word)
    assert first_use(word, entry.meaning) or first_use(word, entry.name)
