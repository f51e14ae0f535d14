"""The front door; the rooms behind it are `faultspace.exact`, `faultspace.numeric` and `faultspace.proofs`.

__version__     the one place where the version is written; the build reads it from here
"""

__version__ = "0.1.0"
