"""These are fixtures of the tests of commands.

record        the packaged record
csv_file      the same as a table
rendered      a test that asks for it has its pictures rendered; of all others they are drawn, and a line of words is written as the file
"""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

import pytest

from faultspace import example_data as made
from tests.end_to_end.identify_runs import small_csv


@pytest.fixture(scope="session")
def record() -> made.FaultyRecord:
    return made.faulty_record()


@pytest.fixture
def csv_file(tmp_path: Path, record: made.FaultyRecord) -> Path:
    return small_csv(tmp_path, made.csv_text(record), made.FILE_NAME)


@pytest.fixture
def rendered() -> None:
    """Matplotlib renders the pictures of this test, which takes two thirds of the time of `identify`."""


@pytest.fixture(autouse=True)
def _not_rendered(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    if "rendered" in request.fixturenames or importlib.util.find_spec("matplotlib") is None:
        return

    def savefig(figure: object, file: Any, **options: Any) -> None:
        file.write(b"not rendered")

    monkeypatch.setattr("matplotlib.figure.Figure.savefig", savefig)
