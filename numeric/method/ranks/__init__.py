"""How many faults there are, or that the data cannot tell."""
