"""Make what docs/ has from the ledger anew, or the pages that are not in the tree.

python docs/make.py             the tables of the pages and the picture of the README, which tests compare with the ledger
python docs/make.py FOLDER      the pages of tools/pages.py, into the folder
"""

import sys
from pathlib import Path

from tools.pages import write
from tools.tables import fill

if __name__ == "__main__":
    arguments = sys.argv[1:]
    if len(arguments) > 1 or any(one.startswith("-") for one in arguments):
        sys.exit(__doc__)
    if arguments:
        write(Path(arguments[0]))
    else:
        fill()
