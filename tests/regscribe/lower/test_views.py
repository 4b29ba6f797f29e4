from collections.abc import Callable
from fractions import Fraction

from regscribe.model import Order, Register, Rounding, Space, View, WireType, order_from

Registers = Callable[..., dict[str, Register]]

TABLES = """
    views:
      fraction:
        x10: {offset: 1000, type: int16, factor: 10, rounding: half_up, saturates: true, region: 1000..1999}
        base: {type: int16, rounding: half_up}
        ieee: {offset: 8000, stride: 2, type: float32, word_order: {register: order, codes: {0: big, 1: little}},
               functions: [3, 16], align: 2, preferred: true}
"""
ORDER = "- {at: 4084, name: Order, type: int16, enum: {0: big, 1: little}}\n"


def test_the_address_of_a_view_is_its_offset_plus_stride_times_at(registers: Registers) -> None:
    found = registers(f"{ORDER}- {{at: 7, name: Level, views: fraction}}", tables=TABLES, each="{access: rw}")["level"]
    assert [(view.name, view.address(found.at), view.words) for view in found.views] == [
        ("base", 7, 1),
        ("x10", 1007, 1),
        ("ieee", 8014, 2),
    ]
    assert found.views[1] == View(
        "x10",
        WireType.INT16,
        offset=1000,
        factor=Fraction(10),
        rounding=Rounding.HALF_UP,
        saturates=True,
        region=(1000, 1999),
    )
    assert found.preferred.name == "ieee"
    assert found.views[2].order == order_from("order", ((0, Order.BIG), (1, Order.LITTLE)))
    assert (found.views[2].functions, found.views[2].align, found.views[2].stride) == ((3, 16), 2, 2)


def test_without_views_the_type_makes_the_only_view(registers: Registers) -> None:
    line = "- {at: 9, name: Total, type: uint32, word_order: little, byte_order: little, functions: [3]}"
    (view,) = registers(line)["total"].views
    assert (view.name, view.type, view.words, view.functions) == ("base", WireType.UINT32, 2, (3,))
    assert (view.order, view.byte_order) == (Order.LITTLE, Order.LITTLE)


def test_the_type_is_an_unsigned_word_unless_told(registers: Registers) -> None:
    assert registers("- {at: 9, name: Total}", each="{access: r}")["total"].base.type is WireType.UINT16


def test_a_coil_is_a_bit_and_a_status_a_byte_unless_told(registers: Registers) -> None:
    lines = "- {at: 9, name: Relay, space: coil}\n- {at: 0, name: Status, space: status}"
    found = registers(lines, each="{access: r}")
    assert (found["relay"].base.type, found["relay"].base.space) == (WireType.BIT, Space.COIL)
    assert found["status"].base.type is WireType.UINT8


def test_a_string_takes_its_length_in_words(registers: Registers) -> None:
    assert registers("- {at: 9, name: Tag, type: string, length: 3}")["tag"].base.words == 3


def test_a_type_of_the_register_replaces_the_views_of_the_group(registers: Registers) -> None:
    found = registers(f"{ORDER}- {{at: 9, name: Tag, type: int16}}", tables=TABLES, each="{access: r, views: fraction}")
    assert [view.address(found["tag"].at) for view in found["tag"].views] == [9]
