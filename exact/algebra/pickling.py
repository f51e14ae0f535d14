"""Teaches pickle the flint types that exact records hold, so that systems and results travel between processes.

Importing the module registers them; there is nothing to call.
"""

from __future__ import annotations

import copyreg
from collections.abc import Callable
from typing import Any

from flint import fmpq_mat, fmpq_poly, fmpz_poly, nmod, nmod_mat

REDUCERS: dict[type, Callable[[Any], tuple[Any, ...]]] = {
    nmod: lambda x: (int(x), x.modulus()),
    fmpq_poly: lambda f: (f.coeffs(),),
    fmpz_poly: lambda f: (f.coeffs(),),
    fmpq_mat: lambda m: (m.nrows(), m.ncols(), m.entries()),
    nmod_mat: lambda m: (m.nrows(), m.ncols(), [int(x) for x in m.entries()], m.modulus()),
}  # what each is made of again

for kind, parts in REDUCERS.items():
    copyreg.pickle(kind, lambda one, kind=kind, parts=parts: (kind, parts(one)))  # type: ignore[misc]
