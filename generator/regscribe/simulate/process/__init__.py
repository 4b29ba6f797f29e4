"""The thermal process behind a simulated controller."""
