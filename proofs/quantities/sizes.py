"""These are the sizes: n, m and p."""

from __future__ import annotations

from ..evidence import certified
from .registry import Kind, Quantity, Told

QUANTITIES = (
    Quantity(
        "n",
        Kind.INTEGER,
        "the number of states",
        lambda x: x.system.n,
        lambda r: r.n,
        certified.read,
        told=Told((), lambda e: e.system.n),
    ),
    Quantity(
        "m",
        Kind.INTEGER,
        "the number of faults (unknown inputs)",
        lambda x: x.system.m,
        lambda r: r.m,
        certified.read,
        told=Told((), lambda e: e.system.m),
    ),
    Quantity(
        "p",
        Kind.INTEGER,
        "the number of outputs",
        lambda x: x.system.p,
        lambda r: r.p,
        certified.read,
        told=Told((), lambda e: e.system.p),
    ),
)
