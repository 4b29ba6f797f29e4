"""Texts in YAML as people and programs lay them out: any indentation, blanks, quotes, brackets and comments."""

from random import Random

VALUES = (
    "a",
    "off",
    "1",
    "0x1F",
    "1.50",
    "true",
    "null",
    "~",
    "°C",
    "a:b",
    "12:30",
    "a?",
    "x " * 90 + "end",
    "y" * 170,
)
TEXTS = ("a: b", "a #b", "- a", "it's", 'say "hi"', "a, b", "{x}", "", "*x", "back\\slash", "tail ", "%", "a\nb\n", "-")
BLOCKS = ("one\ntwo", "one\n\n two\nthree", "  x\n y", "# no comment\nx", "a\n\n\n", "a" * 170, "end \n    ")


class Layout:
    """Writes one text; ask a fresh one for each."""

    def __init__(self, random: Random) -> None:
        self._random = random
        self._number = 0

    def text(self) -> str:
        text = f"{self._rows(0)}{self._block(4, 0)}{self._rows(0)}"
        return text.replace("\n", "\r\n") if self._maybe(0.1) else text

    def _maybe(self, chance: float) -> bool:
        return self._random.random() < chance

    def _key(self) -> str:
        self._number += 1
        return self._random.choice(("k{}", "'k{}'", '"k {}"', "{}")).format(self._number)

    def _anchor(self) -> str:
        self._number += 1
        return f"&A{self._number} " if self._maybe(0.06) else ""

    def _quoted(self, indent: int) -> str:
        text = self._random.choice(TEXTS)
        if "\n" not in text and self._maybe(0.4):
            return "'" + text.replace("'", "''") + "'"
        escaped = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
        broken = escaped.replace(" ", "\n" + " " * (indent + 2), 1) if self._maybe(0.2) else escaped
        return f'"{broken}"'

    def _scalar(self, indent: int) -> str:
        return self._random.choice(VALUES) if self._maybe(0.5) else self._quoted(indent)

    def _literal(self, parent: int) -> str:
        body, indent = self._random.choice(BLOCKS), self._random.randint(1, 4)
        stated = str(indent) if body.startswith(" ") else ""
        head = self._random.choice("|>") + stated + self._random.choice(("", "-", "+")) + " # head" * self._maybe(0.2)
        return head + "\n" + "\n".join(" " * (parent + indent) + line if line else "" for line in body.split("\n"))

    def _gap(self, indent: int) -> str:
        """What may stand between two tokens in brackets."""
        margin = " " * (indent + self._random.randint(0, 3))
        comment = f"# c{self._random.randint(0, 99)}\t x"
        kinds = (f" {comment}\n{margin}", f"\n{comment}\n{margin}", "\n" * self._random.randint(1, 3) + margin)
        blanks = " " * self._random.choice((0, 0, 1, 4))
        return self._random.choice((*kinds, *[blanks] * 12))

    def _brackets(self, depth: int, indent: int) -> str:
        if depth <= 0 or self._maybe(0.5):
            return self._scalar(indent)
        rows = [self._row(depth - 1, indent, keyed := self._maybe(0.5)) for _ in range(1)]
        rows += [self._row(depth - 1, indent, keyed) for _ in range(self._random.randint(0, 4))]
        comma = "," * self._maybe(0.1)
        return ("{%s}" if keyed else "[%s]") % (",".join(rows) + comma)

    def _row(self, depth: int, indent: int, keyed: bool) -> str:  # noqa: FBT001 - of this class alone
        value = self._brackets(depth, indent)
        key = f"{'? ' * self._maybe(0.03)}{self._key()}{' ' * self._maybe(0.1)}: " if keyed else self._anchor()
        return f"{self._gap(indent)}{key}{value}{self._gap(indent)}"

    def _end(self) -> str:
        return f"  # e{self._random.randint(0, 99)}\t" if self._maybe(0.1) else " " * self._maybe(0.1)

    def _rows(self, column: int) -> str:
        comment = " " * self._random.randint(0, column + 2) + f"# b{self._random.randint(0, 99)}\n"
        return self._random.choice((comment, "\n\n", *[""] * 14))

    def _node(self, depth: int, parent: int, *, dash: bool) -> str:
        """What stands behind a colon or a dash, up to the end of its last line."""
        below = f"{self._end()}\n{' ' * (parent + 1)}" if self._maybe(0.15) else " "
        if depth <= 0 or self._maybe(0.3):
            return f"{below}{self._anchor()}{self._scalar(parent)}{self._end()}\n"
        if self._maybe(0.1):
            return f" {self._literal(parent)}\n"
        if self._maybe(0.35):
            return f"{below}{self._anchor()}{self._brackets(2, parent + 1)}{self._end()}\n"
        if dash and self._maybe(0.5):
            blanks = self._random.randint(1, 3)
            return " " * blanks + self._block(depth - 1, parent + 1 + blanks).lstrip(" ")
        head = f" {self._anchor()}{self._end()}\n"
        return head + self._block(depth - 1, parent + self._random.randint(0, 4))

    def _block(self, depth: int, column: int) -> str:
        dash = self._maybe(0.4)
        rows = []
        for _ in range(self._random.randint(1, 4)):
            between = self._rows(column)
            key = f"{'? ' * self._maybe(0.04)}{self._key()}:"
            rows.append(f"{between}{' ' * column}{'-' if dash else key}{self._node(depth, column, dash=dash)}")
        return "".join(rows)
