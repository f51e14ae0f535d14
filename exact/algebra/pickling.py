"""Teaches pickle the flint types that exact records hold, so that systems and results travel between processes.

Importing the module registers them; there is nothing to call.
"""

from __future__ import annotations

import copyreg
from typing import Any

from flint import fmpq_mat, fmpq_poly, fmpz_poly, nmod, nmod_mat


def _nmod(x: nmod) -> tuple[Any, ...]:
    return nmod, (int(x), x.modulus())


def _fmpq_poly(f: fmpq_poly) -> tuple[Any, ...]:
    return fmpq_poly, (f.coeffs(),)


def _fmpz_poly(f: fmpz_poly) -> tuple[Any, ...]:
    return fmpz_poly, (f.coeffs(),)


def _fmpq_mat(m: fmpq_mat) -> tuple[Any, ...]:
    return fmpq_mat, (m.nrows(), m.ncols(), m.entries())


def _nmod_mat(m: nmod_mat) -> tuple[Any, ...]:
    return nmod_mat, (m.nrows(), m.ncols(), [int(x) for x in m.entries()], m.modulus())


REDUCERS = ((nmod, _nmod), (fmpq_poly, _fmpq_poly), (fmpz_poly, _fmpz_poly), (fmpq_mat, _fmpq_mat), (nmod_mat, _nmod_mat))

for kind, reducer in REDUCERS:
    copyreg.pickle(kind, reducer)  # type: ignore[arg-type]
