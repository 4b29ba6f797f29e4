"""What can go wrong when a device is set up or served: always one clear message, never a traceback to a user."""


class SimulatorError(Exception):
    """The simulator cannot do what was asked; the message says where, what and what to do."""
