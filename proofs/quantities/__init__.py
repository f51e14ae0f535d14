"""The numbers, lists and words that a claim about a system can speak of, each exact, and each found for many small systems at once."""
