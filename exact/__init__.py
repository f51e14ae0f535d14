"""The truth: exact arithmetic over Q, a number field Q(a) and a prime field.

This room answers questions about one system or two. It knows nothing of claims, verdicts or files: it reads and
writes JSON-ready dicts, and opening files is the caller's. A float enters only where a name says so. It imports
neither of the other rooms. Its public names are loaded when they are first asked for; `__init__.pyi` lists them with their modules.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

if __name__ == "exact":
    raise ImportError("plain 'exact' is the name of another package: write 'import faultspace.exact'")
