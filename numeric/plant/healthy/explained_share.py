"""This tells how much of a residual n_v signals explain, and how much of mere noise they would.

    noise_share     the largest share of noise that n_v signals can explain, from the spectra of the noise
    against         the matrix spectrum Phi(f) of a residual without fault, or, where none is known, noise that is independent from output
                    to output and has each output's own spectrum

At each frequency the signals of one F, G reach one n_v-dimensional subspace of the outputs, and of noise of spectrum Phi(f) no such
subspace holds more than the n_v largest eigenvalues of Phi(f). Summed over the frequencies this bounds what any F, G explain of noise, so
that a share below it is no sign of a fault; a share above it is more than noise of those spectra would give. Spectra are estimated over
MANY_TAPERS tapers, which makes the largest eigenvalues larger, and so the bound.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ....base.arrays import Array
from ....base.errors import InvalidData
from ....base.sheets import counted
from ...data.validation import signal
from .healthy_model import MANY_TAPERS, spectra


def noise_share(r: ArrayLike, n_v: int, units: Array, *, healthy: bool) -> float:
    """Return the share that n_v <= p signals could explain of noise, r (N, p) in `units` (p,); `healthy`: r is a residual without fault.

    Otherwise only the spectrum of each output is taken from r. Raises InvalidData for fewer than 4 MANY_TAPERS samples.
    """
    residual = signal(r, "r") / units
    if len(residual) < 4 * MANY_TAPERS:
        raise InvalidData(f"r has {counted(len(residual), 'sample')}; at least {4 * MANY_TAPERS} are needed for its spectra: record more")
    x = spectra(residual - residual.mean(axis=0), MANY_TAPERS).transforms
    alone = np.sort(np.sum(np.abs(x) ** 2, axis=1), axis=1)
    powers = np.linalg.eigvalsh(x.conj().transpose(0, 2, 1) @ x) if healthy else alone
    total = float(powers.sum())
    return float(powers[:, -n_v:].sum()) / total if total else 1.0
