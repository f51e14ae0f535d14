"""Counting faults against a healthy record: an exact law under chance, right counts, units, and clear refusals."""

import numpy as np
import pytest
import scipy.linalg
import scipy.signal
import scipy.stats
from numpy.typing import NDArray

from faultspace.base.errors import InvalidData
from faultspace.numeric.plant.healthy import unlike_healthy
from faultspace.numeric.plant.healthy.against_healthy import fault_dimension_against_healthy, fault_direction_against_healthy
from faultspace.numeric.plant.healthy.healthy_model import healthy_reference, spectra
from faultspace.numeric.plant.healthy.largest_root import largest_root_probability, largest_root_quantile

Array = NDArray[np.float64]
MIX = np.random.default_rng(99).standard_normal((4, 4))


def noise(seed: int, samples: int = 2000) -> Array:
    """Return coloured noise in four outputs, correlated and of sizes 1 to 1000."""
    white = np.random.default_rng(seed).standard_normal((samples + 50, 4)) @ MIX
    low: Array = scipy.signal.lfilter([1.0, 0.3], [1.0, -0.9], white, axis=0)
    return low[50:] * [1.0, 10.0, 100.0, 1000.0]


def faults(seed: int, count: int, samples: int = 2000) -> Array:
    """Return coloured fault signals through different filters to each output, of about the size of the noise in each."""
    random = np.random.default_rng(seed)
    v = random.standard_normal((samples, count))
    r = np.zeros((samples, 4))
    for j in range(count):
        for i in range(4):
            r[:, i] += scipy.signal.lfilter(random.standard_normal(3), [1.0, -0.5], v[:, j]) * 3.0 * 10.0**i
    return r


@pytest.mark.parametrize(("dimension", "over", "under"), [(1, 5, 20), (3, 8, 40), (6, 4, 50), (4, 4, 30)])
def test_the_law_of_the_largest_root_by_simulation(dimension: int, over: int, under: int) -> None:
    random = np.random.default_rng(0)

    def covariance(freedom: int) -> NDArray[np.complex128]:
        x = random.standard_normal((dimension, freedom)) + 1j * random.standard_normal((dimension, freedom))
        return np.asarray(x @ x.conj().T / freedom)

    trials = 2000
    roots = [scipy.linalg.eigh(covariance(over), covariance(under), eigvals_only=True)[-1] for _ in range(trials)]
    for chance in (0.5, 0.1, 0.02):
        root = largest_root_quantile(chance, dimension, over, under)
        assert abs(largest_root_probability(root, dimension, over, under) - (1.0 - chance)) < 1e-8
        assert abs(np.mean(np.array(roots) > root) - chance) < 4.0 * np.sqrt(chance * (1.0 - chance) / trials)


def test_a_single_ratio_has_fishers_law() -> None:
    for root in (0.3, 1.0, 2.5):
        assert np.isclose(largest_root_probability(root, 1, 6, 20), scipy.stats.f.cdf(root, 12, 40), atol=1e-12)
    with pytest.raises(ValueError, match="needed"):
        largest_root_probability(1.0, 5, 8, 4)


def test_tapered_transforms_of_white_noise_are_white() -> None:
    record = spectra(np.random.default_rng(1).standard_normal((4000, 1)), 8)
    x = record.transforms[:, :, 0]
    moments = x.conj().T @ x / len(x)
    assert np.abs(moments - np.eye(8)).max() < 5.0 / np.sqrt(len(x))
    # Against the definition.
    e = np.random.default_rng(2).standard_normal((101, 1))
    short = spectra(e, 3)
    k = np.arange(1, 102)
    taper = np.sqrt(2 / 102) * np.sin(np.pi * 2 * k / 102)
    direct = np.sum(taper * e[:, 0] * np.exp(-2j * np.pi * short.frequencies[4] * k))
    assert np.isclose(abs(short.transforms[4, 1, 0]), abs(direct), rtol=1e-10)


@pytest.mark.parametrize("count", [0, 1, 2, 3])
def test_faults_under_unequal_coloured_noise_are_counted(count: int) -> None:
    for seed in range(3):
        healthy = healthy_reference(noise(seed))
        answer = fault_dimension_against_healthy(noise(seed + 50) + faults(seed, count), healthy)
        assert answer.n_v == count and answer.decided, answer.reason


def test_as_many_faults_as_outputs_and_louder_noise_are_undecided() -> None:
    healthy = healthy_reference(noise(0))
    for r in (noise(1) + 3.0 * faults(1, 4), 5.0 * noise(1)):
        answer = fault_dimension_against_healthy(r, healthy)
        assert answer.n_v is None and "more noise" in answer.reason


