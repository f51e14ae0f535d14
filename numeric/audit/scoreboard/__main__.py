"""`python -m faultspace.numeric.audit.scoreboard`: audits what is installed and writes the scoreboard and its pages."""

from .boards import main

if __name__ == "__main__":
    raise SystemExit(main())
