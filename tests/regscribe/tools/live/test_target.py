import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from regscribe.simulate import Running
from regscribe.tools.live import catalogue, config, target
from regscribe.tools.live.errors import TargetError
from regscribe_runtime import NoAnswer

CONFIG = """\
format: 1
devices:
  oven: {link: "tcp:10.0.0.7:1502?framing=rtu", unit: 3, model: 16C, timeout: 1.5, note: on the left}
  kiln: rtu:/dev/ttyUSB0?baud=9600&unit=7&model=M5000
  press: {link: "rtu:/dev/ttyS0", model: BTC-9100, given: {linear_inputs: [1, "4..6"]}}
"""


@pytest.fixture
def configured(tmp_path: Path) -> config.Config:
    path = tmp_path / "devices.yaml"
    path.write_text(CONFIG, encoding="utf-8")
    return config.load(path)


def test_a_link_names_unit_and_model_behind_its_settings() -> None:
    found = target.parse("rtu:/dev/ttyUSB0?baud=9600&unit=3&model=m5000")
    assert (found.unit, found.known().model, found.link.baud) == (3, "M5000", 9600)


def test_a_name_of_the_configuration_stands_for_all_that_is_said_there(configured: config.Config) -> None:
    oven = target.parse("oven", configured)
    assert (str(oven.link), oven.unit, oven.model) == ("tcp:10.0.0.7:1502?framing=rtu&timeout=1.5", 3, "16C")
    assert (str(oven), target.parse("kiln", configured).unit) == ("oven", 7)


def test_a_device_with_givens_is_made_with_them(configured: config.Config) -> None:
    device = target.connect(target.parse("press", configured))
    assert device.session.givens == {"linear_inputs": frozenset({1, 4, 5, 6})}


def test_a_given_that_is_missing_is_named() -> None:
    with pytest.raises(TargetError, match=re.escape("--given linear_inputs=1,4..6")):
        target.connect(target.parse("tcp:h?model=C21"))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("ovne", "did you mean `oven`?"),
        ("tcp:h?unti=3", "did you mean `unit`?"),
        ("rtu:/dev/x?buad=9600", "did you mean `baud`?"),
        ("tcp:h?unit=256", "a unit id is 0 to 255"),
        ("tcp:h?unit=-1", "a unit id is 0 to 255"),
    ],
)
def test_a_device_that_is_none_says_which_was_meant(text: str, said: str, configured: config.Config) -> None:
    with pytest.raises(TargetError) as caught:
        target.parse(text, configured)
    assert said in str(caught.value)


def test_a_unit_that_the_device_cannot_have_is_refused_before_anything_is_sent() -> None:
    with pytest.raises(TargetError, match="unit 250 is outside 1 to 247"):
        target.connect(target.parse("tcp:h?model=16C&unit=250"))


@pytest.mark.parametrize("name", ["16C", "16c", "athena/series-c:16C", "Athena16C"])
def test_a_model_is_found_by_each_of_its_names(name: str) -> None:
    assert catalogue.find(name).driver.__name__ == "Athena16C"


def test_every_model_of_the_shipped_package_is_in_the_catalogue() -> None:
    assert len(catalogue.models()) == 21
    assert all(catalogue.title(known) for known in catalogue.models())


def test_a_package_of_the_user_comes_before_the_shipped_one(tmp_path: Path) -> None:
    package = tmp_path / "own_devices_of_a_test"
    package.mkdir()
    (package / "__init__.py").write_text("", encoding="utf-8")
    (package / "oven.py").write_text(
        "from regscribe_devices.athena.series_c import Athena16C as A, AsyncAthena16C as B\n"
        "class Own16C(A): pass\nclass AsyncOwn16C(B): pass\n",
        encoding="utf-8",
    )
    assert catalogue.find("16C", [str(package)]).driver.__name__ == "Own16C"


