"""Which requests read a set of registers at the least cost."""
