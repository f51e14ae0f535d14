"""PO-MOESP, with past outputs beside past inputs as instruments: kept for comparison with packaged subspace tools.

The factor of [Uf; Up; Yp; Yf] by sequential QR; singular values of Yf along [Up; Yp] with Uf projected out, not scaled, as SLICOT's
IB01AD prints them. Under a coloured additive disturbance or fault it can stay biased at the true order, where past inputs alone do
not for a white input [VV07, ch. 9]; with white measurement noise its estimates vary less.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ....base.threads import one_thread
from ...data.validation import enough_samples, experiment, pieces, two_dimensional
from .compression import EPS, Compression, scaled_condition, window_rows, windows
from .moesp_model import MoespModel
from .past_inputs import check_compression, complete, system_range
from .sequential_qr import SequentialQR


@one_thread()
def po_moesp(y: ArrayLike, u: ArrayLike, *, order: int | None = None, block_rows: int, past_rows: int | None = None) -> MoespModel:
    """Identify the model of one experiment by past inputs and outputs, PO-MOESP [VV07].

    The model can be biased where a fault or a disturbance is coloured, whatever the number of samples (chapter 9 has the method).

    Parameters
    ----------
    y, u : array_like, (N, p) and (N, n_u)
        In any units, not modified.
    order, block_rows, past_rows
        As of `pi_moesp`, with p block_rows > order.

    Returns
    -------
    MoespModel
        A, B, C, D, with singular values of the unscaled factor.

    Raises
    ------
    InvalidData
        As `pi_moesp`.

    Examples
    --------
    >>> import numpy as np
    >>> from faultspace.numeric import po_moesp
    >>> u = np.random.default_rng(1).standard_normal((300, 1))
    >>> y = np.zeros((300, 1))
    >>> for k in range(299):
    ...     y[k + 1] = 0.5 * y[k] + u[k]
    >>> po_moesp(y, u, order=1, block_rows=5).A.round(6).tolist()
    [[0.5]]
    """
    future, past = windows(block_rows, past_rows)
    outputs, inputs = two_dimensional(y, "y"), two_dimensional(u, "u")
    samples, p, n_u = len(outputs), outputs.shape[1], inputs.shape[1]
    enough_samples(samples, past + future, f"a window of past_rows + block_rows = {past} + {future} samples", outputs.shape)
    plain = window_rows(n_u, p, past, future)
    split = (past + future) * n_u
    past_outputs = np.array([(lag, n_u + channel) for lag in range(past) for channel in range(p)], dtype=np.intp)
    running = SequentialQR(np.concatenate([plain[:split], past_outputs, plain[split:]]), n_u + p)
    for y_piece, u_piece in pieces(outputs, inputs):
        running.append(np.concatenate([u_piece, y_piece], axis=1))
    factor = running.factor()
    # Past outputs are instruments only: without them stands the compression that the other checks and regressions read.
    lower = factor.T
    last = split + past * p
    projected = lower[last:, future * n_u : last]
    rest = np.linalg.qr(factor[split:, last:], mode="r")
    without = np.zeros((split + future * p,) * 2)
    without[:split, :split], without[:split, split:] = factor[:split, :split], factor[:split, last:]
    without[split:, split:] = rest
    compression = Compression(future, past, p, n_u, samples, running.columns, without, "qr", scaled_condition(without[:split, :split]), EPS)
    check_compression(compression)
    floor = 10 * EPS * float(np.linalg.norm(lower[last:])) * np.sqrt(float(future * p))
    found = system_range(projected, np.ones(p), floor, order, past * (n_u + p))
    return complete(found, compression, [experiment(outputs, inputs)])
