"""The error of the simulator's users: one clear message, never a traceback."""


class SimulatorError(Exception):
    """A device cannot be set up, changed or served; the message says where, what and what to do."""