def test_a_package_that_is_none_is_an_error() -> None:
    with pytest.raises(TargetError, match="cannot be imported"):
        catalogue.find("16C", ["no_such_package_anywhere"])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("format: 1\ndevices: {oven: {link: 'tcp:h', unti: 1}}", ":2:33: unknown key `unti` in a device (did you mean"),
        ("format: 1\ndevices: {oven: {unit: 1}}", "`link` is missing"),
        ("format: 1\ndevices: {oven: {link: 'tcp:h', model: 16}}", "model must be a text"),
        ("format: 1\ndevices: {'a b': 'tcp:h'}", "not in the form of a name of a device"),
        ("devices: {}", "`format` is missing"),
        ("format: 1\ndevices: {oven: 'tcp:h', oven: 'tcp:i'}", ":2:26:"),
        ("- 1", "must be a mapping"),
    ],
)
def test_a_mistake_in_the_configuration_is_told_with_its_place(text: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "regscribe.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(TargetError) as caught:
        config.load(path)
    assert said in str(caught.value)


def test_a_configuration_that_is_named_must_exist(tmp_path: Path) -> None:
    with pytest.raises(TargetError, match="there is no configuration"):
        config.load(tmp_path / "none.yaml")


def test_the_configuration_here_comes_before_that_of_the_user(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    home = tmp_path / "config" / "regscribe"
    home.mkdir(parents=True)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.delenv("REGSCRIBE_CONFIG", raising=False)
    monkeypatch.chdir(tmp_path)
    (home / "devices.yaml").write_text("format: 1\ndevices: {far: 'tcp:h'}", encoding="utf-8")
    assert list(config.load().devices) == ["far"]
    Path("regscribe.yaml").write_text("format: 1\ndevices: {near: 'tcp:h'}", encoding="utf-8")
    assert list(config.load().devices) == ["near"]


def test_a_configuration_above_counts_if_it_is_the_users_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.delenv("REGSCRIBE_CONFIG", raising=False)
    below = tmp_path / "a" / "b"
    below.mkdir(parents=True)
    monkeypatch.chdir(below)
    (tmp_path / "regscribe.yaml").write_text("format: 1\ndevices: {above: 'tcp:h'}", encoding="utf-8")
    assert list(config.load().devices) == ["above"]
    (tmp_path / "a" / "regscribe.yaml").write_text("format: 1\ndevices: {nearer: 'tcp:h'}", encoding="utf-8")
    assert list(config.load().devices) == ["nearer"]
    monkeypatch.setattr(config, "TRUSTED", ())
    monkeypatch.setattr(os, "getuid", lambda: tmp_path.stat().st_uid + 1)
    assert config.find() is None
    monkeypatch.delattr(os, "getuid")
    assert list(config.load().devices) == ["nearer"]


def test_a_named_configuration_may_be_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("regscribe.yaml").write_text("format: 1\ndevices: {near: 'tcp:h'}", encoding="utf-8")
    assert config.load(config.NONE).devices == {}
    monkeypatch.setenv("REGSCRIBE_CONFIG", config.NONE)
    assert config.load().devices == {}


def test_a_device_that_answers_for_one_model_alone_tells_it(serve: Callable[..., Any]) -> None:
    with serve(model="1ZC") as running:
        found = target.identified(target.parse(f"tcp:{running.host}:{running.port}"))
    assert found.model == "athena/series-c:1ZC"


def test_models_that_answer_alike_are_named_and_none_is_guessed(running: Running) -> None:
    with pytest.raises(TargetError, match="model=16C or model=CN8200"):
        target.identified(target.parse(f"tcp:{running.host}:{running.port}"))


def test_a_unit_that_is_silent_is_no_unknown_device(serve: Callable[..., Any]) -> None:
    with (
        serve(transport="rtu-tcp") as running,
        pytest.raises(NoAnswer),
    ):
        target.identified(target.parse(f"tcp:{running.host}:{running.port}?framing=rtu&unit=9&timeout=0.05"))


def test_a_device_that_shows_to_be_another_is_refused_by_name(running: Running) -> None:
    named = target.parse(f"tcp:{running.host}:{running.port}?model=25C")
    with target.connect(named) as device, pytest.raises(TargetError, match="does not show to be a 25C"):
        target.check_identity(device, named)


def test_a_link_without_its_first_word_is_told_how_to_write_it() -> None:
    for text in ("10.0.0.7:502", "[::1]:502?model=16C"):
        with pytest.raises(TargetError, match=re.escape(f"of a link write tcp:{text}")):
            target.parse(text)
