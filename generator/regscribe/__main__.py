"""`python -m regscribe`: the same as the command `regscribe`."""

import sys

from regscribe.cli import main

if __name__ == "__main__":
    sys.exit(main())
