"""This measures how the cost of an exact population limit grows with n and with s.

    python benchmarks/limits.py [--states 2,4,...] [--windows 4,8,...] [--markdown]

experiment   a random stable system with rational filters, dense entries of small numerators and denominators
measured     seconds of each step for one experiment, of its four certificates and of checking them; bits of the largest entry
main         a table over n at s = n + 2 (past the same), then one over s at n = 10; nu = 4, m = 2, p = 3

u and v have a numerator of two lags over denominators of order two and one, w of one lag. One run each, no repetition: what counts is
the growth. No peer computes these numbers; a dense rational solve of the Lyapunov equation (n^2 unknowns) is timed beside it up to
DENSE states of the joint process. "checked" is empty where the checker refuses for the work it would take.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from random import Random
from typing import Any

from flint import fmpq_mat

from faultspace.exact.algebra.matrices import Matrix
from faultspace.exact.algebra.stability import is_stable
from faultspace.exact.limits.column_space import past_input_and_output_limit, past_input_limit
from faultspace.exact.limits.experiments import Experiment, read_experiment
from faultspace.exact.limits.inputs import by_moesp, by_output_error
from faultspace.exact.limits.lyapunov import state_covariance
from faultspace.exact.limits.moesp import limit
from faultspace.exact.limits.moments import Covariances, window_covariances
from faultspace.exact.limits.process import JointProcess, joint_process
from faultspace.exact.system.windows import observability_matrix
from faultspace.proofs.trust import checker
from faultspace.proofs.trust.limit_certificates import Certified

DENSE = 30
STEPS = ("Lyapunov", "dense", "windows", "past inputs", "past outputs", "output error", "MOESP", "certified", "checked")


def experiment(*, n: int, nu: int, m: int, p: int, s: int, seed: int) -> Experiment:
    """A random experiment of these sizes, past = s."""
    random = Random(seed)

    def rows(nrows: int, ncols: int) -> list[list[str]]:
        return [[f"{random.randint(-9, 9)}/{random.randint(1, 7)}" for _ in range(ncols)] for _ in range(nrows)]

    while True:
        A = [[f"{random.randint(-9, 9)}/{3 * n}" for _ in range(n)] for _ in range(n)]
        if is_stable(Matrix.of(A, shape=(n, n))):
            break
    shapes = {"B": (n, nu), "C": (p, n), "D": (p, nu), "F": (n, m), "G": (p, m)}
    noise = nu + m
    signals = {
        "u_filter": {"num": [rows(nu, noise) for _ in range(3)], "den": ["1", "1/2", "1/5"]},
        "v_filter": {"num": [rows(m, noise) for _ in range(3)], "den": ["1", "-1/3"]},
        "w_filter": [rows(p, p) for _ in range(2)],
    }
    return read_experiment({"A": A, "s": s, "past": s} | {name: rows(*shape) for name, shape in shapes.items()} | signals)


def measured(given: Experiment) -> dict[str, Any]:
    """Seconds by step; "dense" is None beyond DENSE states."""
    seconds: dict[str, Any] = {}

    def timed(name: str, work: Callable[[], Any]) -> Any:
        start = time.perf_counter()
        result = work()
        seconds[name] = time.perf_counter() - start
        return result

    residual = given.system.residual
    process = joint_process(given)
    P = timed("Lyapunov", lambda: state_covariance(process))
    seconds["dense"] = None
    if process.Phi.nrows <= DENSE and timed("dense", lambda: _dense(process)) != P.flint:
        raise ArithmeticError("the dense solve and the structured one differ")
    known = Covariances(process, P)
    blocks = timed("windows", lambda: window_covariances(given, known))
    timed("past inputs", lambda: past_input_limit(given, blocks))
    timed("past outputs", lambda: past_input_and_output_limit(given, blocks))
    timed("output error", lambda: by_output_error(known, residual.A, residual.C))
    timed("MOESP", lambda: by_moesp(blocks, observability_matrix(residual, given.s), residual.p))
    total = sum(value for name, value in seconds.items() if name != "dense")
    limits = limit(given)
    makers = (Certified.past_input_limit, Certified.past_input_and_output_limit, Certified.output_error_inputs, Certified.moesp_inputs)
    certificates = timed("certified", lambda: [maker(Certified(limits)) for maker in makers])
    try:
        timed("checked", lambda: [checker.verify(certificate) for certificate in certificates])
    except checker.Rejected:  # for work, where the checker's own bound is reached
        seconds["checked"] = None
    bits = max(max(abs(x.p), x.q).bit_length() for x in P.flint.entries())
    return {"states": process.Phi.nrows, "bits": bits, "total": total} | seconds


def _dense(process: JointProcess) -> Any:
    """Solve for vec P in the Kronecker system of as many unknowns as P has entries."""
    Phi, size = process.Phi.elements(), process.Phi.nrows
    drive = (process.Gamma @ process.Gamma.transposed()).flint.entries()
    table = []
    for i in range(size):
        for j in range(size):
            row = [-x * y for x in Phi[i] for y in Phi[j]]
            row[i * size + j] += 1
            table.extend(row)
    solved = fmpq_mat(size * size, size * size, table).solve(fmpq_mat(size * size, 1, drive), "dixon")
    return fmpq_mat(size, size, solved.entries())


def main() -> None:
    """This prints both tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--states", default="2,4,6,8,10,12")
    parser.add_argument("--windows", default="6,8,12,16")
    parser.add_argument("--markdown", action="store_true")
    chosen = parser.parse_args()
    sizes = [(int(n), int(n) + 2) for n in chosen.states.split(",")] + [(10, int(s)) for s in chosen.windows.split(",")]
    separator, edge = (" | ", "| ") if chosen.markdown else ("  ", "")
    heads = ["n", "s", "states", "bits", "total", *STEPS]
    print(edge + separator.join(head.rjust(6) for head in heads) + edge[::-1])
    if chosen.markdown:
        print("|" + "---|" * len(heads))
    for n, s in sizes:
        row = measured(experiment(n=n, nu=4, m=2, p=3, s=s, seed=1))
        cells = [str(n), str(s), str(row["states"]), str(row["bits"])]
        cells += ["-" if row[name] is None else f"{row[name]:.2g}" for name in ("total", *STEPS)]
        widths = [max(6, len(head)) for head in heads]
        print(edge + separator.join(cell.rjust(width) for cell, width in zip(cells, widths, strict=True)) + edge[::-1], flush=True)


if __name__ == "__main__":
    main()
