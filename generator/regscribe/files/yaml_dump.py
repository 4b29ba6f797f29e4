"""Writing YAML that people read and compare line by line, and that a YAML 1.2 reader takes for what it was."""

from collections.abc import Mapping, Sequence
from typing import Any

import yaml

from regscribe import source
from regscribe.visible import INVISIBLE


class OneLine(dict[str, Any]):
    """A mapping that stands on one line."""


class _Dumper(yaml.SafeDumper):
    """No anchors: equal values stay readable."""

    def ignore_aliases(self, data: object) -> bool:  # noqa: ARG002 (pyyaml's signature)
        """Whether a value is written out although it was written before."""
        return True

    def increase_indent(self, flow: bool = False, indentless: bool = False) -> None:  # noqa: ARG002, FBT001, FBT002 (as above)
        """Put the items of a list to the right of their key."""
        super().increase_indent(flow, indentless=False)


def _one_line(dumper: yaml.SafeDumper, data: OneLine) -> yaml.Node:
    return dumper.represent_mapping("tag:yaml.org,2002:map", data.items(), flow_style=True)


def _text(dumper: yaml.SafeDumper, data: str) -> yaml.Node:
    visible = INVISIBLE.search(data) is None
    return dumper.represent_scalar("tag:yaml.org,2002:str", data, style=None if visible and _plain(data) else '"')


def _plain(data: str) -> bool:
    """Whether a text without quotes is a text by YAML 1.2, too (pyyaml quotes what is none by 1.1)."""
    try:
        return isinstance(source.resolve(data), str)
    except source.NumberFormError:
        return False


_Dumper.add_representer(OneLine, _one_line)
_Dumper.add_representer(str, _text)


def dump(data: Mapping[str, Any], *, remarks: Sequence[str] = ()) -> str:
    """A mapping as YAML in the order of its keys; `remarks` become comments above it."""
    body: str = yaml.dump(dict(data), Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=1 << 20)
    return "".join(f"# {remark}\n" for remark in remarks) + body
