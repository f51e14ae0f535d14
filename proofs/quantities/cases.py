"""What a claim can be about, besides one system: the cases, each exact, with everything that quantities ask of them.

Case        a system, or one of the following
Pair        two systems over one field with as many outputs each
Choice      a system and a P, by which the columns of its fault space are combined to those of another one
Record      a system with inputs, and what drove it
PairSubject, ChoiceSubject, RecordSubject    what is known of them, found when it is first asked for
case_json   what a program is told of a case
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ...exact.algebra.matrices import Matrix
from ...exact.structure.behavior import Comparison, compare
from ...exact.structure.fault_columns import with_pair
from ...exact.structure.signals import Trajectory, simulate
from ...exact.system.systems import FaultySystem, ResidualSystem
from ..evidence.subjects import Subject


@dataclass(frozen=True)
class Pair:
    """Two systems over the same field with p outputs each; their numbers of states and faults may differ.

    `one_A_and_C` where the claim is about pairs with the same (A, C), as these are then.
    """

    first: ResidualSystem
    second: ResidualSystem
    one_A_and_C: bool = False

    def __str__(self) -> str:
        return f"first: {self.first}; second: {self.second}"

    @property
    def size(self) -> tuple[int, ...]:
        """The number of all states, faults and outputs, then those of the first, and of the second."""
        sizes = [(one.n, one.m, one.p) for one in (self.first, self.second)]
        return (sum(map(sum, sizes)), *sizes[0], *sizes[1])

    def to_json(self) -> dict[str, Any]:
        """Both systems, as exact files hold them."""
        return {"first": self.first.to_json(), "second": self.second.to_json()}


@dataclass(frozen=True)
class Choice:
    """A system, and P (n_z x k) over its field, n_z the dimension of its fault space."""

    system: ResidualSystem
    P: Matrix

    def __str__(self) -> str:
        return f"{self.system}; P={self.P}"

    @property
    def size(self) -> tuple[int, ...]:
        """n + m + p, then k, then n, m, p."""
        system = self.system
        return (system.n + system.m + system.p, self.P.ncols, system.n, system.m, system.p)

    def to_json(self) -> dict[str, Any]:
        """The system, as exact files hold it, and P with its number of columns."""
        return {"system": self.system.to_json(), "P": self.P.to_json(), "k": self.P.ncols}


@dataclass(frozen=True)
class Record:
    """A system with nu inputs, driven by u (N x nu, time down the rows) from x0 (n x 1), its faults at rest."""

    system: FaultySystem
    u: Matrix
    x0: Matrix

    def __str__(self) -> str:
        return f"{self.system}; u={self.u}, x0={self.x0}"

    @property
    def size(self) -> tuple[int, ...]:
        """n + m + p, then nu, N, and n, m, p."""
        system = self.system
        return (system.n + system.m + system.p, system.nu, self.u.nrows, system.n, system.m, system.p)

    def to_json(self) -> dict[str, Any]:
        """The system, as exact files hold it, u with a row a sample, and x0."""
        return {"system": self.system.to_json(), "u": self.u.to_json(), "x0": [row[0] for row in self.x0.to_json()]}


class PairSubject:
    """A pair and what is known of it; the same Subject may be part of many pairs."""

    def __init__(self, first: Subject, second: Subject) -> None:
        self.first, self.second = first, second

    @property
    def subjects(self) -> dict[str, Subject]:
        """The two systems by their names."""
        return {"first": self.first, "second": self.second}

    @property
    def matrices(self) -> dict[str, Matrix]:
        """Matrices that both have, or that belong to neither."""
        return {"A": self.first.system.A, "C": self.first.system.C}

    @cached_property
    def comparison(self) -> Comparison:
        """This has the shortest word of each system that the other cannot make, where there is one."""
        return compare(self.first.kernel, self.second.kernel)


class ChoiceSubject(PairSubject):
    """A system and (A, Fhat P, C, Ghat P), [Fhat; Ghat] being the reduced basis of its fault space, and what is known of both."""

    def __init__(self, system: Subject, P: Matrix) -> None:
        super().__init__(system, Subject(with_pair(system.fault_space, P)))
        self.P = P

    @property
    def subjects(self) -> dict[str, Subject]:
        """The two systems by their names."""
        return {"": self.first, "chosen": self.second}

    @property
    def matrices(self) -> dict[str, Matrix]:
        """P, the matrix that was chosen."""
        return {"P": self.P}


class RecordSubject:
    """A record and what is known of it: its system (A, F, C, G), (A, B, C, D) as another one, and the trajectory."""

    def __init__(self, system: Subject, record: Record) -> None:
        self.system, self.u, self.x0 = system, record.u, record.x0
        self.inputs = Subject(system.system.with_faults(record.system.B, record.system.D))

    @property
    def subjects(self) -> dict[str, Subject]:
        """The two systems by their names."""
        return {"": self.system, "inputs": self.inputs}

    @property
    def matrices(self) -> dict[str, Matrix]:
        """What belongs to the record."""
        return {"B": self.inputs.system.F, "D": self.inputs.system.G, "u": self.u, "x0": self.x0}

    @cached_property
    def trajectory(self) -> Trajectory:
        """The trajectory from x0 under u."""
        return simulate(self.inputs.system, self.x0, self.u)


Case = ResidualSystem | Pair | Choice | Record
Known = Subject | PairSubject | RecordSubject


def size_of(case: Case) -> tuple[int, ...]:
    """Return by what cases are ordered first: n + m + p, n, m, p of a system."""
    if isinstance(case, ResidualSystem):
        return (case.n + case.m + case.p, case.n, case.m, case.p)
    return case.size


def case_json(case: Case) -> dict[str, Any]:
    """Return the system with its sizes, or what else the case is made of."""
    if isinstance(case, ResidualSystem):
        return {"system": case.to_json(), "n": case.n, "m": case.m, "p": case.p}
    return case.to_json()
