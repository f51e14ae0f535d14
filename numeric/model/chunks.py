"""PI-MOESP [V93] on a record that is read in pieces, more than once: nothing of the size of the record is held.

pi_moesp_from_chunks    from a compression and the pieces that it was made of

One pass makes the compression (two where the Gram's rounding asks for the QR: `compress_chunks`), one the output-error regression for B, D
and x0, one the residual's covariance.
"""

from collections.abc import Iterable, Iterator

from numpy.typing import ArrayLike

from faultspace.base.errors import InvalidData
from faultspace.numeric.data.validation import FloatArray, checked_piece
from faultspace.numeric.model.compression import Compression
from faultspace.numeric.model.past_inputs import Identification, _range_of, complete


def pi_moesp_from_chunks(
    compression: Compression, chunks: Iterable[tuple[ArrayLike, ArrayLike]], *, order: int | None = None
) -> Identification:
    """The model of one experiment from its compression and its consecutive pieces y (any, p), u (any, n_u), as `pi_moesp` gives it.

    `chunks` must give the pieces anew at each `iter`: it is read twice. InvalidData as `pi_moesp`, and for an iterator, which can be
    read only once.
    """
    if isinstance(chunks, Iterator):
        raise InvalidData("chunks can be read only once: pass a list, or an object whose `iter` begins anew, or use the compression alone")

    def checked() -> Iterator[tuple[FloatArray, FloatArray]]:
        first = 0
        for y, u in chunks:
            piece = checked_piece(y, u, first)
            first += len(piece[0])
            yield piece

    return complete(_range_of(compression, order), compression, lambda: [checked()])
