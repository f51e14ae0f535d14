"""The truth: exact arithmetic over Q, a number field Q(a) and a prime field.

This room answers questions about one system or two. It knows nothing of claims, verdicts or files: it reads and
writes JSON-ready dicts, and opening files is the caller's. A float enters only where a name says so. It imports
neither of the other rooms.
"""

if __name__ == "exact":
    raise ImportError("plain 'exact' is the name of another package: write 'import faultspace.exact'")
