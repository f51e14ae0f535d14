"""Bad manners, what is left in the process: descriptors, children, handlers, limits of the interpreter, logs, paths, copies of records."""

from __future__ import annotations

import os

from tests.numeric.audit.unseen.form import Mutants

IDENTIFY, RESIDUAL, RANKS, COUNT = Mutants("identify"), Mutants("residual"), Mutants("window_ranks"), Mutants("fault_dimension")
SPACE, SIGNAL, STRUCTURE = Mutants("fault_space"), Mutants("reconstruct"), Mutants("structure")


os.umask(_MASK := os.umask(0))


_LOGS: list[int] = []
