"""A script that shows one check without faultspace: the call, the data inline, what was got beside what is due.

script    the text, in Python, Octave, MATLAB or Julia
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from types import FunctionType
from typing import Any

from ....base.errors import InvalidData
from ..adapter import ARGUMENTS
from ..checks import growth
from ..checks.catalogue import chosen
from ..peers import Peer
from ..peers import peer as peer_named
from ..records import Check, Demand
from ..reports.versions import kit
from ..subjects.subprocess_adapter import ANSWERS
from ..vectors.rationals import floats
from .languages import LANGUAGES, ONCE, Dialect, compared, side_by_side
from .questions import GROWS, question


def script(
    name: str,
    functions: Collection[str],
    language: str,
    *,
    adapter: str | None = None,
    peer: str | None = None,
    command: str | Sequence[str] | None = None,
) -> str:
    """Return the script of the first check of that name that asks one of these functions. It calls the adapter where it is in Python and so
    is the script; else a function of the audit's name for it, which the user defines or replaces.

    Raises InvalidData for an unknown name, and for a check that the language has no script of.
    """
    check = next(iter(chosen(functions, [name])), None)
    if check is None:
        raise InvalidData(f"check {name}: no function of this adapter has one that fits, expected one of `faultspace audit --list`")
    dialect = LANGUAGES[language]
    if (check.slug, check.function) == ("right-on-long-records", "identify") or check.slug in GROWS:
        if language != "python":
            raise InvalidData(f"check {check.full_name}: there is a script in Python alone, expected --language python")
        body = _growth(check) if check.slug in GROWS else _long_model(check)
    else:
        body = _body(check, dialect)
    wanted = {Demand.MUST_REFUSE: ["It must be refused."], Demand.FREE: ["Nothing is due: the answer is told."]}.get(check.kind, [])
    words = [
        f"{check.full_name}: {check.effect}.",
        *wanted,
        f"Made by faultspace {kit()}: faultspace audit --reproduce '{check.full_name}' --language {language}",
    ]
    helpers = [one.rstrip() for called, one in dialect.helpers.items() if f"{called}(" in "\n".join(body)]
    load = _loaded(check.function, language, adapter=adapter, peer=peer, command=command)
    lines = [*(f"{dialect.mark} {one}" for one in words), dialect.opening.rstrip(), *helpers, *load, f"{dialect.mark} -- the question"]
    return "\n".join([*lines, *body, dialect.ending]) + "\n"


def _body(check: Check, dialect: Dialect) -> list[str]:
    asked, lines = question(check), list[str]()
    manner = check.slug if asked.measured and not any(call.due for call in asked.calls) else None
    if manner not in (None, "deterministic", "inputs-untouched"):
        raise InvalidData(f"check {check.full_name}: there is no script of it yet; `faultspace audit --check` shows it")
    must_answer = check.kind is Demand.MUST_HOLD and not asked.may_refuse
    template = {None: dialect.call, "deterministic": dialect.twice, "inputs-untouched": dialect.untouched}[manner]
    for one in asked.calls[:1] if manner else asked.calls:
        names = [argument.name for argument in one.arguments]
        lines += side_by_side([dialect.assigned(argument.name, argument.value) for argument in one.arguments])
        answer = dialect.answers.get(check.function, "answer")
        values = {
            "function": check.function,
            "given": ", ".join(names),
            "copied": ", ".join(dialect.copied.replace("{}", name) for name in names),
            "answer": answer,
            "names": answer.strip("[]"),
            "refused": "WRONG: an answer is due" if must_answer else "right: there is nothing to answer",
            "code": str(int(must_answer)),
        }
        lines += _filled(template, values).strip("\n").splitlines()
        shown = [line for due in one.due for line in compared(dialect, due)]
        lines += [line for place, line in enumerate(shown) if line not in ONCE or line not in shown[:place]]
        if check.kind is Demand.MUST_REFUSE:
            lines += dialect.answered.splitlines()
    return lines


def _filled(template: str, values: Mapping[str, str]) -> str:
    return re.sub(f"{{({'|'.join(values)})}}", lambda found: values[found[1]], template)


# -- how the script comes by the function that it calls -----------------------------------------------------------------------------------


def _loaded(function: str, language: str, *, adapter: str | None, peer: str | None, command: str | Sequence[str] | None) -> list[str]:
    """Return the lines before the question."""
    mark = LANGUAGES[language].mark
    known = peer_named(peer) if peer is not None else None
    if known is not None and known.language.lower() == language:
        return ["", f"{mark} -- how {known.title} is called", *_PEERS[language](known, function), ""]
    if language == "python" and command is None and peer is None:
        return ["", *_imported(function, adapter or "faultspace.numeric.audit.reference"), ""]
    return [f"{mark} -- the function: define {function} before this line, or replace its name in the call below by that of yours", ""]


def _imported(function: str, adapter: str) -> list[str]:
    """Return the import of an adapter by its name."""
    place, _, found = adapter.rpartition(":")
    place, found = (place, found) if place else (found, "")
    lines = ["# -- the function: this imports the one that was audited; paste it here to send the script to others"]
    if place.endswith(".py"):
        path = Path(place).resolve()
        lines.append(f"sys.path.insert(0, {str(path.parent)!r})")
        place = path.stem
    if not found:
        return [*lines, f"from {place} import {function}"]
    first = found.partition(".")[0]
    return [*lines, f"from {place} import {first}", f"{function} = ({found}() if isinstance({found}, type) else {found}).{function}"]


def _of_python(known: Peer, function: str) -> list[str]:
    """Return the source of a peer's function with those that it calls, which are of its module and import what they need themselves."""
    assert known.adapter is not None
    module, _, name = known.adapter.partition(":")
    called = getattr(getattr(import_module(module), name), function)
    needed: dict[str, Any] = {}

    def need(one: Callable[..., Any]) -> None:
        assert isinstance(one, FunctionType)
        for name in one.__code__.co_names:
            other = one.__globals__.get(name)
            if isinstance(other, FunctionType) and other.__module__ == one.__module__ and name not in needed:
                need(other)
        needed[one.__name__] = one

    need(called)
    text = "\n\n".join(inspect.getsource(one).rstrip() for one in needed.values())
    refusing = ["Refused = ValueError"] if "Refused" in text else []
    return [*refusing, *text.splitlines(), "", f"{function} = {called.__name__}"]


