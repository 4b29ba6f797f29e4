"""Whole tables, dirty as vendors write them: nothing is silently wrong, and what is not sure is said."""

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import pytest

from regscribe.model import Access, Space

Import = Callable[..., Any]

HEAT_PUMP = """\
Registerliste Wärmepumpe WP-3;;;;;;;;
Register;Bezeichnung;Datentyp;Einheit;Faktor;Min;Max;Zugriff;Bemerkung
30001;Aussentemperatur;INT16;°C;0,1;-50,0;80,0;L;
30002;Vorlauf;INT16;°C;0,1;0;100;L;
30003;Menge;UINT32;kWh;0,001;;;L;Lo-Hi
40001;Betriebsart;UINT16;;;0;3;L/S;0=Aus, 1=Auto, 2=Heizen, 3=Testbetrieb
40002;Sollwert;INT16;°C;0,1;100;300;L/S;
40003;Kennlinie;UINT16;;1;0;1.000;L/S;
Bitmeldungen;;;;;;;;
10001;Alarm;BIT;;;;;L;
00001;Pumpe ein;BIT;;;;;S;
40010.0;Freigabe;BOOL;;;;;L/S;
40010.1;Sommer;BOOL;;;;;L/S;
* Werte nach Neustart unbestimmt;;;;;;;;
"""


def test_a_german_list_with_modicon_numbers_decimal_commas_and_bits(imported: Import) -> None:
    found = imported("table", HEAT_PUMP)
    assert found.left_out == {}
    outside = found.register("aussentemperatur")
    assert (outside.at, outside.base.space) == (0, Space.INPUT)
    assert found.value("aussentemperatur", 0xFFFB) == Fraction(-5, 10)
    assert found.value("menge", 0x0001, 0x0000) == Fraction(1, 1000)  # the remark says the low word first
    assert found.members("betriebsart") == {0: "Aus", 1: "Auto", 2: "Heizen", 3: "Testbetrieb"}
    assert found.register("pumpe_ein").access is Access.WRITE
    assert found.bits("bits_of_holding_9") == {"Freigabe": (0, 0), "Sommer": (1, 1)}


def test_ranges_with_a_point_show_that_all_count_values(imported: Import) -> None:
    found = imported("table", HEAT_PUMP)
    assert "range: -50..80" in found.text
    assert "name: Sollwert, access: rw, type: int16, decimals: 1, unit: °C, range: 100..300" in found.text
    assert "range: 0..1000" in found.text  # 1.000 has a separator of thousands, as others have decimal commas


GATEWAY = """\
variable name,data type,register,unit,values,writable
pv voltage,USHORT,3,0.1V,,R
frequency,USHORT,x21D,0.01H Z,,R
current,SHORT,5,-0.1A,,R
serial,ASCII,7~10,,,R
mode,USHORT,15,,0 :Disable1: enable,RW
state,2bit,x20.b3,,0:waiting 1:normal 3:fault,R
temperature,USHORT,17,01.c,,R
delay,USHORT,18,20ms,,RW
faults,16bit_flags,21,,"{""b0"": ""over"", ""b1"": ""under""}",R
"""


def test_scales_in_units_ranges_of_addresses_and_parts_of_words(imported: Import) -> None:
    found = imported("table", GATEWAY)
    assert found.left_out == {}
    assert found.value("pv_voltage", 2301) == Fraction(2301, 10)
    assert (found.register("frequency").at, found.value("frequency", 5001)) == (0x21D, Fraction(5001, 100))
    assert found.register("serial").base.words == 4
    assert found.members("mode") == {0: "Disable", 1: "enable"}
    assert found.bits("state") == {"state": (3, 4)}
    assert found.value("delay", 3) == 60
    assert found.bits("faults") == {"over": (0, 0), "under": (1, 1)}


@pytest.mark.parametrize("name", ["current", "temperature"])
def test_a_unit_that_may_hold_a_scale_leaves_the_number_raw(imported: Import, name: str) -> None:
    found = imported("table", GATEWAY)
    assert "scale-unclear" in found.codes(name)
    assert found.value(name, 100) == 100
    assert f"name: {name}, access: r" in found.text
    assert found.text.count("decimals: not_stated") == 2


METER = """\
Parameter,Modbus Register (hex),Register (dec),Length,Format,Unit,R/W,Function
Voltage,0x0000,30001,2,Float,V,R,04
Energy,0x0156,30343,2,Float,kWh,R,04
Serial number,0xFC00,464513,2,UINT32,,R,03
Baud rate,0x001C,40029,2,Float,,R/W,03/16
Pulse width,0x000C,40013,1,UINT16,ms,R/W,03/16
Wrong,0x0010,40099,1,UINT16,,R/W,03
"""


