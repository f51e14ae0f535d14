"""This tells poles in the units of the plant: natural frequency in hertz, damping, and time constant in seconds.

A pole z of a sampled system is exp(s dt) of a pole s = ln(z) / dt of the plant, the principal value of the logarithm: faster oscillations
than half the sampling rate, the Nyquist frequency, look like slower ones. The natural frequency is |s| / (2 pi), the damping -Re s / |s|,
and the time constant -1 / Re s, negative where the mode grows. A negative real pole turns its sign at every sample and has no course
between them: it is told as an oscillation that turns at the Nyquist frequency, and its natural frequency is above that but for -1.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ...data.plain import plain

if TYPE_CHECKING:
    from ..steps.findings import Answer

MOST = 12  # modes that the summary tells


@dataclass(frozen=True)
class Mode:
    """The mode of one real `pole`, or of the pair of one and its conjugate: natural `frequency` in hertz, `damping`, for a pole that does
    not oscillate 1, or -1 where it grows, and `constant`, the time constant in seconds, infinite where it neither grows nor dies out."""

    pole: complex
    frequency: float
    damping: float
    constant: float

    @property
    def line(self) -> str:
        """Return the mode in words."""
        kind = "dies out" if self.constant > 0 else "grows"
        lasting = f"{kind} with a time constant of {abs(self.constant):.4g} s" if np.isfinite(self.constant) else "does not die out"
        turning = f"{self.frequency:.4g} Hz, damping {self.damping:.3g}, " if self.pole.imag or self.pole.real < 0 else ""
        return turning + lasting


def modes(poles: ArrayLike, dt: float) -> list[Mode]:
    """Return the modes of poles (n,) at the sample time dt in seconds, in their order, one of each pair; poles at zero have none."""
    found = []
    for z in np.asarray(poles, dtype=np.complex128):
        if z == 0 or z.imag < 0:
            continue
        s = complex(np.log(z)) / dt
        constant = -1.0 / s.real if s.real else float("inf")
        damping = -s.real / abs(s) if s else 1.0
        found.append(Mode(complex(z), abs(s) / (2 * np.pi), damping, constant))
    return found


def sample_time(answer: Answer) -> tuple[float | None, str]:
    """Return the sample time in seconds, None where nothing tells it, and what tells it."""
    clock = answer.record.clock
    if answer.dt is None:
        return None, "unknown"
    if clock is not None and answer.dt == clock.dt:
        return answer.dt, clock.source
    return answer.dt, "stated"


def mode_lines(answer: Answer) -> Iterator[str]:
    """Yield what the poles are in physical units, where the sample time is known."""
    dt, source = sample_time(answer)
    if dt is None or answer.model is None:
        return
    yield f"sample time {dt:.6g} s ({source}), Nyquist frequency {0.5 / dt:.4g} Hz"
    told = [mode.line for mode in modes(answer.model.model.poles, dt)]
    if told:
        yield f"modes: {'; '.join(told[:MOST])}{f'; ... ({len(told)} in all)' if len(told) > MOST else ''}"


def physical(answer: Answer) -> dict[str, Any]:
    """Return the sample time, what tells it, the Nyquist frequency and the modes; null where they are not known."""
    dt, source = sample_time(answer)
    known = dt is not None and answer.model is not None
    found = modes(answer.model.model.poles, dt) if dt is not None and answer.model is not None else []
    rows = [
        {"pole": plain(mode.pole), "hertz": plain(mode.frequency), "damping": plain(mode.damping), "seconds": plain(mode.constant)}
        for mode in found
    ]
    return {"dt": dt, "dt_from": source, "nyquist_hertz": None if dt is None else 0.5 / dt, "modes": rows if known else None}
