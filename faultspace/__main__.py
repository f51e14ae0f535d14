"""`python -m faultspace`: the same as the command `faultspace`."""

import sys

from faultspace.cli.command_line import main

if __name__ == "__main__":
    sys.exit(main())
