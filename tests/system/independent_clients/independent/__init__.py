"""Clients that nobody here wrote, behind one small interface, and the simulated devices that they are let loose on."""
