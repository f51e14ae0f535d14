"""Estimates go to the exact population values like N^(-1/2), under a coloured fault that is independent of a white input; and what is
biased does not.

Each seed gives one slope of ln |error| against ln N; seeds are independent, so that Student's t gives an interval for the mean slope. The
population values come from the exact system: the system itself where the fault is independent of all inputs, B + A F and D + C F with the
true A, C where v(k) = u(k + 1).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import pytest
import scipy.stats
from scipy.optimize import linear_sum_assignment

from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.structure.fault_columns import fault_space as exact_fault_space
from faultspace.exact.structure.kernel_rows import kernel_representation
from faultspace.exact.system.systems import ResidualSystem
from faultspace.numeric.method.model.input_matrices import by_output_error
from faultspace.numeric.method.model.models import StateSpaceModel
from faultspace.numeric.method.model.past_inputs import pi_moesp
from faultspace.numeric.method.model.past_outputs import po_moesp
from faultspace.numeric.method.space.by_likelihood import fault_space_by_likelihood
from faultspace.numeric.method.space.distances import subspace_distance
from tests.numeric.exact_cases import floats

A = Matrix.of([["1/2", "1/4"], ["-1/4", "1/3"]])
B = Matrix.of([["1", "0"], ["1/2", "-1"]])
C = Matrix.of([["1", "0"], ["1", "1"]])
D = Matrix.of([["0", "1/3"], ["-1/2", "0"]])
F = Matrix.of([["1"], ["-1/2"]])
G = Matrix.of([["1"], ["1/3"]])
TRUTH = StateSpaceModel(*(floats(M) for M in (A, B, C, D)))
COUNT = 6  # Markov parameters: 2 n + 2
CONFIDENCE = 0.99


def white(samples: int, channels: int, seed: int) -> Any:
    return np.random.default_rng(seed).standard_normal((samples, channels))


def coloured(samples: int, seed: int) -> Any:
    """Return a moving average: what past outputs take for dynamics."""
    e = white(samples + 3, 1, seed + 10_000)
    return e[3:] + 0.9 * e[2:-1] + 0.7 * e[1:-2] + 0.5 * e[:-3]


def faulty(samples: int, seed: int) -> tuple[Any, Any]:
    """Return (y, u) with a coloured fault from x(0) = (1, 1)."""
    u, v = white(samples, 2, seed), coloured(samples, seed)
    joint = StateSpaceModel(TRUTH.A, np.hstack([TRUTH.B, floats(F)]), TRUTH.C, np.hstack([TRUTH.D, floats(G)]))
    return joint.simulate(np.hstack([u, v]), np.ones(2)), u


@dataclass(frozen=True)
class Slope:
    """The slope is the mean over seeds, with half the width of its confidence interval and the last mean error."""

    mean: float
    half: float
    last: float

    def contains(self, value: float) -> bool:
        return abs(self.mean - value) <= self.half

    def __str__(self) -> str:
        return f"slope {self.mean:+.3f} +- {self.half:.3f}, error at the largest N {self.last:.1e}"


def slope(errors: Any, lengths: Sequence[int]) -> Slope:
    """Return the slope from errors (seeds, lengths)."""
    slopes = np.polyfit(np.log(lengths), np.log(errors).T, 1)[0]
    seeds = len(slopes)
    half = scipy.stats.t.ppf((1 + CONFIDENCE) / 2, seeds - 1) * slopes.std(ddof=1) / np.sqrt(seeds)
    return Slope(float(slopes.mean()), float(half), float(errors[:, -1].mean()))


def pole_error(found: Any) -> float:
    gaps = np.abs(found.model.poles[:, np.newaxis] - TRUTH.poles)
    return float(gaps[linear_sum_assignment(gaps)].max())


def markov_error(found: Any) -> float:
    return float(np.linalg.norm(found.model.markov(COUNT) - TRUTH.markov(COUNT)))


@cache
def identified(method: Callable[..., Any], lengths: tuple[int, ...], seeds: int) -> dict[str, Slope]:
    """Return slopes of the pole and Markov parameter errors; every length has its own data."""
    errors = np.empty((2, seeds, len(lengths)))
    for seed in range(seeds):
        for place, samples in enumerate(lengths):
            y, u = faulty(samples, 100 * seed + place)
            found = method(y, u, order=2, block_rows=4)
            errors[:, seed, place] = pole_error(found), markov_error(found)
    return {"poles": slope(errors[0], lengths), "Markov parameters": slope(errors[1], lengths)}


@pytest.mark.parametrize("quantity", ["poles", "Markov parameters"])
def test_past_inputs_converge(quantity: str) -> None:
    """For PI-MOESP with N = 1e3 .. 2.56e5 the interval holds -1/2, and is short enough to exclude -1/4 and -3/4."""
    found = identified(pi_moesp, (1000, 4000, 16_000, 64_000, 256_000), 12)[quantity]
    print(f"PI-MOESP {quantity}: {found}")
    assert found.contains(-0.5) and found.half < 0.2 and found.last < 0.02


@pytest.mark.parametrize("quantity", ["poles", "Markov parameters"])
def test_past_outputs_do_not(quantity: str) -> None:
    """PO-MOESP at the true order is the contrast: it has no decay worth the name, and -1/2 is far outside the interval."""
    found = identified(po_moesp, (1000, 10_000, 100_000), 8)[quantity]
    print(f"PO-MOESP {quantity}: {found}")
    assert not found.contains(-0.5) and abs(found.mean) < 0.1 and found.half < 0.2 and found.last > 0.02


def fault_space_slope(noise_sizes: Callable[[Any], Any]) -> Slope:
    """Return the likelihood estimate from r with white noise, the true A and C, and n_v, against the space of the exact branch.

    The noise has one twentieth of `noise_sizes` of the channels' sizes.
    """
    system = ResidualSystem(A, F, C, G)
    truth = floats(exact_fault_space(kernel_representation(system)).basis).T
    model = StateSpaceModel(*(floats(M) for M in (A, F, C, G)))
    lengths, seeds = (1000, 10_000, 100_000), 16
    errors = np.empty((seeds, len(lengths)))
    for seed in range(seeds):
        for place, samples in enumerate(lengths):
            r = model.simulate(coloured(samples, 100 * seed + place), np.ones(2))
            sizes = r.std(axis=0)
            assert sizes.max() > 1.5 * sizes.min()
            r = r + 0.05 * noise_sizes(sizes) * white(samples, 2, 100 * seed + place + 50)
            found = fault_space_by_likelihood(r, TRUTH.A, TRUTH.C, n_v=1)
            assert found.n_z == truth.shape[1], found.reason
            errors[seed, place] = subspace_distance(truth, found.basis)
    return slope(errors, lengths)


def test_the_fault_space_converges() -> None:
    """The noise is as the likelihood takes it: of equal power in channels of equal size."""
    rate = fault_space_slope(lambda sizes: sizes)
    print(f"fault space, noise in proportion: {rate}")
    assert rate.contains(-0.5) and rate.half < 0.2


def test_the_fault_space_is_biased_by_noise_out_of_proportion() -> None:
    """This is the contrast: noise of unequal relative power leaves a bias, of second order in the noise, that more samples do not take
    away."""
    rate = fault_space_slope(lambda sizes: np.full_like(sizes, sizes.max()))
    print(f"fault space, noise out of proportion: {rate}")
    assert not rate.contains(-0.5) and rate.mean > -0.1 and rate.last > 0.02


def test_a_leading_fault_converges_to_its_own_population_values() -> None:
    """With v(k) = u(k + 1), u white and the true A, C, the estimate goes to B + A F and D + C F of the exact system, not to B and D."""
    first = Matrix.of([["1", "0"]])
    # x - F u obeys the model of B + A F and D + C F; G u(k + 1) is noise to the past.
    B_limit, D_limit = floats(B + A @ F @ first), floats(D + C @ F @ first)
    lengths, seeds = (1000, 10_000, 100_000), 16
    to_limit, to_truth = np.empty((seeds, len(lengths))), np.empty((seeds, len(lengths)))
    joint = StateSpaceModel(TRUTH.A, np.hstack([TRUTH.B, floats(F)]), TRUTH.C, np.hstack([TRUTH.D, floats(G)]))
    for seed in range(seeds):
        for place, samples in enumerate(lengths):
            u = white(samples + 1, 2, 100 * seed + place)
            y = joint.simulate(np.hstack([u[:-1], u[1:, :1]]))
            found = by_output_error([[(y, u[:-1])]], TRUTH.A, TRUTH.C, 2)
            to_limit[seed, place] = np.linalg.norm(np.vstack([found.B - B_limit, found.D - D_limit]))
            to_truth[seed, place] = np.linalg.norm(np.vstack([found.B - TRUTH.B, found.D - TRUTH.D]))
    rates = slope(to_limit, lengths), slope(to_truth, lengths)
    print(f"v(k) = u(k + 1): to the exact limit {rates[0]}; to B, D {rates[1]}")
    assert rates[0].contains(-0.5) and rates[0].half < 0.2
    assert not rates[1].contains(-0.5) and abs(rates[1].mean) < 0.05
