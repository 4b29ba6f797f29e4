"""The configuration of Zensical: JSON, which is YAML, in the file that MkDocs and Zensical both read."""

import json
from collections.abc import Sequence

FEATURES = (
    "content.code.copy",
    "navigation.footer",
    "navigation.indexes",
    "navigation.path",
    "navigation.sections",
    "navigation.top",
    "navigation.tracking",
    "search.highlight",
)

PALETTE: tuple[tuple[str, dict[str, str], str, str], ...] = (
    ("(prefers-color-scheme)", {}, "lucide/sun-moon", "Switch to light mode"),
    ("(prefers-color-scheme: light)", {"scheme": "default"}, "lucide/sun", "Switch to dark mode"),
    ("(prefers-color-scheme: dark)", {"scheme": "slate"}, "lucide/moon", "Switch to the system's mode"),
)

EXTENSIONS: dict[str, object] = {
    "attr_list": {},
    "md_in_html": {},
    "tables": {},
    "toc": {"permalink": True},
    "pymdownx.highlight": {"pygments_lang_class": True},
    "pymdownx.superfences": {},
}
"""What our pages use, and nothing else: each would read something in the text of a map as mark-up."""

API = {
    "handlers": {
        "python": {
            "options": {
                "docstring_style": "sphinx",
                "heading_level": 2,
                "members_order": "source",
                "separate_signature": True,
                "show_bases": True,
                "show_root_full_path": False,
                "show_root_heading": True,
                "show_signature_annotations": True,
                "show_source": False,
                "show_symbol_type_heading": True,
                "signature_crossrefs": True,
            }
        }
    }
}


def configuration(title: str, nav: Sequence[object], *, url: str, repository: str, api: bool) -> str:
    """Return the text of `mkdocs.yml`: no font and nothing else is asked of another host."""
    palette = [
        {"media": media, **scheme, "toggle": {"icon": icon, "name": name}} for media, scheme, icon, name in PALETTE
    ]
    found: dict[str, object] = {
        "site_name": title,
        "site_url": url,
        "docs_dir": "pages",
        "site_dir": "site",
        "nav": nav,
        "theme": {"language": "en", "font": False, "features": FEATURES, "palette": palette},
        "extra_css": ["assets/regscribe.css"],
        "extra_javascript": ["assets/regscribe.js"],
        "extra": {"generator": False},
        "markdown_extensions": EXTENSIONS,
        "plugins": {"search": {}} | ({"mkdocstrings": API} if api else {}),
    }
    if repository:
        found["extra"] = {"generator": False, "social": [{"icon": "lucide/git-branch", "link": repository}]}
    return json.dumps(found, ensure_ascii=False, indent=1)
