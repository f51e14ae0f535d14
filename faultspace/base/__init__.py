"""What every room may import and what imports none: errors and how they are told."""
