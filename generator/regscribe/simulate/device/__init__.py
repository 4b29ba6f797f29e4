"""The state of a simulated device and what its registers do."""
