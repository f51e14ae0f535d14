"""The experiments of counterexamples/, which refute what one might expect of population limits; its README says what each shows.

kept            the experiment of a name
WITHOUT_RANK    those in which PI-MOESP loses a rank though v is uncorrelated with u at all lags
"""

from __future__ import annotations

import json
from importlib import resources

from ...exact.limits.experiments import Experiment, read_experiment

WITHOUT_RANK = (
    "seasonal-input",
    "seasonal-input-coloured-fault",
    "moving-average-input",
    "moving-average-input-coloured-fault",
    "integer-taps",
    "rational-input",
    "rational-input-one-output",
)


def kept(name: str) -> Experiment:
    """Return the experiment that stands in counterexamples/NAME.json."""
    text = resources.files("faultspace.proofs").joinpath("counterexamples", f"{name}.json").read_text(encoding="utf-8")
    return read_experiment(json.loads(text), where=name)
