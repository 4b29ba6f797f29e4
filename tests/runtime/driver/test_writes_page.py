"""What docs/writes.md shows is carried out against the simulator."""

import re
from pathlib import Path
from typing import Any

import pytest

from regscribe.model import RegisterMap
from regscribe.simulate import simulate
from regscribe.simulate.map_cache import find_map
from regscribe_runtime import Fate

ROOT = Path(__file__).parents[3]


def compiled(name: str) -> RegisterMap:
    return find_map(ROOT / "maps" / f"{name}.yaml")


def test_the_page_about_writes_can_be_carried_out(
    capsys: pytest.CaptureFixture[str],
) -> None:
    page = (ROOT / "docs" / "writes.md").read_text(encoding="utf-8")
    imports, single, several, refused, line = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    names: dict[str, Any] = {}
    exec(imports, names)  # noqa: S102 (the page is ours)
    with (
        simulate(compiled("athena/series-c"), "16C", unit=1) as running,
        simulate(compiled("athena/platinum-c10-m10"), "C10", unit=1) as other,
        names["Athena16C"].tcp(running.host, port=running.port, unit=1) as controller,
    ):
        names |= {"controller": controller, "other": other}
        exec(single, names)  # noqa: S102 (as above)
        assert controller.display_unit_of_measure.read() == 2
        exec(several, names)  # noqa: S102 (as above)
        assert names["report"].written == ("setpoint_high_limit", "rate", "setpoint_eeprom_and_ram")
        assert set(names["plan"].paths(Fate.PLANNED)) == {"rate", "auto_reset"}
        assert controller.rate.read() == 2.5
        exec(refused, names)  # noqa: S102 (as above)
        assert "rate: 5000" in capsys.readouterr().out
        exec(line, names)  # noqa: S102 (as above)
        assert controller.session.unit == running.device.unit == 7
        assert names["jbus"].link.addressing == "jbus"
