"""The charts of a page from the records that they show.

of_system, of_word, of_example, of_curve, of_bound    one chart each
medians                                               the errors of each method in one number
"""

from __future__ import annotations

from collections.abc import Mapping
from statistics import median
from typing import Any

from markupsafe import Markup

from ..drawing.charts import Series, closing_in, falling, ranks, strips, word

Found = Mapping[str, Any]


def of_system(system: Found) -> Markup:
    """Return the ranks of a system over s beside the formula of theorem-2, which it has where it is left-invertible."""
    structure = system["structure"]
    series = [
        Series("rank [O_s T_s], exact", structure["window_ranks"], 1),
        Series("s r + sum of min(s, eta_i)", system["by_indices"], 2),
    ]
    if system["by_zeros"] is not None:
        series.append(Series("n + s m - zeta, of theorem-2", system["by_zeros"], 3))
    return ranks(system["windows"], series[::-1], "Ranks over the window, beside the formulas")


def of_word(found: Found) -> Markup | None:
    """Return the outputs of a word, None where they are no rational numbers."""
    return word(found["r"], f"The outputs of a word of {found['samples']} samples")


def of_example(example: Found, place: int) -> Markup:
    """Return the singular values of R_5 or R_6."""
    length = example["lengths"][place]
    right = example["exact"][length - 1]
    return falling(
        example["singular_values"][place], right, example["threshold"], f"Singular values of R_{length}, the identified system's residual"
    )


def of_curve(convergence: Found, curve: Found) -> Markup:
    """Return the distances of one method's estimates to the exact limit and to the truth."""
    series = [Series("to the truth", curve["to_truth"], 2)]
    if curve["to_limit"] is not None:
        series.append(Series("to the exact limit", curve["to_limit"], 1))
    return closing_in(convergence["lengths"], series, f"{curve['method']}, {curve['experiment']}")


def of_bound(bound: Found) -> Markup:
    """Return the errors of all methods over the bound, those left out that gave no model."""
    rows = [(one["name"], [error for error in one["errors"] if error is not None]) for one in bound["methods"]]
    return strips(rows, "Errors of models over the Cramer-Rao bound", "error over the bound, a mark a record, a bar at the median")


def medians(bound: Found) -> list[tuple[str, float | None, int, int]]:
    """Return name, median, records with a model and records, of each method."""
    rows = []
    for one in bound["methods"]:
        found = [error for error in one["errors"] if error is not None]
        rows.append((one["name"], median(found) if found else None, len(found), len(one["errors"])))
    return rows
