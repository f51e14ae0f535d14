"""The paper's example: exact ranks beside the singular values that floats have, on one record and over many.

example     the object: ranks by theory, ranks counted with two thresholds, singular values of R_5 and R_6, how often which ranks come out
RUNS        records over which ranks are counted
"""

from __future__ import annotations

from collections import Counter
from typing import Any

from ...exact.structure.record import analyze
from ...numeric.study.paper_example import IDENTIFIED_WINDOW, PUBLISHED_THRESHOLD, SAMPLES, SHOWN_WINDOWS, example_v, published_ranks
from ...numeric.study.studies import SEED
from ...proofs.evidence.families import paper_example

RUNS = 50


def example(runs: int = RUNS, *, samples: int = SAMPLES) -> dict[str, Any]:
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
