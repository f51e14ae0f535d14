"""Measured data: records in memory and in files, and the checks of what comes in."""
