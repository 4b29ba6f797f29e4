"""A register: its declaration, the Python types of its values, words to value and back."""
