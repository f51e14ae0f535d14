"""The certificates, the checker that alone decides them, and what makes them."""

from . import checker_limits as checker_limits  # with it all files of the checker, each of which adds its kinds to those of checker.py
