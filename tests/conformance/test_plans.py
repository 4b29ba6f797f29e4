"""`regscribe plan` shows what a driver sends, request by request, to a server that knows no map: cases, random maps."""

import json
import random
import struct
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from io import StringIO
from itertools import cycle
from math import isfinite
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from regscribe.cli.app import run
from regscribe.emit import python
from regscribe_runtime import NotPresent
from regscribe_runtime.operations.prepared_read import dependencies

from .matrix_watch import Wire
from .strategies import FUZZ, STEADY, maps
from .suite import FUNCTIONS, Built, Case, Json, build, cases, diagnose, errors_of, module_of, whole_map
from .trial import Trial
from .wire import Memory, Server

FEW, FEW_IDS = 16, 4
SOUND = [case for case in cases() if not case.refused]
TCP, SERIAL = ("--tcp",), ("--baud", "9600", "--line-format", "8N1")
"""The lines that drivers talk over here, as the command is told."""
Requests = list[tuple[int, int, int]]
"""Function, address and quantity of each, in the order of sending."""

PROTOCOLS = st.fixed_dictionaries(
    {"functions": st.just(FUNCTIONS), "read_holes": st.booleans()},
    optional={
        "limits": st.fixed_dictionaries({"read_words": st.sampled_from((4, 10, 40)), "read_bits": st.just(3)}),
        "latency": st.just({3: {"fixed": "1..5", "per_word": "0..9"}}),
    },
)
"""What a device accepts, and what decides how its registers are joined in requests."""
WHOLE = st.builds(lambda parts, protocol: parts | {"protocol": protocol}, maps(), PROTOCOLS)


class Question(NamedTuple):
    """What is read, in the words of the command and as a driver is asked; `fresh` with what it depends on."""

    words: tuple[str, ...]
    what: tuple[Any, ...] = ()
    fresh: bool = True


class Bench(NamedTuple):
    """A map's file, and its drivers by the line that they believe in: all in front of the words of one server."""

    path: Path
    memory: Memory
    drivers: dict[tuple[str, ...], Any]

    def differences(self, *questions: Question) -> Iterator[str]:
        """Where the command shows other requests than the server saw; each question goes to the next line."""
        for one, (line, driver) in zip(questions, cycle(self.drivers.items()), strict=False):
            saw = self._saw(one, driver)
            told = self._told(one, line, driver.session.memory)
            if told is not None and told != saw and (one.fresh or _is_known(driver, one.what)):
                yield f"{one.words} {line} {one.fresh}: told {told}, saw {saw}"

    def _told(self, one: Question, line: tuple[str, ...], known: Mapping[str, Any]) -> Requests | None:
        """What the command shows: it is told the numbers that a driver found, for they say what exists.

        None where it refuses these, for a packed array has fewer elements than there may be.
        """
        held = [f"--with={path}={value + 0}" for path, value in known.items() if _is_number(value)]
        remembered = () if one.fresh else ("--remembered",)
        words = ["plan", str(self.path), "--model", "A", "--json", *one.words, *line, *remembered, *held]
        with redirect_stdout(StringIO()) as out, redirect_stderr(StringIO()) as refused:
            code = run(words)
        if code and "which is packed" in refused.getvalue():
            return None
        assert code == 0, refused.getvalue()
        found = json.loads(out.getvalue())["requests"]
        return [_whole(each) for each in found]

    def _saw(self, one: Question, driver: Any) -> Requests:
        driver.read(*one.what)  # from now on it knows what values depend on
        self.memory.log.clear()
        driver.read(*one.what, fresh=one.fresh)
        return [_asked(pdu) for pdu in self.memory.log]


def _is_known(driver: Any, registers: Sequence[Any]) -> bool:
    """Whether all that the registers depend on has a value: what has none cannot be remembered, and is asked anew."""
    needs = dependencies(driver.session.registers, registers)
    return all(path in driver.session.memory for found in needs.values() for path in found)


def _is_number(value: Any) -> bool:
    """Whether the command can be told that a register holds this."""
    return isinstance(value, int | float) and isfinite(value)


def _whole(told: Json) -> tuple[int, int, int]:
    """A request of a plan; a queue and an object of the identification come as a whole."""
    function, address = told["function"], told["address"]
    if function == 20:
        return 20, told["file"] << 16 | address, told["quantity"]
    if function in {24, 43}:
        return function, told["queue"] << 6 if function == 24 else address << 8, 0
    return function, address, told["quantity"]


def _asked(pdu: bytes) -> tuple[int, int, int]:
    """What a request asks; function 07 names no address, others have a number of a file, queue or object in it."""
    if pdu[0] == 20:
        file, record, quantity = struct.unpack(">HHH", pdu[3:])
        return 20, file << 16 | record, quantity
    if pdu[0] in {24, 43}:
        return pdu[0], pdu[3] << 8 if pdu[0] == 43 else struct.unpack(">H", pdu[1:])[0] << 6, 0
    function, address, quantity = struct.unpack(">BHH", pdu[:5]) if len(pdu) > 1 else (pdu[0], 0, 1)
    return function, address, 1 if function in {5, 6} else quantity


def everything(device: Any) -> tuple[Question, Question]:
    """All registers, and their group."""
    return Question(("--all",)), Question(("--group", "all"), (device.groups.all,))


