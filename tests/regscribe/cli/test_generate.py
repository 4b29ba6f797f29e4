import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

DRIVER = Path("generated/regscribe_devices/acme/oven.py")
INDEX = Path("generated/docs/README.md")
OTHER = "acme/kiln"


def tree(out: Path = Path("generated")) -> dict[str, bytes]:
    return {path.relative_to(out).as_posix(): path.read_bytes() for path in out.rglob("*") if path.is_file()}


def add_kiln(oven: Path) -> Path:
    kiln = oven.with_name("kiln.yaml")
    kiln.write_text(oven.read_text().replace("acme/oven", OTHER).replace("class_prefix: Acme", "class_prefix: Kiln"))
    return kiln


@pytest.mark.usefixtures("oven")
def test_a_map_becomes_driver_docs_vectors_and_tests_with_a_summary(cli: Callable[..., Any]) -> None:
    result = cli("generate")
    assert (result.code, result.err) == (0, "")
    assert result.out.startswith("1 map, 1 model, 2 registers, 1 enum; 8 files in generated: 8 written, 0 unchanged, ")
    assert sorted(tree()) == [
        "docs/README.md",
        "docs/acme/oven.md",
        "docs/acme/oven/addresses.svg",
        "regscribe_devices/acme/__init__.py",
        "regscribe_devices/acme/oven.py",
        "regscribe_devices/acme/py.typed",
        "tests/acme/test_acme__oven.py",
        "vectors/acme/oven.json",
    ]


@pytest.mark.usefixtures("oven")
def test_a_second_run_compiles_and_writes_nothing(cli: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    cli("generate")
    monkeypatch.setattr("regscribe.pipeline.compile_map", None)
    result = cli("generate")
    assert result.code == 0
    assert "1 map, 1 model, 2 registers, 1 enum; 8 files in generated: 0 written, 8 unchanged, 0 removed" in result.out


@pytest.mark.usefixtures("oven")
def test_the_output_does_not_depend_on_where_the_map_lies_or_how_it_is_named(
    cli: Callable[..., Any], oven: Path, tmp_path: Path
) -> None:
    cli("generate")
    cli("generate", oven.resolve(), "--out", "absolute")
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "my map.yaml").write_bytes(oven.read_bytes())
    cli("generate", tmp_path / "elsewhere", "--out", tmp_path / "out")
    assert tree() == tree(Path("absolute")) == tree(tmp_path / "out")


def test_the_output_does_not_depend_on_the_hash_seed_or_the_locale(process: Callable[..., Any], oven: Path) -> None:
    for seed, locale in (("1", "C"), ("2", "C.UTF-8")):
        process("generate", oven, "--out", seed, env={"PYTHONHASHSEED": seed, "LC_ALL": locale, "PYTHONUTF8": "0"})
    assert tree(Path("1")) == tree(Path("2")) != {}


@pytest.mark.parametrize("damage", [b"", b"# by hand\n", None])
def test_a_generated_file_that_was_changed_is_put_right(
    cli: Callable[..., Any], oven: Path, damage: bytes | None
) -> None:
    cli("generate", oven)
    good = tree()
    if damage is None:
        DRIVER.unlink()
    else:
        DRIVER.write_bytes(damage)
    assert "1 written, 7 unchanged" in cli("generate").out
    assert tree() == good


def test_only_the_map_that_changed_is_written_again(cli: Callable[..., Any], oven: Path) -> None:
    add_kiln(oven)
    cli("generate")
    oven.write_text(oven.read_text().replace("0..400", "0..450"))
    result = cli("generate")
    assert "2 maps, 2 models, 4 registers, 2 enums; 13 files in generated: 5 written, 8 unchanged" in result.out


