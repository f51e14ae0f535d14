"""This measures how far off a fault space is on the noisy records of the audit, drawn anew: what its bound on the angle rests on.

    python benchmarks/audit_space.py [--trials 30] [--seed 640000]

The records of `space-of-record-noisy` with other faults, inputs and noise of the same laws, asked of our own code. The sine of the largest
angle between what the columns do and what the true ones do: its median, the nine in ten, the largest. LEVEL of
`numeric/audit/checks/laws.py` is the largest of 60, rounded up to a twentieth.
"""

from __future__ import annotations

import argparse
from dataclasses import replace

import numpy as np

from faultspace.numeric.audit import reference
from faultspace.numeric.audit.checks.laws import ASKED, LEVEL, SAME, space_errors
from faultspace.numeric.audit.vectors.shipped_vectors import shipped


def main() -> None:
    """Measure and print a line for each record, and one for all."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--trials", type=int, default=30)
    parser.add_argument("--seed", type=int, default=640000)
    arguments = parser.parse_args()
    largest = 0.0
    for vector in shipped("noisy"):
        if vector.slug not in ASKED:
            continue
        sines, undecided = list[float](), 0
        for number in range(arguments.trials):
            found = [one.got for one in space_errors(replace(vector, seed=arguments.seed + number), SAME, reference.identified_fault_space)]
            undecided += len(found) < 2
            sines += found[1:]
        middle, most, largest = float(np.median(sines)), float(np.quantile(sines, 0.9)), max(largest, max(sines))
        print(
            f"{vector.slug}: median {middle:.3g}, 90 % {most:.3g}, largest {max(sines):.3g} of {len(sines)}, {undecided} undecided",
            flush=True,
        )
    print(f"the largest of all, rounded up: {np.ceil(20 * largest) / 20:g}; LEVEL is {LEVEL:g}")


if __name__ == "__main__":
    main()
