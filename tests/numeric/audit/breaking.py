"""What a mutant is: the reference with one thing broken, as an adapter, and the slug of a check that must catch it.

Mutant      name, what is wrong, the slug, `adapter` (a namespace with the broken functions alone), `also`: further slugs that catch it
mutant      one of these from its broken functions by name
patched     a function, run while attributes of modules or classes are replaced
views       the slugs of a check in these views
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch


@dataclass(frozen=True)
class Mutant:
    """A broken implementation and the check that it must fail."""

    name: str
    wrong: str
    caught_by: str
    adapter: Any
    also: tuple[str, ...] = ()


def patched(function: Callable[..., Any], *patches: tuple[Any, str, Any]) -> Callable[..., Any]:
    """The function, run with these attributes (owner, name, value) replaced."""

    @contextmanager
    def all_of(left: tuple[tuple[Any, str, Any], ...]) -> Iterator[None]:
        if not left:
            yield
            return
        with patch.object(*left[0]), all_of(left[1:]):
            yield

    def run(*arguments: Any) -> Any:
        with all_of(patches):
            return function(*arguments)

    return run


def mutant(name: str, wrong: str, caught_by: str, *also: str, **functions: Callable[..., Any]) -> Mutant:
    """It breaks these functions of the reference, and offers no others."""
    return Mutant(name, wrong, caught_by, SimpleNamespace(**functions), also)


def views(slug: str, *suffixes: str) -> tuple[str, ...]:
    """They are the slugs of these views of a check."""
    return tuple(f"{slug}-{suffix}" for suffix in suffixes)
