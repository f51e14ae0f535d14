"""What the page shows of numbers: the paper's Monte Carlo study on a few systems, and its example in floats.

study     a table for each plan, as published and as corrected, with the size of the run and what a reader should know of it
example   ranks of the paper's example by theory, counted with two thresholds in floats, and over many records
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

from ...base.progress import Progress, silent
from ...exact.structure.record import analyze
from ...numeric.study.groups import by_zeros
from ...numeric.study.paper_example import IDENTIFIED_WINDOW, PUBLISHED_THRESHOLD, SHOWN_WINDOWS, example_v, published_ranks
from ...numeric.study.paper_example import SAMPLES as EXAMPLE_SAMPLES
from ...numeric.study.runs import SAMPLES
from ...numeric.study.studies import SEED, STUDIES, Study, monte_carlo
from ...proofs.evidence.families import paper_example

SYSTEMS, RUNS = 8, 50  # of the study, and records of the example over which ranks are counted


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


def example(runs: int = RUNS, *, samples: int = EXAMPLE_SAMPLES) -> dict[str, Any]:
    """Return what floats make of the example, beside what is exact."""
    run = example_v(SEED, samples=samples)
    structure = analyze(paper_example().residual).to_json()
    tallied = Counter(published_ranks(seed, samples=samples) for seed in range(runs))
    return {
        "seed": SEED,
        "samples": samples,
        "windows": list(range(1, SHOWN_WINDOWS + 1)),
        "exact": structure["window_ranks"][:SHOWN_WINDOWS],
        "structure": structure,
        "default_true": list(run.default_true),
        "default_identified": list(run.default_identified),
        "threshold_identified": list(run.threshold_identified),
        "threshold": PUBLISHED_THRESHOLD,
        "lengths": [IDENTIFIED_WINDOW, IDENTIFIED_WINDOW + 1],
        "singular_values": [list(values) for values in run.singular_values],
        "state_error": run.state_error,
        "runs": runs,
        "tally": [{"ranks": list(ranks), "difference": ranks[1] - ranks[0], "runs": count} for ranks, count in tallied.most_common()],
    }
