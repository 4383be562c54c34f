"""Errors of input files."""


class InputError(Exception):
    """Bad input; the message is one line with the file, the problem and a remedy."""


class MissingPackage(Exception):
    """A package of Debian is missing; the message is one line that names it."""