def test_two_columns_of_addresses_show_base_and_space(imported: Import) -> None:
    found = imported("table", METER)
    assert (found.register("voltage").at, found.register("voltage").base.space) == (0, Space.INPUT)
    assert (found.register("energy").at, found.register("energy").base.space) == (0x156, Space.INPUT)
    assert (found.register("serial_number").at, found.register("serial_number").base.space) == (0xFC00, Space.HOLDING)
    assert (found.register("baud_rate").at, found.register("baud_rate").access) == (28, Access.READ_WRITE)
    assert list(found.left_out) == ["Wrong"]
    assert "`0x0010` and `40099`" in found.left_out["Wrong"]


def test_functions_alone_show_what_can_be_written(imported: Import) -> None:
    found = imported("table", "Address,Name,Type,Function\n1,A,U16,03\n2,B,U16,03/06\n3,C,U16,06\n4,D,U16,04\n")
    accesses = [found.register(name).access for name in "abcd"]
    assert accesses == [Access.READ, Access.READ_WRITE, Access.WRITE, Access.READ]


INVERTER = """\
Signal name,Read/Write,Type,Unit,Gain,Address,Quantity,Scope
Model,RO,STR,N/A,1,30000,15,N/A
PV voltage,RO,I16,V,10,32016,1,N/A
PV current,RO,I16,A,100,32017,1,N/A
Active power,RO,I32,kW,1000,32080,2,N/A
Power factor,RO,I16,N/A,1000,32084,1,"[-1.000, 1.000]"
Status,RO,U16,N/A,1,32089,1,"0x0000: Standby: idle\n0x0100: Starting"
Alarm,RO,Bitfield16,N/A,1,32008,1,
Compensation,RW,I16,N/A,1000,40122,1,"(-1, -0.8] U [0.8, 1]"
"""


def test_gains_divide_and_quantities_are_registers(imported: Import) -> None:
    found = imported("table", INVERTER)
    assert found.left_out == {}
    assert found.register("model_register").base.words == 15
    assert found.value("pv_current", 1234) == Fraction(1234, 100)
    assert found.value("active_power", 0, 1500) == Fraction(15, 10)
    assert "range: -1..1" in found.text
    assert found.members("status") == {0: "Standby: idle", 256: "Starting"}
    assert found.codes("Compensation") == ["range-unclear"]
    assert found.codes("Alarm") == ["bits-unnamed"]


BUS = """\
Note: subject to change
description,Address,Type,Scalefactor,Range,writable,dbus-unit
Battery voltage,259,uint16,100,0 to 655.36,no,V DC
Current,261,in16,10,-3276.8 to 3276.7,no,A DC
Temperature,262,int16,10,-3276.8 to 3276.7,no,Degrees celsius
Serial,800,string[6],1,12 characters,no,
Relay,806,uint16,1,0 to 65536,yes,0=Open;1=Closed
Energy,807,unit32,0.1,0 to 4294967295,no,kWh
"""


def test_ranges_show_that_mixed_factors_divide_and_typos_are_left_out_with_a_proposal(imported: Import) -> None:
    found = imported("table", BUS)
    assert found.value("battery_voltage", 1234) == Fraction(1234, 100)
    assert found.register("serial").base.words == 6  # it ends just before the next row
    assert found.members("relay") == {0: "Open", 1: "Closed"}
    assert found.codes("Battery voltage") == ["range-unclear"]  # 65536 is one too many
    assert "perhaps `int16`" in found.left_out["Current"]
    assert "perhaps `uint32`" in found.left_out["Energy"]
    assert "range-lost" in found.codes("Serial")


def test_a_row_whose_type_has_no_order_of_its_own_takes_the_one_in_its_description(imported: Import) -> None:
    head = "Address,Name,Type,Description\n"
    found = imported("table", f"{head}1,A,U32,value (low word first)\n3,B,U32,little endian\n5,C,U32,\n")
    assert found.value("a", 1, 0) == 1
    assert found.value("c", 0, 1) == 1
    assert "CDAB" in found.left_out["B"]


