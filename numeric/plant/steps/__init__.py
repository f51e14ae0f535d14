"""The steps of `identify`: operating point, model, onset, number of faults, fault space, causes and signal."""
