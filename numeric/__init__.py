"""The room for the reference method in floats: data in; system matrices, fault dimension, fault space and signal out.

It is empty: the float reference implementation is not part of this release. When it comes it will import numpy and
scipy and never `faultspace.exact`, so that the exact results can judge it.
"""

if __name__ == "numeric":
    raise ImportError("this folder is no package of its own: write 'import faultspace.numeric'")
