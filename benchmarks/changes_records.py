"""This draws the records on which `changes.py` measures: a random plant, its noise, and one change of a known kind, size and beginning.

Plants are stable and have three states; the noise has a random colour, is correlated, and is a fortieth of each output's size. With
feedback a random proportional controller sees what the sensors say. A change sets in with the first sample after the healthy ones, of 3,
10 and 30 standard deviations (sigma) of the noise of one output:

    mean shift, step     a constant, from the beginning or from the middle on
    drift                a ramp up to this size
    white, coloured      noise of this deviation; that which is coloured is an autoregression with a pole from -0.9 to 0.9
    sinusoid             of this amplitude and a random frequency
    output gain          a sensor, input gain an actuator, that loses so much of its gain that the loss has this root mean square
    stuck                a sensor that stands still but for a jitter of a hundredth of sigma; freezing: one that holds its value now
                         and then, for 10 to 30 samples. Their size is that of the output: its noise is a third, a tenth, a thirtieth of it

    Drawn     a record and what is true of it
    record    draws one
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

Array = NDArray[np.float64]

SIGNAL_TO_NOISE = 40.0
SETTINGS = {"short": (5, 1, 160, 240), "middle": (3, 2, 300, 300), "usual": (3, 2, 600, 900)}  # outputs, inputs, healthy samples, after
KINDS = (
    *("mean shift", "step", "drift", "white fault", "coloured fault"),
    *("sinusoid", "output gain", "input gain", "stuck", "freezing"),
)


@dataclass(frozen=True)
class Drawn:
    """This is a record y (N, p), u (N, n_u) of which the first `healthy` samples are without fault; `channel` has changed from sample
    `begins` on, None where nothing has."""

    y: Array
    u: Array
    healthy: int
    channel: str | None
    begins: int | None


@dataclass(frozen=True)
class Plant:
    """x(k+1) = A x(k) + B u(k), y(k) = C x(k), and u(k) = L y(k-1) + what excites it."""

    A: Array
    B: Array
    C: Array
    L: Array


def plant(random: np.random.Generator, p: int, n_u: int, *, loop: bool) -> Plant:
    """Draw a stable plant, whose loop is stable, too."""
    A = random.standard_normal((3, 3))
    A *= random.uniform(0.3, 0.95) / np.abs(np.linalg.eigvals(A)).max()
    B, C, L = random.standard_normal((3, n_u)), random.standard_normal((p, 3)), random.standard_normal((n_u, p)) * loop
    while True:
        closed = np.block([[A, B @ L], [C, np.zeros((p, p))]])
        if np.abs(np.linalg.eigvals(closed)).max() < 0.95 or not L.any():
            return Plant(A, B, C, L)
        L = L * 0.7


def run(system: Plant, dither: Array, noise: Array, sensor: Callable[[int, Array, Array], Array], actuator: Array) -> tuple[Array, Array]:
    """Return y and u: `sensor` makes what is measured of (k, true outputs and noise, the last measured), `actuator` (N, n_u) are gains."""
    x, y, u = np.zeros(3), np.zeros(noise.shape), np.zeros(dither.shape)
    last = np.zeros(noise.shape[1])
    for k in range(len(y)):
        u[k] = system.L @ last + dither[k]
        last = y[k] = sensor(k, system.C @ x + noise[k], last)
        x = system.A @ x + system.B @ (actuator[k] * u[k])
    return y, u


def coloured(random: np.random.Generator, samples: int, p: int) -> Array:
    """Return correlated noise of one random colour, each output of deviation one."""
    white = random.standard_normal((samples + 200, p)) @ (np.eye(p) + 0.5 * random.standard_normal((p, p)))
    made = lfilter([1.0, random.uniform(-0.8, 0.8)], [1.0, -random.uniform(-0.8, 0.8)], white, axis=0)[200:]
    return np.asarray(made / made.std(axis=0))


def record(kind: str, size: float, setting: tuple[int, int, int, int], random: np.random.Generator, loop: bool) -> Drawn:
    """Draw a record; the kind "none" changes nothing."""
    p, n_u, healthy, after = setting
    N = healthy + after
    system, dither, unit = plant(random, p, n_u, loop=loop), random.standard_normal((N, n_u)), coloured(random, N, p)
    held = kind in ("stuck", "freezing")
    quiet, given = run(system, dither, np.zeros((N, p)), lambda k, y, last: y, np.ones((N, n_u)))
    sigma = quiet.std(axis=0) / (size if held else SIGNAL_TO_NOISE)
    which = int(random.integers(n_u if kind == "input gain" else p))
    k = np.arange(N)
    on = k >= healthy
    late = np.where(on, k - healthy, 0) / after
    shapes = {
        "mean shift": 1.0 * on,
        "step": 1.0 * (late > 0.5),
        "drift": late,
        "white fault": on * random.standard_normal(N),
        "coloured fault": on * _autoregression(random, N) if kind == "coloured fault" else 0.0 * on,
        "sinusoid": on * np.sin(2.0 * np.pi * random.uniform(0.02, 0.48) * k + random.uniform(0.0, 6.0)),
    }
    added = size * sigma[min(which, p - 1)] * shapes.get(kind, np.zeros(N))
    gain = -min(size / SIGNAL_TO_NOISE, 0.95) * on if kind == "output gain" else np.zeros(N)
    actuator = np.ones((N, n_u))
    if kind == "input gain":
        alone = run(
            Plant(system.A, system.B, system.C, 0.0 * system.L), given * (np.arange(n_u) == which), np.zeros((N, p)), same, actuator
        )
        actuator[on, which] -= min(size / np.max(alone[0].std(axis=0) / sigma), 0.95)
    stops = on & (kind == "stuck")
    if kind == "freezing":
        for start in random.choice(np.arange(healthy, N - 30), max(after // 100, 1), replace=False):
            stops[start : start + int(random.integers(10, 31))] = True
    jitter = 0.01 * sigma[min(which, p - 1)] * random.standard_normal(N) if kind == "stuck" else np.zeros(N)
    base = [0.0]

    def sensor(k: int, y: Array, last: Array) -> Array:
        y = y.copy()
        if kind != "input gain":
            y[which] = (1.0 + gain[k]) * y[which] + added[k]
            if stops[k]:
                base[0] = base[0] if k and stops[k - 1] else last[which]
                y[which] = base[0] + jitter[k]
        return y

    y, u = run(system, dither, unit * sigma, sensor, actuator)
    if kind == "none":
        return Drawn(y, u, healthy, None, None)
    changed = {"step": late > 0.5, "freezing": stops}.get(kind, on)
    return Drawn(y, u, healthy, f"{'u' if kind == 'input gain' else 'y'}{which + 1}", int(np.argmax(changed)))


def _autoregression(random: np.random.Generator, samples: int) -> Array:
    """Return a signal of unit deviation through one pole from -0.9 to 0.9."""
    pole = random.uniform(-0.9, 0.9)
    return np.asarray(lfilter([np.sqrt(1.0 - pole**2)], [1.0, -pole], random.standard_normal(samples + 100))[100:])


def same(k: int, y: Array, last: Array) -> Array:
    """Measure what is there."""
    return y
