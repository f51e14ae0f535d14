"""What a plant's record gives reason to doubt: each reason with its evidence, what it does to the answer, and what to do."""
