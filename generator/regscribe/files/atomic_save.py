"""Files that are whole or not there: written beside their place, flushed to the disk, then moved into it."""

import os
import tempfile
from contextlib import suppress
from pathlib import Path

from regscribe.files.yaml_load import FileError


def save(path: Path, text: str) -> None:
    """Write a file; where that fails (a full disk) FileError, and a file that was there before is as it was."""
    temporary = ""
    try:
        descriptor, temporary = tempfile.mkstemp(prefix=f".{path.name[:100]}.", dir=path.parent)
        with os.fdopen(descriptor, "w", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
            os.fchmod(file.fileno(), _mode(path))
        Path(temporary).replace(path)
    except OSError as error:
        with suppress(OSError):
            Path(temporary).unlink()
        message = f"{path} cannot be written ({error.strerror or error}); nothing of it was changed"
        raise FileError(message) from None


def _mode(path: Path) -> int:
    """Of the file that is replaced, else what the user's mask leaves of 666."""
    with suppress(OSError):
        return path.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
