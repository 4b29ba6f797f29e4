"""Settings go from a device into a file and from there into another device, whole or not at all unreported."""

import asyncio
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from regscribe.tools import settings
from regscribe.tools.settings import Backup, Saved, UnfitError
from regscribe_devices.athena.series_c import AsyncAthena16C
from regscribe_runtime import RegscribeError
from regscribe_runtime.link.connect import async_tcp

Serve = Callable[..., Any]
MODELS = (
    ("athena/series-c", "16C"),
    ("omega/cn8200", "CN8240"),
    ("athena/platinum-c10-m10", "M10"),
    ("athena/platinum-m300", "M300"),
    ("athena/platinum-m400", "M400"),
    ("athena/platinum-m5000", "M5000"),
    ("athena/platinum-x100-x400", "X400"),
    ("athena/platinum-x5000", "X5000"),
    ("fdc/series-100", "BTC-9100"),
)


def take(driver: Any) -> Backup:
    found: Backup = driver.run(settings.backup(type(driver)))
    return found


def bring(driver: Any, backup: Backup, **options: Any) -> Any:
    return driver.run(settings.restore(type(driver), backup, confirm=True, **options))


def same(one: Backup, other: Backup) -> bool:
    return not settings.differences(settings.Side.of(one, "one"), settings.Side.of(other, "other"))


def edited(backup: Backup, **values: Any) -> Backup:
    """The backup with other values, without the words of the old ones."""
    groups = {
        name: {path: Saved(value=values[path], unit=one.unit) if path in values else one for path, one in group.items()}
        for name, group in backup.groups.items()
    }
    return replace(backup, groups=groups)


def moved(driver: Any, backup: Backup) -> Backup:
    """The backup with another value wherever the next number or name is one."""
    found = {}
    for path, saved in backup.settings():
        members = list(getattr(driver.registers[path].value_type.make, "__members__", ()))
        if saved.stays or saved.value is None or isinstance(saved.value, list) or path == "display_unit_of_measure":
            continue
        if members:
            found[path] = members[(members.index(str(saved.value)) + 1) % len(members)]
        elif isinstance(saved.value, (int, float)) and not isinstance(saved.value, bool):
            found[path] = saved.value + 1
    return edited(backup, **found)


@pytest.mark.parametrize(("name", "model"), MODELS)
def test_what_one_device_was_set_to_another_of_its_model_holds_after_a_restore(
    serve: Serve, name: str, model: str, tmp_path: Path
) -> None:
    file = tmp_path / "one.yaml"
    with serve(name, model) as one:
        before = take(one.driver)
        bring(one.driver, moved(one.driver, before), partial=True)
        kept = take(one.driver)
        settings.save(file, settings.to_text(kept))
    changed = settings.differences(settings.Side.of(before, "before"), settings.Side.of(kept, "kept"))
    assert len(changed) > 10
    assert settings.load(file) == kept
    with serve(name, model) as other:
        bring(other.driver, settings.load(file))
        assert same(take(other.driver), kept)
        sent = len(other.requests)
        again = bring(other.driver, kept)
        assert set(again.report.paths()) == set()
        assert all(request[0] in {1, 2, 3, 4} for request in other.requests[sent:] if not applies(other, request))


def applies(bench: Any, request: bytes) -> bool:
    commands = type(bench.driver).commands.commands().values() if hasattr(type(bench.driver), "commands") else ()
    steps = [step for command in commands for step in command.steps]
    return any(request[0] == step.function and request[1:3] == step.address.to_bytes(2) for step in steps)


CHANGES = {
    ("athena/series-c", "16C"): {
        "display_unit_of_measure": "CELSIUS",
        "input_bias": 3.0,
        "setpoint_low_limit": 10.0,
        "setpoint_high_limit": 900.0,
        "setpoint_eeprom_and_ram": 850.0,
        "alarm_1_delay": 7,
    },
    ("athena/platinum-x5000", "X5000"): {"integral_time": 11, "derivative_time": 12, "cycle_time": 13},
}


