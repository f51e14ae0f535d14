"""A script that shows one check without faultspace: data inline, the call of the user's function, what was got beside what is due.

script      the text, in Python, Octave, MATLAB or Julia
LANGUAGES   how each is written
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from textwrap import wrap

from ....base.errors import InvalidData
from ..checks.catalogue import chosen
from ..records import Check, Demand
from ..reports.versions import kit
from .exporting import document
from .languages import growing
from .languages.julia import Julia
from .languages.loading import loaded
from .languages.matrices import Matrices
from .languages.python import Python
from .languages.writing import Dialect
from .questions import GROWS, question

LANGUAGES: dict[str, Dialect] = {"python": Python(), "octave": Matrices(), "matlab": Matrices(), "julia": Julia()}
WIDTH = 110


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
    head = dialect.heading(_words(check, language))
    load = loaded(check.function, language, adapter=adapter, peer=peer, command=command)
    long_model = (check.slug, check.function) == ("right-on-long-records", "identify")
    if check.slug in GROWS or long_model:
        if language != "python":
            raise InvalidData(f"check {check.full_name}: there is a script in Python alone, expected --language python")
        lines = growing.model_lines(check) if long_model else growing.lines(check)
        return "\n".join([*head, *load, *lines, *dialect.ending()]) + "\n"
    return "\n".join([*head, *load, *_body(check, dialect), *dialect.ending()]) + "\n"


def _words(check: Check, language: str) -> list[str]:
    recipe = str(document(check)["recipe"])
    wanted = {"must-refuse": "It must be refused.", "free": "Nothing is due: the answer is told."}.get(str(check.kind), "")
    texts = [
        f"{check.full_name}: {check.effect}.",
        "",
        *wrap(f"How it is compared: {recipe} {wanted}".rstrip(), WIDTH),
        "",
        *wrap(
            f"Made by faultspace {kit()}: faultspace audit --reproduce '{check.full_name}' --language {language}",
            WIDTH,
            break_long_words=False,
        ),
    ]
    return [one.rstrip() for one in texts]


def _body(check: Check, dialect: Dialect) -> list[str]:
    asked, lines = question(check), list[str]()
    manner = check.slug if asked.measured and not any(call.due for call in asked.calls) else None
    calls = asked.calls[:1] if manner else asked.calls
    for call in calls:
        names = [one.name for one in call.arguments]
        for one in call.arguments:
            lines += dialect.value(one.name, one.value)
        if manner is None:
            lines += ["", *dialect.asked(check.function, names, refusal=check.kind is not Demand.MUST_HOLD or asked.may_refuse)]
        elif manner == "deterministic":
            lines += ["", *dialect.twice(check.function, names)]
        elif manner == "inputs-untouched":
            lines += ["", *dialect.untouched(check.function, names)]
        else:
            raise InvalidData(f"check {check.full_name}: there is no script of it yet; `faultspace audit --check` shows it")
        for due in call.due:
            lines += ["", *dialect.compared(due)]
        if check.kind is Demand.MUST_REFUSE:
            lines += ["", *dialect.refused()]
        lines.append("")
    return lines
