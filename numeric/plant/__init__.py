"""What a plant's record needs: the chain of `identify`, samples without fault, changes, doubts, a monitor, and what is told of them."""
