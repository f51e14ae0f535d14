"""What no unbiased estimate can do better: Cramer-Rao bounds for the model and for the fault space."""
