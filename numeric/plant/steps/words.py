"""The words of a number of faults: each reason of a count is a clause that goes on from what was said before it.

said       the sentence of some reasons
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import reduce
from typing import Any

from ....base.errors import shorten
from ....base.sheets import counted
from ...method.rows.fault_count import NO_CONSTANT
from .findings import Because, Reason

AS_MANY = "as many faults as outputs look like noise in every output"
SHOWN = 2  # rows of a table of changes


def said(because: Sequence[Reason]) -> str:
    """Return the sentence of these reasons, of which each goes on from those before."""
    return reduce(_and, because, "")


def _and(before: str, reason: Reason) -> str:
    clause, numbers = _CLAUSES[reason.code], reason.numbers
    if not isinstance(clause, str):
        return clause(before, reason.said, numbers)
    return clause.format(**{**numbers, "before": before, "own": reason.said, "outputs": _names(numbers)})


def _names(numbers: Mapping[str, Any]) -> str:
    return ", ".join(map(shorten, numbers.get("outputs", ())))


def _explained(before: str, own: str, numbers: Mapping[str, Any]) -> str:
    sizes = ", ".join(f"{shorten(name)} {size:.2g}" for name, size in zip(numbers["outputs"], numbers["sizes"], strict=True))
    hidden = numbers["constant_hidden_by"]
    means = "went with the means" if hidden == "means" else "can pass for the response to the mean of the inputs"
    constant = f"; a fault that is constant over the whole record {means}" if hidden else ""
    return f"the model explains the outputs to rounding: nothing larger than {sizes} acts{constant}"


def _given(before: str, own: str, numbers: Mapping[str, Any]) -> str:
    n_v, count = numbers["n_v"], numbers["counted"]
    if count == n_v:
        return f"{n_v} given; as the data say"
    told = count if count is not None else " or ".join(map(str, numbers["possible"])) or "undecided"
    return f"{n_v} given; the data say {told}: {before}"


def _foretold(before: str, own: str, numbers: Mapping[str, Any]) -> str:
    news = numbers["news"]
    return (
        f"{before}; but {news} of them {'is' if news == 1 else 'are'} more than residual and inputs foretell: one fault whose "
        "direction turns with the frequency, as of a gain that has changed, counts twice"
    )


def _laws_broken(before: str, own: str, numbers: Mapping[str, Any]) -> str:
    return (
        f"{before}; but outputs and inputs do not obey {counted(numbers['laws'], 'law')} of so many states: more faults act, for in "
        "separate bands they count as one against healthy samples, or the order is too low"
    )


def _mean_moved(before: str, own: str, numbers: Mapping[str, Any]) -> str:
    where = _names(numbers) or "no output by itself, all of them together"
    return (
        f"a fault moves the mean of the residual ({where}; {own}), at least one; a constant fault changes no rank, so that "
        f"ranks cannot count it; of faults that vary: {before}"
    )


def _row(row: Mapping[str, Any]) -> str:
    where = f" in experiment {row['experiment']}" if row["experiment"] is not None else ""
    return f"{row['kind']} of {row['channel']}{where}"


def _changed(before: str, own: str, numbers: Mapping[str, Any]) -> str:
    seen = numbers["rows"]
    rows = "; ".join(f"{_row(row)}: {row['told']}" for row in seen[:SHOWN])
    more = f" and {counted(len(seen) - SHOWN, 'row')} more" if len(seen) > SHOWN else ""
    return f"{before}; but something has changed ({rows}{more}), whatever its number of independent faults"


def _change_open(before: str, own: str, numbers: Mapping[str, Any]) -> str:
    return f"{before}; but whether there is a {_row(numbers)} is undecided: {own}"


_CLAUSES: dict[Because, str | Callable[[str, str, Mapping[str, Any]], str]] = {
    Because.EXPLAINED: _explained,
    Because.GIVEN: _given,
    Because.RANKS: "{own}",
    Because.LAWS: "{own}",
    Because.AGAINST_HEALTHY: "{own}",
    Because.UNEQUAL_NUMBERS: "numbers of the residual are too unequal to compute with, as outliers make them: mend the record there",
    Because.AS_MANY_AS_OUTPUTS: f"{{before}}; but so many outputs are not explained to rounding: {AS_MANY}",
    Because.COPIES: (
        "{before}; but the {p} outputs are combinations of {independent} of them, as copies are: leave the others out, for " + AS_MANY
    ),
    Because.RANKS_SHOW_FAULTS: "{before}; but the residual shows {n_v}: {own}",
    Because.SPIKES: "{before}; but the residual of {outputs} has spikes beyond {deviations:.2g} deviations, as normal noise has not",
    Because.CONSTANT_UNSEEN: f"{{before}}; {NO_CONSTANT}",
    Because.WENT_WITH_MEANS: (
        "{before}; but a constant fault would have gone with the means, which are the operating point unless one acts: "
        'operating_point="means" says that none does'
    ),
    Because.NOT_ABOUT_ZERO: "{before}; but the residual is not about zero: an operating point, or a constant fault",
    Because.UNLIKE_HEALTHY: "{before}; but {own}",
    Because.FORETOLD: _foretold,
    Because.LAWS_BROKEN: _laws_broken,
    Because.UNEXPLAINED: "the model explains the healthy samples to rounding and not the others, so that a fault acts; {before}",
    Because.MEAN_MOVED: _mean_moved,
    Because.MEAN_OPEN: "{before}; but whether the mean has moved, as by a constant fault, is undecided: {own}",
    Because.MEAN_STAYED: "{before}; {own}",
    Because.CHANGED: _changed,
    Because.CHANGE_OPEN: _change_open,
    Because.HEALTHY_RANKS_ALIKE: (
        "{before}; but the same way finds {n_v} among the healthy samples, so that this may be noise of unequal powers"
    ),
    Because.NO_CHANGE_SEEN: (
        "{before}; but the table of changes sees none since the healthy samples, so that this may be noise of unequal powers"
    ),
}
