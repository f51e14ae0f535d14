"""This redraws the figures of the Monte Carlo study: vacuous cases set apart, random subspaces beside every error.

    error_histogram           how many cases have which error, vacuous ones hatched
    errors_by_zeros           a box for each number of zeros and each estimator, with the median of a random subspace
    errors_by_phase           a box for each kind of phase and each estimator
    errors_against_circle     each case's error over the distance of its nearest zero to the unit circle
    study_figure              all of them on one page

Each of the first four draws the cases of a study on `ax`, a new one unless given, and returns it. Errors are in percent on logarithmic
axes, because they span decades. matplotlib is imported inside and only needed here.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ...base.sheets import counted
from .groups import Group, StudyCases, by_phase, by_zeros, cases_by_phase, cases_by_zeros
from .study_cases import LAWS, LIKELIHOOD, PAPER, Case

# A palette that is told apart in grey print and by colour-blind readers (Okabe and Ito).
COLOURS = {0: "#999999", 1: "#0072B2", 2: "#E69F00", 3: "#009E73"}
ESTIMATORS = {PAPER: "#56B4E9", LIKELIHOOD: "#F0E442", LAWS: "#009E73"}
NAMES = {PAPER: "published estimator", LIKELIHOOD: "likelihood", LAWS: "laws, reduced model"}
RANDOM, INK = "#D55E00", "#222222"
BASELINE = "random subspaces, median"
BOXES = "boxes: quartiles about the median in figures; whiskers: 10 % and 90 % quantiles; in brackets: number of cases"
BINS = 24
# Errors below this, in percent, are drawn there.
LEAST = 1e-2


def error_histogram(study: StudyCases, ax: Any = None, *, estimator: str = PAPER) -> Any:
    """Draw the number of cases by error, coloured by number of zeros; vacuous cases have no error and stand hatched at the left edge."""
    ax = _axes(ax)
    drawn = [case for case in study.cases if _percent(study, case, estimator) is not None and not case.vacuous]
    edges = np.geomspace(LEAST, 100, BINS + 1)
    kinds = sorted({case.n_zeros for case in drawn})
    samples = [[_percent(study, case, estimator) for case in drawn if case.n_zeros == k] for k in kinds]
    if samples:
        colours, labels = [COLOURS[k] for k in kinds], [_zeros(k) for k in kinds]
        ax.hist(samples, edges, stacked=True, color=colours, label=labels, edgecolor="white", linewidth=0.5)
    vacuous = sum(case.vacuous for case in study.cases)
    if vacuous:
        # A place of their own, left of the axis' smallest error.
        ax.bar(LEAST / 3, vacuous, LEAST / 4, color="white", edgecolor=COLOURS[0], hatch="////", label="vacuous: zero by construction")
    values = [100 * study.random_error(case) for case in study.cases if not case.vacuous]
    if values:
        ax.axvline(float(np.median(values)), color=RANDOM, linewidth=2.2, zorder=0.5, label=BASELINE)
    ax.set_xscale("log")
    ax.set_xlim(LEAST / 6 if vacuous else LEAST * 0.8, 130)
    # Room above the bars, so that the legend hides none.
    ax.set_ylim(0, 1.45 * max(ax.get_ylim()[1], 1))
    ax.yaxis.get_major_locator().set_params(integer=True)
    _percent_axis(ax.xaxis)
    ax.set(xlabel="error (%)", ylabel="number of cases", title=_title("Errors", study, estimator))
    ax.legend(frameon=False, fontsize="small", loc="upper left", ncols=2)
    return _plain(ax)


def errors_by_zeros(study: StudyCases, ax: Any = None) -> Any:
    """Draw a box plot: quartiles, whiskers from 10 to 90 %, all cases as points, the median in figures; the random subspace's median as a
    bar."""
    ax = _axes(ax)
    _boxes(ax, study, by_zeros(study), cases_by_zeros(study))
    ax.set_title("By number of finite zeros")
    return _plain(ax)


def errors_by_phase(study: StudyCases, ax: Any = None) -> Any:
    """Draw the same for systems without zeros, with all zeros in the unit circle, and with a zero outside."""
    ax = _axes(ax)
    _boxes(ax, study, by_phase(study), cases_by_phase(study))
    ax.set_title("By phase")
    return _plain(ax)


def errors_against_circle(study: StudyCases, ax: Any = None, *, estimator: str = PAPER) -> Any:
    """Draw the error over the distance of the nearest zero to the unit circle, both logarithmic; open marks: not all zeros inside the
    circle."""
    ax = _axes(ax)
    from matplotlib import ticker

    for k, colour in COLOURS.items():
        for minimum_phase in (True, False):
            chosen = [case for case in study.cases if case.n_zeros == k and case.minimum_phase is minimum_phase]
            points = [(case.distance_to_unit_circle, _percent(study, case, estimator)) for case in chosen]
            drawn = [(x, y) for x, y in points if x is not None and y is not None]
            if drawn:
                x, y = np.array(drawn).T
                label = f"{_zeros(k)}, {'all inside' if minimum_phase else 'not all inside'}"
                face = colour if minimum_phase else "none"
                ax.scatter(x, y, 16, facecolors=face, edgecolors=colour, linewidths=0.9, alpha=0.85, label=label)
    ax.set_xscale("log")
    # Labels at 1 and 3 of each decade: the zeros may lie within one, and more would run into each other.
    ax.xaxis.set_major_locator(ticker.LogLocator(subs=(1.0, 3.0)))
    ax.xaxis.set_major_formatter("{x:g}")
    ax.xaxis.set_minor_formatter(ticker.NullFormatter())
    ax.set_yscale("log")
    ax.set_ylim(LEAST * 0.8, 130)
    _percent_axis(ax.yaxis)
    title = _title("Against the unit circle", study, estimator)
    ax.set(xlabel="distance of the nearest zero to the unit circle", ylabel="error (%)", title=title)
    if ax.collections:
        below = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.15), "ncols": 3}
        ax.legend(frameon=False, fontsize="x-small", columnspacing=1.0, handletextpad=0.2, **below)
    return _plain(ax)


def study_figure(study: StudyCases) -> Any:
    """Make a figure with all plots, histogram and circle for each estimator, made without any window system: save it with
    `figure.savefig`."""
    from matplotlib.figure import Figure

    estimators = study.plan.estimators
    if len(estimators) == 1:
        figure = Figure(figsize=(11, 8.2), layout="constrained")
        (first, second), (third, fourth) = figure.subplots(2, 2)
        histograms, boxes, circles = [first], (second, third), [fourth]
    else:
        figure = Figure(figsize=(6.4 * len(estimators), 12.8), layout="constrained")
        grid = figure.add_gridspec(3, 2 * len(estimators))
        histograms, circles = ([figure.add_subplot(grid[row, 2 * i : 2 * i + 2]) for i in range(len(estimators))] for row in (0, 2))
        boxes = figure.add_subplot(grid[1, : len(estimators)]), figure.add_subplot(grid[1, len(estimators) :])
    for estimator, histogram, circle in zip(estimators, histograms, circles, strict=True):
        error_histogram(study, histogram, estimator=estimator)
        errors_against_circle(study, circle, estimator=estimator)
    errors_by_zeros(study, boxes[0])
    errors_by_phase(study, boxes[1])
    vacuous = sum(case.vacuous for case in study.cases)
    note = f"; {vacuous} vacuous" if vacuous else ""
    figure.suptitle(f"{len(study.cases)} systems, {study.plan.title}{note}\nerror: {study.plan.metric_text}\n{BOXES}", fontsize="medium")
    return figure


def _boxes(ax: Any, study: StudyCases, groups: list[Group], members: dict[str, list[Case]]) -> None:
    """Draw the groups of one label together, one box for each estimator."""
    spread = np.random.default_rng(0)
    labels, estimators = list(members), study.plan.estimators
    width = 0.8 / len(estimators)
    ticks = []
    for group in groups:
        number = labels.index(group.label)
        place = number + (estimators.index(group.estimator) + 0.5) * width - 0.4
        if group.estimator == estimators[0]:
            name = group.label.replace("not minimum ", "not minimum\n")
            ticks.append(f"{name}\n({group.cases}{_remark(group)})")
        if group.vacuous:
            label = "vacuous:\nno null row,\nerror zero by\nconstruction"
            ax.text(place, LEAST * 1.2, label, ha="center", va="bottom", fontsize="small", color=INK)
            continue
        if group.quantiles is None:
            continue
        if group.estimator == estimators[0]:
            ax.plot(number + np.array([-0.4, 0.4]), [100 * group.random_median] * 2, color=RANDOM, linewidth=2.2, label=_once(ax, BASELINE))
        low, first, middle, third, high = (max(100 * value, LEAST) for value in group.quantiles)
        stats = {"med": middle, "q1": first, "q3": third, "whislo": low, "whishi": high}
        kinds = {case.n_zeros for case in members[group.label]}
        alone = len(estimators) == 1
        colour = COLOURS[min(kinds)] if alone and len(kinds) == 1 else ESTIMATORS[group.estimator]
        box = {"facecolor": colour, "alpha": 0.45, "edgecolor": INK}
        if not alone:
            box["label"] = _once(ax, NAMES[group.estimator])
        line = {"color": INK, "linewidth": 1.8}
        plate = {"facecolor": "white", "alpha": 0.8, "edgecolor": "none", "pad": 0.8}
        ax.bxp([stats], [place], widths=0.62 * width, showfliers=False, patch_artist=True, boxprops=box, medianprops=line)
        errors = np.array([error for case in members[group.label] if (error := _percent(study, case, group.estimator)) is not None])
        ax.plot(place + width * spread.uniform(-0.22, 0.22, errors.size), errors, ".", color=INK, markersize=3, alpha=0.35)
        ax.text(
            place + 0.34 * width,
            middle,
            f"{middle:.2g}",
            va="center",
            fontsize="small" if alone else "x-small",
            color=INK,
            bbox=plate,
            zorder=4,
        )
    ax.set_xticks(range(len(labels)), ticks)
    ax.set_xlim(-0.6, len(labels) - 0.4)
    ax.set_yscale("log")
    # Room for the legend above what can be reached.
    ax.set_ylim(LEAST * 0.8, 400)
    _percent_axis(ax.yaxis)
    ax.set_ylabel("error (%)")
    if ax.get_legend_handles_labels()[1]:
        ax.legend(frameon=False, fontsize="small", loc="upper center", ncols=3, columnspacing=1.0, handlelength=1.4)


def _once(ax: Any, label: str) -> str | None:
    """Return the label, unless something on the axes has it."""
    return None if label in ax.get_legend_handles_labels()[1] else label


def _percent(study: StudyCases, case: Case, estimator: str) -> float | None:
    """Return the error to draw; None where there is none."""
    error = study.error(case, estimator)
    return None if error is None else max(100 * error, LEAST)


def _title(what: str, study: StudyCases, estimator: str) -> str:
    return f"{what}: {NAMES[estimator]}" if len(study.plan.estimators) > 1 else what


def _remark(group: Group) -> str:
    if group.vacuous:
        return ", all vacuous" if group.vacuous == group.cases else f", {group.vacuous} vacuous"
    return f", {group.failed} failed" if group.failed else ""


def _zeros(k: int) -> str:
    return counted(k, "zero")


def _percent_axis(axis: Any) -> None:
    ticks = [0.01, 0.1, 1, 10, 100]
    axis.set_ticks(ticks, ["≤ 0.01", "0.1", "1", "10", "100"])
    # No minor ticks below the least error: no scale goes on there.
    axis.set_ticks([k * tick for tick in ticks[:-1] for k in range(2, 10)], minor=True)


def _plain(ax: Any) -> Any:
    ax.spines[["top", "right"]].set_visible(False)
    return ax


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    from matplotlib import pyplot

    return pyplot.figure(layout="constrained").add_subplot()
