"""The arithmetic under everything exact: fields, matrices and polynomials over them, stability, and how they are written."""
