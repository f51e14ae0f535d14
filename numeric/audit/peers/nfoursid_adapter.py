"""This calls nfoursid: NFourSID on a data frame, subspace_identification, then system_identification of the order asked for."""

from __future__ import annotations

from typing import Any

import pandas
from nfoursid.nfoursid import NFourSID

from ....base.arrays import Array
from ._promises import coloured

NOT_PROMISED = coloured()


def identify(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    """num_block_rows is the window: its default, 2, carries no order beyond 2 p."""
    outputs, inputs = ([f"{letter}{j}" for j in range(array.shape[1])] for letter, array in (("y", y), ("u", u)))
    # One frame of two, as from two files: a shorter one is filled up with missing values, which the package refuses.
    frame = pandas.concat([pandas.DataFrame(y, columns=outputs), pandas.DataFrame(u, columns=inputs)], axis=1)
    run = NFourSID(frame, output_columns=outputs, input_columns=inputs, num_block_rows=block_rows)
    run.subspace_identification()
    found, _ = run.system_identification(rank=order)
    return found.a, found.b, found.c, found.d
