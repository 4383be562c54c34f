from typing import Any

class InputError(ValueError):
    """Bad input: one line that says what, where and what to do."""

class EnvironmentError(RuntimeError):
    """A missing or failing device, driver or file system, in one line."""

version: str

def embree_version() -> str: ...
def __getattr__(name: str) -> Any: ...
