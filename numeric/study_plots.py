"""The figures of the Monte Carlo study, redrawn: vacuous cases set apart, random subspaces beside every error.

    error_histogram           how many cases have which error, vacuous ones hatched
    errors_by_zeros           a box for each number of zeros, with the median of a random subspace
    errors_by_phase           a box for each kind of phase
    errors_against_circle     each case's error over the distance of its nearest zero to the unit circle
    study_figure              all four on one page

Each of the first four draws a `Study` on `ax`, a new one unless given, and returns it. Errors are in percent; where they span decades the
axis is logarithmic. matplotlib is imported inside and only needed here.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .monte_carlo import Case, Group, Study, by_phase, by_zeros

# A palette that is told apart in grey print and by colour-blind readers (Okabe and Ito).
COLOURS = {0: "#999999", 1: "#0072B2", 2: "#E69F00", 3: "#009E73"}
RANDOM, INK = "#D55E00", "#222222"
BINS = 24
# Errors below this, in percent, are drawn there.
LEAST = 1e-2


def error_histogram(study: Study, ax: Any = None) -> Any:
    """Number of cases by error, on a logarithmic axis; vacuous cases have none and stand hatched at the left edge."""
    ax = _axes(ax)
    shown = [case for case in study.cases if _percent(study, case) is not None and not case.vacuous]
    edges = np.geomspace(LEAST, 100, BINS + 1)
    kinds = sorted({case.n_zeros for case in shown})
    samples = [[_percent(study, case) for case in shown if case.n_zeros == k] for k in kinds]
    if samples:
        colours, labels = [COLOURS[k] for k in kinds], [_zeros(k) for k in kinds]
        ax.hist(samples, edges, stacked=True, color=colours, label=labels, edgecolor="white", linewidth=0.5)
    vacuous = sum(case.vacuous for case in study.cases)
    if vacuous:
        # A place of their own, left of the axis' smallest error.
        ax.bar(LEAST / 3, vacuous, LEAST / 4, color="white", edgecolor=COLOURS[0], hatch="////", label="vacuous: zero by construction")
    _random_line(ax, study)
    ax.set_xscale("log")
    ax.set_xlim(LEAST / 6 if vacuous else LEAST * 0.8, 130)
    _percent_axis(ax.xaxis)
    ax.set(xlabel="error (%)", ylabel="number of cases", title="Errors")
    ax.legend(frameon=False, fontsize="small")
    return _plain(ax)


def errors_by_zeros(study: Study, ax: Any = None) -> Any:
    """Box plot: quartiles, whiskers from 10 to 90 %, all cases as points; the random subspace's median as a bar."""
    ax = _axes(ax)
    groups = by_zeros(study)
    members = [[case for case in study.cases if case.n_zeros == k] for k in sorted({case.n_zeros for case in study.cases})]
    _boxes(ax, study, groups, members)
    ax.set_title("By number of finite zeros")
    return _plain(ax)


def errors_by_phase(study: Study, ax: Any = None) -> Any:
    """The same for systems without zeros, with all zeros in the unit circle, and with a zero outside."""
    ax = _axes(ax)
    groups = by_phase(study)
    kinds = {
        "no zeros": [case for case in study.cases if not case.zeros],
        "minimum phase": [case for case in study.cases if case.zeros and case.minimum_phase],
        "not minimum phase": [case for case in study.cases if case.zeros and not case.minimum_phase],
    }
    _boxes(ax, study, groups, [kinds[group.label] for group in groups])
    ax.set_title("By phase")
    return _plain(ax)


def errors_against_circle(study: Study, ax: Any = None) -> Any:
    """Error over the distance of the nearest zero to the unit circle, both logarithmic; open marks: a zero outside the circle."""
    ax = _axes(ax)
    for k, colour in COLOURS.items():
        for minimum_phase in (True, False):
            chosen = [case for case in study.cases if case.n_zeros == k and case.minimum_phase is minimum_phase]
            points = [(case.distance_to_unit_circle, _percent(study, case)) for case in chosen]
            drawn = [(x, y) for x, y in points if x is not None and y is not None]
            if drawn:
                x, y = np.array(drawn).T
                label = f"{_zeros(k)}, {'all inside' if minimum_phase else 'one or more outside'}"
                face = colour if minimum_phase else "none"
                ax.scatter(x, y, 16, facecolors=face, edgecolors=colour, linewidths=0.9, alpha=0.85, label=label)
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_ylim(LEAST * 0.8, 130)
    _percent_axis(ax.yaxis)
    ax.set(xlabel="distance of the nearest zero to the unit circle", ylabel="error (%)", title="Against the unit circle")
    if ax.collections:
        ax.legend(frameon=False, fontsize="x-small", loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=3, columnspacing=1.0)
    return _plain(ax)


