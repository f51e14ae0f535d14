"""The charts of a page from the records that they show.

of_example, of_curve    one chart each
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from markupsafe import Markup

from ..drawing.charts import Series, closing_in, falling

Found = Mapping[str, Any]


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
