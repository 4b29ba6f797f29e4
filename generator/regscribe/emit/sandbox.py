"""Jinja's sandbox for a user's templates: text of a template, or an error with file, line and what is wrong."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from types import TracebackType

from jinja2 import FileSystemLoader, StrictUndefined, TemplateNotFound, TemplateSyntaxError
from jinja2.sandbox import ImmutableSandboxedEnvironment

from regscribe.emit.write import WriteError
from regscribe.visible import safe

MOST_TEXT = 300
"""Most characters that are shown of what an expression in a template says."""


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
        """Render the template `name` with what is known to it. Raises WriteError."""
        try:
            text = self._environment.get_template(name).render(known)
            text.encode()  # raises for what no file can hold
        except Exception as error:
            message = safe(f"{self._where(name, error)}: {_what(error)}")
            raise WriteError(message) from error
        return text

    def _where(self, name: str, error: Exception) -> str:
        """File and line of an error; the file alone where no line is to blame."""
        if isinstance(error, TemplateSyntaxError):
            return f"{self._folder / (error.name or name)}:{error.lineno}"
        lines = [(path, line) for path, line in _lines(error.__traceback__) if path.is_relative_to(self._folder)]
        return f"{lines[-1][0]}:{lines[-1][1]}" if lines else str(self._folder / name)


def _lines(traceback: TracebackType | None) -> Iterator[tuple[Path, int]]:
    while traceback is not None:
        yield Path(traceback.tb_frame.f_code.co_filename), traceback.tb_lineno
        traceback = traceback.tb_next


def _what(error: Exception) -> str:
    if isinstance(error, TemplateNotFound):
        return f"no such template: {error.name}"
    said = error.message if isinstance(error, TemplateSyntaxError) else str(error)
    return (said or type(error).__name__)[:MOST_TEXT]
