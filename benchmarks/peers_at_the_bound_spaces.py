"""This measures the fault space end to end, from the data alone, over its Cramer-Rao bound: our way beside the paper's and the author's.

    WAYS       name -> from a record and a window to the basis of a fault space and the A, C that it belongs to
    author     the same by the author's program
    measured   the results of all ways on the records of a cell: over the bound, and in percent of the largest distance

Records are of the paper's study, with 0 to 3 zeros in turn. The paper's way and the author's are told the number of faults, the rank of R_s
and the dimension of the space, as in the published study, s one more than the order; `fault_space` and ours are told the number of faults
only. A basis is laid onto the true states by the observability matrices. The error is the two-sided distance, dimensions included; its
bound is the median distance of an estimate whose errors have the least covariance.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from benchmarks.at_the_bound_cells import Array, Cell, Trial
from benchmarks.peers_at_the_bound_results import INFINITE, CellResults, Result
from benchmarks.peers_at_the_bound_tools import OURS, PAPER
from faultspace.base.errors import InvalidData
from faultspace.numeric import FaultSpectra, arx_reduction, fault_space, fault_space_bound, fault_space_by_rows, pi_moesp, residual
from faultspace.numeric.audit import peers
from faultspace.numeric.audit.records import Broken, Refused
from faultspace.numeric.audit.subjects.subprocess_adapter import Exec
from faultspace.numeric.method.model.models import StateSpaceModel, observability_matrix
from faultspace.numeric.method.space.distances import two_sided_error
from faultspace.numeric.method.space.estimate import orthonormal
from faultspace.numeric.study.toeplitz_factorisation import toeplitz_factorisation

Found = tuple[Array, Array, Array]
Way = Callable[[Trial, int], Found]
LIKELIHOOD = "PI-MOESP, fault_space"


def _ours(trial: Trial, block_rows: int) -> Found:
    model = arx_reduction(trial.y, trial.u, order=trial.model.n).model
    return fault_space_by_rows(trial.y, trial.u, model.A, model.C, n_v=_n_v(trial)).basis, model.A, model.C


def _paper(trial: Trial, block_rows: int) -> Found:
    model, r = _identified(trial, block_rows)
    window, rank, n_z = _told(trial)
    return toeplitz_factorisation(r, model.A, model.C, block_rows=window, rank=rank, n_z=n_z), model.A, model.C


def _likelihood(trial: Trial, block_rows: int) -> Found:
    model, r = _identified(trial, block_rows)
    return fault_space(r, model.A, model.C, n_v=_n_v(trial)).basis, model.A, model.C


WAYS: dict[str, Way] = {OURS: _ours, PAPER: _paper, LIKELIHOOD: _likelihood}


def _identified(trial: Trial, block_rows: int) -> tuple[StateSpaceModel, Array]:
    model = pi_moesp(trial.y, trial.u, order=trial.model.n, block_rows=block_rows).model
    return model, residual(trial.y, trial.u, model).r


def _n_v(trial: Trial) -> int:
    assert trial.faults is not None
    return int(trial.faults.F.shape[1])


def _told(trial: Trial) -> tuple[int, int, int]:
    """Return the window, the rank of R_s and the dimension of the fault space."""
    assert trial.faults is not None
    n_z, n_v, window = trial.faults.Z.shape[1], _n_v(trial), trial.model.n + 1
    return window, trial.model.n + window * n_v - (n_z - n_v), n_z


# The author's functions; fault_space is told the rank in place of block_rows and n_z in place of n_v.
AUTHORS = """1;
source ("%s");
addpath (getenv ("%s"));
function [Q, R] = qr (X, varargin), [Q, R] = builtin ("qr", X, 0); end
function [U, S, V] = svds (M, k, varargin), [U, S, V] = svd (M); V = V(:, end-k+1:end); end
function a = identify (q), [a.A, a.B, a.C, a.D] = pi_moesp (q.u, q.y, q.block_rows, q.order); end
function a = fault_space (q)
  s = rows (q.A) + 1; [U, ~, ~] = svd (blkhankel (q.r, s), "econ");
  a.basis = estimate_input_matrices (U(:, 1:q.block_rows), extended_obs (q.A, q.C, s), rows (q.C), q.n_v);
end
answer_questions (struct ("identify", @identify, "fault_space", @fault_space));
"""


def author_command() -> list[str]:
    """Return the program that answers for the author."""
    return [*peers.OCTAVE, "--eval", AUTHORS % (peers.HERE / "json_lines.m", peers.FAULT_ID)]


def author(program: Exec) -> Way:
    """Return the author's way, by the program that `author_command` starts; only the initial state of the residual is fitted by ours."""

    def way(trial: Trial, block_rows: int) -> Found:
        n, p, n_u = trial.model.n, trial.model.p, trial.model.n_u
        found = program.identify(trial.y, trial.u, n, block_rows)  # type: ignore[attr-defined]
        A, B, C, D = (np.reshape(part, shape) for part, shape in zip(found, ((n, n), (n, n_u), (p, n), (p, n_u)), strict=True))
        _, rank, n_z = _told(trial)
        r = residual(trial.y, trial.u, StateSpaceModel(A, B, C, D)).r
        basis = program.fault_space(r, A, C, n_z, rank)  # type: ignore[attr-defined]
        return np.reshape(basis, (n + p, -1)), A, C

    return way


def distance(trial: Trial, found: Found) -> float:
    """Return the two-sided distance from the true fault space, from 0 to 1."""
    assert trial.faults is not None
    basis, A, C = found
    n = trial.model.n
    true, other = (observability_matrix(*pair, 2 * n) for pair in ((trial.model.A, trial.model.C), (A, C)))
    to_true = np.linalg.lstsq(true, other, rcond=None)[0]
    return two_sided_error(trial.faults.Z, orthonormal(np.vstack([to_true @ basis[:n], basis[n:]])))


def bound(trial: Trial) -> float:
    """Return the median distance of an estimate at the bound."""
    assert trial.faults is not None
    faults = trial.faults
    spectra = FaultSpectra(trial.spectra.input, faults.spectrum, faults.noise)
    return fault_space_bound(trial.model, faults.F, faults.G, spectra, len(trial.y)).distance(0.5)


def measured(
    ways: Mapping[str, Way], cell: Cell, samples: int, seed: int, systems: int, windows: Sequence[int]
) -> tuple[CellResults, CellResults]:
    """Return the results over the bound, and those in percent."""
    trials = [cell.trial(seed, number, samples) for number in range(systems)]
    bounds = [bound(trial) for trial in trials]
    over, percent = [], []
    for name, way in ways.items():
        for block_rows in (None,) if name == OURS else windows:
            errors, failures = [], Counter[str]()
            for trial in trials:
                try:
                    errors.append(distance(trial, way(trial, block_rows or 0)))
                except (Broken, Refused, InvalidData, np.linalg.LinAlgError) as why:
                    errors.append(INFINITE)
                    failures[" ".join(str(why).split())[:100]] += 1
            ratios = tuple(error / least for error, least in zip(errors, bounds, strict=True))
            over.append(Result(name, block_rows, ratios, dict(failures)))
            percent.append(Result(name, block_rows, tuple(100 * error for error in errors), dict(failures)))
    return CellResults(cell.name, samples, tuple(over)), CellResults(cell.name, samples, tuple(percent))
