"""The frontend of Zabbix checks our templates as its import does: their structure, their words, the keys of items."""

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

from regscribe import plugins
from regscribe.map_files import shipped
from regscribe.simulate import find_map

from .install import consumer
from .stage import HERE, Stage

pytestmark = pytest.mark.interop("zabbix-frontend")


def checked(text: str, folder: Path) -> dict[str, Any]:
    """What the frontend finds wrong with a template, and how many items it sees."""
    template = folder / "template.yaml"
    template.write_text(text, encoding="utf-8")
    php = shutil.which("php")
    assert php is not None
    frontend = consumer("zabbix-frontend").folder / "usr" / "share" / "zabbix"
    command = [php, "-n", str(HERE / "programs" / "zabbix_import.php"), str(frontend), str(template)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)  # noqa: S603 (fixed)
    return dict(json.loads(done.stdout))


def test_the_template_of_the_device_is_one_that_zabbix_imports(stage: Stage, tmp_path: Path) -> None:
    text = stage.text("zabbix")
    assert checked(text, tmp_path) == {"faults": [], "items": text.count("\n          key: ")}


@pytest.mark.parametrize("name", ["athena/series-c", "omega/cn8200", "athena/platinum-m300"])
def test_templates_of_shipped_maps_are_such_too(name: str, tmp_path: Path) -> None:
    register_map = find_map(shipped() / f"{name}.yaml")
    options = {one.name: one.default for one in plugins.exporter("zabbix").options}
    options |= {"at": "h:502", "model": register_map.models[0].name}
    made = plugins.export("zabbix", [register_map], options)
    found = checked(str(made.texts[""]), tmp_path)
    assert found["faults"] == []
    assert found["items"] > 20


def test_the_frontend_finds_what_is_wrong(stage: Stage, tmp_path: Path) -> None:
    text = stage.text("zabbix")
    (fault,) = checked(text.replace("value_type: FLOAT", "value_type: REAL", 1), tmp_path)["faults"]
    assert "value_type" in fault
    (fault,) = checked(text.replace("uint16,be]", "uint16,be", 1), tmp_path)["faults"]
    assert "modbus.get" in fault
