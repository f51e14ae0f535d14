"""How far rounding may carry the answers."""
