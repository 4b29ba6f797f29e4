"""The page put together: template, style, data and scripts in one HTML file that asks nothing of anybody."""

import hashlib
from base64 import b64encode
from collections.abc import Iterable, Iterator, Sequence
from html import escape
from importlib.resources import files
from importlib.resources.abc import Traversable
from string import Template

from regscribe.emit.words import one_line
from regscribe.model import RegisterMap
from regscribe.register_browser.data import document
from regscribe.visible import json_text, safe

CODEC = (
    "rational",
    "ieee",
    "wire_types",
    "conditions",
    "terms",
    "words",
    "octets",
    "texts",
    "moments",
    "limits",
    "decode",
    "encode",
    "describe",
    "computed",
    "needs",
    "requests",
    "data",
    "public",
)
"""The scripts of the arithmetic, which know no page; each uses what those before it define."""

POLICY = (
    "default-src 'none'; script-src '{script}'; style-src '{style}'; img-src data:; connect-src 'none'; "
    "base-uri 'none'; form-action 'none'"
)


def page(maps: Sequence[RegisterMap]) -> str:
    """Return the register browser of one or several maps as one HTML file."""
    style, script = asset("style.css"), scripts()
    heading = one_line(maps[0].title) if len(maps) == 1 else f"Registers of {len(maps)} maps"
    return Template(asset("page.html")).substitute(
        title=escape(safe(f"{heading}: registers" if len(maps) == 1 else heading)),
        heading=escape(safe(heading)),
        policy=escape(POLICY.format(script=digest(script), style=digest(style))),
        style=style,
        data=embedded(json_text(document(maps), compact=True)),
        script=script,
    )


def scripts() -> str:
    """Return all scripts as one, which leaves nothing but `regscribe`, the functions of the codec, behind."""
    return _alone((*_codec(), _alone(_ui())))  # names of the page hide none of the arithmetic


def codec() -> str:
    """Return the scripts of the arithmetic alone, as `scripts` does."""
    return _alone(_codec())


def _codec() -> Iterator[str]:
    return (asset(f"codec/{name}.js") for name in CODEC)


def _ui() -> Iterator[str]:
    names = sorted(one.name for one in _assets().joinpath("ui").iterdir())
    return (asset(f"ui/{name}") for name in names if name.endswith(".js"))


def _alone(parts: Iterable[str]) -> str:
    return ";(() => {\n'use strict'\n" + "\n".join(parts) + "\n})()\n"


def asset(name: str) -> str:
    """Return the text of a file beside this one."""
    return _assets().joinpath(name).read_text("utf-8")


def digest(text: str) -> str:
    """Return what a policy calls an element of exactly this text."""
    return f"sha256-{b64encode(hashlib.sha256(text.encode()).digest()).decode()}"


def embedded(json: str) -> str:
    """Return JSON that ends no element of HTML and begins none, nor a line."""
    return json.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def _assets() -> Traversable:
    return files("regscribe.register_browser").joinpath("assets")
