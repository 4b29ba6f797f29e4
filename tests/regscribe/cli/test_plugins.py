"""Exporters and importers by others: found by entry points, and told by name where they are broken."""

import re
import sys
from collections.abc import Callable, Iterator
from importlib.metadata import EntryPoint, EntryPoints
from pathlib import Path
from typing import Any

import pytest

from regscribe import plugins

ROOT = Path(__file__).parents[3]

pytestmark = pytest.mark.usefixtures("oven")

GOOD = """
from regscribe.draft import Draft, Entry, Remark, refused
from regscribe.model import Span
from regscribe.plugins import Likeness, Option, OptionError

class Lists:
    name = "lists"
    summary = "addresses in a file for each map"
    options = (Option("from-address", "the first address", default="0"), Option("tag", "a word", several=True))

    def export(self, maps, options):
        if not options["from-address"].isdecimal():
            raise OptionError("--from-address: write a whole number")
        first = int(options["from-address"])
        def text(one):
            found = [r for r in one.models[0].registers if r.address >= first]
            return "".join(f"{r.address} {r.path} {options['tag'].split()}\\n" for r in found)
        return {"": "done\\n"} | {f"{one.id}.txt": text(one) for one in maps}

class Lines:
    name = "lists"
    summary = "one name a line"
    options = (Option("first", "address of the first name", default="0"),)

    def likeness(self, data, name):
        return Likeness.SURE if name.endswith(".lists") else Likeness.NO

    def read(self, data, name, options):
        if not data:
            return refused(name, "nothing is in it", rule="lists")
        if not options["first"].isdecimal():
            raise OptionError("--first: write a whole number")
        names = data.decode().split()
        return Draft(entries=tuple(
            Entry(name=word, place=Span(name, line, 1, line, 1),
                  keys=None if word == "?" else {"at": line - 1 + int(options["first"]), "name": word, "access": "r"},
                  remarks=(Remark("no-name", "the name is ?"),) if word == "?" else ())
            for line, word in enumerate(names, start=1)))

lists, lines = Lists(), Lines()
"""

Install = Callable[..., None]


@pytest.fixture
def install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Install]:
    """Put a distribution with entry points onto the path of Python, as pip would."""
    before = set(sys.modules)

    def put(code: str, *, distribution: str = "acme-lists", **points: str) -> None:
        site = tmp_path / distribution
        info = site / f"{distribution.replace('-', '_')}-1.2.dist-info"
        info.mkdir(parents=True)
        (site / f"{distribution.replace('-', '_')}.py").write_text(code, encoding="utf-8")
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {distribution}\nVersion: 1.2\n", encoding="utf-8")
        lines = [f"[regscribe.{group}]\n{point}\n" for group, point in points.items()]
        (info / "entry_points.txt").write_text("".join(lines), encoding="utf-8")
        monkeypatch.syspath_prepend(site)

    yield put
    for name in set(sys.modules) - before:
        if name.startswith("acme"):
            del sys.modules[name]


@pytest.fixture
def lists(install: Install) -> None:
    install(GOOD, exporters="lists = acme_lists:lists", importers="lists = acme_lists:lines")


@pytest.mark.usefixtures("lists")
def test_an_installed_exporter_is_a_format_with_options_of_its_own(cli: Callable[..., Any]) -> None:
    done = cli("export", "--format", "lists", "--from-address", "2", "--tag", "a", "--tag", "b", "--out", "lists")
    assert (done.code, done.out, done.err) == (0, "done\n", "")
    assert Path("lists/acme/oven.txt").read_text() == "2 mode ['a', 'b']\n"
    assert "the first address" in cli("export", "--help").out


@pytest.mark.usefixtures("lists")
@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ("--format lists", "say with --out"),
        ("--format lists --out o --from-address x", "write a whole number"),
        ("--format csv --tag a", "--tag: the format csv takes no such option"),
    ],
)
def test_what_an_exporter_cannot_do_is_wrong_usage(cli: Callable[..., Any], arguments: str, said: str) -> None:
    done = cli("export", *arguments.split())
    assert (done.code, done.out) == (2, "")
    assert said in done.err


@pytest.mark.usefixtures("lists")
def test_an_installed_importer_recognises_its_files_and_makes_a_map(cli: Callable[..., Any]) -> None:
    Path("names.lists").write_text("Level Speed")
    done = cli("import", "names.lists", "--first", "7", "--as", "acme/pump", "-o", "maps/acme/pump.yaml")
    assert (done.code, done.out) == (0, "")
    assert "2 rows: 2 whole, 0 with loss, 0 left out" in done.err
    assert cli("check", "acme/pump").code == 0
    assert "holding,8,1,,r,integer" in cli("export", "acme/pump", "--format", "csv").out


