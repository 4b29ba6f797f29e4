"""Installs Chromium for `make test-browser` where it is missing: as root with apt-get; else it says what to install.

python tests/system/browser/install.py
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "interop"))  # its installer is a program of its own, in no package

from install import Consumer, install

if __name__ == "__main__":
    install((Consumer("chromium", programs={"chromium": "chromium"}),))
