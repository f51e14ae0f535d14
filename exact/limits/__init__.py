"""What subspace identification converges to when the record grows without end, as exact numbers."""
