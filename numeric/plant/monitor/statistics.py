"""The statistics of a monitor, for one stream or for many side by side: by the same lines that watch, thresholds are calibrated.

What comes in are innovations z (R, p) of R streams, uncorrelated and of deviation one without a fault, and the same errors s (R, p)
output by output, each over its own deviation. What comes out is one number a test, (R, 4), in the order of TESTS:

    residual      max_i |s_i|: one sample, one output
    chi-square    sum of z'z over the last `window` samples, those of a window ago left out [BN93]
    cusum         |S|, the multivariate CUSUM of Crosier [C88]: C = |S + z|, S := (S + z) (1 - k / C) where C > k, else 0, k = `shift` / 2
    hankel        the largest root of the moments M of Hankel columns h = [z(k-s+1); ..; z(k)], M := (1 - 1 / memory) M + h h' / memory,
                  followed by one step of the power method a sample, v := M v / |M v|. Without a fault the moments are I, up to chance. The
                  roots of M beyond the threshold count its rank without the noise, and by as much as a block row adds to that rank, so many
                  signals the faults have: their rank gap

Each costs the same at every sample, whatever came before: the first is of one sample, the second has a ring of `window` numbers, the others
are recursions. A CUSUM is cut off at a length, `ceiling`, and z is shortened to 30 deviations beyond its usual length, so that all of them
come back soon when a fault goes, and one wild sample is forgotten.

Settings     window, shift, block rows, memory; `checked` refuses what no memory holds
Bank         the state of the four statistics
Latest       the innovations of the last samples, and since when they most likely are others
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import isqrt

import numpy as np
from numpy.typing import NDArray

from ....base.arrays import Array
from ....base.errors import InvalidData, shorten
from ....base.sheets import counted

TESTS = ("residual", "chi-square", "cusum", "hankel")
MEMORY = 5  # windows that the moments remember
LONGEST = 30.0  # deviations, beside the usual root of p, to which an innovation is shortened
REMEMBERED = ("sums", "energies", "squares", "column", "moments", "direction")  # by a bank, from sample to sample
HELD = 1 << 24  # numbers that are remembered at most, 128 MiB
ROUNDING = 1e-9  # share, in numbers of which a file has all digits
HEIGHT, MOST_ROWS = 30, 10  # numbers in a Hankel column, and block rows, at most; two rows at least


@dataclass(frozen=True)
class Settings:
    """The tests are of p outputs: `window` samples of the chi-square test, `shift` in deviations for which the CUSUM is made."""

    p: int
    window: int
    shift: float

    @property
    def memory(self) -> int:
        """Return the samples that the moments of Hankel columns remember."""
        return MEMORY * self.window

    @property
    def rows(self) -> int:
        """Return the block rows of a Hankel column."""
        return int(np.clip(HEIGHT // self.p, 2, MOST_ROWS))

    @property
    def numbers(self) -> int:
        """Return how many numbers a Bank holds of one stream: a window, and the moments with their change."""
        return self.window * (self.p + 1) + 2 * (self.p * self.rows) ** 2


def checked(settings: Settings) -> Settings:
    """Return the settings. Raises InvalidData for outputs whose moments are more numbers than HELD, or a window of so many innovations."""
    p = settings.p
    if settings.numbers - settings.window * (p + 1) > HELD:
        raise InvalidData(f"outputs: got {p}; needed {isqrt(HELD // 8)} at most, of whose pairs the moments are remembered: leave some out")
    if settings.memory * p > HELD:
        raise InvalidData(
            f"window: got {shorten(settings.window)}; needed {HELD // (MEMORY * p)} samples at most for {counted(p, 'output')}, of whose "
            f"innovations {MEMORY} windows are remembered"
        )
    return settings


class Bank:
    """The bank holds the state of the statistics of R streams; `update` takes one sample of each."""

    def __init__(self, settings: Settings, streams: int, ceiling: float = np.inf) -> None:
        p, height = settings.p, settings.p * settings.rows
        self.settings, self._ceiling = settings, ceiling
        self.sums = np.zeros((streams, p))
        self.energies = np.full((streams, settings.window), float(p))
        self.squares = np.zeros((streams, settings.window, p))
        self._place = 0
        self._longest = np.sqrt(p) + LONGEST
        self.column = np.zeros((streams, height))
        self.moments = np.tile(np.eye(height), (streams, 1, 1))
        self._change = np.empty_like(self.moments)
        self.direction = np.full((streams, height), 1 / np.sqrt(height))

    @property
    def scores(self) -> Array:
        """Return the sums (R, p) of s_i^2 over the window."""
        return np.asarray(self.squares.sum(axis=1))

    def state(self) -> dict[str, Array]:
        """Return what the statistics remember, each array with an axis of the streams first; `_place` is where the window goes on."""
        return {name: getattr(self, name) for name in REMEMBERED} | {"place": np.array(self._place)}

    def resume(self, state: Mapping[str, Array]) -> None:
        """Go on from what another bank of these settings remembers. Raises InvalidData for what no bank does."""
        longest, most = self._longest * (1 + ROUNDING), float(np.finfo(float).max ** 0.25)  # what is squared twice stays a float
        for name in REMEMBERED:
            size = np.sqrt(np.sum(state[name] ** 2)) if name == "direction" else np.abs(state[name]).max(initial=0.0)
            least, greatest = {"direction": (1 - ROUNDING, 1 + ROUNDING), "column": (0.0, longest)}.get(name, (0.0, most))
            if not least <= size <= greatest:
                raise InvalidData(f"{name}: got numbers of size {size:g}, expected {least:g} to {greatest:g} in a saved monitor")
            setattr(self, name, np.array(state[name]))
        self._place = int(state["place"])

    def update(self, z: Array, s: Array) -> Array:
        """Return the statistics (R, 4) at this sample."""
        add = np.add.reduce  # `np.sum` without what it looks at first, which takes longer than so few numbers
        z = z * np.minimum(1.0, self._longest / np.maximum(np.sqrt(add(z * z, axis=1)), 1.0))[:, None]
        window, memory, p = self.settings.window, self.settings.memory, self.settings.p
        self.energies[:, self._place] = add(z * z, axis=1)
        self.squares[:, self._place] = s * s
        self._place = (self._place + 1) % window
        total = self.sums + z
        length = np.sqrt(add(total * total, axis=1))
        kept = np.minimum(np.maximum(length - self.settings.shift / 2, 0.0), self._ceiling)
        self.sums = total * (kept / np.where(length > 0, length, 1.0))[:, None]
        self.column[:, :-p] = self.column[:, p:]
        self.column[:, -p:] = z
        np.multiply(self.column[:, :, None], self.column[:, None, :] / memory, out=self._change)
        self.moments *= 1 - 1 / memory
        self.moments += self._change
        image = np.matmul(self.moments, self.direction[:, :, None])[:, :, 0]
        root = np.sqrt(add(image * image, axis=1))
        self.direction = image / root[:, None]
        found = np.empty((len(z), len(TESTS)))
        found[:, 0], found[:, 1] = np.maximum.reduce(np.abs(s), axis=1), add(self.energies, axis=1)
        found[:, 2], found[:, 3] = kept, root
        return found


class Latest:
    """The `innovations` (memory, p) of the samples with these `numbers`, the latest last, of which `add` forgets the oldest."""

    def __init__(self, numbers: NDArray[np.int_], innovations: Array) -> None:
        self._numbers, self._innovations, self._place = numbers, innovations, 0  # rings, which go on at the place

    def add(self, number: int, innovation: Array) -> None:
        """Take the innovation (p,) of this sample."""
        self._numbers[self._place], self._innovations[self._place] = number, innovation
        self._place = (self._place + 1) % len(self._numbers)

    def in_order(self) -> tuple[NDArray[np.int_], Array]:
        """Return numbers and innovations, the latest last."""
        return np.roll(self._numbers, -self._place), np.roll(self._innovations, -self._place, axis=0)

    def changed(self) -> int:
        """Return the sample from which the power of the innovations most likely was larger: of m Gaussian samples with p outputs and the
        power q the likelihood ratio is m (q - p - p log(q / p)) / 2."""
        numbers, innovations = self.in_order()
        p, counts = innovations.shape[1], np.arange(1, len(numbers) + 1)
        power = np.cumsum(np.sum(innovations[::-1] ** 2, axis=1)) / counts
        ratio = np.where(power > p, counts * (power - p - p * np.log(np.maximum(power, p) / p)), 0.0)
        return int(numbers[-1 - int(np.argmax(ratio))])

    def moved(self) -> int:
        """Return the sample from which the mean of the innovations most likely was another: of m samples with the sum S the likelihood
        ratio is S'S / (2 m)."""
        numbers, innovations = self.in_order()
        sums = np.cumsum(innovations[::-1], axis=0)
        ratio = np.sum(sums**2, axis=1) / np.arange(1, len(numbers) + 1)
        return int(numbers[-1 - int(np.argmax(ratio))])


def roots(moments: Array) -> Array:
    """Return the eigenvalues of moments (any, any), falling."""
    return np.asarray(np.linalg.eigvalsh(moments)[::-1])
