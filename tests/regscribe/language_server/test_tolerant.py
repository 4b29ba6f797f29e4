"""The tree of a text that is being written: that of `source` where it is sound, what is left where it is not."""

import random
from pathlib import Path

import pytest

from regscribe import source
from regscribe.language_server.tolerant import read
from regscribe.map_files import shipped
from regscribe.source import SourceNode

from .texts import HEAD

HERE = Path(__file__)
EXAMPLES = sorted((HERE.parents[3] / "generator" / "regscribe").glob("*/examples/**/*.yaml"))
MAPS = sorted(shipped().glob("*/*.yaml"))


def differences(  # noqa: PLR0911 - one for each kind of value
    ours: SourceNode, theirs: SourceNode, path: str = ""
) -> list[str]:
    """Where two trees differ in their keys, in the places of keys and names, or in values."""
    if (ours.members is None, ours.elements is None) != (theirs.members is None, theirs.elements is None):
        return [f"{path}: {ours.value!r} is not {theirs.value!r}"]
    if ours.members is not None and theirs.members is not None:
        if ours.keys != theirs.keys or list(ours.members) != list(theirs.members):
            return [f"{path}: keys"]
        return [
            one
            for key, child in ours.members.items()
            for one in differences(child, theirs.members[key], f"{path}/{key}")
        ]
    if ours.elements is not None and theirs.elements is not None:
        if len(ours.elements) != len(theirs.elements):
            return [f"{path}: elements"]
        pairs = enumerate(zip(ours.elements, theirs.elements, strict=True))
        return [found for number, pair in pairs for found in differences(*pair, f"{path}/{number}")]
    if isinstance(theirs.value, str):  # line ends of folded texts are blanks here or there
        return [] if str(ours.value).split() == theirs.value.split() else [f"{path}: {ours.value!r}"]
    return [] if (ours.value, ours.place[2:]) == (theirs.value, theirs.place[2:]) else [f"{path}: {ours}"]


@pytest.mark.parametrize("path", [*MAPS, *EXAMPLES], ids=lambda path: path.name)
def test_of_a_sound_text_the_tree_is_that_of_the_compiler(path: Path) -> None:
    text = path.read_text("utf-8")
    document, _ = source.parse(text, name="map")
    if document is not None:
        assert differences(read(text), document.root) == []


@pytest.mark.parametrize(
    ("text", "tree"),
    [
        ("a: {b: 1, c\nd: 2\n", {"a": {"b": 1, "c": None}, "d": 2}),
        ("a:\n  - {at: 1, name: Lo, \n  - {at: 2}\n", {"a": [{"at": 1, "name": "Lo"}, {"at": 2}]}),
        ("a:\n  - {at: 1, x: [1, 2\n  - {at: 2}\nb: 1\n", {"a": [{"at": 1, "x": [1, 2]}, {"at": 2}], "b": 1}),
        ("a: {b: [1}, c: 2}\nd: 3\n", {"a": {"b": [1]}, "d": 3}),
        ('a: "no end\nb: 1\n', {"a": "no end", "b": 1}),
        ("a:\n    b: 1\n  c: 2\nd: 3\n", {"a": {"b": 1}, "d": 3}),
        ("a: 1\n   stray words\nb: 2\n", {"a": "1 stray words", "b": 2}),
        ("a: 1\na: 2\n", {"a": 2}),
        ("- \n- a: \n", [None, {"a": None}]),
        ("a: 010\n", {"a": "010"}),
        ("a: *none\n", {"a": None}),
        ("a: &x {b: 1}\nc: *x\n", {"a": {"b": 1}, "c": {"b": 1}}),
        ("", None),
    ],
)
def test_a_broken_line_costs_what_stands_in_it(text: str, tree: object) -> None:
    assert read(text).value == tree


def test_every_prefix_of_a_map_has_a_tree() -> None:
    text = HEAD + 'notes: ["it\'s", \'a "b"\', >-\n  long\n  text\n  ]\n'
    for end in range(len(text) + 1):
        read(text[:end])


def test_whatever_is_typed_has_a_tree() -> None:
    chance = random.Random(1)  # noqa: S311 - the same texts at every run
    for _ in range(300):
        letters = list(HEAD)
        for _ in range(chance.randrange(1, 30)):
            letters[chance.randrange(len(letters))] = chance.choice("{}[]\"'\n:-# &*|>,x!?°")
        read("".join(letters))


@pytest.mark.parametrize(
    "part", ["[", "{", "- ", "a: ", '"', "{a: [", "? ", "\n  ", "- - ", "*x ", "&a ", "'", '{"a": ', '"\n a']
)
def test_no_text_takes_long(part: str) -> None:
    assert read(part * 5000) is not None
