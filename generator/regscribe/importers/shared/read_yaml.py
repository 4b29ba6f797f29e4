"""YAML of other programs as a tree: tags, aliases and merge keys are taken, nothing is executed or included."""

from typing import Any

import yaml

from regscribe.importers.shared.tree import Builder, Node, TreeError
from regscribe.source.unclosed import find_unclosed

Loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
"""The parser of libyaml where it is there; only its events are used."""

PLAIN_TAGS = "tag:yaml.org,2002:"


def read_yaml(text: str) -> tuple[Node, list[tuple[int, str]]]:
    """Return the first document, and keys that stand twice with their lines. Raises TreeError."""
    builder = Builder()
    anchors: dict[str, Node] = {}
    names: list[str] = []
    try:
        for event in yaml.parse(text, Loader=Loader):
            _take(event, builder, anchors, names)
            if isinstance(event, yaml.DocumentEndEvent):
                break
    except yaml.YAMLError as error:
        if unclosed := find_unclosed(text):
            raise TreeError(unclosed.place.line + 1, f"no YAML: {unclosed.message}", unclosed.advice) from None
        mark = getattr(error, "problem_mark", None)
        message = getattr(error, "problem", None) or "it is no YAML"
        raise TreeError((mark.line + 1) if mark else 1, f"no YAML: {message}") from None
    except ValueError as error:
        raise TreeError(1, f"no YAML: {error}") from None
    if builder.root is None:
        raise TreeError(1, "there is nothing in it")
    return builder.root, builder.doubled


def _take(event: Any, builder: Builder, anchors: dict[str, Node], names: list[str]) -> None:  # noqa: ANN401 - pyyaml's events have no types
    line = event.start_mark.line + 1
    if isinstance(event, yaml.ScalarEvent) and builder.awaits_key:
        builder.key(event.value, line)
    elif isinstance(event, yaml.AliasEvent):
        _alias(event, builder, anchors)
    elif isinstance(event, yaml.ScalarEvent):
        node = builder.scalar(event.value, line, quoted=bool(event.style), tag=_tag(event))
        anchors |= {event.anchor: node} if event.anchor else {}
    elif isinstance(event, yaml.MappingStartEvent | yaml.SequenceStartEvent):
        if builder.awaits_key:
            raise TreeError(line, "a key that is a list or a mapping", "no such configuration has one")
        builder.start(line, mapping=isinstance(event, yaml.MappingStartEvent), tag=_tag(event))
        names.append(event.anchor or "")
    elif isinstance(event, yaml.CollectionEndEvent):
        node = builder.end()
        name = names.pop()
        anchors |= {name: node} if name else {}


def _alias(event: Any, builder: Builder, anchors: dict[str, Node]) -> None:  # noqa: ANN401 - as above
    line = event.start_mark.line + 1
    if event.anchor not in anchors:
        raise TreeError(line, f"the alias *{event.anchor} names nothing that stands before it")
    if builder.awaits_key:
        builder.key(anchors[event.anchor].text, line)
    else:
        builder.add(anchors[event.anchor])


def _tag(event: Any) -> str:  # noqa: ANN401 - as above
    tag = event.tag or ""
    return "" if tag.startswith(PLAIN_TAGS) or tag == "!" else str(tag)
