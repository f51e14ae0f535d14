"""These are fixtures of the tests of commands.

rendered      a test that asks for it has its pictures rendered; of all others they are drawn, and a line of words is written as the file
"""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

import pytest


@pytest.fixture
def rendered() -> None:
    """Matplotlib renders the pictures of this test, which takes two thirds of the time of `identify`."""


@pytest.fixture(autouse=True)
def _not_rendered(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    if "rendered" in request.fixturenames or importlib.util.find_spec("matplotlib") is None:
        return

    def savefig(figure: object, path: Any, **options: Any) -> None:
        Path(path).write_bytes(b"not rendered")

    monkeypatch.setattr("matplotlib.figure.Figure.savefig", savefig)
