"""Jinja's sandbox for a user's templates: text of a template, or an error with file, line and what is wrong."""

from collections.abc import Mapping
from pathlib import Path
from traceback import walk_tb

from jinja2 import FileSystemLoader, StrictUndefined, TemplateNotFound, TemplateSyntaxError
from jinja2.sandbox import ImmutableSandboxedEnvironment

from regscribe.emit.write import WriteError
from regscribe.visible import safe

MOST_TEXT = 300
"""Most characters of an error that are shown."""


class Sandbox:
    """The templates below a folder, which may include and import each other."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._environment = ImmutableSandboxedEnvironment(
            loader=FileSystemLoader(folder),
            autoescape=False,  # the author of a template knows what it writes
            trim_blocks=True,
            lstrip_blocks=True,
            keep_trailing_newline=True,
            undefined=StrictUndefined,
        )
        del self._environment.filters["random"], self._environment.globals["lipsum"]  # the same text every time

    def text(self, name: str, known: Mapping[str, object]) -> str:
        """Render the template `name` with the variables in `known`. Raises WriteError."""
        try:
            text = self._environment.get_template(name).render(known)
            text.encode()  # raises for what no file can hold
        except Exception as error:
            message = safe(f"{self._where(name, error)}: {_what(error)}")
            raise WriteError(message) from error
        return text

    def _where(self, name: str, error: Exception) -> str:
        """Return file and line of an error; the file alone if the error is at no line of a template."""
        if isinstance(error, TemplateSyntaxError):
            return f"{self._folder / (error.name or name)}:{error.lineno}"
        steps = [(Path(frame.f_code.co_filename), line) for frame, line in walk_tb(error.__traceback__)]
        lines = [f"{path}:{line}" for path, line in steps if path.is_relative_to(self._folder)]
        return lines[-1] if lines else str(self._folder / name)


def _what(error: Exception) -> str:
    if isinstance(error, TemplateNotFound):
        return f"no such template: {error.name}"
    said = error.message if isinstance(error, TemplateSyntaxError) else str(error)
    return (said or type(error).__name__)[:MOST_TEXT]