def test_a_new_generator_renders_again_what_the_old_one_left(
    cli: Callable[..., Any], oven: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    cli("generate", oven)
    monkeypatch.setattr("regscribe.emit.build_cache.LIBRARIES", ("click",))
    monkeypatch.setattr("regscribe.pipeline.compile_map", None)
    assert cli("generate", oven).code == 70


def test_a_broken_cache_is_no_error(cli: Callable[..., Any], oven: Path, tmp_path: Path) -> None:
    cli("generate", oven)
    (record,) = (tmp_path / "cache" / "regscribe").iterdir()
    for content in ("", "[]", '{"entries": {"a": 1}, "fingerprint": 1}', '{"entries": []}', "{"):
        record.write_text(content)
        assert "0 written, 8 unchanged" in cli("generate").out
    record.unlink()
    record.mkdir()
    assert cli("generate").code == 0


@pytest.mark.usefixtures("oven")
def test_check_passes_when_nothing_would_change_and_writes_nothing_when_something_would(
    cli: Callable[..., Any],
) -> None:
    assert cli("generate", "--check").code == 1
    assert not Path("generated").exists()
    cli("generate")
    assert cli("generate", "--check").code == 0
    DRIVER.write_text(DRIVER.read_text() + "# by hand\n")
    result = cli("generate", "--check")
    assert result.code == 1
    assert "--- a/regscribe_devices/acme/oven.py\n+++ b/regscribe_devices/acme/oven.py\n" in result.out
    assert "\n-# by hand\n" in result.out
    assert "1 to write" in result.out


@pytest.mark.usefixtures("oven")
def test_check_does_not_believe_the_cache(cli: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    cli("generate")
    monkeypatch.setattr("regscribe.pipeline.compile_map", None)
    assert "internal error" in cli("generate", "--check").err


def test_what_was_generated_from_a_map_that_is_gone_is_removed(cli: Callable[..., Any], oven: Path) -> None:
    kiln = add_kiln(oven)
    cli("generate")
    kiln.unlink()
    assert cli("generate", "--check").code == 1
    assert "5 removed" in cli("generate").out
    assert not any("kiln" in path for path in tree())
    assert len(tree()) == 8


def test_a_run_over_one_map_leaves_those_of_others_alone(cli: Callable[..., Any], oven: Path) -> None:
    kiln = add_kiln(oven)
    cli("generate")
    kiln.unlink()
    assert "0 removed" in cli("generate", oven).out
    assert len(tree()) == 13


def test_the_index_lists_every_map_of_a_run_with_its_coverage(cli: Callable[..., Any], oven: Path) -> None:
    add_kiln(oven)
    cli("generate")
    index = INDEX.read_text()
    assert "[Oven](acme/oven.md) | Acme | M1 | 2 |" in index
    assert "| [Oven](acme/kiln.md) | M1 | 2 | 1 | 1 | 2 | 1 | 2 | 0 | 0 | 0 | 0 |" in index
    assert cli("coverage", "--format", "markdown").out in index
    assert cli("generate", "--check").code == 0


def test_the_index_follows_a_map_that_changed_without_compiling_the_others(
    cli: Callable[..., Any], oven: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from regscribe.pipeline import compile_map  # noqa: PLC0415 - as it was before it is replaced

    add_kiln(oven)
    cli("generate")
    before = INDEX.read_text()
    oven.write_text(oven.read_text().replace(", range: 0..400", ""))
    monkeypatch.setattr("regscribe.pipeline.compile_map", lambda path: compile_map({oven.name: path}[path.name]))
    cli("generate")
    row = "| [Oven](acme/oven.md) | M1 | 2 | {} | 1 | 2 | 1 | 2 |"
    assert INDEX.read_text() == before.replace(row.format(1), row.format(0))


def test_a_run_over_one_map_of_several_leaves_the_index_as_it_is(cli: Callable[..., Any], oven: Path) -> None:
    kiln = add_kiln(oven)
    cli("generate")
    before = INDEX.read_text()
    oven.write_text(oven.read_text().replace(", range: 0..400", ""))
    cli("generate", oven)
    assert INDEX.read_text() == before
    cli("generate", oven.parent)
    assert INDEX.read_text() != before
    assert "kiln" in INDEX.read_text()
    kiln.unlink()
    cli("generate")
    assert "kiln" not in INDEX.read_text()


def test_an_error_in_one_map_leaves_everything_as_it_was(cli: Callable[..., Any], oven: Path) -> None:
    cli("generate")
    before = tree()
    oven.write_text(oven.read_text().replace("0..400", "0..450"))
    oven.with_name("worse.yaml").write_text("x: [")
    result = cli("generate")
    assert result.code == 1
    assert result.err.endswith("nothing was written: 1 error\n")
    assert tree() == before


def test_two_maps_of_one_id_are_refused(cli: Callable[..., Any], oven: Path, tmp_path: Path) -> None:
    twin = tmp_path / "twin.yaml"
    twin.write_bytes(oven.read_bytes())
    result = cli("generate", oven, twin)
    assert result.code == 1
    assert "both make" in result.err
    assert not Path("generated").exists()


def test_a_warning_is_shown_in_every_run_and_stops_nothing(cli: Callable[..., Any], oven: Path) -> None:
    oven.write_text(oven.read_text().replace(", number: X1", ""))
    for _ in range(2):
        result = cli("generate")
        assert (result.code, "warning[" in result.err) == (0, True)


def test_a_driver_in_a_directory_of_ones_own_can_be_imported(process: Callable[..., Any], oven: Path) -> None:
    process("generate", oven, "--out", "mine")
    script = "from regscribe_devices.acme.oven import AcmeM1; print(AcmeM1.__module__)"
    result = process(script, python=True, env={"PYTHONPATH": os.fspath(Path("mine").resolve())})
    assert result.out == "regscribe_devices.acme.oven\n"
