"""The language of claims: expressions over the quantities of a system, read against a closed list and decided exactly."""
