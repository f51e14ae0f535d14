"""What a verdict rests on besides theorems: families of systems and experiments, searches, and the attacks on a statement."""
