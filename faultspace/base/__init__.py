"""What every room may import and what imports none: errors and their words, what a person reads of a record, programs under limits."""
