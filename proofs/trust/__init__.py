"""The certificates, the checker that alone decides them, and what makes them.

The files of the checker are compiled here from what is read in them: what Python kept of them compiled, in __pycache__, is not believed,
nor is a folder or a library of the same name beside them, which Python would prefer.
"""

import sys
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, SourceFileLoader
from importlib.util import spec_from_file_location
from pathlib import Path
from types import CodeType

CHECKER = {f"{__name__}.{stem}": stem for stem in ("checker", "checker_fields", "checker_structure", "checker_limits")}


class _AsRead(SourceFileLoader):
    def get_code(self, fullname: str) -> CodeType:
        file = self.get_filename(fullname)
        return self.source_to_code(self.get_data(file), file)


class _Checker(MetaPathFinder):
    @staticmethod
    def find_spec(name: str, path: object = None, target: object = None) -> ModuleSpec | None:
        if name not in CHECKER:
            return None
        file = str(Path(__file__).with_name(f"{CHECKER[name]}.py"))
        return spec_from_file_location(name, file, loader=_AsRead(name, file))


sys.meta_path.insert(0, _Checker())

from . import checker_limits as checker_limits  # noqa: E402  # with it all files, each of which adds its kinds to those of checker.py
