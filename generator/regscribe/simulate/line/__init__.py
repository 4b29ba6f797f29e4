"""The lines and connections that simulated devices answer on."""
