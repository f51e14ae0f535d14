"""How a script comes by the function that it calls.

loaded     the lines that define it, or say where to paste it
inlined    an adapter of ours as a text that imports nothing of ours
"""

from __future__ import annotations

import ast
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path

from ...peers import peer as peer_named

OWN = {
    "Array": "Array = object",
    "ZeroStructure": "from types import SimpleNamespace\n\n\ndef ZeroStructure(rank, zeros, orders, invertible):\n"
    "    return SimpleNamespace(normal_rank=rank, finite_zeros=zeros, infinite_zero_orders=orders, left_invertible=invertible)",
    "Refused": "class Refused(ValueError):\n    pass",
}
"""What adapters of peers import of ours, as a script defines it."""
CALLS = {"python": "#", "octave": "%", "matlab": "%", "julia": "#"}


def loaded(
    function: str, language: str, *, adapter: str | None = None, peer: str | None = None, command: str | Sequence[str] | None = None
) -> list[str]:
    """Return the lines before the question."""
    mark = CALLS[language]
    if peer is not None:
        known = peer_named(peer)
        if language == "python" and known.adapter is not None:
            module, _, attribute = known.adapter.rpartition(".")[2].partition(":")
            bound = [f"{function} = {attribute}.{function}"] if attribute else []
            return [f"# -- how {known.title} is called", *inlined(module).splitlines(), *bound, "", "# -- the question"]
        if language == "octave" == known.language.lower() and known.command is not None:
            return [f"% -- how {known.title} is called", *_octave(Path(known.command[4]), function), "", "% -- the question"]
        if language == "julia" == known.language.lower() and known.command is not None:
            return [f"# -- how {known.title} is called", *_without_protocol(Path(known.command[-1]), "include("), "", "# -- the question"]
    if language == "python" and command is None and peer is None:
        return [*_imported(function, adapter), "", "# -- the question"]
    return [
        f"{mark} -- the function: define {function} before this line, or replace its name in the call below by that of yours",
        "",
        f"{mark} -- the question",
    ]


def _imported(function: str, adapter: str | None) -> list[str]:
    """Return the import of an adapter by its name; without a name it is our own code."""
    place, _, attribute = (adapter or "faultspace.numeric.audit.reference").rpartition(":")
    if not place:
        place, attribute = attribute, ""
    lines = ["# -- the function: this imports the one that was audited; paste it here to send the script to others"]
    if place.endswith(".py"):
        path = Path(place).resolve()
        lines.append(f"sys.path.insert(0, {str(path.parent)!r})")
        place = path.stem
    if not attribute:
        return [*lines, f"from {place} import {function}"]
    first, *rest = attribute.split(".")
    found = ".".join([first, *rest])
    return [*lines, f"from {place} import {first}", "", f"{function} = ({found}() if isinstance({found}, type) else {found}).{function}"]


def inlined(module: str) -> str:
    """Return the source of a peer's adapter without its docstring, with what it imports of ours defined in it."""
    source = files("faultspace.numeric.audit.peers").joinpath(f"{module}.py").read_text("utf-8")
    parts, kept = list[str](), list[str]()
    for node in ast.parse(source).body:
        if isinstance(node, ast.ImportFrom) and node.module == "__future__":
            continue
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            continue
        if _promises(node):
            continue
        if isinstance(node, ast.ImportFrom) and node.level:
            parts += [OWN[name.name] if name.name in OWN else inlined(str(node.module)) for name in node.names]
            continue
        kept.append(ast.get_source_segment(source, node) or "")
        if isinstance(node, ast.FunctionDef):
            kept[-1] = "\n\n" + kept[-1] + "\n"
    return "\n".join(dict.fromkeys(parts)) + "\n" + "\n".join(kept)


def _promises(node: ast.stmt) -> bool:
    """Say whether a line of an adapter is about what the package never promised, which matters to an audit alone."""
    if isinstance(node, ast.Assign):
        return any(ast.unparse(target).rpartition(".")[2] == "NOT_PROMISED" for target in node.targets)
    return isinstance(node, ast.ImportFrom) and node.module == "_promises"


def _without_protocol(file: Path, loading: str) -> list[str]:
    """Return the lines of a peer's script, but the first, which is of the protocol, and those that load the protocol or answer by it."""
    return [one for one in file.read_text("utf-8").splitlines()[1:] if not one.startswith((loading, "answer_questions("))]


def _octave(file: Path, function: str) -> list[str]:
    """Return the functions of a peer's script, which take a question as a struct, and one of the audit's name for them."""
    from ...signatures import ARGUMENTS
    from ...subjects.subprocess_adapter import ANSWERS

    lines = ["1;", *_without_protocol(file, "source(")]
    lines = [one.replace(f"= {function}(q)", f"= asked_{function}(q)") for one in lines]
    names, answers = ARGUMENTS[function], ANSWERS[function]
    given = ", ".join(f'"{name}", {name}' for name in names)
    if len(answers) == 1:
        body, gives = f"answer = asked_{function}(struct({given})).{answers[0]};", "answer"
    elif function == "structure":
        body, gives = (
            f"answer = asked_{function}(struct({given})); answer.finite_zeros = cellfun(@(z) complex(z(1), z(2)), answer.finite_zeros);",
            "answer",
        )
    else:
        body = f"a = asked_{function}(struct({given})); " + " ".join(f"{name}_ = a.{name};" for name in answers)
        gives = f"[{', '.join(f'{name}_' for name in answers)}]"
    return [*lines, f"function {gives} = {function}({', '.join(names)})", f"  {body}", "end"]
