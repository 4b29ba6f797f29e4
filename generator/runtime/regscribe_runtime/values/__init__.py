"""The vocabulary of register maps: frozen facts that compiler, drivers and simulator share."""
