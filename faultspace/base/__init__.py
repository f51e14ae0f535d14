"""What every room may import and what imports none: errors, how results and progress are shown, programs under limits, threads, chi-squared."""
