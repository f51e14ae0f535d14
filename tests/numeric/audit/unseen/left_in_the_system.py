"""Bad manners, what is left in the system and in libraries: cores, priority, locale, functions that were replaced, temporary files."""

from __future__ import annotations

from multiprocessing import shared_memory

from tests.numeric.audit.unseen.form import Mutants

IDENTIFY, RESIDUAL, RANKS, COUNT = Mutants("identify"), Mutants("residual"), Mutants("window_ranks"), Mutants("fault_dimension")
SPACE, SIGNAL, STRUCTURE = Mutants("fault_space"), Mutants("reconstruct"), Mutants("structure")

_SHARED: list[shared_memory.SharedMemory] = []
