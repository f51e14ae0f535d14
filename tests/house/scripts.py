"""The scripts of .ci are read as modules, for they have no ending by which Python would know them.

script          one of them, by its name
"""

from __future__ import annotations

import sys
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from types import ModuleType

from .import_graph import ROOT


def script(name: str) -> ModuleType:
    """Return the module that .ci/NAME is."""
    loader = SourceFileLoader(name, str(ROOT / ".ci" / name))
    spec = spec_from_loader(name, loader)
    assert spec is not None
    module = module_from_spec(spec)
    sys.modules[name] = module  # records ask for their module
    loader.exec_module(module)
    return module
