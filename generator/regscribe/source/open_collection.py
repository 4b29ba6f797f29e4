"""A collection while it is being read, and the places of YAML events."""

from dataclasses import dataclass, field

from yaml.events import Event

from regscribe.source.document import START, SourceNode, SourcePlace


@dataclass(slots=True)
class OpenCollection:
    """A collection that is being read: in a mapping `key` is the key whose value comes next."""

    place: SourcePlace
    anchor: str | None
    flow: bool
    is_key: bool
    children: dict[str, SourceNode] | list[SourceNode]
    keys: dict[str, SourcePlace] = field(default_factory=dict)
    awaits_value: bool = False
    key: str | None = None
    size: int = 1
    height: int = 1

    @property
    def awaits_key(self) -> bool:
        """Whether the next event starts a key."""
        return isinstance(self.children, dict) and not self.awaits_value

    def attach(self, node: SourceNode) -> None:
        """Add a value; the value of a key that was refused is dropped."""
        self.size += node.size
        self.height = max(self.height, node.height + 1)
        if isinstance(self.children, list):
            self.children.append(node)
            return
        self.awaits_value = False
        if self.key is not None:
            self.children[self.key] = node

    def close(self, end: Event) -> SourceNode:
        """Return the finished collection; in block style it ends where its last child ends."""
        members = self.children if isinstance(self.children, dict) else None
        elements = self.children if isinstance(self.children, list) else None
        nodes = list(elements or (members or {}).values())
        last = place_of(end)
        if not self.flow:
            last = nodes[-1].place if nodes else self.place
        whole = SourcePlace(self.place.line, self.place.column, last.end_line, last.end_column)
        values = [node.value for node in nodes]
        data = values if members is None else dict(zip(members, values, strict=True))
        return SourceNode(data, whole, self.keys, members, elements, self.size, self.height)


def place_of(event: Event) -> SourcePlace:
    """Return where an event stands in the text."""
    start, end = event.start_mark, event.end_mark
    if start is None or end is None:
        return START
    return SourcePlace(start.line, start.column, end.line, end.column)
