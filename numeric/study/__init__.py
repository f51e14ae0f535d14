"""The example and the Monte Carlo study of the paper."""