def test_equal_limits_in_many_rows_are_no_range_and_their_default_is_none(imported: Import) -> None:
    head = "Title;ID;Unit;Size;Factor;Min;Max;Default;Mode\n"
    rows = "A;40004;°C;s16;10;0;0;0;R\nB;40005;;s16;1;0;0;0;R\nC;47007;;s8;1;0;15;9;R/W\n"
    found = imported("table", head + rows)
    assert found.value("a", 215) == Fraction(215, 10)
    assert found.text.count("range:") == found.text.count("default:") == 1
    assert "{at: 7006, name: C, access: rw, type: int8, range: 0..15, default: 9}" in found.text


METER_WITH_REMARKS = """\
Address,Name,Type,Unit,Access,Description
0,Setpoint,S16,°C (x0.1),RW,
1,Pressure,U16,bar,R,1 = 0.01 bar
2,Flow,U16,m3/h,R,Value is scaled by factor 100
3,Level,U16,%,R,level of tank 10
4,Power,U16,W*10,R,
5,Ready,BOOL,,R,
6,Status,Bitmap,,R,"bit 0: pump, bit 1: valve, bits 4-7: stage"
"""


def test_a_scale_in_a_remark_is_read_alone_and_doubted_among_other_words(imported: Import) -> None:
    found = imported("table", METER_WITH_REMARKS)
    assert found.value("setpoint", 215) == Fraction(215, 10)
    assert found.value("pressure", 215) == Fraction(215, 100)
    assert found.codes("Flow") == found.codes("Power") == ["scale-unclear"]
    assert found.codes("Level") == []


def test_a_boolean_in_a_register_and_parts_of_a_bitmap(imported: Import) -> None:
    found = imported("table", METER_WITH_REMARKS)
    assert found.value("ready", 1) == 1
    assert found.bits("status") == {"pump": (0, 0), "valve": (1, 1), "stage": (4, 7)}


def test_coils_and_discrete_inputs_by_their_numbers(imported: Import) -> None:
    found = imported("table", "Coil,Description,R/W\n00001,Pump,R/W\n00002,Valve,R/W\n10001,Door,R\n")
    assert (found.register("valve").at, found.register("valve").base.space) == (1, Space.COIL)
    assert found.register("door").base.space is Space.DISCRETE


NAMED_VALUES = """\
Address,Name,Type,Unit,Scale,Range,Access,Values
0,Timer,U16,min,,0..120,RW,0=off
1,Setpoint,S16,°C,0.1,-20..60,RW,-999=no sensor
2,Speed,U16,%,,0..100,RW,"0=off, 101=auto"
3,Temperature,S16,°C,0.1,,R,"32767=open, -32768=short"
4,Mode,U16,,,0..65535,RW,"0=off, 1=on, 2=auto"
5,Delay,U16,s,,,RW,"0=off; 1..3600=seconds"
6,Level,U16,,,,R,0=empty
"""


def test_codes_beside_a_number_are_values_with_names_and_no_enum(imported: Import) -> None:
    found = imported("table", NAMED_VALUES)
    assert found.value("timer", 7) == found.value("level", 7) == found.value("delay", 7) == 7
    assert "unit: min, special: {0: 'off'}, range: 0..120" in found.text
    assert "special: {0: 'off', 101: auto}, range: 0..100" in found.text
    assert found.value("temperature", 215) == Fraction(215, 10)
    assert "special: {3276.7: open, -3276.8: short}" in found.text  # they fit the type as stored numbers alone
    assert found.members("mode") == {0: "off", 1: "on", 2: "auto"}


@pytest.mark.parametrize("unit", ["-", "N/A", "enum"])
def test_codes_in_a_remark_count_where_the_unit_says_that_there_is_none(imported: Import, unit: str) -> None:
    found = imported("table", f"Register,Name,Type,Unit,Remark\n0,Mode,U16,{unit},0: Off; 1: Cool\n")
    assert "enum: {0: 'Off', 1: Cool}" in found.text


@pytest.mark.parametrize("unit", ["s", "F"])
def test_codes_in_a_remark_are_no_enum_beside_a_unit(imported: Import, unit: str) -> None:
    found = imported("table", f"Register,Name,Type,Unit,Remark\n0,Mode,U16,{unit},0: Off; 1: Cool\n")
    assert "enum" not in found.text


def test_a_code_that_may_count_both_is_asked_for(imported: Import) -> None:
    found = imported("table", NAMED_VALUES)
    assert found.codes("Setpoint") == ["codes-unclear", "range-unclear"]
    assert "# TODO code -999 is not in the map: the number -999 may count values, or stored numbers" in found.text


