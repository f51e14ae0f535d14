"""Exact systems with faults, the matrices of their windows, and their images modulo a prime."""
