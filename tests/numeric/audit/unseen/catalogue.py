"""All mutants of this folder.

ALL        every Unseen, in the order of the files
BY_NAME    the same by slug
"""

from __future__ import annotations

from tests.numeric.audit.unseen import corners, from_records, models, ranks, residual, spaces, zeros
from tests.numeric.audit.unseen.form import Mutants, Unseen

FILES = (models, residual, ranks, spaces, zeros, from_records, corners)


def _all() -> tuple[Unseen, ...]:
    """Return the mutants that each file makes, once."""
    registers = {id(one): one for file in FILES for one in vars(file).values() if isinstance(one, Mutants)}
    return tuple(one for register in registers.values() for one in register.all)


ALL = _all()
BY_NAME = {one.name: one for one in ALL}
RIGHT = {
    "fault-space-cuts-n-v-to-the-outputs": "a number of faults that is not that of the record may be put right",
    "fault-dimension-says-p-where-nothing-is-known": "where all outputs are faulty, or nothing is known, a number is free",
    "identify-squeezes-a-single-state": "a matrix of one row or column may be answered as a list of its numbers",
    "structure-lists-orders-from-the-largest": "the order of a list of zeros, or of their orders, is anybody's",
    "structure-goes-through-the-coefficients": "a zero is right within what rounding of the pencil may make of it",
    "fault-dimension-takes-a-sine-for-none": "a sine does not excite: no number is due",
    "identify-saves-memory-on-long-records": "of long records whole numbers are compared, and of models those are small",
}
