"""This calls sippy_unipi: system_identification(y, u, "MOESP"). A user sets the horizons to the window and the order to the one asked for.

identify           with the package's default SS_D_required=False: D is zero, and a plant with a D is not what was promised
with_feedthrough   the same package with SS_D_required=True, which is what a user sets who knows of a D

Models come without an initial state (x0 is zeros in SS_model), so that there is nothing else to ask.
"""

from __future__ import annotations

import contextlib
import io
from types import SimpleNamespace
from typing import Any

from sippy_unipi import system_identification

from ....base.arrays import Array
from ._promises import coloured, more_block_rows_than_states
from ._promises import with_feedthrough as plants_with_feedthrough


def _identified(y: Array, u: Array, order: int, block_rows: int, **options: bool) -> tuple[Any, Any, Any, Any]:
    # It takes either orientation and guesses; a row a channel is that of its examples. Views, so that what it does to them is seen.
    with contextlib.redirect_stdout(io.StringIO()) as said:
        found = system_identification(y.T, u.T, "MOESP", SS_f=block_rows, SS_p=block_rows, SS_fixed_order=order, **options)
    if "Warning" in said.getvalue():  # printed, not raised
        raise ValueError(said.getvalue())
    return found.A, found.B, found.C, found.D


def identify(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    """It is called with its defaults."""
    return _identified(y, u, order, block_rows)


def _with_feedthrough(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    return _identified(y, u, order, block_rows, SS_D_required=True)


with_feedthrough = SimpleNamespace(identify=_with_feedthrough)
with_feedthrough.NOT_PROMISED = (
    more_block_rows_than_states("The horizon must be larger than the model order")
    | coloured()
    | {"form-float32/*": "no document of the package promises the digits of double precision for arrays of single precision"}
)
NOT_PROMISED = with_feedthrough.NOT_PROMISED | plants_with_feedthrough("the default SS_D_required=False estimates no D")