def test_units_do_not_matter() -> None:
    before, after = noise(3), noise(4) + faults(3, 2)
    plain = fault_dimension_against_healthy(after, healthy_reference(before))
    for units in (1e6, 1e-12, np.array([1e8, 1.0, -1e-5, 3.0])):
        other = fault_dimension_against_healthy(after * units, healthy_reference(before * units))
        assert other.n_v == plain.n_v == 2
        assert np.allclose(other.roots, plain.roots, rtol=1e-6, atol=1e-9)


def test_an_error_of_the_model_is_explained_by_the_inputs() -> None:
    u = np.random.default_rng(7).standard_normal((4000, 1))
    error = scipy.signal.lfilter([1.0, 0.5], [1.0, -0.7], u, axis=0) * [3.0, -20.0, 100.0, 2000.0]
    r = noise(8, 4000) + error
    r[2000:] += faults(8, 1)
    healthy = healthy_reference(r[:2000], u[:2000])
    assert fault_dimension_against_healthy(r[2000:], healthy, u=u[2000:]).n_v == 1
    louder = error[2000:] * 3.0 + noise(9)
    assert fault_dimension_against_healthy(louder, healthy_reference(r[:2000])).n_v == 1, "without u it is a fault"


def test_the_direction_and_the_signal_of_one_fault() -> None:
    A, C = np.array([[0.8, 0.3], [-0.3, 0.6]]), np.random.default_rng(10).standard_normal((4, 2))
    F, G = np.array([1.0, -2.0]), np.array([1.0, 0.0, -0.5, 0.3])
    v, x, r = np.random.default_rng(11).standard_normal(4000), np.zeros(2), np.empty((4000, 4))
    for k in range(4000):
        r[k] = C @ x + G * v[k]
        x = A @ x + F * v[k]
    small = noise(12, 8000) * 0.01 / np.array([1.0, 10.0, 100.0, 1000.0])
    found = fault_direction_against_healthy(small[4000:] + r, healthy_reference(small[:4000]), A=A, C=C)
    truth = np.concatenate([F, G]) / np.linalg.norm(np.concatenate([F, G]))
    # p - m = 3 kernel rows and no zeros: [F; G] itself is what is found.
    assert np.linalg.norm(found.z - truth * (truth @ found.z)) < 0.01
    assert abs(np.corrcoef(found.signal[10:], v[10:])[0, 1]) > 0.995
    with pytest.raises(InvalidData, match="one without the other"):
        fault_direction_against_healthy(r, healthy_reference(small), A=A)


def test_bad_data_are_refused_with_a_reason() -> None:
    healthy = healthy_reference(noise(0))
    kept = noise(1)
    before = kept.copy()
    fault_dimension_against_healthy(kept, healthy)
    assert np.array_equal(kept, before)
    for call, says in (
        (lambda: healthy_reference(noise(0)[:100]), "at least 256 are needed: record more$"),
        (lambda: healthy_reference(noise(0)[:255, :1]), "at least 256 are needed: record more$"),
        (lambda: healthy_reference(np.tile(noise(0)[:300], 2)), "at least 512 are needed: record more, or take fewer channels$"),
        (lambda: healthy_reference(noise(0).T), "transposed"),
        (lambda: healthy_reference(noise(0) * [1, 1, 1, 0]), "no noise to compare"),
        (lambda: healthy_reference(noise(0), np.ones((5, 1))), "equal numbers"),
        (lambda: fault_dimension_against_healthy(noise(1)[:, :3], healthy), "same plant"),
        (lambda: fault_dimension_against_healthy(noise(1)[:20], healthy), "record more"),
        (lambda: fault_dimension_against_healthy(noise(1), healthy, level=2.0), "level"),
        (lambda: fault_dimension_against_healthy(np.full((500, 4), np.nan), healthy), "NaN"),
    ):
        with pytest.raises(InvalidData, match=says):
            call()


def test_the_largest_of_later_values_stays_within_its_ratio_of_the_largest_healthy_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """With exponential tails about as rarely as the level says, and with normal ones more rarely; of few healthy values nothing follows."""
    monkeypatch.setattr(unlike_healthy, "HEALTHY_LEVEL", 0.1)
    draw = np.random.default_rng(31)
    most = unlike_healthy.largest_ratio(200, 1000)
    beyond = {
        name: np.mean([np.max(values(1000)) > most * np.max(values(200)) for _ in range(1000)])
        for name, values in (("exponential", draw.standard_exponential), ("normal", lambda count: np.abs(draw.standard_normal(count))))
    }
    assert 0.002 < beyond["exponential"] < 0.1 and beyond["normal"] < beyond["exponential"]
    assert unlike_healthy.largest_ratio(2, 1000) == np.inf
