"""The page put together: template, style, data and scripts in one HTML file that asks nothing of anybody."""

import hashlib
from base64 import b64encode
from collections.abc import Sequence
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
    "limits",
    "decode",
    "encode",
    "computed",
    "needs",
    "data",
)
"""The scripts of the arithmetic, which know no page; each uses what those before it define."""

POLICY = (
    "default-src 'none'; script-src '{script}'; style-src '{style}'; img-src data:; connect-src 'none'; "
    "base-uri 'none'; form-action 'none'"
)


def page(maps: Sequence[RegisterMap]) -> str:
    """Return the register browser of one or several maps as one HTML file."""
    style, script = asset("style.css"), scripts()
    return Template(asset("page.html")).substitute(
        title=escape(safe(one_line(" · ".join(one.title for one in maps)))),
        policy=escape(POLICY.format(script=digest(script), style=digest(style))),
        style=style,
        data=embedded(json_text(document(maps))),
        script=script,
    )


def scripts() -> str:
    """Return all scripts as one, which leaves nothing but `regscribe`, the functions of the codec, behind."""
    ui = sorted(one.name for one in _assets().joinpath("ui").iterdir() if one.name.endswith(".js"))
    parts = [codec(), *(asset(f"ui/{name}") for name in ui)]
    return "(() => {\n'use strict'\n" + "\n".join(parts) + "\n})()\n"


def codec() -> str:
    """Return the scripts of the arithmetic alone."""
    return "\n".join(asset(f"codec/{name}.js") for name in CODEC)


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
