"""This simulates the threshold UNIT_ROOT of `mean_shift`: what a random walk of K samples shows of its root, a mean fitted [F76]."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from faultspace.numeric.plant.healthy.mean_shift import UNIT_ROOT

CHANCE = 0.99
SAMPLES, WALKS = 2000, 20_000


def distances(walks: int, samples: int, seed: int) -> NDArray[np.float64]:
    """Return K (1 - root) of so many random walks of K = `samples` samples: one lag and a constant, by least squares."""
    rng, found = np.random.default_rng(seed), []
    for _ in range(0, walks, 1000):
        x = np.cumsum(rng.standard_normal((1000, samples)), axis=1)
        before, after = x[:, :-1], x[:, 1:]
        before = before - before.mean(axis=1, keepdims=True)
        found.append(samples * (1.0 - np.sum(before * after, axis=1) / np.sum(before**2, axis=1)))
    return np.concatenate(found)


def test_a_random_walk_stays_below_the_threshold_with_the_stated_chance() -> None:
    """Four standard errors of the share of WALKS walks; 20.7 has three digits, and half a unit of the last is less than that."""
    share = float(np.mean(distances(WALKS, SAMPLES, 76) < UNIT_ROOT))
    error = np.sqrt(CHANCE * (1.0 - CHANCE) / WALKS)
    assert abs(share - CHANCE) < 4.0 * error, share
    # The thresholds of other chances are far away: 16.9 goes with .975 [F76].
    for other in (0.975, 0.995):
        assert abs(share - other) > 6.0 * error
