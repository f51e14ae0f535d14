"""Scripts that show a finding without faultspace: for one finding of each cause that is worth telling upstream.

KEPT      (package, full name of a check) of those that stand in the tree; `faultspace audit --peer NAME --reproduce CHECK` prints any
path      where a script stands, beside the pages
text      what is in it, in the language of the package
write     all of them into a folder
"""

from __future__ import annotations

import re
from pathlib import Path

from ....base.writing import write_text
from ..adapter import FUNCTIONS
from ..peers import peer
from ..upstream.reproducing import script

ENDINGS = {"Python": "py", "Octave": "m", "Julia": "jl"}
KEPT = (
    ("ctrlsys", "exact-recovery[n2-u1-p1]-identify"),
    ("ctrlsys", "refuses-shapes[two-faults]-structure"),
    ("ctrlsys", "refuses-no-number[two-faults-F-nan]-structure"),
    ("nfoursid", "memory-grows-with-N[N3000-N12000]-identify"),
    ("nfoursid", "other-units[n2-u1-p1]-identify"),
    ("nfoursid", "refuses-short-data[n3-u2-p2]-identify"),
    ("sippy_unipi", "right-on-long-records[N12000]-identify"),
    ("python-control", "refuses-unexciting-input[n2-u1-p1-constant]-identify"),
    ("python-control-alone", "finite-zeros[orders-one-and-three]-structure"),
    ("slycot", "normal-rank[six-by-six]-structure"),
    ("octave-control", "refuses-nan-model[two-faults]-structure"),
    ("matrix-pencils", "finite-zeros[zeros-outside]-structure"),
    ("fault_id", "fault-space-1e6[one-fault]-fault_space"),
    ("fault_id-threshold", "window-ranks-1e-12[one-fault]-window_ranks"),
)


def path(name: str, check: str) -> str:
    """Return the path of the script of a package's check, below the folder of the pages."""
    return f"reproducers/{name}/{re.sub('[^A-Za-z0-9_]+', '_', check).strip('_')}.{ENDINGS[peer(name).language]}"


def text(name: str, check: str) -> str:
    """Return the script of a package's check."""
    return script(check, FUNCTIONS, peer(name).language.lower(), peer=name)


def write(folder: Path) -> None:
    """Write the scripts of KEPT below the folder of the pages."""
    for name, check in KEPT:
        file = folder / path(name, check)
        file.parent.mkdir(parents=True, exist_ok=True)
        write_text(file, text(name, check))
