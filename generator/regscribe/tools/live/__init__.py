"""Tools upon generated drivers, without printing: names of links and devices, values as text, frames, scans, watching.

Nothing of it is imported by a driver; pymodbus is loaded when a link is made, yaml when there is a configuration.
"""
