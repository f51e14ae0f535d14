"""Claims, verdicts and certificates: what the review states of the paper, what is true of it, and what proves it.

A verdict is computed by a run, never stored by hand. The certificates are decided by `trust/checker.py` and the three files whose names
begin with `checker_`, which import nothing but Python's standard library and those before them; their format is `trust/FORMAT.md`.
Everything else here may import `faultspace.exact`. The public names are loaded when they are first asked for; `__init__.pyi` lists them
with their modules.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

if __name__ == "proofs":
    raise ImportError("this folder is no package of its own: write 'import faultspace.proofs'")