@pytest.mark.usefixtures("lists")
def test_what_an_importer_leaves_out_is_told_with_its_reason(cli: Callable[..., Any]) -> None:
    Path("names.lists").write_text("Level ?")
    done = cli("import", "names.lists")
    assert done.code == 1
    assert "names.lists:2:1: ?: left out: no-name: the name is ?" in done.err
    assert "{at: 0, name: Level, access: r}" in done.out


@pytest.mark.usefixtures("lists")
def test_what_an_importer_finds_wrong_writes_nothing(cli: Callable[..., Any]) -> None:
    Path("names.txt").write_text("")
    done = cli("import", "names.txt", "--format", "lists", "-o", "maps/acme/pump.yaml")
    assert done.code == 1
    assert "nothing is in it" in done.err
    assert not Path("maps/acme/pump.yaml").exists()
    Path("names.json").write_text("{}")
    done = cli("import", "names.json")
    assert done.code == 2
    assert "nothing here reads names.json: say with --format what it is" in done.err


@pytest.mark.usefixtures("lists")
def test_an_option_of_another_importer_is_wrong_usage(cli: Callable[..., Any]) -> None:
    Path("names.lists").write_text("Level")
    Path("names.csv").write_text("address,name,access\n")
    assert cli("import", "names.lists", "--first", "x").code == 2
    done = cli("import", "names.csv", "--format", "csv", "--first", "1")
    assert done.code == 2
    assert "--first: the format csv takes no such option" in done.err


def test_the_importer_of_the_docs_works(cli: Callable[..., Any], install: Install) -> None:
    page = (ROOT / "docs" / "plugins.md").read_text(encoding="utf-8")
    code = next(code for code in re.findall(r"```python\n(\"\"\".*?)```", page, re.DOTALL) if "def read(" in code)
    (point,) = re.findall(r'importers"\]\n(.*?)\n```', page)
    install(code, distribution="acme-points", importers=point.replace('"', ""))
    Path("oven.points").write_text("40001 Setpoint\n40002 Mode\nsee manual Bias\n")
    done = cli("import", "oven.points", "--from-one", "yes")
    assert done.code == 1
    assert "{at: 0, name: Setpoint, access: r}" in done.out
    assert "oven.points:3:1: see manual Bias: left out: address-unclear: " in done.err


def test_the_exporter_of_the_docs_works(cli: Callable[..., Any], install: Install) -> None:
    page = (ROOT / "docs" / "plugins.md").read_text(encoding="utf-8")
    code = next(code for code in re.findall(r"```python\n(\"\"\".*?)```", page, re.DOTALL) if "def export(" in code)
    (point,) = re.findall(r'exporters"\]\n(.*?)\n```', page)
    install(code, distribution="acme-addresses", exporters=point.replace('"', ""))
    assert cli("export", "--format", "addresses", "--base", "40001", "--out", "lists").code == 0
    assert Path("lists/acme/oven.txt").read_text() == "40002 M1 setpoint\n40003 M1 mode\n"
    assert cli("export", "--format", "addresses", "--base", "x", "--out", "lists").code == 2


BROKEN = {
    "import acme_nowhere": "ModuleNotFoundError",
    "raise SystemExit(3)": "SystemExit: 3",
    "bad = 1": "no name `bad`",
    "name, summary = 'bad', ''": "no function",
    "class bad: name, summary, export = 'bad', '', print": "no tuple of Option",
    "from regscribe.plugins import Option\nclass bad:\n"
    " name, summary, options, export = 'bad', '', (Option('out', ''),), print": "no tuple of Option",
}
RAISING = {
    "1 / 0": "ZeroDivisionError",
    "exit(3)": "SystemExit: 3",
    "'text'": "no dict of texts",
    "{'a': 1}": "no dict of texts",
    "{'': '\\ud800'}": "UnicodeEncodeError",
    "{'../a': ''}": "leaves the output directory",
    "{'/a': ''}": "leaves the output directory",
}


@pytest.mark.parametrize("code", BROKEN)
def test_a_plugin_that_is_none_is_told_by_name_and_stops_no_other(
    cli: Callable[..., Any], install: Install, code: str
) -> None:
    where = "acme_lists" if code.startswith("name") else "acme_lists:bad"
    install(code, exporters=f"bad = {where}")
    done = cli("export", "--format", "bad")
    assert (done.code, done.out) == (1, "")
    assert "the exporter bad of acme-lists 1.2 is broken" in done.err
    assert BROKEN[code] in done.err
    assert "bad of acme-lists 1.2 is broken" in cli("export", "--format", "bad", "--own", "1").err
    assert cli("export", "--format", "csv").code == 0