@pytest.mark.parametrize("after", [False, True], ids=["before it was sent", "after it was carried out"])
@pytest.mark.parametrize(("name", "model"), CHANGES)
@pytest.mark.usefixtures("hurried")
def test_a_restore_that_is_cut_off_at_any_request_is_completed_by_the_next(
    serve: Serve, name: str, model: str, *, after: bool
) -> None:
    with serve(name, model) as whole:
        wanted = {path: value for path, value in CHANGES[name, model].items() if path in whole.driver.registers}
        goal = edited(in_unit(take(whole.driver), wanted), **wanted)
        assert len(wanted) >= 3
    for at in range(1, 200):
        with serve(name, model, at=at, after=after) as bench:
            try:
                bring(bench.driver, goal)
            except RegscribeError:
                assert bench.driver.link.broken
            if not bench.driver.link.broken:
                break
            bench.driver.link = bench.driver.link._link
            bench.driver.link.close()
            bench.driver.link.open()
            bring(bench.driver, goal)
            held = dict(take(bench.driver).settings())
            assert {path: held[path].value for path in wanted} == wanted, at
            assert_in_effect(bench)
    else:
        pytest.fail("the restore never came to its end")
    assert at > len(wanted)


def in_unit(backup: Backup, values: dict[str, Any]) -> Backup:
    """The backup as it would be taken under another unit of measure."""
    if values.get("display_unit_of_measure") != "CELSIUS":
        return backup
    groups = {
        name: {
            path: Saved(value=one.value, unit="°C", stays=one.stays) if one.unit == "°F" and path in values else one
            for path, one in group.items()
            if one.unit != "°F" or path in values
        }
        for name, group in backup.groups.items()
    }
    return replace(backup, groups=groups)


def assert_in_effect(bench: Any) -> None:
    """Whatever must be applied was applied after the last write to it."""
    names = {register.apply for register in bench.driver.registers.values() if register.apply}
    if names:
        assert bench.device.commands_run[-1] in names
        writes = [request for request in bench.requests if request[0] in {5, 6, 15, 16}]
        assert applies(bench, writes[-1])


def test_settings_that_belong_to_one_device_are_kept_and_written_only_when_included(serve: Serve) -> None:
    with serve("athena/series-c", "16C") as one:
        one.device.poke("span_100_mv", 1.5)
        kept = take(one.driver)
    assert kept.groups["calibration"]["span_100_mv"].stays == "calibration"
    with serve("athena/series-c", "16C") as other:
        done = bring(other.driver, kept, dry_run=True)
        assert done.fit.stays["span_100_mv"] == "calibration"
        assert "span_100_mv" not in done.fit.values
        assert "span_100_mv" in bring(other.driver, kept, dry_run=True, include={"calibration"}).fit.values


def test_a_dry_run_writes_nothing_and_tells_what_it_would(serve: Serve) -> None:
    with serve("athena/series-c", "16C") as bench:
        goal = edited(take(bench.driver), input_filter=9.0)
        sent = len(bench.requests)
        done = bring(bench.driver, goal, dry_run=True)
        assert [(one.register, one.was, one.value) for one in done.report.changes if one.fate != "equal"] == [
            ("input_filter", 5.0, 9.0)
        ]
        assert {request[0] for request in bench.requests[sent:]} == {3}


def test_words_in_the_other_word_order_mean_what_they_meant_on_their_device(serve: Serve) -> None:
    with serve("athena/series-c", "16C") as one:
        one.device.poke("ieee_register_ordering", 0)
        one.device.poke("input_filter", 9)
        kept = take(one.driver)
    with serve("athena/series-c", "16C") as other:
        done = bring(other.driver, kept)
        assert done.fit.misfits == ()
        assert other.device.peek("input_filter") == 9


def test_a_value_in_another_unit_than_the_device_will_work_in_does_not_fit(serve: Serve) -> None:
    with serve("athena/series-c", "16C") as bench:
        kept = edited(take(bench.driver), display_unit_of_measure="CELSIUS")
        with pytest.raises(UnfitError, match=r"input_bias: it stands in °F, but with these settings .* °C"):
            bring(bench.driver, kept)
        assert bench.device.peek("display_unit_of_measure") == 1


