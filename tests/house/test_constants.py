"""Constants of numeric are judged: each float says what it rests on, and commands that are named exist with their tables and options.

What follows from data that were looked at stood in SET_BY_HAND, by module; whoever calibrated one struck it out, and none is added: none is
left.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]
MODULES = sorted((ROOT / "numeric").rglob("*.py"))
SET_BY_HAND = set[str]()
WORDS = re.compile(r"(?:set|revised|settled) (?:by hand|after looking)|rules? of thumb with", re.IGNORECASE)
COMMAND = re.compile(r"`?(?:python )?(?:benchmarks/)?(\w+\.py)((?: (?:--)?[a-z_]+)?)`")


def constants(tree: ast.Module) -> Iterator[tuple[int, tuple[str, ...], ast.stmt | None]]:
    """Yield line, names and the next statement of what is a float, or has one among its numbers, and is named in capitals."""
    for place, statement in enumerate(tree.body):
        if not isinstance(statement, ast.Assign) or not isinstance(target := statement.targets[0], ast.Name | ast.Tuple):
            continue
        names = tuple(one.id for one in (target.elts if isinstance(target, ast.Tuple) else [target]) if isinstance(one, ast.Name))
        floats = [one for one in ast.walk(statement.value) if isinstance(one, ast.Constant) and isinstance(one.value, float)]
        plain = all(
            isinstance(one, ast.Constant | ast.Tuple | ast.BinOp | ast.UnaryOp | ast.operator | ast.unaryop | ast.Load)
            for one in ast.walk(statement.value)
        )
        if names and all(name.strip("_").isupper() for name in names) and floats and plain:
            yield statement.lineno, names, tree.body[place + 1] if place + 1 < len(tree.body) else None


def explained(path: Path) -> Iterator[tuple[tuple[str, ...], bool]]:
    """Yield the names of each constant, and whether a comment, a string below or the head of the module speaks of it."""
    text = path.read_text("utf-8")
    tree, lines = ast.parse(text), text.splitlines()
    head = ast.get_docstring(tree) or ""
    for line, names, after in constants(tree):
        below = isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant) and isinstance(after.value.value, str)
        yield names, "  # " in lines[line - 1] or lines[line - 2].startswith("# ") or below or all(name in head for name in names)


def test_every_constant_says_what_it_rests_on() -> None:
    found = [(str(path.relative_to(ROOT)), names, said) for path in MODULES for names, said in explained(path)]
    assert len(found) > 100
    assert [one[:2] for one in found if not one[2]] == []


def test_what_is_set_by_hand_is_known() -> None:
    found = {str(path.relative_to(ROOT / "numeric")) for path in MODULES if WORDS.search(path.read_text("utf-8"))}
    assert found == SET_BY_HAND


def test_commands_that_constants_name_exist() -> None:
    named = {match for path in MODULES for match in COMMAND.findall(path.read_text("utf-8").replace("\n# ", " ").replace("\n", " "))}
    scripts = {name: word.strip() for name, word in named if (ROOT / "benchmarks" / name).exists()}
    assert len(scripts) > 6
    for name, word in named:
        path = ROOT / "benchmarks" / name
        if path.exists() and word:
            parts = sorted(path.parent.glob(f"{path.stem}*.py"))  # a script and what it is made of
            assert any(f'"{word.strip()}"' in part.read_text("utf-8") for part in parts), (name, word)


def test_a_constant_without_a_word_is_found(tmp_path: Path) -> None:
    path = tmp_path / "module.py"
    path.write_text('"""Of A."""\n\nA = 1.5\nB, C = 2, 0.5\nD = 3\nE = 1e-3  # told\n', "utf-8")
    assert list(explained(path)) == [(("A",), True), (("B", "C"), False), (("E",), True)]
