"""Samples that are stated to be without fault: what they tell of the noise, and what stands out of it."""
