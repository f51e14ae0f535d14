"""Which pairs (F, G) = (Fhat P, Ghat P) out of the fault space do: the good, the bad, and those with wanted zeros."""
