"""The import arrows between the rooms point one way.

ROOMS           room -> rooms it may import (its own always)
HALLS           the halls of numeric, each of which imports those before it
room_of         the room of a dotted name; None for what is not ours
violations      the sentences that say what a module may not do
"""

import sys

from .import_graph import FOLDERS, Module, house, imports

ROOMS = {
    "base": set[str](),
    "exact": {"base"},
    "numeric": {"base"},
    "audit": {"base", "exact", "numeric"},
    "proofs": {"base", "exact"},
    "front": {"base", "exact", "numeric", "audit", "proofs"},
}
HALLS = ("data", "method", "plant", "study")
CHECKER = "faultspace.proofs.trust.checker"
CHAIN = (CHECKER, f"{CHECKER}_fields", f"{CHECKER}_structure", f"{CHECKER}_limits")
ALONE = {name: {*CHAIN[:k]} for k, name in enumerate(CHAIN)}  # what these files may import beside the standard library


def room_of(name: str) -> str | None:
    """Return the room that a dotted import name leads to."""
    match name.split("."):
        case ["faultspace", "numeric", "audit", *_]:
            return "audit"
        case ["faultspace", ("base" | "exact" | "numeric" | "proofs") as room, *_]:
            return room
        case ["faultspace", *_]:
            return "front"
    return None


def hall_of(name: str) -> int | None:
    """Return the place in HALLS of a module of numeric; None for what lies in no hall."""
    match name.split("."):
        case ["faultspace", "numeric", hall, *_] if hall in HALLS:
            return HALLS.index(hall)
    return None


def violations(module: Module) -> list[str]:
    """Return what the module imports and may not; empty when every arrow points the right way."""
    room = room_of(module.name)
    assert room is not None, f"{module.name} is in no room"
    allowed = {room} | ROOMS[room]
    if room == "proofs" and "cross" in module.name.rpartition(".")[2]:
        allowed.add("numeric")
    found = []
    for name in imports(module):
        target = room_of(name)
        if name.partition(".")[0] in FOLDERS:
            found.append(f"{module.name} imports {name} by its folder's name instead of faultspace.{name}")
        elif target is not None and target not in allowed:
            found.append(f"{module.name} ({room}) imports {name} ({target})")
        elif None not in (here := hall_of(module.name), there := hall_of(name)) and there > here:  # type: ignore[operator]
            found.append(f"{module.name} imports {name}, whose hall lies above its own")
        if module.name in ALONE and name not in ALONE[module.name] and name.partition(".")[0] not in sys.stdlib_module_names:
            found.append(f"{module.name} imports {name}, which is not in the standard library")
    return found


def test_every_import_follows_the_arrows() -> None:
    assert [words for module in house() for words in violations(module)] == []


def test_the_house_is_seen_once() -> None:
    names = [module.name for module in house()]
    assert {"faultspace", "faultspace.exact", "faultspace.numeric", "faultspace.proofs"} <= set(names)
    assert len(names) == len(set(names))


BROKEN = [
    ("exact.made_up", "import faultspace.proofs.trust.checker"),
    ("exact.made_up", "from faultspace import numeric"),
    ("exact.made_up", "from faultspace import __version__"),
    ("exact.made_up", "from .. import proofs"),
    ("exact.made_up", "from ..numeric.pi_moesp import identify"),
    ("exact.made_up", "def late():\n    from faultspace.proofs import claims"),
    ("exact.made_up", "import importlib\nimportlib.import_module('faultspace.proofs')"),
    ("exact.made_up", "from exact import windows"),
    ("numeric.made_up", "from faultspace.exact.system.windows import observability"),
    ("numeric.made_up", "from .audit import checks"),
    ("numeric.method.signal.made_up", "from ...plant.healthy import mean_shift"),
    ("numeric.data.made_up", "def late():\n    from ..method import plotting"),
    ("numeric.audit.made_up", "from ...proofs import ledger"),
    ("proofs.made_up", "import numpy, faultspace.numeric"),
    ("proofs.cross_floats", "import faultspace.numeric.audit"),
    ("proofs.claims.cross_floats", "from faultspace import command_line"),
    ("proofs.trust.checker", "import sympy"),
    ("proofs.trust.checker", "from faultspace.exact import fields"),
    ("proofs.trust.checker", "from .structure_certificates import Certificate"),
    ("proofs.trust.checker", "from . import checker_limits"),
    ("proofs.trust.checker_fields", "from . import checker_structure"),
    ("proofs.trust.checker_limits", "from .structure_certificates import Certificate"),
]
SOUND = [
    ("exact.made_up", "import sympy\nfrom . import fields\nfrom .fields import QQ\nimport faultspace.exact.system.windows"),
    ("numeric.audit.made_up", "from ...exact import windows\nfrom ..pi_moesp import fit\nfrom faultspace import exact"),
    ("numeric.study.made_up", "from ..method import plotting\nfrom ..plant import pipeline\nfrom ..data import records"),
    ("proofs.cross_floats", "from faultspace import numeric\nfrom ..exact import windows"),
    ("proofs.trust.checker", "from __future__ import annotations\nimport json\nfrom collections import abc"),
    ("proofs.trust.checker_limits", "import json\nfrom . import checker"),
    ("command_line", "from faultspace import __version__, exact, numeric, proofs\nimport faultspace.numeric.audit"),
]


def test_broken_arrows_are_noticed_and_sound_ones_let_pass() -> None:
    assert [one for one in BROKEN if violations(Module(f"faultspace.{one[0]}", one[1])) == []] == []
    assert [found for name, source in SOUND for found in violations(Module(f"faultspace.{name}", source))] == []


def test_a_package_resolves_its_own_dots() -> None:
    source = "from . import windows\nfrom ..proofs import checker"
    assert list(imports(Module("faultspace.exact", source, is_package=True))) == ["faultspace.exact.windows", "faultspace.proofs.checker"]
