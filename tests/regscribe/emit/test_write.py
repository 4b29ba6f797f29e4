from pathlib import Path

import pytest

from regscribe.emit.header import header
from regscribe.emit.write import PACKAGE_FILE, WriteError, write
from regscribe.model import Manual, RegisterMap

DRIVER = "regscribe_devices/acme/oven.py"
DOC = "docs/acme/oven.md"


def generated(map_id: str) -> str:
    """A file as emitters make it."""
    register_map = RegisterMap(
        id=map_id,
        title="",
        maker="",
        class_prefix="",
        source="",
        content_hash="0" * 64,
        manual=Manual(""),
        models=(),
    )
    return header(register_map, prefix="# ") + "\n"


def tree(out: Path) -> dict[str, str]:
    return {path.relative_to(out).as_posix(): path.read_text() for path in out.rglob("*") if path.is_file()}


def test_the_drivers_of_a_maker_become_an_import_package_in_one_that_other_distributions_have_parts_of(
    tmp_path: Path,
) -> None:
    report = write({DRIVER: "x = 1\n"}, tmp_path)
    assert tree(tmp_path) == {
        DRIVER: "x = 1\n",
        "regscribe_devices/acme/__init__.py": PACKAGE_FILE,
        "regscribe_devices/acme/py.typed": "",
    }
    assert sorted(tree(tmp_path)) == list(report.written)


def test_a_second_run_touches_nothing(tmp_path: Path) -> None:
    write({DRIVER: "x = 1\n"}, tmp_path)
    before = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*")}
    report = write({DRIVER: "x = 1\n"}, tmp_path)
    assert (report.written, report.removed, len(report.unchanged)) == ((), (), 3)
    assert {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*")} == before


def test_only_what_changed_is_written(tmp_path: Path) -> None:
    write({DOC: "a\n", "docs/acme/b.md": "b\n"}, tmp_path)
    assert write({DOC: "a\n", "docs/acme/b.md": "c\n"}, tmp_path).written == ("docs/acme/b.md",)


def test_check_writes_nothing_and_shows_the_difference(tmp_path: Path) -> None:
    write({DOC: "a\nb\n", "docs/x/old.md": generated("x/old")}, tmp_path)
    before = tree(tmp_path)
    report = write({DOC: "a\nc\n", "docs/acme/new.md": "n"}, tmp_path, check=True, owned=lambda _: True)
    assert tree(tmp_path) == before
    assert (report.written, report.removed) == (("docs/acme/new.md", DOC), ("docs/x/old.md",))
    assert f"--- a/{DOC}\n+++ b/{DOC}\n@@ -1,2 +1,2 @@\n a\n-b\n+c\n" in report.diff
    assert "--- /dev/null\n+++ b/docs/acme/new.md\n@@ -0,0 +1 @@\n+n\n\\ No newline at end of file\n" in report.diff
    assert "--- a/docs/x/old.md\n+++ /dev/null\n" in report.diff


def test_check_of_an_output_directory_that_does_not_exist_does_not_make_it(tmp_path: Path) -> None:
    assert write({DOC: "a\n"}, tmp_path / "out", check=True).written == (DOC,)
    assert not (tmp_path / "out").exists()


def test_stale_files_go_with_the_folders_that_they_leave_empty(tmp_path: Path) -> None:
    write({DRIVER: generated("acme/oven"), "regscribe_devices/old/gone.py": generated("old/gone")}, tmp_path)
    report = write({DRIVER: generated("acme/oven")}, tmp_path, owned=lambda map_id: map_id == "old/gone")
    assert report.removed == ("regscribe_devices/old/gone.py",)
    assert not (tmp_path / "regscribe_devices" / "old").exists()
    assert (tmp_path / DRIVER).exists()


def test_what_is_not_generated_or_not_owned_stays(tmp_path: Path) -> None:
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs" / "mine.md").write_text("my own notes\n")
    (tmp_path / "docs" / "theirs.md").write_text(generated("other/map"))
    assert write({DOC: "a\n"}, tmp_path, owned=lambda map_id: map_id == "acme/oven").removed == ()
    assert write({DOC: "a\n"}, tmp_path, owned=lambda _: True).removed == ("docs/theirs.md",)
    assert (tmp_path / "docs" / "mine.md").exists()


def test_kept_files_are_neither_stale_nor_written(tmp_path: Path) -> None:
    write({DRIVER: generated("acme/oven")}, tmp_path)
    report = write({}, tmp_path, kept=[DRIVER], owned=lambda _: True)
    assert (report.written, report.removed, len(report.unchanged)) == ((), (), 3)


@pytest.mark.parametrize(
    "path", ["../out.md", "/etc/out.md", "docs/../../out.md", "", "docs\\..\\out.md", "a\0b", "c:x"]
)
def test_a_path_that_leaves_the_output_directory_is_refused(tmp_path: Path, path: str) -> None:
    with pytest.raises(WriteError, match="leaves the output directory"):
        write({path: "x", DOC: "a\n"}, tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_a_symbolic_link_out_of_the_output_directory_is_refused(tmp_path: Path) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    out = tmp_path / "out"
    out.mkdir()
    (out / "docs").symlink_to(elsewhere)
    with pytest.raises(WriteError, match="symbolic link"):
        write({DOC: "a\n", DRIVER: "x\n"}, out)
    assert (list(elsewhere.iterdir()), list(out.iterdir())) == ([], [out / "docs"])


def test_the_output_directory_itself_may_be_a_symbolic_link(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    (tmp_path / "out").symlink_to(tmp_path / "real")
    assert write({DOC: "a\n"}, tmp_path / "out").written == (DOC,)


def test_a_file_in_place_of_a_folder_is_a_clear_message_and_leaves_the_tree_as_it_was(tmp_path: Path) -> None:
    write({"docs/a.md": "old\n"}, tmp_path)
    (tmp_path / "vectors").write_text("in the way")
    before = tree(tmp_path)
    with pytest.raises(WriteError, match=r"vectors.*choose another directory with --out"):
        write({"docs/a.md": "new\n", "docs/b.md": "b\n", "vectors/acme/oven.json": "{}"}, tmp_path)
    assert tree(tmp_path) == before


def test_a_folder_in_place_of_a_file_is_a_clear_message(tmp_path: Path) -> None:
    (tmp_path / DOC).mkdir(parents=True)
    with pytest.raises(WriteError, match="choose another directory"):
        write({DOC: "a\n"}, tmp_path)


def test_a_disk_that_fills_up_leaves_the_tree_as_it_was(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write({"docs/a.md": "old\n", "docs/b.md": "old\n"}, tmp_path)
    before = tree(tmp_path)
    write_bytes = Path.write_bytes

    def full(path: Path, content: bytes) -> int:
        if "b.md" in path.name:
            raise OSError(28, "No space left on device", str(path))
        return write_bytes(path, content)

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(WriteError, match="No space left on device"):
        write({"docs/a.md": "new\n", "docs/b.md": "new\n"}, tmp_path)
    assert tree(tmp_path) == before
