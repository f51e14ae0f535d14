"""The hypotheses of each claim, as tests on certified subjects: what `ablation` drops, one file a kind of subject.

ablations     all of them, in the order of the claims
"""

from __future__ import annotations

from typing import Any

from ..verdict.ablation import Ablation
from .consistency import consistency, consistency_coloured
from .fault_matrices import theorem_3_ii
from .pairs import same_model, theorem_1, theorem_3_i
from .pencils import bad_of_full_rank, codimension, determinant, placement, zeros_of_pair
from .systems import (
    columns,
    every_window,
    gap,
    gap_from_lag,
    range_of_f,
    rank_formula,
    sharp_gap,
    signal_from_known_state,
    signal_from_unknown_state,
    solutions,
    solutions_from_lag,
)
from .trajectories import excited, persistently_excited


def ablations() -> tuple[Ablation[Any], ...]:
    """Return every ablation, by the order of its claim."""
    return (
        consistency(),
        consistency_coloured(),
        theorem_1(),
        rank_formula(),
        excited(),
        persistently_excited(),
        gap(),
        gap_from_lag(),
        solutions(),
        solutions_from_lag(),
        columns(),
        theorem_3_i(),
        same_model(),
        theorem_3_ii(),
        range_of_f(),
        signal_from_known_state(),
        signal_from_unknown_state(),
        every_window(),
        sharp_gap(),
        determinant(),
        zeros_of_pair(),
        codimension(),
        bad_of_full_rank(),
        placement(),
    )
