"""The Python side of the theory in Rocq: it builds it, reads its theorems and hands it certificates."""