def _of_octave(known: Peer, function: str) -> list[str]:
    """Return the functions of a peer's script, which take a question as a struct, and one of the audit's name for them."""
    assert known.command is not None
    lines = ["1;", *_without_protocol(known.command[4], "source(")]
    lines = [one.replace(f"= {function}(q)", f"= asked_{function}(q)") for one in lines]
    names, answers = ARGUMENTS[function], ANSWERS[function]
    given = ", ".join(f'"{name}", {name}' for name in names)
    asked = f"asked_{function}(struct({given}))"
    gives = "answer"
    if len(answers) == 1:
        body = f"answer = {asked}.{answers[0]};"
    elif function == "structure":
        body = f"answer = {asked}; answer.finite_zeros = cellfun(@(z) complex(z(1), z(2)), answer.finite_zeros);"
    else:
        body = f"a = {asked}; " + " ".join(f"{name}_ = a.{name};" for name in answers)
        gives = f"[{', '.join(f'{name}_' for name in answers)}]"
    return [*lines, f"function {gives} = {function}({', '.join(names)})", f"  {body}", "end"]


def _of_julia(known: Peer, function: str) -> list[str]:
    assert known.command is not None
    return _without_protocol(known.command[-1], "include(")


def _without_protocol(file: str, loading: str) -> list[str]:
    """Return the lines of a peer's script, but the first, which is of the protocol, and those that load the protocol or answer by it."""
    return [one for one in Path(file).read_text("utf-8").splitlines()[1:] if not one.startswith((loading, "answer_questions("))]


