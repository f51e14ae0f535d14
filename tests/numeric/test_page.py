"""The page of a record is complete in itself, harmless whatever a channel is called, and says in words what is open."""

from __future__ import annotations

from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from faultspace.base.page import Picture, Tile, page
from faultspace.numeric import fault_onset, identify, isolate_shift
from faultspace.numeric.data.records import recorded, stored
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.plant.report import residual_spectra as spectra
from faultspace.numeric.plant.report.result_page import CAPTIONS, report, tiles
from faultspace.numeric.plant.report.result_pictures import PICTURES
from faultspace.numeric.plant.report.summary import advice, summary
from faultspace.numeric.plant.steps.findings import Answer

PLANT = StateSpaceModel([[0.5, 0.2], [0.0, 0.3]], [[1.0], [0.5]], [[1.0, 0.0], [0.3, 1.0]], [[0.0], [0.0]])
EVIL = "<script>alert('y')</script>"


class Elements(HTMLParser):
    """Collects the elements of a page with their attributes, those that stay open, and the words."""

    EMPTY = ("meta", "img", "br", "hr", "!doctype")

    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: list[tuple[str, dict[str, str | None]]] = []
        self.stack: list[str] = []
        self.words = ""
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append((tag, dict(attrs)))
        if tag not in self.EMPTY:
            self.stack.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert tag in self.EMPTY or self.stack.pop() == tag

    def handle_data(self, data: str) -> None:
        self.words += data

    def names(self) -> list[str]:
        return [name for name, _ in self.found]


@pytest.fixture(scope="module")
def found() -> Answer:
    u = np.random.default_rng(1).standard_normal((400, 1))
    y = PLANT.simulate(u) + 0.01 * np.random.default_rng(2).standard_normal((400, 2))
    return identify(recorded(y, u, outputs=(EVIL, "y|2"), inputs=("u",)), order=2)


def test_the_page_is_well_formed_fetches_nothing_and_runs_nothing(found: Answer, tmp_path: Path) -> None:
    for name in PICTURES[:2]:
        (tmp_path / name).write_bytes(b"\x89PNG")
    seen = Elements(report(found, [*summary(found, EVIL)], tmp_path, EVIL))
    assert seen.stack == [] and "script" not in seen.names() and "link" not in seen.names()
    assert EVIL in seen.words, "a name is shown as it is"
    for name, attributes in seen.found:
        for attribute in ("src", "href", "onload", "onerror", "srcset"):
            value = attributes.get(attribute)
            assert value is None or (name == "img" and value.startswith("data:image/png;base64,")), (name, attributes)
    images = [attributes for name, attributes in seen.found if name == "img"]
    assert len(images) == 2 and all(attributes["alt"] for attributes in images)
    assert seen.names().count("h1") == 1 and ("html", {"lang": "en"}) in seen.found


def test_every_picture_has_a_caption_and_its_words() -> None:
    assert set(CAPTIONS) == set(PICTURES)


def test_a_wide_picture_can_be_scrolled_on_a_phone_and_a_long_answer_is_set_smaller() -> None:
    header = b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR"
    wide, square = (header + width.to_bytes(4, "big") + (500).to_bytes(4, "big") for width in (1000, 500))
    text = page(
        "t", "# t", tiles=[Tile("A", "x" * 31, ""), Tile("B", "y", "")], pictures=[Picture(wide, "", "", ""), Picture(square, "", "", "")]
    )
    assert text.count('class="pane wide"') == text.count('class="pane"') == 1
    assert text.count('class="answer long"') == text.count('class="answer"') == 1


def test_a_fit_below_zero_is_explained_and_its_advice_comes_first(found: Answer) -> None:
    draw = np.random.default_rng(1)
    u = draw.standard_normal((400, 1))
    y = PLANT.simulate(u) + 0.1 * draw.standard_normal((400, 2)) + [0.0, 500.0]
    off = identify(y, u, order=2, operating_point="zero")
    words = "\n".join(summary(off, "x"))
    assert "below zero: the simulated y2 lies" in words and "missed of y2 is mostly its level" in words
    assert advice(off)[0].startswith('operating_point="means", before anything else')
    assert {tile.of: tile for tile in tiles(off)}["Model"].rests.startswith("It misses the level of an output")
    for fine in (found, identify(y, u, order=2, operating_point="means")):
        words = "\n".join(summary(fine, "x"))
        assert "below zero" not in words and not any(line.startswith("operating_point") for line in advice(fine))


