"""The certificates, the checker that alone decides them, and what makes them."""

from . import checker_limits as checker_limits  # adds its kinds to those of checker.py
