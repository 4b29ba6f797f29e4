"""Run a generated driver against its vectors, and state properties that hold for every value.

A generated test module loads its vectors with `load` and its driver with `driver_module`, makes a `DriverUnderTest`
for each model and calls the checks; the strategies in `regscribe.testing.properties` need hypothesis. Imports the
runtime only, never the compiler.
"""

from regscribe.testing.driver_checks import DriverUnderTest
from regscribe.testing.driver_modules import driver_module
from regscribe.testing.vectors import Trial, Vectors, load, number

__all__ = ["DriverUnderTest", "Trial", "Vectors", "driver_module", "load", "number"]
