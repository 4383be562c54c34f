from typing import Any

class InputError(ValueError):
    """Invalid input; the message is one line with the problem, its place and a remedy."""

class EnvironmentError(RuntimeError):
    """A missing or failing device, driver or file system; the message is one line."""

version: str

def embree_version() -> str: ...
def __getattr__(name: str) -> Any: ...
