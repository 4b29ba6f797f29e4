"""Texts with a cursor mark."""

from collections.abc import Callable
from pathlib import Path

import pytest

from regscribe.language_server.files import Files, MapText

from .texts import CURSOR

At = Callable[..., tuple[Files, MapText, int, int]]


@pytest.fixture
def at(tmp_path: Path) -> At:
    """The files of a text, the text itself and where its cursor stands; `more` are other files, by their ids."""

    def read(text: str, **more: str) -> tuple[Files, MapText, int, int]:
        before = text.partition(CURSOR)[0]
        path = tmp_path / "maps" / "acme" / "one.yaml"
        texts = {path.parent / name.replace("__", "."): other for name, other in more.items()}
        files = Files({path: text.replace(CURSOR, ""), **texts})
        file = files.get(path)
        assert file is not None
        return files, file, before.count("\n"), len(before) - before.rfind("\n") - 1

    return read
