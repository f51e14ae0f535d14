"""A claim that anyone brings: its file, the search for its smallest counterexample, its verdict."""
