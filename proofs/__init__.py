"""Claims, verdicts and certificates: what the paper states, what is true of it, and what proves it.

A verdict is computed by a run, never stored by hand. The certificates are decided by `checker.py`, which imports
nothing but Python's standard library; their format is `FORMAT.md` beside this file. Everything else here may import
`faultspace.exact`, and modules with `cross` in their name `faultspace.numeric`.
"""

if __name__ == "proofs":
    raise ImportError("this folder is no package of its own: write 'import faultspace.proofs'")
