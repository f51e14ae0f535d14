"""What a verdict rests on besides theorems: families of systems and experiments, and the attacks on a statement."""
