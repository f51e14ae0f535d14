"""The laws that outputs and inputs obey together whatever the faults: what they say of the number of faults and of the fault space."""
