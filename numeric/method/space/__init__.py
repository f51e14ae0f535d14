"""The fault space from a residual, how sure it is, and distances between subspaces."""
