"""The checks of the claims: one function a check, from a Workbench to an Outcome, in a file named as the claim with underscores."""
