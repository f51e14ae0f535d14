"""These are the arrays of floats that the room numeric works on.

Array       any numpy array of float64, whatever its shape; signals are time-major, one row a sample
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
