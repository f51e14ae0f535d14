"""What every room may import and what imports none: errors, how results are shown (sheets.py), programs under limits, threads of BLAS."""
