import json
import sqlite3
import subprocess
import sys
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path

import pytest

from regscribe.tools.live.errors import TargetError
from regscribe.tools.live.log import COLUMNS, LogError, open_log
from regscribe.tools.live.reading import RegisterReading
from regscribe.tools.live.watch import Round
from regscribe_runtime import LinkLost, SensorFault

START = datetime(2026, 1, 2, 3, 4, 5, 678_000, UTC)
FAULT = SensorFault("alarm", "low", "sensor low")
READINGS = (
    RegisterReading("setpoint", 150.5, "150.5", "°F", None),
    RegisterReading("flags", ["A", "B"], "A, B", "", None),
    RegisterReading("alarm", None, "", "", FAULT),
)
ROUND = Round(1, START, 0.1, READINGS, frozenset(), None, late=False)
LOST = Round(2, START, 0.1, (), frozenset(), LinkLost("the cable"), late=False)
HEAD = ",".join(COLUMNS)
LINES = [
    HEAD,
    "2026-01-02T03:04:05.678Z,oven,setpoint,150.5,°F,",
    '2026-01-02T03:04:05.678Z,oven,flags,"A, B",,',
    "2026-01-02T03:04:05.678Z,oven,alarm,,,alarm: fault sensor low (low) instead of a value",
]


def written(path: Path, *rounds: Round) -> Path:
    log = open_log(path, "oven")
    for one in rounds:
        log.write(one)
    log.close()
    return path


def test_a_csv_has_a_line_a_register(tmp_path: Path) -> None:
    assert written(tmp_path / "log.csv", ROUND).read_text(encoding="utf-8").splitlines() == LINES


def test_a_round_without_an_answer_is_in_the_log_too(tmp_path: Path) -> None:
    last = written(tmp_path / "log.csv", LOST).read_text(encoding="utf-8").splitlines()[-1]
    assert last == "2026-01-02T03:04:05.678Z,oven,,,,the cable"


def test_json_lines_have_an_object_a_round(tmp_path: Path) -> None:
    (line,) = written(tmp_path / "log.jsonl", ROUND).read_text(encoding="utf-8").splitlines()
    found = json.loads(line)
    assert found["registers"]["setpoint"] == {"value": 150.5, "unit": "°F"}
    assert found["registers"]["flags"]["value"] == ["A", "B"]
    assert "sensor low" in found["registers"]["alarm"]["error"]


def test_a_table_in_sqlite_has_a_row_a_register(tmp_path: Path) -> None:
    with sqlite3.connect(written(tmp_path / "log.sqlite", ROUND, LOST)) as base:
        rows = base.execute("select register, value, unit from readings order by rowid").fetchall()
    base.close()
    assert rows == [("setpoint", 150.5, "°F"), ("flags", "A, B", ""), ("alarm", None, ""), ("", None, "")]


@pytest.mark.parametrize("name", ["log.csv", "log.jsonl", "log.sqlite"])
def test_a_log_is_continued(name: str, tmp_path: Path) -> None:
    once = written(tmp_path / name, ROUND).stat().st_size
    written(tmp_path / name, ROUND)
    if name == "log.sqlite":
        with sqlite3.connect(tmp_path / name) as base:
            assert base.execute("select count(*) from readings").fetchone() == (6,)
        base.close()
        return
    head = len(HEAD) + 1 if name == "log.csv" else 0
    assert (tmp_path / name).stat().st_size == 2 * once - head


def test_a_line_that_was_cut_off_does_not_stay(tmp_path: Path) -> None:
    path = tmp_path / "log.csv"
    path.write_text("\n".join([*LINES, "2026-01-02T03:04"]), encoding="utf-8")
    written(path, LOST)
    assert path.read_text(encoding="utf-8").splitlines() == [*LINES, "2026-01-02T03:04:05.678Z,oven,,,,the cable"]


