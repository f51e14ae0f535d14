"""The names that `faultspace.numeric` offers: each is there, says what it needs to, and its examples run."""

from __future__ import annotations

import doctest
import inspect
import re
import subprocess
import sys
from types import FunctionType
from typing import Any

import pytest

from faultspace import numeric
from tests.end_to_end.commands import ROOT, environment

FUNCTIONS = [name for name in numeric.__all__ if isinstance(getattr(numeric, name), FunctionType)]
SAYS = {"shapes": r"\(N?,? ?n?|\(p\)", "units": r"\bunits?\b", "errors": r"\bRaises\b", "source": r"\[[A-Z]+\d\d\b|\bsource\b|\bfile\b"}


def unsaid(text: str) -> list[str]:
    """Return what a docstring does not say."""
    return [what for what, pattern in SAYS.items() if not re.search(pattern, text)] + ([] if ">>>" in text else ["example"])


@pytest.mark.parametrize("name", numeric.__all__)
def test_a_public_name_is_there_and_documented(name: str) -> None:
    assert inspect.getdoc(getattr(numeric, name))


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_function_says_what_it_takes_and_raises_and_its_example_runs(name: str) -> None:
    function = getattr(numeric, name)
    assert unsaid(function.__doc__) == []
    names: dict[str, Any] = vars(sys.modules[function.__module__])
    (found,) = doctest.DocTestFinder(recurse=False).find(function, name, globs=dict(names))
    assert found.examples and doctest.DocTestRunner(verbose=False).run(found).failed == 0


def test_a_docstring_that_says_nothing_is_noticed() -> None:
    assert unsaid("Of the residual.") == [*SAYS, "example"]


def test_no_module_has_the_name_of_what_the_room_exports() -> None:
    folders = {getattr(numeric, name).__module__.rpartition(".")[2] for name in numeric.__all__}
    assert not folders & set(numeric.__all__)


def test_the_room_loads_nothing_before_it_is_asked() -> None:
    line = "import sys, faultspace.numeric as room; print('numpy' in sys.modules); room.identify; print('flint' in sys.modules)"
    run = subprocess.run([sys.executable, "-c", line], capture_output=True, text=True, cwd=ROOT, env=environment(), timeout=60, check=True)
    assert run.stdout.split() == ["False", "False"]