def test_words_that_contradict_their_value_are_refused(serve: Serve) -> None:
    with serve("athena/series-c", "16C") as bench:
        kept = take(bench.driver)
        entry = replace(kept.groups["display"]["linear_decimal_position"], value=2)
        groups = {**kept.groups, "display": {**kept.groups["display"], "linear_decimal_position": entry}}
        with pytest.raises(UnfitError, match=r"the file says 2, but its words \[0\] mean 0"):
            bring(bench.driver, replace(kept, groups=groups))


def test_a_file_of_another_model_says_so_and_gives_what_fits_when_asked(serve: Serve) -> None:
    with serve("athena/series-c", "1ZC") as one:
        kept = edited(take(one.driver), input_filter=9.0)
    with serve("athena/series-c", "18C") as other:
        with pytest.raises(UnfitError, match="the file is of a 1ZC, the device is a 18C") as refusal:
            bring(other.driver, kept)
        assert "output_1_alarm_action: there is no register `output_1_alarm_action` in 18C" in str(refusal.value)
        done = bring(other.driver, kept, partial=True)
        assert other.device.peek("input_filter") == 9
        assert {one.path for one in done.fit.misfits} >= {"output_1_alarm_action"}


def test_a_file_of_another_version_of_the_map_says_so(serve: Serve) -> None:
    with serve("athena/series-c", "16C") as bench:
        kept = take(bench.driver)
        old = replace(kept, origin=replace(kept.origin, map_sha256="0" * 16))
        with pytest.raises(UnfitError, match="another version of the map athena/series-c"):
            bring(bench.driver, old)


def test_what_was_changed_since_the_factory_is_what_differs_from_the_manuals_defaults(serve: Serve) -> None:
    with serve("athena/series-c", "16C") as bench:
        driver = type(bench.driver)
        bench.device.poke("input_filter", 9)
        left = settings.Side.of(take(bench.driver), "now")
        right = settings.Side("factory", driver.map_id, driver.model, settings.factory(driver))
        found = settings.differences(left, right, missing=False)
    assert [(one.path, one.left.value, one.right.value) for one in found if one.left and one.right] == [
        ("input_filter", 9.0, 5.0),
        ("access_level", "CONFIGURATION", "FACTORY"),  # delivered with another value than its default
    ]


def test_a_setting_without_a_value_is_kept_with_its_words_and_the_reason(serve: Serve) -> None:
    with serve("athena/series-c", "16C") as bench:
        bench.device.state.store("ieee_register_ordering", 9)
        kept = dict(take(bench.driver).settings())
        filter_ = kept["input_filter"]
        assert (filter_.value, filter_.raw) == (None, bench.device.peek_words("input_filter", "ieee"))
        assert "ieee_register_ordering" in filter_.error
        saved = take(bench.driver)
        assert "input_filter" in bring(bench.driver, saved).report.equal
        bench.device.state.store("input_filter", 9)
        with pytest.raises(UnfitError, match="input_filter: the file has no value for it"):
            bring(bench.driver, saved)
        snapshot = bench.driver.read(type(bench.driver).input_filter, type(bench.driver).input_type)
        assert list(snapshot.valid) == ["input_type"]


def test_an_asyncio_driver_backs_up_and_restores_too(serve: Serve) -> None:
    async def travel(host: str, port: int) -> tuple[Backup, Any]:
        async with AsyncAthena16C(async_tcp(host, port=port), unit=1) as driver:
            kept = await driver.run(settings.backup(AsyncAthena16C))
            return kept, await driver.run(settings.restore(AsyncAthena16C, edited(kept, input_filter=9.0)))

    with serve("athena/series-c", "16C") as bench:
        kept, done = asyncio.run(travel(bench.host, bench.port))
        assert dict(kept.settings())["input_filter"].value == 5
        assert done.report.written == ("input_filter",)
        assert bench.device.peek("input_filter") == 9
