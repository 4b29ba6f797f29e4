"""docs/programs.md: its picture is that of its recipe, and its Python runs."""

import re
from pathlib import Path

from regscribe.simulate import simulate
from regscribe.tools import programs
from regscribe.tools.programs.picture import picture

from .conftest import shipped

DOCS = Path(__file__).parents[4] / "docs"
PAGE = (DOCS / "programs.md").read_text(encoding="utf-8")
BLOCK = re.compile(r"^```(\w+) ?([^\n]*)\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def block(language: str, name: str) -> str:
    return next(text for kind, title, text in BLOCK.findall(PAGE) if (kind, title) == (language, name))


def test_the_picture_of_the_page_is_that_of_its_recipe(tmp_path: Path) -> None:
    """`regscribe program draw anneal.yaml --svg docs/anneal.svg` draws it anew."""
    path = tmp_path / "anneal.yaml"
    path.write_text(block("yaml", "anneal.yaml"), encoding="utf-8")

    assert (DOCS / "anneal.svg").read_text(encoding="utf-8") == picture(programs.load(path).program)


def test_the_python_of_the_page_runs(tmp_path: Path) -> None:
    recipe = tmp_path / "anneal.yaml"
    recipe.write_text(block("yaml", "anneal.yaml"), encoding="utf-8")
    with simulate(shipped("athena/series-c"), "16C", unit=1) as running:
        code = block("python", "").replace('"10.0.0.7"', f'"{running.host}", port={running.port}')
        names: dict[str, object] = {}
        exec(code.replace('"anneal.yaml"', repr(str(recipe))), names)  # noqa: S102 - the page's own lines

        assert running.device.peek("operating_mode") == 5
    assert str(names["svg"]).startswith("<!--")
