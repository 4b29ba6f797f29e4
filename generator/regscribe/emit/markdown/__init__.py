"""Reference docs in Markdown: a map in, `{path: text}` out; no clock, no environment, no order of sets."""

from functools import cache

from jinja2 import Environment, PackageLoader, StrictUndefined

from regscribe.emit.markdown.escape import Md, escape
from regscribe.emit.markdown.page_builder import index_row, page
from regscribe.model import RegisterMap

__all__ = ["index_row", "render"]


def render(register_map: RegisterMap) -> dict[str, str]:
    """Return the reference of a map: CommonMark with tables, at `docs/<maker>/<family>.md`."""
    text = _environment().get_template("page.md.j2").render(page=page(register_map))
    return {f"docs/{register_map.id}.md": text}


@cache
def _environment() -> Environment:
    """Return an environment that escapes every value for Markdown unless it is a `Md`."""
    return Environment(
        loader=PackageLoader("regscribe.emit.markdown", "templates"),
        autoescape=False,  # noqa: S701 (the output is Markdown: `finalize` escapes for it, HTML included)
        finalize=_ready,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        undefined=StrictUndefined,
        auto_reload=False,
    )


def _ready(value: object) -> object:
    return escape(value) if isinstance(value, str) and not isinstance(value, Md) else value
