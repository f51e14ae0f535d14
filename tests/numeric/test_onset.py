"""The onset of a fault: where it is, how sure that is, in which outputs, how large; and none where there is none."""

from __future__ import annotations

import json

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import lfilter

from faultspace.base.errors import InvalidData
from faultspace.numeric import fault_onset
from faultspace.numeric.plant.changes import change_scan
from faultspace.numeric.plant.changes.change_scan import choose_lags, located, rows_of, scan

Array = NDArray[np.float64]


def noise(seed: int, N: int = 400, p: int = 2, pole: float = 0.0) -> Array:
    """Return stationary noise of unit power."""
    white = np.random.default_rng(seed).standard_normal((N + 300, p))
    return np.asarray(lfilter([np.sqrt(1 - pole**2)], [1.0, -pole], white, axis=0)[300:])


def slow_ratio(r: Array, lags: int, k: int, first: int) -> float:
    """Return the likelihood ratio of a change at sample k by three regressions, one after the other."""

    def log_spread(start: int, stop: int) -> tuple[float, int]:
        y = r[start:stop]
        X = np.hstack([np.ones((len(y), 1)), *(r[start - i : stop - i] for i in range(1, lags + 1))])
        left = y - X @ np.linalg.lstsq(X, y, rcond=None)[0]
        return float(np.linalg.slogdet(left.T @ left / len(y))[1]), len(y)

    (whole, n), (before, n_1), (after, n_2) = (log_spread(*ends) for ends in ((first, len(r)), (first, k), (k, len(r))))
    return n * whole - n_1 * before - n_2 * after


def test_the_scan_takes_the_sample_that_three_regressions_take() -> None:
    r = noise(3, 240, 2, 0.5)
    r[150:] *= 1.8
    found = scan(lambda a, b: r[a:b], 0, len(r), 2, 1, 0)
    assert found is not None
    sample, (first, last) = located(lambda a, b: r[a:b], found, 0, 0.95)
    begin = int(found.edges[0])
    slow = {k: slow_ratio(r, 1, k, begin) for k in range(begin + 10, len(r) - 10)}
    assert sample == max(slow, key=lambda k: slow[k])
    reach = -2 * np.log(1 - np.sqrt(0.95))
    inside = [k for k, value in slow.items() if value >= slow[sample] - reach]
    assert (first, last) == (min(inside) - 1, max(inside))


def test_the_rows_are_the_samples_before_and_the_sample() -> None:
    assert rows_of(np.arange(4.0)[:, None], 2).tolist() == [[1, 1, 0, 2], [1, 2, 1, 3]]


@pytest.mark.parametrize("kind", ["mean", "variance", "colour", "correlation"])
def test_a_change_of_any_kind_is_found_within_its_interval(kind: str) -> None:
    r = noise(1, 600, 2)
    if kind == "mean":
        r[350:, 1] -= 2.0
    elif kind == "variance":
        r[350:, 1] *= 3.0
    elif kind == "colour":
        r[350:] = noise(2, 250, 2, 0.9)
    else:
        r[350:, 1] = 0.95 * r[350:, 0] + np.sqrt(1 - 0.95**2) * r[350:, 1]
    found = fault_onset(r)
    assert len(found.onsets) == 1 and found.onsets[0].p_value <= 0.01
    first, last = found.onsets[0].interval
    assert first <= 350 <= last and last - first < 60
    if kind in ("mean", "variance"):
        assert found.onsets[0].changed == (1,)
    if kind == "correlation":
        assert found.onsets[0].changed == ()


def test_sizes_are_in_deviations_of_the_reference() -> None:
    r = noise(5, 1000, 3) * np.array([1.0, 1e-3, 50.0])
    r[600:, 1] += 5e-3
    r[600:, 2] *= 4.0
    (onset,) = fault_onset(r).onsets
    assert np.allclose(onset.shift, [0.0, 5.0, 0.0], atol=0.4) and np.allclose(onset.growth, [1.0, 1.0, 4.0], rtol=0.1)
    assert np.allclose(onset.size, [0.0, 5.0, np.sqrt(15)], atol=0.5)


def test_several_changes_are_found_one_after_the_other_and_the_end_of_a_fault_has_size_zero() -> None:
    r = noise(9, 900, 2)
    r[300:600, 0] += 4.0
    found = fault_onset(r)
    assert [abs(onset.sample - at) <= 2 for onset, at in zip(found.onsets, (300, 600), strict=True)] == [True, True]
    assert found.onsets[0].size[0] == pytest.approx(4.0, abs=0.3) and found.onsets[1].size[0] < 0.5


@pytest.mark.parametrize("pole", [0.0, 0.95])
def test_a_residual_that_is_alike_has_no_onset_and_says_what_that_means(pole: float) -> None:
    found = [fault_onset(noise(seed, 300, 2, pole)) for seed in range(6)]
    assert sum(bool(one.onsets) for one in found) <= 1
    assert any("acts all the time, and has no onset" in one.reason for one in found)


