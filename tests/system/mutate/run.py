"""Break one thing at a time and see that a test notices: `make mutate`.

A mutant is a small textual mistake from `mutants.toml`, or one of the operators of `judge.py` on the model of a real
map. Each is judged in a process of its own, on a copy of the generator if its mistake is there. Prints a table; exits
with 1 if one survives, with 2 if one could not be made (its text stands no more where it stood) or if the sound code
fails.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
PACKAGE = Path("generator")
WORKERS = 2
SECONDS = 120
SUITES = {
    "expressions": ("tests/regscribe/emit/python/test_expressions.py",),
    "vectors": ("tests/regscribe/emit/vectors", "-k", "not schema and not seed"),
    "reference": ("tests/regscribe/reference/test_reference.py", "tests/regscribe/emit/vectors/test_numbers.py"),
    "breaking": ("tests/regscribe/breaking", "-m", "not slow"),
    "testing": ("tests/regscribe/testing/test_driver_checks.py",),
    "markdown": (
        "tests/regscribe/emit/markdown/test_content.py",
        "tests/regscribe/emit/markdown/test_escape.py",
        "tests/regscribe/emit/markdown/test_page.py",
    ),
}
"""Which tests judge a mistake in a room of the generator that no driver runs through."""

OPERATORS = {
    "maps/fdc/series-100.yaml": "address multiply offset sign case limit access alias member bit",
    "maps/athena/series-c.yaml": "address multiply offset sign case limit access member bit order factor",
}
SAID = 70
"""Characters of the reason that the table shows."""


@dataclass(frozen=True, slots=True)
class Mutant:
    """A mistake: `new` in place of `old` in `file` (below the root), or `operator` on the map `file`."""

    room: str
    name: str
    file: str
    old: str = ""
    new: str = ""
    operator: str = ""
    fast: bool = False

    def text(self, source: str) -> str:
        """The source with the mistake in it; LookupError if the place is not unique any more."""
        found = source.count(self.old)
        if found != 1:
            message = f"{self.room}, {self.name}: {self.old!r} stands {found} times in {self.file}, not once"
            raise LookupError(message)
        return source.replace(self.old, self.new)


@dataclass(frozen=True, slots=True)
class Verdict:
    """What became of a mutant: what caught it, or nothing; or why it could not be judged."""

    mutant: Mutant
    caught: str = ""
    broken: str = ""


def mutants() -> Iterator[Mutant]:
    """All mutants: those of the file, then the operators on real maps."""
    listed = tomllib.loads((HERE / "mutants.toml").read_text(encoding="utf-8"))
    for room, several in listed.items():
        for one in several:
            file = str(PACKAGE / one["file"]) if "file" in one else "tests/system/mutate/kiln.yaml"
            yield Mutant(room, one["name"], file, one["old"], one["new"], fast=one.get("fast", False))
    for file, names in OPERATORS.items():
        yield from (Mutant("real", f"{Path(file).stem}: {name}", file, operator=name) for name in names.split())


def tree(folder: Path, mutant: Mutant | None = None) -> None:
    """A copy of the generator, with the mistake of a mutant in it; everything else is linked."""
    shutil.copytree(ROOT / PACKAGE, folder / PACKAGE)
    for name in ("tests", "schema", "maps", "generated", "pyproject.toml"):
        (folder / name).symlink_to(ROOT / name)
    if mutant is None:
        return
    path = folder / mutant.file
    path.write_text(mutant.text(path.read_text(encoding="utf-8")), encoding="utf-8")


def run(arguments: Iterable[str], root: Path) -> subprocess.CompletedProcess[str]:
    """Run Python with the packages below `root` first on its path."""
    path = os.pathsep.join(str(root / name) for name in ("generator", "generator/runtime", "generated"))
    return subprocess.run(  # noqa: S603 (our own interpreter and scripts)
        [sys.executable, "-P", *arguments],
        cwd=root,
        env={**os.environ, "PYTHONPATH": path, "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        check=False,
        text=True,
        timeout=SECONDS,
    )


def run_suite(room: str, root: Path) -> subprocess.CompletedProcess[str]:
    """Run the tests that judge a room, up to the first failure."""
    options = ("-x", "-q", "-p", "no:cacheprovider", "--no-header", "--tb=line")
    return run(["-m", "pytest", *options, *SUITES[room]], root)


def judged(mutant: Mutant, vectors: Path) -> Verdict:
    """Make the mutant and judge it."""
    try:
        with tempfile.TemporaryDirectory() as name:
            return _judged(mutant, vectors, Path(name))
    except LookupError as gone:
        return Verdict(mutant, broken=str(gone.args[0]))
    except subprocess.TimeoutExpired:
        return Verdict(mutant, caught="no end within the time")


def _judged(mutant: Mutant, vectors: Path, folder: Path) -> Verdict:
    kiln = HERE / "kiln.yaml"
    judge = str(HERE / "judge.py")
    if mutant.operator:
        return _verdict(mutant, run([judge, "real", str(ROOT / mutant.file), mutant.operator], ROOT))
    if mutant.room == "map":
        broken = folder / "kiln.yaml"
        broken.write_text(mutant.text(kiln.read_text(encoding="utf-8")), encoding="utf-8")
        return _verdict(mutant, run([judge, "driver", str(broken), str(vectors)], ROOT))
    tree(folder, mutant)
    if mutant.room not in SUITES:
        return _verdict(mutant, run([judge, "driver", str(kiln), str(vectors)], folder))
    suite = run_suite(mutant.room, folder)
    lines = [line for line in suite.stdout.splitlines() if line.startswith(("FAILED", "ERROR"))]
    return Verdict(mutant, caught=lines[0].split("::")[-1] if lines else "tests fail" if suite.returncode else "")


def _verdict(mutant: Mutant, done: subprocess.CompletedProcess[str]) -> Verdict:
    said = done.stdout.strip()
    if done.returncode in {0, 1} and (said or done.stderr == ""):
        return Verdict(mutant, caught=said)
    if mutant.room in {"map", "real"}:
        return Verdict(
            mutant, broken=f"{mutant.room}, {mutant.name}: {done.stderr.strip() or 'nothing to judge'}"[-300:]
        )
    return Verdict(mutant, caught=done.stderr.strip().splitlines()[-1] if done.stderr else "")


def sound_suites(rooms: Iterable[str]) -> None:
    """Run the suites on sound code, copied as for a mutant; SystemExit if one fails: a mutant would prove nothing."""
    with tempfile.TemporaryDirectory() as name:
        tree(Path(name))
        for room in rooms:
            done = run_suite(room, Path(name))
            if done.returncode:
                sys.stderr.write(f"the tests of {room} fail without a mutant:\n{done.stdout}{done.stderr}\n")
                raise SystemExit(2)


def baseline(folder: Path) -> Path:
    """Write the vectors of the sound kiln; SystemExit if the sound code does not pass them."""
    program = (
        "import sys; from pathlib import Path; from regscribe import lower, source\n"
        "from regscribe.emit.vectors import render\n"
        "found = lower.lower(source.load(Path(sys.argv[1]))[0])[0]\n"
        "print(render(found)['vectors/test/kiln.json'])"
    )
    vectors = folder / "kiln.json"
    made = run(["-c", program, str(HERE / "kiln.yaml")], ROOT)
    vectors.write_text(made.stdout, encoding="utf-8")
    sound = run([str(HERE / "judge.py"), "driver", str(HERE / "kiln.yaml"), str(vectors)], ROOT)
    if made.returncode or sound.returncode != 1 or sound.stdout.strip() or sound.stderr:
        sys.stderr.write(f"the sound kiln fails: {made.stderr}{sound.stdout}{sound.stderr}\n")
        raise SystemExit(2)
    return vectors


def main() -> int:
    """Judge all mutants, or those of one room."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--room", help="only the mutants of this room: map, runtime, python, vectors, ...")
    room = parser.parse_args().room
    started = time.monotonic()
    chosen = [mutant for mutant in mutants() if room in {None, mutant.room}]
    sound_suites(sorted({mutant.room for mutant in chosen} & SUITES.keys()))
    with tempfile.TemporaryDirectory() as name:
        vectors = baseline(Path(name))
        with ThreadPoolExecutor(WORKERS) as pool:
            verdicts = list(pool.map(lambda mutant: judged(mutant, vectors), chosen))
    return report(verdicts, time.monotonic() - started)


def report(verdicts: list[Verdict], seconds: float) -> int:
    """Print the table and the survivors; return the exit code."""
    for verdict in verdicts:
        outcome = "??? " + verdict.broken if verdict.broken else verdict.caught or "SURVIVED"
        print(f"{verdict.mutant.room:11} {verdict.mutant.name:42} {outcome[:SAID]}")  # noqa: T201 (a command)
    broken = [verdict.broken for verdict in verdicts if verdict.broken]
    survivors = [verdict.mutant for verdict in verdicts if not verdict.caught and not verdict.broken]
    caught = len(verdicts) - len(broken) - len(survivors)
    print(f"{len(verdicts)} mutants, {caught} caught, {len(survivors)} survived, {seconds:.0f} s")  # noqa: T201
    for mutant in survivors:
        change = f"{mutant.old!r} -> {mutant.new!r}" if mutant.old else mutant.operator
        print(f"survived: {mutant.room}, {mutant.name}: {change} in {mutant.file}")  # noqa: T201
    for text in broken:
        print(f"cannot be judged: {text}")  # noqa: T201
    return 2 if broken else 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())
