"""Compile and emit a synthetic map; the same in PeakRDL-python 4.0.0; import what came out; build all real maps.

What `generate` writes besides the driver (docs, pictures, vectors, tests) is held against PeakRDL's driver alone.
"""

import compileall
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from measure import Row, at_least, at_most, best, milliseconds, paired, process
from synthetic import system_rdl, yaml_map

ROOT = Path(__file__).parents[3]
PEAKRDL = """
import sys
from systemrdl import RDLCompiler
from peakrdl_python.exporter import PythonExporter
compiler = RDLCompiler()
compiler.compile_file(sys.argv[1])
PythonExporter().export(node=compiler.elaborate().top, path=sys.argv[2], skip_test_case_generation=True)
"""
OURS = """
import sys
from pathlib import Path
from regscribe.emit import python
from regscribe.pipeline import compile_map
compiled = compile_map(Path(sys.argv[1]))
for path, text in python.render(compiled.map).items():
    target = Path(sys.argv[2], path)
    target.parent.mkdir(parents=True)
    target.write_text(text, encoding="utf-8")
"""
EVERYTHING = OURS.replace("from regscribe.emit import python", "from regscribe import emit as python").replace(
    "mkdir(parents=True)", "mkdir(parents=True, exist_ok=True)"
)

FEW = 100
"""Registers of the small map: what it takes is start-up, which is taken off the cost of a register."""


def rows(registers: int, *, peers: bool) -> Iterator[Row]:
    """Compile time and output size of a synthetic map against PeakRDL-python; import time of the driver."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ours, theirs, whole = (_seconds(code, registers, folder / out) for code, out in _sides(peers=peers))
        few, their_few, few_whole = (_seconds(code, FEW, folder / f"few {out}") for code, out in _sides(peers=peers))
        what = f"{registers} registers: compile and emit a driver (PeakRDL-python), start-up included"
        yield Row(what, f"{ours:.2f} s", f"{theirs:.2f} s" if peers else "-", theirs / ours, "-", kept=True)
        if peers:
            more = registers - FEW
            each, their_each = (ours - few) / more, (theirs - their_few) / more
            what = f"{registers} registers: compile and emit, per register (PeakRDL-python)"
            yield at_least(what, milliseconds(each), milliseconds(their_each), their_each / each, 6)
            all_each = (whole - few_whole) / more
            what = f"{registers} registers: all that `generate` writes, per register (PeakRDL-python: its driver)"
            yield at_most(what, milliseconds(all_each), milliseconds(their_each), all_each / their_each, 0.5)
            size, their_size = _size(folder / "ours"), _size(folder / "theirs")
            what = f"{registers} registers: size of the driver (PeakRDL-python)"
            yield at_least(what, f"{size // 1000} kB", f"{their_size // 1000} kB", their_size / size, 20)
        yield from _imports(registers, folder / "ours")


def _sides(*, peers: bool) -> tuple[tuple[str, str], ...]:
    return (OURS, "ours"), (PEAKRDL if peers else "", "theirs"), (EVERYTHING if peers else "", "all")


def _seconds(code: str, registers: int, out: Path) -> float:
    if not code:
        return float("nan")
    source = out.with_suffix(".map")
    source.write_text((system_rdl if code is PEAKRDL else yaml_map)(registers), encoding="utf-8")
    return _generate(code, source, out)


def _generate(code: str, source: Path, out: Path) -> float:
    command = [sys.executable, "-c", code, str(source), str(out)]

    def run() -> None:
        shutil.rmtree(out, ignore_errors=True)
        subprocess.run(command, check=True, capture_output=True)  # noqa: S603 (own code)

    return best(run, runs=2)


def _size(folder: Path) -> int:
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file() and path.suffix != ".pyc")


def _imports(registers: int, folder: Path) -> Iterator[Row]:
    compileall.compile_dir(folder, quiet=1)
    runtime = "from regscribe_runtime import Device"  # loads all of it
    module = folder / "regscribe_devices" / "bench" / "synthetic.py"
    load = (
        f"{runtime}; import sys, time; sys.path.insert(0, {str(module.parent)!r}); t = time.perf_counter(); "
        "import synthetic; print(time.perf_counter() - t)"
    )
    seconds = min(_printed(load) for _ in range(9))
    budget = 0.003 + 0.010 * registers / 1000
    what = f"{registers} registers: import of the driver with .pyc, beyond the runtime"
    yield at_most(what, milliseconds(seconds), milliseconds(budget), seconds / budget, 1)


def _printed(code: str) -> float:
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)  # noqa: S603 (own code)
    return float(done.stdout)


def real_maps() -> Iterator[Row]:
    """A whole build of all maps, cold, and one in which nothing changed."""
    command = [sys.executable, "-m", "regscribe", "generate", "maps", "--out"]
    with tempfile.TemporaryDirectory() as out:

        def run() -> None:
            subprocess.run([*command, out], cwd=ROOT, check=True, capture_output=True)  # noqa: S603 (own code)

        cold, warm = best(run, 1), best(run, 3)
    yield at_most("all maps: build from nothing", f"{cold:.2f} s", "10 s", cold / 10, 1)
    if len(CORES) > 1:
        yield _cores()
    yield at_most("all maps: build in which nothing changed", f"{warm:.2f} s", f"{cold:.2f} s", warm / cold, 0.1)


CORES = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []


def _cores() -> Row:
    """A whole build of all maps on two cores against one."""
    two, one = paired(lambda: _build(set(CORES[:2])), lambda: _build(set(CORES[:1])), 2)
    return at_least("all maps: build on two cores (on one)", f"{two:.2f} s", f"{one:.2f} s", one / two, 1.7)


def _build(cores: set[int]) -> None:
    with tempfile.TemporaryDirectory() as out:
        code = f"import os; os.sched_setaffinity(0, {cores}); from regscribe.cli import main; main()"
        command = [sys.executable, "-c", code, "generate", "maps", "--out", out]
        subprocess.run(command, cwd=ROOT, check=True, capture_output=True)  # noqa: S603 (own code)


def start_up() -> Iterator[Row]:
    """`regscribe --version` against an empty Python process that imports click."""
    ours = process("import sys; sys.argv = ['regscribe', '--version']; from regscribe.cli import main; main()")
    bare = process("import click")
    yield at_most(
        "regscribe --version (python -c 'import click')", milliseconds(ours), milliseconds(bare), ours / bare, 1.5
    )
    command = f"import sys; sys.argv = ['regscribe', 'check', {str(ROOT / 'maps/fdc/series-100.yaml')!r}]"
    ours, bare = process(f"{command}; from regscribe.cli import main; main()"), process("import yaml, jsonschema")
    what = "regscribe check of one map (python -c 'import yaml, jsonschema')"
    yield at_most(what, milliseconds(ours), milliseconds(bare), ours / bare, 4)
