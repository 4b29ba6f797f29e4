"""Run by the Python of Home Assistant: polls a device as a configuration says, and prints the states as JSON.

    python home_assistant.py CONFIGURATION FOLDER [UNIQUE_ID...]

The switches named by their unique ids are turned on. The core runs with the integration `modbus` and nothing else.
"""

import asyncio
import json
import logging
import sys
from typing import Any

from homeassistant import bootstrap, config_entries, loader
from homeassistant.core import HomeAssistant
from homeassistant.helpers import entity_registry
from homeassistant.setup import async_setup_component
from homeassistant.util.yaml import load_yaml

PATIENCE = 60
"""Seconds until each entity has a state."""

SETTLED = 2
"""Seconds more for switches, which have one from the beginning."""

KINDS = ("sensors", "binary_sensors", "switches")


class Warned(logging.Handler):
    """Keeps what was warned of."""

    def __init__(self) -> None:
        """Without anything so far."""
        super().__init__(logging.WARNING)
        self.said: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        """Keep it."""
        self.said.append(f"{record.name}: {record.getMessage()}")


async def polled(configuration: str, folder: str, switches: list[str]) -> dict[str, Any]:
    """The state of every entity by its unique id, how many are configured, and what was warned of."""
    hass = await started(folder)
    config = await hass.async_add_executor_job(load_yaml, configuration)
    warned = Warned()
    logging.getLogger().addHandler(warned)
    accepted = await async_setup_component(hass, "modbus", config)
    await hass.async_block_till_done()
    wanted = sum(len(hub.get(kind, ())) for hub in config["modbus"] for kind in KINDS)
    for _ in range(PATIENCE * 10):
        states = [one.state for one in hass.states.async_all()]
        if len(states) == wanted and "unknown" not in states:
            break
        await asyncio.sleep(0.1)
    await asyncio.sleep(SETTLED)
    entities = entity_registry.async_get(hass)
    for unique_id in switches:
        target = entities.async_get_entity_id("switch", "modbus", unique_id)
        await hass.services.async_call("switch", "turn_on", {"entity_id": target}, blocking=True)
    said = list(warned.said)
    found = {entities.async_get(one.entity_id).unique_id: one.as_dict() for one in hass.states.async_all()}
    await hass.async_stop(force=True)
    return {"accepted": accepted, "wanted": wanted, "states": found, "said": said}


async def started(folder: str) -> HomeAssistant:
    """A core that runs in a folder, without anything set up."""
    hass = HomeAssistant(folder)
    hass.config.skip_pip = True
    hass.config_entries = config_entries.ConfigEntries(hass, {})
    loader.async_setup(hass)
    await bootstrap.async_load_base_functionality(hass)
    await hass.async_start()
    return hass


if __name__ == "__main__":
    print(json.dumps(asyncio.run(polled(sys.argv[1], sys.argv[2], sys.argv[3:])), default=str))  # noqa: T201 (a program)
