"""These checks use signals that do not excite: what the data cannot tell must not be told.

A fault that is constant, a sine or in proportion to another shows fewer independent faults than there are: problem (11) then has solutions
that are none of the system's. An input that is constant or one sine determines no system of order two: other B, D and initial states give
the same outputs. So do other columns of B and D where an input is another one times a number, or the other one a sample later. All of it is
shown exactly in the tests.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.structure.signals import simulate
from faultspace.exact.system.systems import ResidualSystem

from ..records import Check, Severity
from ..vectors.fault_vectors import UnexcitingVector, alike_inputs, unexciting_inputs
from ..vectors.rationals import floats
from ..vectors.shipped_vectors import IdentificationVector, shipped
from .faults import free_count, window_ranks_off
from .refusals import refuses


def checks() -> Iterator[Check]:
    """Yield that ranks of windows are what they are; that n_v is free; that a fault space, a model must be refused."""
    for vector in shipped("unexciting"):
        effect = "wrong ranks of windows where a fault does not excite: it is taken for one that does"
        ranks = partial(window_ranks_off, vector)
        yield Check("window-ranks-unexciting", "window_ranks", vector.slug, "window-ranks", effect, Severity.SILENT, ranks)
        yield _count(vector)
        yield _space(vector)
    model = next(one for one in shipped("identification") if (one.order, one.B.ncols) == (2, 1))
    for name, u in unexciting_inputs(model.u.nrows).items():
        yield _model(name, model, u)
    model = next(one for one in shipped("identification") if one.B.ncols == 2)
    for name, u in alike_inputs(model.u.columns([0])).items():
        yield _model(name, model, u)


def response(model: IdentificationVector, u: Matrix) -> Matrix:
    """Return the exact outputs from the vector's initial state under another input."""
    return simulate(ResidualSystem(model.A, model.B, model.C, model.D), model.x0, u).residuals


def _count(vector: UnexcitingVector) -> Check:
    """Return a check that is free, since the data show fewer faults than there are."""
    effect = "faults that do not excite are counted, or not: the data cannot tell"
    return free_count("fault-dimension-unexciting", vector.slug, effect, "n_v, as many as the data show", vector.r, vector.visible)


def _space(vector: UnexcitingVector) -> Check:
    def arguments() -> tuple[Any, ...]:
        system = vector.system
        return floats(vector.r), floats(system.A), floats(system.C), system.m, system.n + 1

    effect = "fault matrices from a fault signal that fits many others"
    return refuses("refuses-unexciting-fault", "fault_space", vector.slug, effect, arguments, "problem-11")


def _model(name: str, model: IdentificationVector, u: Matrix) -> Check:
    def arguments() -> tuple[Any, ...]:
        return floats(response(model, u)), floats(u), model.order, model.block_rows

    effect = "one of many models that fit, without a word"
    return refuses("refuses-unexciting-input", "identify", f"{model.slug}-{name}", effect, arguments)
