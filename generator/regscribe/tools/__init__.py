"""Tools for real devices: reading and logging, backups, setpoint programs."""
