"""The paper's Monte Carlo study on a few systems: as published and as corrected, with the true and with an identified model.

study     the object: a table for each plan, with the size of the run and what a reader should know of it
SYSTEMS   how many systems each plan sees
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ...base.progress import Progress, silent
from ...numeric.study.groups import by_zeros
from ...numeric.study.runs import SAMPLES
from ...numeric.study.studies import SEED, STUDIES, Study, monte_carlo

SYSTEMS = 8


def study(
    systems: int = SYSTEMS, *, samples: int = SAMPLES, plans: Sequence[str] = tuple(STUDIES), on_progress: Progress = silent
) -> dict[str, Any]:
    """Run each of these plans on the same `systems` systems, in this process."""
    studies = [monte_carlo(plan, systems=systems, samples=samples, jobs=1, on_progress=on_progress) for plan in plans]
    return {"systems": systems, "samples": samples, "seed": SEED, "plans": [_plan(one) for one in studies]}


def _plan(found: Study) -> dict[str, Any]:
    groups = [
        {
            "cases": group.cases,
            "label": group.label,
            "estimator": group.estimator,
            "median": group.median,
            "least": None if group.quantiles is None else group.quantiles[0],
            "most": None if group.quantiles is None else group.quantiles[-1],
            "random": group.random_median,
            "vacuous": group.vacuous,
            "refused": group.failed,
            "right_dimension": group.right_dimension,
        }
        for group in by_zeros(found)
    ]
    decibels = [case.decibels for case in found.cases]
    return {
        "name": found.plan.name,
        "title": found.plan.title,
        "error": found.plan.metric_text,
        "groups": groups,
        "failed": len(found.failed),
        "decibels": sum(decibels) / len(decibels) if decibels else None,
    }
