"""The same made-up device as a map and as SystemRDL: every fifth register has an enum, every tenth bit fields."""

ENUM = '{0: "off", 1: low, 2: high, 3: boost}'
FIELDS = "{mode: {bits: 4..7}, alarm: {bit: 0}, fault: {bit: 1}}"


def yaml_map(registers: int) -> str:
    """A map of so many registers."""
    rows = []
    for number in range(registers):
        name = f"name: Parameter {number}, at: {number}"
        if number % 10 == 0:
            rows.append(f"      - {{{name}, fields: {FIELDS}}}")
        elif number % 5 == 0:
            rows.append(f"      - {{{name}, enum: level, default: 1}}")
        elif number % 2:
            rows.append(f"      - {{{name}, decimals: 1, type: int16, range: -100.0..500.0, unit: °C, default: 20}}")
        else:
            rows.append(f"      - {{{name}, range: 0..1000, default: 5}}")
    return "\n".join(
        [
            "format: 1",
            "map: {id: bench/synthetic, title: Synthetic, maker: Bench, class_prefix: Bench}",
            'manual: {title: No manual, number: "1"}',
            "models: {Unit: {}}",
            f"enums: {{level: {ENUM}}}",
            "groups:",
            "  - id: all",
            "    name: All",
            '    source: "1"',
            "    each: {access: rw}",
            "    registers:",
            *rows,
            "",
        ]
    )


def system_rdl(registers: int) -> str:
    """The same registers in SystemRDL, 16 bits each."""
    rows = []
    for number in range(registers):
        if number % 10 == 0:
            fields = "field {} alarm[0:0]; field {} fault[1:1]; field {} mode[7:4];"
        elif number % 5 == 0:
            fields = "field { encode = level_e; } value[15:0];"
        else:
            fields = "field {} value[15:0];"
        described = f'desc = "Parameter {number}";'
        rows.append(f"reg {{ {described} regwidth = 16; {fields} }} parameter_{number} @{2 * number:#x};")
    enum = "enum level_e { off = 0; low = 1; high = 2; boost = 3; };"
    return "\n".join(["addrmap synthetic {", "default sw = rw; default hw = r;", enum, *rows, "};", ""])
