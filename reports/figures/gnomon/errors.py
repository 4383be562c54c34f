"""What goes wrong with files."""


class InputError(Exception):
    """Bad input, in one line: which file, what about it, and what to do."""