@pytest.mark.parametrize("result", RAISING)
def test_an_exporter_that_breaks_is_told_by_name(cli: Callable[..., Any], install: Install, result: str) -> None:
    code = f"name, summary, options = 'bad', '', ()\ndef export(maps, options):\n    return {result}\n"
    install(code, exporters="bad = acme_lists")
    done = cli("export", "--format", "bad", "--out", "out")
    assert (done.code, done.out) == (1, "")
    assert "the exporter bad" in done.err
    assert RAISING[result] in done.err
    assert not Path("out").exists()


@pytest.mark.parametrize("result", ["None", "('', [1])", "b''.x"])
def test_an_importer_that_breaks_is_told_by_name(cli: Callable[..., Any], install: Install, result: str) -> None:
    code = (
        "name, summary, options = 'bad', '', ()\ndef likeness(data, name):\n    return 2\n"
        f"def read(data, name, options):\n    return {result}\n"
    )
    install(code, importers="bad = acme_lists")
    Path("a.bad").write_text("")
    done = cli("import", "a.bad", "-o", "maps/acme/pump.yaml")
    assert done.code == 1
    assert "the importer bad of acme-lists 1.2 is broken" in done.err
    assert not Path("maps/acme/pump.yaml").exists()


def test_an_importer_that_recognises_nothing_disturbs_no_other(cli: Callable[..., Any], install: Install) -> None:
    code = "name, summary, options = 'bad', '', ()\ndef likeness(data, name):\n    return 1 / 0\ndef read(*_): ...\n"
    install(code, importers="bad = acme_lists")
    Path("table.csv").write_text(cli("export", "--format", "csv").out)
    assert cli("import", "table.csv").code == 0


def test_nothing_that_a_plugin_says_is_obeyed_by_a_terminal(cli: Callable[..., Any], install: Install) -> None:
    code = (
        "name, options = 'bad', ()\nsummary = 'a\\x1b[31m'\ndef export(maps, options): raise ValueError('b\\x1b[31m')"
    )
    install(code, exporters="bad = acme_lists")
    told = cli("export", "--help").out + cli("export", "--format", "bad").err
    assert "\x1b" not in told
    assert told.count("\\x1b[31m") == 2


def test_two_plugins_of_one_name_are_refused_with_both_distributions(cli: Callable[..., Any], install: Install) -> None:
    for distribution in ("acme-lists", "acme-more"):
        install(GOOD, distribution=distribution, exporters=f"lists = {distribution.replace('-', '_')}:lists")
    done = cli("export", "--format", "lists", "--out", "out")
    assert done.code == 1
    assert "acme-lists 1.2 and acme-more 1.2" in done.err
    assert cli("export", "--format", "csv").code == 0


def test_without_collectd_everything_else_works(cli: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    def without(*, group: str) -> EntryPoints:
        return EntryPoints(one for one in found(group=group) if one.name != "collectd")

    found = plugins.entry_points
    monkeypatch.setattr(plugins, "entry_points", without)
    for name in [name for name in sys.modules if name.startswith("regscribe.export.collectd")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "regscribe.export.collectd", None)
    assert "collectd" not in cli("export", "--help").out.split("Options:")[1].split("Example")[0]
    assert cli("export", "--format", "collectd").code == 2
    for form in ("csv", "json"):
        assert cli("export", "--format", form).code == 0
    assert cli("generate").code == 0


def test_entry_points_that_cannot_be_read_are_told_where_a_plugin_is_asked_for(
    cli: Callable[..., Any], install: Install
) -> None:
    install("", exporters="no equals sign")
    Path("table.csv").write_text("")
    for arguments in ("export --format csv", "import table.csv"):
        done = cli(*arguments.split())
        assert done.code == 1
        assert "the entry points of some installed package cannot be read" in done.err
    assert cli("generate").code == 0


def test_an_installation_without_entry_points_is_told(cli: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(plugins, "entry_points", lambda **_: EntryPoints())
    assert "install regscribe anew" in cli("export", "--format", "csv").err
    Path("table.csv").write_text("")
    assert "no importer is installed" in cli("import", "table.csv").err


def test_the_builtin_plugins_are_declared_as_any_other() -> None:
    assert {"collectd", "csv", "json"} <= {*plugins.names(plugins.EXPORTERS)}
    assert "csv" in plugins.names(plugins.IMPORTERS)
    for name in plugins.names(plugins.EXPORTERS):
        assert plugins.exporter(name).name == name
    for name in plugins.names(plugins.IMPORTERS):
        assert plugins.importer(name).name == name


def test_an_entry_point_without_a_distribution_has_an_owner_too(monkeypatch: pytest.MonkeyPatch) -> None:
    point = EntryPoint("bad", "acme_nowhere", plugins.EXPORTERS)
    monkeypatch.setattr(plugins, "entry_points", lambda **_: EntryPoints([point]))
    with pytest.raises(plugins.PluginError, match="of nobody"):
        plugins.exporter("bad")
