"""How published packages in Python are called, a class each: its functions, and what the package says that it does not do.

Sippy, SippyWithFeedthrough    sippy_unipi: system_identification(y, u, "MOESP"), by default, where D is zero, and with SS_D_required=True
Nfoursid                       nfoursid: NFourSID on a data frame
Ctrlsys, CtrlsysCombined       SLICOT in C: ib01ad and ib01bd by MOESP, SLICOT's usual choice, and with METH = "C"; ab08nd
Control, ControlWithoutSlycot  python-control: markov, eigensys_realization; StateSpace.zeros, with slycot and as without
Slycot                         slycot: ab08nd

A package is imported where it is called. A script that shows a failure (`upstream.reproducing`) has the source of the functions that its
question needs, so that these import what they use, and need nothing of ours.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, partial
from importlib import import_module
from typing import Any

from ....base.arrays import Array
from ..records import Refused
from . import _promises as promises


class Package:
    """An adapter is there where its package can be imported; `apart` gives its NOT_PROMISED."""

    package: str
    apart: Callable[[], dict[str, str]] = staticmethod(dict)

    def __init__(self) -> None:
        import_module(self.package)

    @cached_property
    def NOT_PROMISED(self) -> dict[str, str]:
        return self.apart()


def _of(package: str, apart: Callable[[], dict[str, str]] = dict, **functions: Callable[..., Any]) -> type[Package]:
    parts = {name: staticmethod(one) for name, one in {"apart": apart, **functions}.items()}
    return type(package, (Package,), {"package": package, **parts})


# -- sippy_unipi: models come without an initial state (x0 is zeros in SS_model), so that there is nothing else to ask ----------


def _sippy(y: Array, u: Array, order: int, block_rows: int, **options: bool) -> tuple[Any, Any, Any, Any]:
    import contextlib
    import io

    from sippy_unipi import system_identification

    # It takes either orientation and guesses; a row a channel is that of its examples. Views, so that what it does to them is seen.
    with contextlib.redirect_stdout(io.StringIO()) as said:
        found = system_identification(y.T, u.T, "MOESP", SS_f=block_rows, SS_p=block_rows, SS_fixed_order=order, **options)
    if "Warning" in said.getvalue():  # printed, not raised
        raise ValueError(said.getvalue())
    return found.A, found.B, found.C, found.D


def _sippy_with_feedthrough(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    return _sippy(y, u, order, block_rows, SS_D_required=True)


def _apart_from_sippy(more: Callable[[], dict[str, str]]) -> dict[str, str]:
    return (
        promises.more_block_rows_than_states("The horizon must be larger than the model order")
        | promises.coloured()
        | {"form-float32/*": "no document of the package promises the digits of double precision for arrays of single precision"}
        | more()
    )


_NO_D = partial(promises.with_feedthrough, "the default SS_D_required=False estimates no D")
Sippy = _of("sippy_unipi", partial(_apart_from_sippy, _NO_D), identify=_sippy)
SippyWithFeedthrough = _of("sippy_unipi", partial(_apart_from_sippy, dict), identify=_sippy_with_feedthrough)

# -- nfoursid -----------------------------------------------------------------------------------------------------------------------------


def by_nfoursid(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    import pandas
    from nfoursid.nfoursid import NFourSID

    outputs, inputs = ([f"{letter}{j}" for j in range(array.shape[1])] for letter, array in (("y", y), ("u", u)))
    # One frame of two, as from two files: a shorter one is filled up with missing values, which the package refuses.
    frame = pandas.concat([pandas.DataFrame(y, columns=outputs), pandas.DataFrame(u, columns=inputs)], axis=1)
    # num_block_rows is the window: its default, 2, carries no order beyond 2 p.
    run = NFourSID(frame, output_columns=outputs, input_columns=inputs, num_block_rows=block_rows)
    run.subspace_identification()
    found, _ = run.system_identification(rank=order)
    return found.a, found.b, found.c, found.d


Nfoursid = _of("nfoursid", promises.coloured, identify=by_nfoursid)

# -- SLICOT, in C and in Fortran ----------------------------------------------------------------------------------------------------------


def _zeros_of_slicot(nu: int, rank: int, infz: Any, Af: Any, Bf: Any, inputs: int) -> dict[str, Any]:
    import scipy.linalg

    # Finite zeros are the eigenvalues of the pencil (Af, Bf), which is left to the caller of AB08ND. infz[i] infinite zeros have the
    # order i + 1; as many as the rank leaves over have the order 0, which AB08ND does not list.
    zeros = scipy.linalg.eigvals(Af[:nu, :nu], Bf[:nu, :nu]) if nu else []
    orders = [i + 1 for i, count in enumerate(infz) for _ in range(int(count))]
    orders = [0] * (int(rank) - len(orders)) + orders
    known = {"normal_rank": int(rank), "left_invertible": int(rank) == inputs}
    return {**known, "finite_zeros": [complex(z) for z in zeros], "infinite_zero_orders": orders}


def _ctrlsys(y: Array, u: Array, order: int, block_rows: int, method: str = "M", jobd: str = "M") -> tuple[Any, Any, Any, Any]:
    import ctrlsys
    import numpy as np

    # METH = "M" and JOB = "A" promise A, B, C and D by MOESP, after ib01ad with JOBD = "M", which those need. info other than 0, and
    # warnings that say the problem is singular, are SLICOT's way to decline: of ib01ad all singular values zero, a rank-deficient problem.
    outputs, inputs = np.asfortranarray(y), np.asfortranarray(u)
    n_u, p = u.shape[1], y.shape[1]
    _, factor, _, warning, info = ctrlsys.ib01ad("M", "C", jobd, "O", "N", "N", block_rows, n_u, p, inputs, outputs, 0.0, -1.0)
    if info != 0 or warning in (3, 4, 5):
        raise ValueError(f"ib01ad: info {info}, warning {warning}")
    A, C, B, D, *_, warning, info = ctrlsys.ib01bd(method, "A", "N", block_rows, order, n_u, p, len(y), np.asfortranarray(factor), 0.0)
    if info != 0 or warning == 4:  # a least-squares problem with a rank-deficient matrix
        raise ValueError(f"ib01bd: info {info}, warning {warning}")
    return A, B, C, D


def _ctrlsys_combined(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    return _ctrlsys(y, u, order, block_rows, "C", "N")


def _ctrlsys_zeros(A: Array, F: Array, C: Array, G: Array) -> dict[str, Any]:
    import ctrlsys
    import numpy as np

    n, m = len(A), F.shape[1]
    matrices = (np.asfortranarray(M) for M in (A, F, C, G))
    # Without scaling, at the default tolerance.
    nu, rank, dinfz, _, _, infz, _, _, Af, Bf, info = ctrlsys.ab08nd("N", n, m, len(C), *matrices, 0.0)
    if info != 0:
        raise ValueError(f"ab08nd: info {info}")
    return _zeros_of_slicot(nu, rank, infz[:dinfz], Af, Bf, m)


def _apart_from_ctrlsys() -> dict[str, str]:
    return promises.more_block_rows_than_states("ib01bd: n (int): System order (0 < n < nobr)") | promises.coloured()


Ctrlsys = _of("ctrlsys", _apart_from_ctrlsys, identify=_ctrlsys, structure=_ctrlsys_zeros)
CtrlsysCombined = _of("ctrlsys", _apart_from_ctrlsys, identify=_ctrlsys_combined)


def _slycot_zeros(A: Array, F: Array, C: Array, G: Array) -> dict[str, Any]:
    import slycot

    n, m = len(A), F.shape[1]
    try:  # no scaling, its own tolerance
        nu, rank, dinfz, _, _, infz, _, _, Af, Bf = slycot.ab08nd(n, m, len(C), A, F, C, G)
    except Exception as error:
        if type(error).__module__ != "_wrapper":
            raise
        raise ValueError(str(error)) from error  # f2py's class for arguments of the wrong shape, which no module exports
    return _zeros_of_slicot(nu, rank, infz[:dinfz], Af, Bf, m)


Slycot = _of("slycot", structure=_slycot_zeros)

# -- python-control: no normal rank and no infinite zeros ---------------------------------------------------------------------------------


def _markov_parameters(samples: int, n_u: int, order: int) -> int:
    return max(min(samples // (2 * n_u), 100), 4 * order + 1)


def _control(y: Array, u: Array, order: int, block_rows: int) -> tuple[Any, Any, Any, Any]:
    import warnings

    import control

    # markov has no initial state and takes the impulse response to be over after m samples. m is two equations an unknown, at most 100,
    # never fewer than eigensys_realization's default Hankel matrix takes (the default m, as many as samples, is right for a single input at
    # rest alone).
    n_u, p = u.shape[1], y.shape[1]
    m = _markov_parameters(len(u), n_u, order)
    with warnings.catch_warnings():
        warnings.simplefilter("error", UserWarning)  # "Not enough data for requested number of parameters"
        try:
            response = control.markov(y.T, u.T, m)
        except UserWarning as warning:
            raise ValueError(str(warning)) from warning
    found, _ = control.eigensys_realization(response.reshape(p, n_u, m), order)
    return found.A, found.B, found.C, found.D


def _control_zeros(A: Array, F: Array, C: Array, G: Array) -> dict[str, Any]:
    import control

    try:  # by slycot where that is installed, else of square systems alone
        return {"finite_zeros": [complex(z) for z in control.StateSpace(A, F, C, G, True).zeros()]}
    except NotImplementedError as lacking:
        raise Refused(str(lacking)) from lacking


def _zeros_without_slycot(A: Array, F: Array, C: Array, G: Array) -> dict[str, Any]:
    import sys
    from unittest.mock import patch

    # The package imports slycot where it needs it, and takes a module of None for one that is not installed.
    with patch.dict(sys.modules, {"slycot": None}):
        return _control_zeros(A, F, C, G)


def _apart_from_control() -> dict[str, str]:
    over = promises.not_over(_markov_parameters, "markov takes the impulse response to be over after m samples")
    return over | promises.from_a_state("markov has no initial state")


Control = _of("control", _apart_from_control, identify=_control, structure=_control_zeros)
_SQUARE = partial(promises.not_square, "zeros of square systems alone")
ControlWithoutSlycot = _of("control", _SQUARE, structure=_zeros_without_slycot)