def test_spectra_show_the_frequency_of_a_fault_and_are_left_out_of_short_records(found: Answer) -> None:
    assert found.residual is not None
    r = np.random.default_rng(5).standard_normal((1200, 2))
    r[500:, 1] += 2 * np.sin(2 * np.pi * 0.125 * np.arange(700))
    changed = replace(found, residual=replace(found.residual, store=stored(r)), onset=fault_onset(r), signal=None)
    (_, quiet), (name, curves) = spectra.panels(changed)
    assert name == "y|2" and [what for what, _ in curves] == ["before the onset", "after the onset"]
    before, after = (density for _, density in curves)
    assert np.argmax(after) == round(0.125 * 2 * (len(after) - 1)) and after.max() > 10 * before.max()
    assert max(density[1:].max() for _, density in quiet) < 10  # white noise of power one has the density 2
    whole = spectra.panels(replace(changed, onset=None))[1][1]
    assert [what for what, _ in whole] == ["whole record"]
    power = 0.5 * np.mean(whole[0][1]) / np.var(r[:, 1])
    assert 0.8 < power < 1.2, "the density adds up to the power"
    assert spectra.panels(replace(changed, residual=replace(found.residual, store=stored(r[:60])), onset=None)) == []


def test_pictures_stand_in_their_section_or_last() -> None:
    pictures = [Picture(b"a", "Two", "second", "2"), Picture(b"b", "Nowhere", "lost", "3")]
    text = page("t", "# t\n\n## One\n\nfirst\n\n## Two\n\nwords\n", pictures=pictures)
    assert text.index("first") < text.index("words") < text.index("second") < text.index("Pictures") < text.index("lost")


def test_an_open_answer_says_so_in_words_not_in_colour_alone(found: Answer) -> None:
    shown = {tile.of: tile for tile in tiles(replace(found, n_v=None, possible=(1, 2)))}
    assert shown["Faults"] == Tile("Faults", "undecided: 1 or 2", "See the section on faults.", False)
    assert 'class="tile open"' in page("t", "# t", tiles=[shown["Faults"]])


def test_a_zero_that_rests_on_the_noise_is_no_bare_zero(found: Answer) -> None:
    assert found.n_v == 0 and found.noise_level is None
    shown = {tile.of: tile for tile in tiles(found)}["Faults"]
    assert not shown.decided and shown.answer == "none told from noise" and "noise" in shown.rests
    assert found.mean is not None
    moved = {tile.of: tile for tile in tiles(replace(found, mean=replace(found.mean, shifted=True)))}["Faults"]
    assert moved.answer == "a constant one acts" and not moved.decided


def test_onset_and_cause_stand_at_the_head(found: Answer) -> None:
    rng = np.random.default_rng(5)
    r = rng.standard_normal((600, 2))
    r[400:, 1] += 20
    onset, shift = fault_onset(r), isolate_shift([0.0, 20.0], 0.01 * np.eye(2), PLANT)
    shown = {tile.of: tile for tile in tiles(replace(found, onset=onset, shift_isolation=shift))}
    assert shown["Onset"].answer == f"sample {onset.onsets[0].sample}" and "0.95" in shown["Onset"].rests
    assert "a sensor fault on y2 explains the shift" in shown["Cause"].answer and shown["Cause"].decided
    assert "Cause" not in {tile.of for tile in tiles(replace(found, shift_isolation=None, isolation=None))}


def test_no_healthy_count_of_zero_is_a_bare_zero(found: Answer) -> None:
    shown = {tile.of: tile for tile in tiles(replace(found, healthy=100))}["Faults"]
    assert shown.answer == "none seen" and "from which size on" in shown.rests