@pytest.mark.parametrize(
    ("name", "text"), [("log.csv", "a,b\n"), ("log.jsonl", "hello\n"), ("log.sqlite", "no database, " * 20)]
)
def test_a_file_of_another_kind_is_left_alone(name: str, text: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(TargetError, match=name):
        open_log(tmp_path / name, "oven")
    assert (tmp_path / name).read_text(encoding="utf-8") == text


def test_a_table_of_another_kind_is_left_alone(tmp_path: Path) -> None:
    with sqlite3.connect(tmp_path / "log.db") as base:
        base.execute("create table readings (a, b)")
    base.close()
    with pytest.raises(TargetError, match="of another kind"):
        open_log(tmp_path / "log.db", "oven")


@pytest.mark.parametrize("name", ["log.txt", "log"])
def test_an_ending_that_is_none_says_which_there_are(name: str, tmp_path: Path) -> None:
    with pytest.raises(TargetError, match=r"\.csv, \.jsonl or \.sqlite"):
        open_log(tmp_path / name, "oven")


def test_a_folder_that_is_not_there_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(LogError, match="cannot be written"):
        open_log(tmp_path / "none" / "log.csv", "oven")


LIMITED = """
import resource, sys
from pathlib import Path
sys.path[:0] = [sys.argv[3]]
import test_log
from regscribe.tools.live.log import LogError, open_log
log = open_log(Path(sys.argv[1]), "oven")
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[2]), resource.RLIM_INFINITY))
done = 0
try:
    for done in range(1000):
        log.write(test_log.ROUND)
except LogError as error:
    print(done, error)
"""


@pytest.mark.parametrize("name", ["log.csv", "log.jsonl"])
def test_a_log_on_a_full_disk_ends_with_a_whole_round(name: str, tmp_path: Path) -> None:
    # a limit of the file's size stands in for the full disk: a write is cut short, then refused
    arguments = [sys.executable, "-c", LIMITED, str(tmp_path / name), "1000", str(Path(__file__).parent)]
    done = subprocess.run(arguments, capture_output=True, text=True, timeout=60, check=False)  # noqa: S603 - our own
    number, _, said = done.stdout.partition(" ")
    whole = written(tmp_path / f"whole-{name}", *[ROUND] * int(number)).read_bytes()
    assert int(number) > 1, done.stderr
    assert ((tmp_path / name).read_bytes(), "the log is whole up to there" in said) == (whole, True)


def test_a_table_on_a_full_disk_ends_with_a_whole_round(tmp_path: Path) -> None:
    log = open_log(tmp_path / "log.sqlite", "oven")
    log.base.execute("PRAGMA max_page_count = 3")  # type: ignore[attr-defined]  # as a disk that has no room for a page
    done = 0
    with suppress(LogError):
        while done < 10_000:
            log.write(ROUND)
            done += 1
    count = log.base.execute("select count(*) from readings").fetchone()  # type: ignore[attr-defined]  # as above
    log.close()
    assert (count, done < 10_000) == ((done * len(READINGS),), True)


@pytest.mark.parametrize("text", ["=1+1", "@SUM(A1)", "+cmd|' /C calc'!A0", "-2+3+cmd|' /C calc'!A0", " =1", "\n=1"])
def test_a_spreadsheet_calculates_nothing_of_what_a_device_says(text: str, tmp_path: Path) -> None:
    said = Round(1, START, 0.1, (RegisterReading("label", text, text, "", None),), frozenset(), None, late=False)
    assert f"'{text}" in written(tmp_path / "log.csv", said).read_text(encoding="utf-8")


@pytest.mark.parametrize("text", ["-1999..9999", "+5 V", "-", "150.5"])
def test_what_a_spreadsheet_shows_as_it_is_stays_as_it_is(text: str, tmp_path: Path) -> None:
    said = Round(1, START, 0.1, (RegisterReading("label", text, text, "", None),), frozenset(), None, late=False)
    assert f"label,{text}," in written(tmp_path / "log.csv", said).read_text(encoding="utf-8")
