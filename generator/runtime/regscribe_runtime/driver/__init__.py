"""What users hold: devices, attributes, arrays, buses, identification; and the two executors."""
