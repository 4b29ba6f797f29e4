"""The command line: the only place that prints. Nothing but click is imported before a command is chosen."""

from regscribe.cli.app import main

__all__ = ["main"]
