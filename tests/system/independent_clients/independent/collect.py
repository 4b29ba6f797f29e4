"""collectd with its modbus plugin, run in the foreground on generated configurations; its values, from CSV files."""

import csv
import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

from click.testing import CliRunner

from independent.families import MAPS, Family
from regscribe.cli.commands.export import command

TYPES = Path("/usr/share/collectd/types.db")
LIFE = "300"
"""Seconds after which collectd is ended, should this process be gone."""

LAST = 10
"""Seconds that collectd has to write its last values when it is ended."""


class Value(NamedTuple):
    """One value of one poll."""

    time: float
    number: float


def configuration(family: Family, place: str, name: str, *, every: int) -> str:
    """Return what `regscribe export --format collectd` prints for the state in which the family is tried."""
    given = [f"{name}={','.join(map(str, sorted(codes)))}" for name, codes in family.givens.items()]
    state = [f"{path}={value}" for path, value in family.sets.items()]
    options = [part for text in state for part in ("--with", text)]
    options += [part for text in given for part in ("--given", text)]
    asked = [
        str(MAPS / f"{family.map}.yaml"),
        "--format",
        "collectd",
        "--model",
        family.model,
        "--at",
        place,
        "--name",
        name,
    ]
    done = CliRunner().invoke(command, [*asked, "--every", str(every), *options], standalone_mode=False)
    assert done.exit_code == 0, done.output
    return done.output


@contextmanager
def polling(configurations: Sequence[str], folder: Path) -> Iterator[Path]:
    """Let collectd poll while the block runs; yields the folder of its CSV files."""
    data = folder / "csv"
    main = folder / "collectd.conf"
    main.write_text(_main(folder, data), encoding="utf-8")
    for place, text in enumerate(configurations):
        (folder / f"{place}.modbus.conf").write_text(text, encoding="utf-8")
    process = subprocess.Popen(["timeout", LIFE, "/usr/sbin/collectd", "-f", "-C", str(main)])  # noqa: S603, S607 (fixed, no shell)
    try:
        yield data
        assert process.poll() is None, "collectd ended by itself"
    finally:
        process.terminate()
        try:
            process.wait(LAST)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def _main(folder: Path, data: Path) -> str:
    return f"""
BaseDir "{folder}"
PIDFile "{folder}/collectd.pid"
TypesDB "{TYPES}"
FQDNLookup false
Hostname "wire"
LoadPlugin logfile
<Plugin logfile>
  LogLevel warning
  File "{folder}/log"
</Plugin>
LoadPlugin csv
<Plugin csv>
  DataDir "{data}"
</Plugin>
Include "{folder}/*.modbus.conf"
"""


def values(data: Path, host: str, unit: int, instance: str) -> list[Value]:
    """Return all values of a register that collectd wrote, oldest first."""
    found: list[Value] = []
    for path in sorted((data / host / f"modbus-slave_{unit}").glob(f"gauge-{instance}-[0-9]*")):
        with path.open(encoding="ascii") as lines:
            found += [Value(float(time), float(number)) for time, number in list(csv.reader(lines))[1:]]
    return found
