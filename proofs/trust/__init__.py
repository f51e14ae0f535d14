"""The certificates, the checker that alone decides them, and what makes them."""
