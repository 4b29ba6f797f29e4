"""YAML events to nodes, without recursion: depth, size and aliases are bounded while the file is being read."""

import re
from decimal import Decimal

import yaml
from yaml import events

from regscribe.source import rules
from regscribe.source.document import START, Plain, SourceNode, SourcePlace
from regscribe.source.findings import Findings
from regscribe.source.open_collection import OpenCollection, place_of
from regscribe.source.scalars import NUMBER_HELP, NumberFormError, resolve, shorten
from regscribe.source.utf8 import find_invisible, place_at
from regscribe.source.yaml_errors import explain

MAX_DEPTH = 64
MAX_VALUES = 300_000
MAX_TEXT = 100_000
CHARACTERS_PER_VALUE = 50  # a long text counts as several values, so that aliases of it are bounded too

_LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)  # PyYAML may have been built without libyaml: slow, but equal
_CORE = "tag:yaml.org,2002:"
_TYPES: dict[str, tuple[type, ...]] = {
    "null": (type(None),),
    "bool": (bool,),
    "int": (int,),
    "float": (int, Decimal),
}
_BLANK_OR_COMMENT = re.compile(r"(?:[ \t]*+(?:#.*)?+(?:\n|\Z))*+[ \t]*+")


class NodeBuilder:
    """Builds the tree of one file, and adds its mistakes to `findings`; `escapes` allows any character as an escape."""

    def __init__(self, text: str, findings: Findings, *, escapes: bool = False) -> None:
        self._escapes = escapes
        self._text = text
        self._findings = findings
        self._roots: list[SourceNode] = []
        self._stack = [OpenCollection(START, None, flow=False, is_key=False, children=self._roots)]
        self._anchors: dict[str, SourceNode | None] = {}
        self._values = 0

    def build(self) -> SourceNode:
        """Return the top of the tree; raises StopReadingError if the file cannot be read to its end."""
        try:
            for event in yaml.parse(self._text, Loader=_LOADER):
                self._take(event)
                if isinstance(event, events.DocumentEndEvent):
                    self._check_rest(event)
                    break
        except yaml.YAMLError as error:
            raise explain(error, self._text, self._findings) from None
        if not self._roots or self._roots[0].value is None:
            advice = "start one with `regscribe new MAKER/FAMILY`"
            raise self._findings.stop(rules.EMPTY, "the file holds no map", START, advice=advice)
        return self._roots[0]

    def _take(self, event: events.Event) -> None:
        if isinstance(event, events.ScalarEvent):
            self._scalar(event)
        elif isinstance(event, events.CollectionStartEvent):
            self._open(event)
        elif isinstance(event, events.MappingEndEvent | events.SequenceEndEvent):
            self._close(event)
        elif isinstance(event, events.AliasEvent):
            self._alias(event)

    def _scalar(self, event: events.ScalarEvent) -> None:
        place = place_of(event)
        size = 1 + len(event.value) // CHARACTERS_PER_VALUE
        self._check_limits(size, 0, place)
        self._check_text(event, place)
        frame = self._stack[-1]
        if frame.awaits_key:
            self._key(frame, event, place)
            if event.anchor:
                self._anchors[event.anchor] = SourceNode(frame.key, place)
            return
        node = SourceNode(self._value(event, place), place, size=size)
        if event.anchor:
            self._anchors[event.anchor] = node
        frame.attach(node)

    def _check_text(self, event: events.ScalarEvent, place: SourcePlace) -> None:
        if len(event.value) > MAX_TEXT:
            message = f"a text of {len(event.value):,} characters; at most {MAX_TEXT:,} are read"
            self._findings.add(rules.TEXT_TOO_LONG, message, place, advice="is a quote missing before? else shorten it")
        hidden = find_invisible(event.value) if event.style == '"' and not self._escapes else None
        if hidden:
            advice = "leave the escape out; only visible characters, \\n and \\t have a place in a map"
            self._findings.add(rules.CONTROL_CHARACTER, f"{hidden} written as an escape", place, advice=advice)

    def _value(self, event: events.ScalarEvent, place: SourcePlace) -> Plain:
        tag = (event.tag or "").removeprefix(_CORE)
        if tag in {"", "!", "str"}:
            return event.value if event.style or tag else self._resolve(event.value, place)
        value = self._resolve(event.value, place)
        if not isinstance(value, _TYPES.get(tag, ())) or (tag in {"int", "float"} and isinstance(value, bool)):
            self._refuse_tag(event.tag, place)
        return Decimal(value) if tag == "float" and type(value) is int else value

    def _resolve(self, text: str, place: SourcePlace) -> Plain:
        try:
            return resolve(text)
        except NumberFormError as error:
            self._findings.add(rules.NUMBER_FORM, str(error), place, advice=NUMBER_HELP)
            return text

    def _key(self, frame: OpenCollection, event: events.ScalarEvent, place: SourcePlace) -> None:
        frame.awaits_value = True
        frame.key = key = self._key_text(event, place)
        if key is None:
            return
        if key in frame.keys:
            self._findings.add(
                rules.DUPLICATE_KEY,
                f"the key `{shorten(key)}` is given twice",
                place,
                advice="delete one of the two, or give it its own name",
                related=((f"`{shorten(key)}` stands here first", frame.keys[key]),),
            )
            frame.key = None
        else:
            frame.keys[key] = place

    def _key_text(self, event: events.ScalarEvent, place: SourcePlace) -> str | None:
        """Return a key as text: codes in decimal whatever their notation, words as they stand."""
        if not event.style and event.value == "<<":
            advice = "write the keys out, or put what is common into the group's `each`"
            self._findings.add(rules.MERGE_KEY, "a merge key `<<`", place, advice=advice)
            return None
        value = self._value(event, place)
        if value is None or value == "":
            advice = "write the key before the `:`; put it in quotes if it is really `null`"
            self._findings.add(rules.KEY_NOT_TEXT, "an empty key", place, advice=advice)
            return None
        return str(value) if type(value) is int else event.value

    def _open(self, event: events.CollectionStartEvent) -> None:
        place = place_of(event)
        self._check_limits(1, 1, place)
        mapping = isinstance(event, events.MappingStartEvent)
        if event.tag not in {None, "!", f"{_CORE}{'map' if mapping else 'seq'}"}:
            self._refuse_tag(event.tag, place)
        is_key = self._stack[-1].awaits_key
        if is_key:
            self._refuse_key(place)
        if event.anchor:
            self._anchors[event.anchor] = None
        children: dict[str, SourceNode] | list[SourceNode] = {} if mapping else []
        self._stack.append(OpenCollection(place, event.anchor, bool(event.flow_style), is_key, children))

    def _close(self, event: events.Event) -> None:
        frame = self._stack.pop()
        node = frame.close(event)
        if frame.anchor:
            self._anchors[frame.anchor] = node
        if not frame.is_key:
            self._stack[-1].attach(node)

    def _alias(self, event: events.AliasEvent) -> None:
        place = place_of(event)
        if self._stack[-1].awaits_key:
            self._refuse_key(place)
            return
        anchor = event.anchor or ""
        node = self._anchors.get(anchor)
        if node is None:
            reason = "stands inside its own" if anchor in self._anchors else "has no"
            message = f"the alias `*{shorten(anchor)}` {reason} anchor"
            advice = f"write `&{shorten(anchor)}` before a value above it, or quote a text that starts with `*`"
            self._findings.add(rules.BAD_ALIAS, message, place, advice=advice)
            node = SourceNode(None, place)
        self._check_limits(node.size, node.height, place)
        self._stack[-1].attach(node._replace(place=place))

    def _check_limits(self, size: int, height: int, place: SourcePlace) -> None:
        """Count the values of a node, and check the depth with its own levels; raises StopReadingError."""
        self._values += size
        if self._values > MAX_VALUES:
            message = f"more than {MAX_VALUES:,} values with all aliases expanded"
            advice = "write fewer aliases of aliases, or split the family into several maps"
            raise self._findings.stop(rules.TOO_MANY_VALUES, message, place, advice=advice)
        if len(self._stack) - 1 + height > MAX_DEPTH:
            message, advice = (
                f"more than {MAX_DEPTH} levels of nesting",
                "is a bracket not closed? a map needs about ten",
            )
            raise self._findings.stop(rules.TOO_DEEP, message, place, advice=advice)

    def _refuse_tag(self, tag: str | None, place: SourcePlace) -> None:
        message = f"the tag `{shorten((tag or '').replace(_CORE, '!!'))}` does not fit"
        advice = "leave the tag out; put a text in quotes to keep it a text"
        self._findings.add(rules.TAG, message, place, advice=advice)

    def _refuse_key(self, place: SourcePlace) -> None:
        frame = self._stack[-1]
        frame.awaits_value, frame.key = True, None
        advice = "write the key as a text; quote a text that starts with `[`, `{`, `?` or `*`"
        self._findings.add(rules.KEY_NOT_TEXT, "a key that is a list, a mapping or an alias", place, advice=advice)

    def _check_rest(self, event: events.DocumentEndEvent) -> None:
        rest = _BLANK_OR_COMMENT.match(self._text, event.end_mark.index if event.end_mark else 0)
        if rest and rest.end() < len(self._text):
            place = place_at(self._text, rest.end())
            if event.explicit or self._text.startswith("---", rest.end()):
                advice = "keep one map in a file"
                raise self._findings.stop(rules.SEVERAL_DOCUMENTS, "a second document", place, advice=advice)
            advice = "indent all keys of the map alike, and quote a text that starts with `&`, `*`, `!` or `%`"
            raise self._findings.stop(rules.SYNTAX, "the map has ended before this", place, advice=advice)
