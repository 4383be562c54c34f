"""What a hostile case is, and the words that most of them begin with."""

from dataclasses import dataclass
from typing import Callable

TINY = ["--set", "image.width=16", "--set", "image.height=16", "--set", "shadow_map.resolution=16"]
LONGEST_S = 300


class Skip(Exception):
    """A case that cannot be tried here, and why."""


@dataclass
class Case:
    name: str
    command: list  # words after gnomon; "{d}" is the case's folder
    codes: tuple
    words: str = ""
    prepare: Callable = None
    is_quick: bool = False
    kept: tuple = ()  # files that must be as they were
    absent: tuple = ()  # files that must not be there
    signals: tuple = ()  # (seconds, signal), …
    stdout: str = None
    inspect: Callable = None
    lines: int = 1  # of error, at most


def compare(*more, scene="wall"):
    return ["compare", "--builtin", scene, *TINY, *more]


def job_of(text):
    return ["compare", "{d}/job.toml", *TINY], lambda d: (d / "job.toml").write_bytes(text)


def write(name, data):
    return lambda d: (d / name).write_bytes(data if isinstance(data, bytes) else data.encode())
