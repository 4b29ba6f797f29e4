"""Two maps are held against each other, model by model."""

from collections.abc import Callable

import pytest

from regscribe.evidence.compare import compare_maps
from regscribe.evidence.table import TableError
from regscribe.model import RegisterMap

Load = Callable[[str], RegisterMap]


@pytest.fixture(scope="module")
def sibling(load: Load, text: str) -> RegisterMap:
    """The same device under other names, with another default and without the status."""
    changed = text.replace("acme/kiln", "omega/kiln").replace("K1", "CN1").replace("K2", "CN2")
    changed = changed.replace("      - {at: 3, name: Status, access: r, flags: {0: alarm, 3: open loop}}\n", "")
    return load(changed.replace("default: 25", "default: 20"))


def test_a_map_equals_itself(kiln: RegisterMap) -> None:
    found = compare_maps(kiln, kiln)
    assert (found.equal, found.matched) == (True, 19)


def test_models_of_other_names_are_paired_by_order(kiln: RegisterMap, sibling: RegisterMap) -> None:
    found = compare_maps(kiln, sibling)
    assert {(one.place.model, one.column, one.ours, one.theirs) for one in found.differences} == {
        ("K1 = CN1", "default", "25", "20"),
        ("K2 = CN2", "default", "25", "20"),
    }
    assert [(one.model, one.id) for one in found.only_ours] == [("K1 = CN1", "status"), ("K2 = CN2", "status")]
    assert found.only_theirs == ()


def test_pairs_choose_the_models_and_the_others_are_told(kiln: RegisterMap, sibling: RegisterMap) -> None:
    found = compare_maps(kiln, sibling, pairs={"K2": "CN1"}, columns=["name"])
    assert [(one.model, one.id) for one in found.only_theirs] == [("K2 = CN1", "gain")]
    assert found.differences == ()
    assert found.notes == ("acme/kiln: not compared: K1", "omega/kiln: not compared: CN2")


def test_families_of_other_sizes_must_be_paired_by_hand(kiln: RegisterMap, load: Load, text: str) -> None:
    one = load(text.replace("models: {K1: {}, K2: {}}", "models: {CN1: {}}").replace(", except: [K2]", ""))
    with pytest.raises(TableError, match=r"has K1, K2 and .* has CN1: say .* --pair K2=CN1"):
        compare_maps(kiln, one)


def test_models_of_the_same_name_belong_together_whatever_their_order(kiln: RegisterMap, load: Load, text: str) -> None:
    turned = load(text.replace("{K1: {}, K2: {}}", "{K2: {}, K1: {}}"))
    assert compare_maps(kiln, turned).equal


def test_a_column_that_the_export_has_not_is_refused(kiln: RegisterMap) -> None:
    with pytest.raises(TableError, match="there is no column `colour`"):
        compare_maps(kiln, kiln, columns=["colour"])
