"""The checks of the claims: the function CLAIM_READING, with underscores, takes a Workbench to an Outcome.

TOPICS      which file the checks of a claim stand in; where none is named, in a file of its own
check_of    the function of a check that the ledger names as "claim.reading"
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

TOPICS = {
    "windows": ("theorem_1", "theorem_2", "proposition_3", "objection_3", "problem_11", "window_ranks", "sharp_windows"),
    "pairs": ("theorem_3_ii", "one_determinant", "bad_set", "canonical_form", "zero_assignment", "zeros_of_pairs"),
    "experiments": ("proposition_1", "assumption_2", "past_outputs", "settle_1"),
    "signals": ("assumption_4", "zero_feedthrough", "trajectory_recovered"),
}


def check_of(name: str) -> Any:
    """Return the function. Raises ImportError or AttributeError where there is none."""
    claim, _, reading = name.partition(".")
    file = next((topic for topic, claims in TOPICS.items() if claim in claims), claim)
    return getattr(import_module(f".{file}", __package__), f"{claim}_{reading}")