def test_a_fault_from_the_first_sample_on_has_no_onset() -> None:
    r = noise(2, 500, 2) + 10 * noise(3, 500, 1, 0.5)
    assert fault_onset(r).onsets == ()


def test_nothing_is_looked_for_among_healthy_samples() -> None:
    r = noise(4, 400, 2)
    r[250:, 1] *= 5.0
    found = fault_onset(r, healthy=150)
    assert [abs(onset.sample - 250) <= 3 for onset in found.onsets] == [True] and found.reference[1] >= 150
    assert fault_onset(r, healthy=300).onsets == () or fault_onset(r, healthy=300).onsets[0].sample >= 300
    at_once = noise(6, 400, 2)
    at_once[200:, 0] += 6.0
    assert fault_onset(at_once, healthy=200).onsets[0].interval[0] == 200


@pytest.mark.parametrize("factor", [1e-150, 1e150])
def test_units_do_not_matter(factor: float) -> None:
    r = noise(9, 300, 2)
    r[180:] *= 3.0
    one, other = fault_onset(r), fault_onset(r * factor)
    assert one.onsets[0].interval == other.onsets[0].interval and one.onsets[0].p_value == other.onsets[0].p_value
    assert np.allclose(one.onsets[0].size, other.onsets[0].size)


def test_what_never_changes_rounding_copies_and_few_samples_are_borne() -> None:
    assert "never changes" in fault_onset(np.ones((100, 2))).reason
    assert "too few" in fault_onset(noise(1, 12, 2)).reason
    silent = np.zeros((300, 2))
    silent[200:, 1] = noise(1, 100, 1)[:, 0]
    assert [onset.sample for onset in fault_onset(silent).onsets] == [200]
    rounding = 1e-16 * noise(2, 300, 2)
    rounding[200:, 0] += noise(1, 100, 1)[:, 0]
    assert [onset.sample for onset in fault_onset(rounding).onsets] == [200]
    copies = noise(3, 300, 1)
    copies[200:] *= 4.0
    assert len(fault_onset(np.hstack([copies, copies])).onsets) == 1
    spike = noise(7, 400, 2)
    spike[200, 0] = 200.0
    assert fault_onset(spike).onsets == ()


def test_a_step_far_above_the_noise_is_no_large_innovation_of_a_slow_process() -> None:
    r = noise(20, 400, 3)
    r[160:, 1] += 30.0
    assert [onset.sample for onset in fault_onset(r).onsets][:1] == [160]
    slow = noise(21, 600, 2, 0.9)
    slow[300:] += np.array([30.0, 12.0])
    assert [abs(onset.sample - 300) <= 2 for onset in fault_onset(slow).onsets][:1] == [True]


def test_lags_are_chosen_by_what_the_colour_needs() -> None:
    white, coloured = noise(1, 2000, 2), noise(1, 2000, 2, 0.8)
    assert (choose_lags(lambda a, b: white[a:b], 0, 2000, 2), choose_lags(lambda a, b: coloured[a:b], 0, 2000, 2)) == (0, 1)


def test_bad_arguments_are_refused_in_one_line() -> None:
    r = noise(1, 100, 1)
    for arguments in ({"level": 0.001}, {"confidence": 1.0}, {"healthy": 100}, {"healthy": 0}):
        with pytest.raises(InvalidData, match=next(iter(arguments))):
            fault_onset(r, **arguments)
    assert json.dumps(fault_onset(r).to_json(), allow_nan=False)


@pytest.mark.parametrize(("p", "lags", "parts", "length"), [(2, 3, 6, 11), (1, 0, 4, 5), (3, 1, 5, 40)])
def test_records_without_a_change_are_those_of_the_plain_recursion(p: int, lags: int, parts: int, length: int) -> None:
    rows = np.random.default_rng([p, lags]).standard_normal((parts, length, 1 + p * (lags + 1)))
    rows[..., 0] = 1.0
    slopes, innovations = change_scan._innovations(rows, p, parts // 2)
    draw, samples = np.random.default_rng(change_scan.SEED), parts * length
    made = np.concatenate(list(change_scan._without_change(rows, p, parts // 2)))
    assert len(made) == change_scan.DRAWS
    for sums in made[: 2 * change_scan.CLEAR]:
        errors = innovations[draw.permutation(parts)].reshape(samples, p)
        y = np.zeros((lags + samples, p))
        for k in range(samples):
            y[lags + k] = errors[k] + sum((y[lags + k - i] @ slopes[p * (i - 1) : p * i] for i in range(1, lags + 1)), np.zeros(p))
        z = np.hstack([np.ones((samples, 1)), *(y[lags - i : lags - i + samples] for i in range(lags + 1) if i), y[lags:]])
        parted = z.reshape(parts, length, -1)
        assert np.allclose(sums, np.swapaxes(parted, 1, 2) @ parted, rtol=1e-10, atol=1e-10)
