"""The certificates, the checker that alone decides them, and what makes them.

The files of the checker are compiled here from what is read in them: what Python kept of them compiled, in __pycache__, is not believed.
"""

import sys
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from types import CodeType

CHECKER = tuple(f"{__name__}.checker{part}" for part in ("", "_fields", "_structure", "_limits"))


class _AsRead(SourceFileLoader):
    def get_code(self, fullname: str) -> CodeType:
        file = self.get_filename(fullname)
        return self.source_to_code(self.get_data(file), file)


class _Checker(MetaPathFinder):
    @staticmethod
    def find_spec(name: str, path: object = None, target: object = None) -> ModuleSpec | None:
        found = PathFinder.find_spec(name, __path__) if name in CHECKER else None
        if found is not None and found.origin is not None:
            found.loader, found.cached = _AsRead(name, found.origin), None
        return found


sys.meta_path.insert(0, _Checker())

from . import checker_limits as checker_limits  # noqa: E402  # with it all files, each of which adds its kinds to those of checker.py
