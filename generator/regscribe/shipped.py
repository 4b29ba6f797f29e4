"""The maps that come with regscribe."""

from pathlib import Path

import regscribe


def shipped() -> Path:
    """Return the folder of the maps that come with regscribe: in the wheel, else those of the source checkout."""
    package = Path(regscribe.__file__).parent
    wheel = package / "data" / "maps"
    return wheel if wheel.is_dir() else package.parents[1] / "maps"
