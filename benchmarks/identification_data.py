"""The records of the identification benchmark: four states, white input, one coloured additive fault as strong as the input's effect.

Setting     inputs, outputs, block rows s, samples N, sensor noise relative to the input's effect (0: none)
System      the true model and the fault's matrices; the same for equal n_u and p in every run
record      y (N, p) and u (N, n_u) of a setting
write       that record as raw files, which NumPy and Octave both read
errors      eigenvalues: largest distance in the best matching; Markov parameters: relative error of the first MARKOV ones
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
import scipy.signal
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from faultspace.numeric.method.model.models import StateSpaceModel

Array = NDArray[np.float64]

ORDER = 4
POLES = (0.9, -0.6, 0.3 + 0.5j, 0.3 - 0.5j)
FAULT_POLE = 0.9
SEED = 2024
MARKOV = 20


@dataclass(frozen=True)
class Setting:
    """One record and the window it is identified with."""

    n_u: int
    p: int
    block_rows: int
    samples: int
    noise: float = 0.0

    def __str__(self) -> str:
        samples = f"{self.samples:.0e}".replace("e+0", "e")
        return f"{self.n_u}-in {self.p}-out, s = {self.block_rows}, N = {samples}{', noise' if self.noise else ''}"


@dataclass(frozen=True)
class System:
    """This is x+ = A x + B u + F v, y = C x + D u + G v as two models of one A and C."""

    from_input: StateSpaceModel
    from_fault: StateSpaceModel


def system(n_u: int, p: int) -> System:
    """Return random B, C, D, F, G beside the fixed POLES, in rotated coordinates."""
    random = np.random.default_rng((SEED, n_u, p))
    blocks = np.diag([pole.real for pole in map(complex, POLES)])
    blocks[2, 3], blocks[3, 2] = POLES[2].imag, POLES[3].imag

    def entries(*shape: int) -> Array:
        """Away from zero: every mode is then excited and seen, whatever the numbers of channels."""
        return random.choice((-1.0, 1.0), shape) * random.uniform(0.5, 1.5, shape)

    B, C, D = entries(ORDER, n_u), entries(p, ORDER), entries(p, n_u)
    F, G = entries(ORDER, 1), entries(p, 1)
    rotation = np.linalg.qr(random.standard_normal((ORDER, ORDER)))[0]
    A, B, C, F = rotation @ blocks @ rotation.T, rotation @ B, C @ rotation.T, rotation @ F
    return System(StateSpaceModel(A, B, C, D), StateSpaceModel(A, F, C, G))


def record(setting: Setting) -> tuple[Array, Array]:
    """y (N, p), u (N, n_u): the fault's effect has the root mean square of the input's (0 dB), the noise is white."""
    true = system(setting.n_u, setting.p)
    random = np.random.default_rng((SEED, setting.n_u, setting.p, setting.samples))
    u = random.standard_normal((setting.samples, setting.n_u))
    v = scipy.signal.lfilter([1.0], [1.0, -FAULT_POLE], random.standard_normal((setting.samples, 1)), axis=0)
    driven, faulty = true.from_input.simulate(u), true.from_fault.simulate(v)
    size = np.sqrt(np.mean(driven**2))
    y = driven + faulty * (size / np.sqrt(np.mean(faulty**2)))
    if setting.noise:
        y += setting.noise * size * random.standard_normal(y.shape)
    return y, u


def write(setting: Setting, folder: Path) -> None:
    """Write y.bin and u.bin (float64, one sample after the other) and setting.json into the folder."""
    y, u = record(setting)
    y.tofile(folder / "y.bin")
    u.tofile(folder / "u.bin")
    (folder / "setting.json").write_text(json.dumps(asdict(setting)), "utf-8")


def read(folder: Path) -> tuple[Setting, Array, Array]:
    """This reads what `write` has written."""
    setting = Setting(**json.loads((folder / "setting.json").read_text("utf-8")))
    return setting, np.fromfile(folder / "y.bin").reshape(-1, setting.p), np.fromfile(folder / "u.bin").reshape(-1, setting.n_u)


def errors(found: StateSpaceModel, n_u: int, p: int) -> tuple[float, float]:
    """(eigenvalue error, Markov-parameter error) of a model found from a record of `system(n_u, p)`."""
    true = system(n_u, p).from_input
    distances = np.abs(found.poles[:, np.newaxis] - true.poles[np.newaxis, :])
    matched = distances[linear_sum_assignment(distances)]
    expected = true.markov(MARKOV)
    return float(matched.max()), float(np.linalg.norm(found.markov(MARKOV) - expected) / np.linalg.norm(expected))