_PEERS = {"python": _of_python, "octave": _of_octave, "julia": _of_julia}

# -- records that are too long to stand in a script, and are made there, in Python --------------------------------------------------------

_DRIVEN = """
def driven(length):
    \"\"\"The outputs and the inputs: signs of a linear congruential generator through the system, from rest.\"\"\"
    state, drawn, x, out = {seed}, [], np.zeros(len(A)), []
    for _ in range(length * B.shape[1]):
        state = (6364136223846793005 * state + 1442695040888963407) % 2**64
        drawn.append(1.0 if state >> 63 else -1.0)
    signs = np.ascontiguousarray(np.array(drawn).reshape(B.shape[1], length).T)
    for w in signs:
        out.append(C @ x + D @ w)
        x = A @ x + B @ w
    return np.array(out), signs
"""
_COSTS = """
import time
import tracemalloc
from math import log


def cost(length):
    record, signs = driven(length)
    {begin}
    {function}({given})
    return {cost}


lengths = {lengths}
costs = [cost(length) for length in lengths]
share = {floor} * lengths[0] / lengths[1]
exponent = log(costs[1] / max(costs[0], share)) / log(lengths[1] / lengths[0]) if costs[1] > {floor} else 0.0
told("costs {{}}, exponent".format(costs), exponent, "at most {bound}", exponent, {bound})
"""
_MARKOV = """
def markov(A, B, C, D):
    return np.array([D] + [C @ np.linalg.matrix_power(A, k) @ B for k in range(2 * len(A) + 1)])


record, signs = driven({length})
found = [np.asarray(one, dtype=float) for one in identify(record, signs, {order}, {block_rows})]
got, expected = markov(*found), markov(A, B, C, D)
told("D, C B, C A B, ...", got, expected, np.abs(got - expected), {nearest})
"""


def _growth(check: Check) -> list[str]:
    """Return the recipe of the records, the costs at two lengths, and the exponent beside its bound."""
    memory = check.slug == "memory-grows-with-N"
    short = dict(zip(ARGUMENTS[check.function], growth.question(check.function, 100), strict=True))
    rest = {"y": "record", "r": "record", "u": "signs", "F": "B", "G": "D", "x0": "np.zeros(len(A))"}
    given = [str(value) if isinstance(value, int) else rest.get(name, name) for name, value in short.items()]
    costs = _COSTS.format(
        function=check.function,
        given=", ".join(given),
        begin="tracemalloc.stop(), tracemalloc.start()" if memory else "begun = time.process_time()",
        cost="tracemalloc.get_traced_memory()[1]  # bytes of numpy and Python alone" if memory else "time.process_time() - begun",
        lengths=growth.LENGTHS,
        floor=growth.MEMORY_FLOOR if memory else growth.TIME_FLOOR,
        bound=growth.BOUND,
    )
    return [*_driven(check.function), *costs.splitlines()]


def _long_model(check: Check) -> list[str]:
    """Return the recipe of the record, the call, and the Markov parameters beside the whole numbers that they are."""
    kind = next(kind for kind, suffix in growth.KINDS.items() if check.vector == f"N{growth.LENGTHS[1]}{suffix}")
    *_, order, block_rows = growth.question("identify", 10, kind)
    text = _MARKOV.format(length=growth.LENGTHS[1], order=order, block_rows=block_rows, nearest=growth.NEAREST)
    return [*_driven("identify", kind), *text.splitlines()]


def _driven(function: str, *kind: str) -> list[str]:
    """Return the lines that define A, B, C, D and what makes a record of a length."""
    system = zip("ABCD", growth.driven_system(function, *kind), strict=True)
    return [*(f"{name} = np.array({floats(one).tolist()!r})" for name, one in system), "", *_DRIVEN.format(seed=growth.SEED).splitlines()]