def test_the_name_of_a_scale_factor_is_the_register_that_holds_it(imported: Import) -> None:
    rows = "2,A,uint16,A_SF,A\n6,A_SF,sunssf,,\n7,W,int16,W_SF,W\n9,WH,acc32,-3,Wh\n"
    found = imported("table", f"Address Offset,Name,Type,Scale Factor,Units\n{rows}")
    assert "name: A, access: r, exponent: a_sf, unit: A" in found.text
    assert found.codes("W") == ["scale-unclear"]  # the table has no register W_SF
    assert found.value("wh", 0, 1500) == Fraction(15, 10)


CONTRARY = """\
Address,Name,Type,Unit,Range,Access,Description
0,Voltage (0.1 V),U16,,,R,
1,Current (x0.01A),U16,A,,R,
2,Power (*10),U16,W,,R,
3,Angle,WORD,,,R,signed
4,Temperature,U16,°C,-50..150,R,
5,Date,UINT,,,R,packed BCD
6,Speed (motor 2),U16,rpm,0..3000,R,unsigned
7,Offset,S16,,-50..150,R,signed
"""


def test_a_scale_in_brackets_behind_a_name_counts(imported: Import) -> None:
    found = imported("table", CONTRARY)
    assert found.value("voltage_0_1_v", 2301) == Fraction(2301, 10)
    assert "unit: V" in found.text
    assert found.value("current_x0_01a", 2301) == Fraction(2301, 100)
    assert found.codes("Power (*10)") == ["scale-unclear"]
    assert found.value("speed_motor_2", 1500) == 1500


def test_a_remark_or_a_range_against_the_type_leaves_the_row_out(imported: Import) -> None:
    found = imported("table", CONTRARY)
    assert list(found.left_out) == ["Angle", "Temperature", "Date"]
    assert "`signed`" in found.left_out["Angle"]
    assert "begins at -50" in found.left_out["Temperature"]
    assert "`BCD`" in found.left_out["Date"]
    assert found.value("offset", 0xFFFF) == -1


FRENCH = """\
Adresse;Désignation;Type;Unité;Coefficient;Accès;Commentaire
@100;Depart;Entier 16 bits signé;°C;0,1;Lecture;
@102;Energie;Mot double;kWh;1;L;
@104;Debit;Réel;m3/h;;L;poids faible en premier
@106;Marche;Booléen;;;L/E;0 : arrêt / 1 : marche
@107;Etat;Mot;;;L;bit 0 = défaut, bit 1 = alarme
"""


def test_a_french_list(imported: Import) -> None:
    found = imported("table", FRENCH)
    assert found.left_out == {}
    assert found.value("depart", 0xFFFF) == Fraction(-1, 10)
    assert found.value("debit", 0x0000, 0x3FC0) == Fraction(3, 2)  # 1.5 is 3FC00000, low word first
    assert found.members("marche") == {0: "arrêt", 1: "marche"}
    assert found.bits("etat") == {"défaut": (0, 0), "alarme": (1, 1)}


def test_a_column_of_valid_values_may_have_ranges_and_codes(imported: Import) -> None:
    rows = '1,V,UInt16,10,V,0-6553.5\n2,Mode,UInt16,,,"0 (Off), 1 (On)"\n3,F,UInt16,100,Hz,45.00-65.00\n'
    found = imported("table", f"Register,Description,Data Type,Scale Factor,Units,Valid Values\n{rows}")
    assert "range: 0..6553.5" in found.text
    assert "range: 45..65" in found.text
    assert found.members("mode") == {0: "Off", 1: "On"}


def test_a_name_and_a_column_that_say_different_scales_leave_the_number_raw(imported: Import) -> None:
    rows = "0,Voltage (0.1 V),U16,10\n1,Current (0.1 A),U16,1\n2,Power (0.1 W),F32,1\n"
    found = imported("table", f"Address,Name,Type,Gain\n{rows}")
    assert found.value("voltage_0_1_v", 2301) == Fraction(2301, 10)
    assert found.codes("Current (0.1 A)") == ["scale-unclear"]
    assert found.codes("Power (0.1 W)") == []  # a float needs no scale, so this is how fine it is


def test_a_default_may_contradict_what_a_range_shows_of_scales(imported: Import) -> None:
    rows = "0,A,U16,0.1,0,100.5,50\n1,B,INT16,10,-10,10,1.5\n"  # A multiplies, B divides
    found = imported("table", f"Address,Name,Type,Scale,Min,Max,Default\n{rows}")
    assert "scale-unclear" in found.codes("A")
    assert "scale-unclear" in found.codes("B")