PAGED: Json = {
    "decimals": {"digits": {"register": "places"}},
    "protocol": {"functions": [1, 3, 4, 5, 6, 16, 23], "limits": {"read_words": 4}, "latency": {6: {"fixed": "5..9"}}},
    "groups": [
        {
            "id": "all",
            "name": "All",
            "source": "1",
            "each": {"access": "rw", "stays": "operation"},
            "registers": [
                {"at": 0, "name": "Bank"},
                {"at": 1, "name": "Row", "type": "uint32"},
                {"at": 5, "name": "Switch", "space": "coil"},
            ],
        },
        {
            "id": "own",
            "name": "Own",
            "source": "1",
            "registers": [{"at": 9, "name": "Places", "access": "rw", "range": "0..3"}],
        },
        *[
            {
                "id": f"page_{number}",
                "name": f"Page {number}",
                "source": "1",
                **reached,
                "each": {"access": "r", **how},
                "registers": [
                    {"id": f"one_{number}", "at": 10, "name": "One", "decimals": "digits"},
                    {"id": f"two_{number}", "at": 12, "name": "Two", "type": "uint32"},
                    {"id": f"far_{number}", "at": 90, "name": "Far", "type": "uint32"},
                    {"id": f"in_{number}", "at": 3, "name": "In", "space": "input", "functions": [4]},
                ],
            }
            for number, (reached, how) in enumerate(
                (
                    ({"page": {"bank": 3, "row": 5}}, {}),
                    ({"page": {"bank": 4, "row": 6}}, {"functions": [23]}),
                    ({"page": {"bank": 5, "switch": 1}}, {}),
                    ({"unit_id": 7}, {}),
                )
            )
        ],
    ],
}
"""Pages that are selected by several writes, by the request that reads, by a coil, and by the unit id."""


def of_ids(device: Any, chance: random.Random) -> Question:
    """One to three registers that can be read, by path; often such that depend on others."""
    readable = [one for one in device.registers.values() if one.access.readable]
    depending = [one for one in readable if one.needs(one.read_view())]
    among = chance.choice((readable, depending or readable))
    chosen = tuple(chance.sample(among, min(len(among), chance.choice((1, 1, 2, 3)))))
    return Question(tuple(one.path for one in chosen), chosen, chance.choice((True, True, False)))


@contextmanager
def bench(path: Path, parts: Json, device: Any, server: Server) -> Iterator[Bench]:
    """Drivers of a map over TCP, and on a serial line of 9600 baud, in front of what a server holds."""
    path.write_text(whole_map(parts), encoding="utf-8")
    with device.tcp("127.0.0.1", port=server.port, unit=1) as over_tcp:
        serial = device(Wire(server.memory.answer), unit=1)
        yield Bench(path, server.memory, {TCP: over_tcp, SERIAL: serial})


@pytest.fixture(scope="module")
def server() -> Iterator[Server]:
    with Server() as running:
        yield running


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("maps") / "case.yaml"


@pytest.mark.parametrize("case", SOUND, ids=repr)
def test_the_plan_of_a_case_is_what_its_driver_sends(case: Case, server: Server, path: Path) -> None:
    device = build(whole_map(case.map)).module.CaseA
    chance = random.Random(case.name)  # noqa: S311 (found again by its name)
    case.prepare(server.memory)

    with bench(path, case.map, device, server) as made:
        questions = [chance.choice(everything(device)), of_ids(device, chance)]
        assert list(made.differences(*chance.sample(questions, 2))) == []


@pytest.mark.parametrize("seed", range(8))
def test_the_plan_of_pages_is_what_a_driver_sends(seed: int, server: Server, path: Path) -> None:
    device = build(whole_map(PAGED)).module.CaseA
    chance = random.Random(seed)  # noqa: S311 (found again by its seed)
    server.memory.clear()
    group = Question(("--group", f"page_{seed % 4}"), (getattr(device.groups, f"page_{seed % 4}"),))

    with bench(path, PAGED, device, server) as made:
        questions = [Question(("--all",)), group, *(of_ids(device, chance) for _ in range(FEW_IDS))]
        assert list(made.differences(*chance.sample(questions, len(questions)))) == []


def differences(parts: Json, seed: int, server: Server, path: Path) -> list[str]:
    """What is sent otherwise than planned of a map that no rule refuses, whose registers hold words of any kind.

    A register that is named and does not exist now is left out: the command does not show what tells a driver so.
    """
    register_map, found = diagnose(whole_map(parts))
    assume(register_map is not None and not errors_of(found))
    assert register_map is not None
    ((_, code),) = python.render(register_map).items()
    chance = random.Random(seed)  # noqa: S311 (found again by its seed)
    trial = Trial(Built(register_map, module_of(code)), chance)
    trial.hold()
    server.memory.cells, device = trial.memory.cells, type(trial.plain)
    server.memory.long = range(0)
    deciding = {path for register in trial.registers for path in register.when.registers}
    with bench(path, parts, device, server) as made:
        driver = made.drivers[TCP]
        gone = {path for path, value in driver.read().entries.items() if isinstance(value, NotPresent)}
        assume(
            all(_is_number(driver.session.memory.get(path)) for path in deciding)
        )  # else nobody can tell the command
        questions = [*everything(device), *(of_ids(device, chance) for _ in range(FEW_IDS))]
        return list(made.differences(*(one for one in questions if not gone.intersection(one.words))))


@settings(STEADY, max_examples=FEW, derandomize=True)
@given(parts=WHOLE, seed=st.integers(0, 2**32))
def test_the_plan_of_a_random_map_is_what_its_driver_sends(server: Server, path: Path, parts: Json, seed: int) -> None:
    assert differences(parts, seed, server, path) == []


@pytest.mark.slow
@settings(STEADY, max_examples=FUZZ)
@given(parts=WHOLE, seed=st.integers(0, 2**32))
def test_the_plans_of_many_random_maps_are_what_drivers_send(
    server: Server, path: Path, parts: Json, seed: int
) -> None:
    assert differences(parts, seed, server, path) == []
