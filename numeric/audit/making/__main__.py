"""`python -m faultspace.numeric.audit.making`: makes the vectors of the audit anew."""

from .all_vectors import main

if __name__ == "__main__":
    raise SystemExit(main())
