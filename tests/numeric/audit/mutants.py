"""The reference with one thing broken, each as an adapter and the slug of a check that must catch it.

MUTANTS     all of them: a new one stands in `identification_mutants`, `fault_mutants`, `edge_mutants` or `manner_mutants`; `breaking` says
            what a mutant is
"""

from __future__ import annotations

from tests.numeric.audit.breaking import Mutant
from tests.numeric.audit.edge_mutants import EDGES
from tests.numeric.audit.fault_mutants import FAULTS
from tests.numeric.audit.identification_mutants import IDENTIFICATION
from tests.numeric.audit.manner_mutants import MANNERS

__all__ = ["MUTANTS", "Mutant"]

MUTANTS = [*IDENTIFICATION, *FAULTS, *EDGES, *MANNERS]
