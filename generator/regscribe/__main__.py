"""`python -m regscribe`: the same as the command `regscribe`."""

from regscribe.cli import main

if __name__ == "__main__":
    main()