def study_figure(study: Study) -> Any:
    """A figure with the four plots, made without any window system: save it with `figure.savefig`."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11, 8.2), layout="constrained")
    (first, second), (third, fourth) = figure.subplots(2, 2)
    error_histogram(study, first)
    errors_by_zeros(study, second)
    errors_by_phase(study, third)
    errors_against_circle(study, fourth)
    vacuous = sum(case.vacuous for case in study.cases)
    note = f"; {vacuous} vacuous" if vacuous else ""
    figure.suptitle(f"{len(study.cases)} systems, {study.title}{note}\nerror: {study.metric_text}", fontsize="medium")
    return figure


def _boxes(ax: Any, study: Study, groups: list[Group], members: list[list[Case]]) -> None:
    spread = np.random.default_rng(0)
    labels = []
    for place, (group, cases) in enumerate(zip(groups, members, strict=True)):
        labels.append(f"{group.label}\n({group.cases}{_remark(group)})")
        if group.vacuous:
            told = "vacuous:\nno null row,\nerror zero by\nconstruction"
            ax.text(place, LEAST * 1.2, told, ha="center", va="bottom", fontsize="small", color=INK)
            continue
        if group.quantiles is None:
            continue
        low, first, middle, third, high = (max(100 * value, LEAST) for value in group.quantiles)
        stats = {"med": middle, "q1": first, "q3": third, "whislo": low, "whishi": high}
        colour = COLOURS.get(cases[0].n_zeros, INK) if len({case.n_zeros for case in cases}) == 1 else "#56B4E9"
        box = {"facecolor": colour, "alpha": 0.35, "edgecolor": INK}
        line = {"color": INK, "linewidth": 1.8}
        ax.bxp([stats], [place], widths=0.5, showfliers=False, patch_artist=True, boxprops=box, medianprops=line)
        errors = np.array([error for case in cases if (error := _percent(study, case)) is not None])
        ax.plot(place + spread.uniform(-0.18, 0.18, errors.size), errors, ".", color=INK, markersize=3, alpha=0.35)
        ax.text(place + 0.28, middle, f"{middle:.2g}", va="center", fontsize="small", color=INK)
        if group.random_median is not None:
            label = None if ax.get_legend_handles_labels()[1] else "median of a random subspace"
            ax.plot([place - 0.3, place + 0.3], [100 * group.random_median] * 2, color=RANDOM, linewidth=2.2, label=label)
    ax.set_xticks(range(len(labels)), labels)
    ax.set_xlim(-0.6, len(labels) - 0.4)
    ax.set_yscale("log")
    ax.set_ylim(LEAST * 0.8, 130)
    _percent_axis(ax.yaxis)
    ax.set_ylabel("error (%)")
    if ax.get_legend_handles_labels()[1]:
        ax.legend(frameon=False, fontsize="small", loc="lower right")


def _random_line(ax: Any, study: Study) -> None:
    values = [100 * study.random_error(case) for case in study.cases if not case.vacuous]
    if values:
        ax.axvline(float(np.median(values)), color=RANDOM, linewidth=2.2, label="median of a random subspace")


def _percent(study: Study, case: Case) -> float | None:
    """The error to draw; None where there is none."""
    error = study.error(case)
    return None if error is None else max(100 * error, LEAST)


def _remark(group: Group) -> str:
    if group.vacuous:
        return ", all vacuous" if group.vacuous == group.cases else f", {group.vacuous} vacuous"
    return f", {group.failed} failed" if group.failed else ""


def _zeros(k: int) -> str:
    return f"{k} zero" if k == 1 else f"{k} zeros"


def _percent_axis(axis: Any) -> None:
    ticks = [0.01, 0.1, 1, 10, 100]
    axis.set_ticks(ticks, ["≤ 0.01", "0.1", "1", "10", "100"])


def _plain(ax: Any) -> Any:
    ax.spines[["top", "right"]].set_visible(False)
    return ax


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    from matplotlib import pyplot

    return pyplot.figure(layout="constrained").add_subplot()
