"""Reading, writing and configuring, step by step and without I/O."""
