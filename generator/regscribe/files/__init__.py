"""Files that people write besides maps: backups, programs, configurations, states of simulated devices.

`read` checks one against its JSON Schema, `dump` makes YAML that reads back as it was, `save` writes whole or not at
all. Every mistake is a FileError with its place.
"""

from regscribe.files.atomic_save import save
from regscribe.files.yaml_dump import OneLine, dump
from regscribe.files.yaml_load import FileError, parse, read

__all__ = ["FileError", "OneLine", "dump", "parse", "read", "save"]
