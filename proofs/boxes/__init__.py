"""Boxes of small cases, gone through in order: one search for the smallest counterexample, of systems, pairs, choices and records."""
