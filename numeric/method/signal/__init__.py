"""The fault signal for a chosen pair of fault matrices, and what limits it."""
