"""A hostile case, and the commands with which most begin."""

from dataclasses import dataclass
from typing import Callable

TINY = ["--set", "image.width=16", "--set", "image.height=16", "--set", "shadow_map.resolution=16"]
LONGEST_S = 300


class Skip(Exception):
    """Why a case cannot be tried here."""


@dataclass
class Case:
    name: str
    command: list  # words after gnomon; "{d}" is the case's folder
    codes: tuple
    words: str = ""
    prepare: Callable = None
    is_quick: bool = False
    kept: tuple = ()  # files that must not change
    absent: tuple = ()  # files that must not exist
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
