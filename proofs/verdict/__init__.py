"""From evidence to verdict: the ledger of claims, the run that certifies, what each hypothesis is needed for, and the report."""
