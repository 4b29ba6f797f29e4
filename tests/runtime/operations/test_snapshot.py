"""What a read of several registers gives."""

import pytest

from regscribe_runtime import OutOfRange
from regscribe_runtime.operations.snapshot import Snapshot


def test_a_register_without_a_value_is_in_the_snapshot_and_raises_only_where_it_is_looked_up() -> None:
    snapshot = Snapshot({"flow": 5, "level": OutOfRange("level", "900 lies outside 0 to 600")})

    assert "flow" in snapshot
    assert "level" in snapshot
    assert "speed" not in snapshot
    with pytest.raises(OutOfRange):
        _ = snapshot["level"]
