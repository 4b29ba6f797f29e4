"""regscribe: a register-map compiler for Modbus.

Rooms, in the order of the pipeline: source, schema, compose, lower, checks, emit; beside them model and reference (what
all of them speak of), simulate, tools and cli. What generated drivers import is `regscribe_runtime`.
"""

__version__ = "0.1.0"
