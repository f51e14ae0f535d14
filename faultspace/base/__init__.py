"""What every room may import and what imports none: errors, how results and progress are shown, limits, threads, the law of chi-squared."""
