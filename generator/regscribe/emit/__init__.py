"""From a map to texts: pure emitters `render(map) -> {path: text}`, and the one step that writes."""

from importlib import import_module
from typing import Protocol, cast

from regscribe.model import RegisterMap

EMITTERS = {
    "python": "regscribe.emit.python",
    "markdown": "regscribe.emit.markdown",
    "pictures": "regscribe.pictures",
    "vectors": "regscribe.emit.vectors",
}
"""What `regscribe generate` writes, and the package of each emitter, imported when first needed."""


class Emitter(Protocol):
    """What a module (or package) of EMITTERS offers."""

    def render(self, register_map: RegisterMap) -> dict[str, str]:
        """Return text by path, relative to the output directory, with `/` between its parts."""
        ...


def load_emitters() -> dict[str, Emitter]:
    """Import what renders maps, by name."""
    return {name: cast("Emitter", import_module(package)) for name, package in EMITTERS.items()}


def render(register_map: RegisterMap) -> dict[str, str]:
    """Return all files of a map by path, relative to the output directory. ValueError if two emitters share a path."""
    files: dict[str, str] = {}
    for name, emitter in load_emitters().items():
        rendered = emitter.render(register_map)
        if shared := files.keys() & rendered.keys():
            message = f"the emitter {name} renders {', '.join(sorted(shared))}, as another emitter does"
            raise ValueError(message)
        files |= rendered
    return files
