"""regscribe: a register-map compiler for Modbus.

Rooms, in the order of the pipeline: source, schema, lower, checks, emit; beside them model (the vocabulary of all),
runtime (what generated drivers import), simulate and cli.
"""

__version__ = "0.1.0"
