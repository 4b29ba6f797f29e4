"""Tools for generated drivers, without printing: names of links and devices, values as text, frames, scans, logs."""
