"""Two versions of a small map, and what changed between them."""

from collections.abc import Callable
from pathlib import Path

import pytest

from regscribe.breaking.change import Change
from regscribe.breaking.compare import Comparison, compare
from regscribe.breaking.examples import BASE
from regscribe.model import RegisterMap, Severity
from regscribe.pipeline import compile_map

Edited = Callable[..., list[Change]]


class Bench:
    """Compiles versions of a map, each in a folder of its own, with other files beside it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.versions = 0

    def compiled(self, text: str, **others: str) -> RegisterMap:
        """The map of a text; `others` are further files of its maker's folder: libraries, or maps."""
        self.versions += 1
        maker = self.folder / str(self.versions) / "maps" / "acme"
        maker.mkdir(parents=True)
        for name, other in others.items():
            ending = ".library.yaml" if "\nlibrary:" in f"\n{other}" else ".yaml"
            (maker / f"{name}{ending}").write_text(other, encoding="utf-8")
        path = maker / "oven.yaml"
        path.write_text(text, encoding="utf-8")
        found = compile_map(path)
        assert found.map is not None, [(str(one.span), one.message) for one in found.diagnostics]
        assert [one for one in found.diagnostics if one.severity is Severity.ERROR] == []
        return found.map

    def compared(self, old: str, new: str, **others: str) -> Comparison:
        """What changed from one text to another; `others` stand beside the new one."""
        return compare([self.compiled(old)], [self.compiled(new, **others)], alone=True)

    def edited(self, *texts: str, base: str = BASE) -> list[Change]:
        """What changed where in the base each text is replaced by the one behind it, once."""
        new = base
        for old, other in zip(texts[::2], texts[1::2], strict=True):
            assert old in new, old
            new = new.replace(old, other, 1)
        return list(self.compared(base, new).changes)


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path)


@pytest.fixture
def edited(bench: Bench) -> Edited:
    """What changed in the map of the examples where texts are replaced."""
    return bench.edited
