"""Reads the descriptions of engines, engines/NAME/league.toml."""

import hashlib
import subprocess
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

from checks import CHECKS
from scenes import ROOT

ENGINES = ROOT / "engines"
QUICK = ("three", "babylon", "playcanvas")
BUDGET = 60  # default limit of the settings that tune draws
NOT_THE_ADAPTERS = ("node_modules", "build", "__pycache__")  # installed files, which report their own version
KEYS = {"title", "command", "lights", "map_size", "shadows_off", "known_shape", "search", "budget", "documented", "limits", "second",
        "own_picture", "explained", "frustum", "note"}
LIGHTS = ("spot", "directional", "point")
LIMITS = ("mask", "read_back", "anti_aliasing", "depths")


class DescriptionError(Exception):
    """A fault in a league.toml, with its place and the allowed values."""


@dataclass(frozen=True)
class Engine:
    """An engine of the league; docs/league.md describes the keys of its file."""

    name: str
    folder: Path
    title: str
    lights: tuple
    map_size: str = "set"
    command: tuple = ()
    shadows_off: dict = field(default_factory=dict)
    known_shape: dict = field(default_factory=dict)
    search: tuple | None = None  # None: all keys
    budget: int = BUDGET
    documented: dict = field(default_factory=dict)
    limits: dict = field(default_factory=dict)
    second: dict = field(default_factory=dict)
    own_picture: tuple = ()
    explained: dict = field(default_factory=dict)
    frustum: str = ""  # the parts of the map's frustum that its adapter sets; empty: the engine fits its maps itself
    note: str = ""

    def words(self, variant="first"):
        """The options with which gnomon starts a variant: `first`, `second` (rasterizer), or `picture` (mask from pictures)."""
        command = {"first": self.command, "second": self.second.get("command"), "picture": self.own_picture}[variant]
        if not command:
            return ["--renderer", self.name]
        return ["--renderer-command", " ".join(self._word(word) for word in command)]

    def _word(self, word):
        """The word, or the path of a file that it names, relative to the checkout if possible."""
        path = self.folder / word
        if not path.is_file():
            return word
        return str(path.relative_to(ROOT)) if path.is_relative_to(ROOT) else str(path)

    def documented_for(self, light):
        """The keys that the documentation recommends for a type of light; None if it recommends nothing."""
        if not self.documented:
            return None
        return {**self.documented.get("engine", {}), **self.documented.get(light, {})}

    def second_for(self, light):
        """The second rasterizer for a type of light; empty if there is none."""
        return self.second if light in self.second.get("lights", self.lights) else {}

    def explained_for(self, light):
        """Why checks fail under a type of light, by check."""
        common = {check: text for check, text in self.explained.items() if check not in LIGHTS}
        return {**common, **self.explained.get(light, {})}

    def adapter_hash(self):
        """A hash of the adapter's files and the shared ones, without README.md and league.toml."""
        digest = hashlib.sha256()
        for folder in (self.folder, self.folder.parent / "common"):
            for path in sorted(folder.rglob("*")):
                inside = path.relative_to(folder)
                if path.is_file() and not set(inside.parts) & set(NOT_THE_ADAPTERS) and path.name not in ("README.md", "league.toml"):
                    digest.update(str(inside).encode() + b"\0" + path.read_bytes())
        return digest.hexdigest()

    def missing(self):
        """The first missing requirement, in one line; empty if all are installed."""
        if not (self.folder / "engine.sh").exists():
            return ""
        script = 'source "$1/missing.sh" && missing_of "$2"'
        done = subprocess.run(["bash", "-c", script, "missing", str(ENGINES / "common"), str(self.folder)], capture_output=True, text=True)
        return done.stdout.strip() or (done.stderr.strip().splitlines() or [""])[-1]


def _refuse(path, what, known):
    raise DescriptionError(f"{path}: {what}; known are {', '.join(sorted(known))}")


def read_engine(folder):
    """The engine that folder/league.toml describes.

    Raises DescriptionError if a key or value is unknown or missing.
    """
    path = folder / "league.toml"
    try:
        table = tomllib.loads(path.read_text())
    except tomllib.TOMLDecodeError as error:
        raise DescriptionError(f"{path}: {error}") from None
    for key in table:
        if key not in KEYS:
            _refuse(path, f"unknown key {key}", KEYS)
    for key in ("title", "lights", "shadows_off", "limits"):
        if key not in table:
            raise DescriptionError(f"{path}: {key} is missing; docs/league.md describes it")
    for light in (*table["lights"], *table.get("second", {}).get("lights", ())):
        if light not in LIGHTS:
            _refuse(path, f"lights: unknown light {light}", LIGHTS)
    for key in table["limits"]:
        if key not in LIMITS:
            _refuse(path, f"limits: unknown key {key}", LIMITS)
    explained = table.get("explained", {})
    for key in (*(explained.keys() - set(LIGHTS)), *(check for light in LIGHTS for check in explained.get(light, {}))):
        if key not in CHECKS:
            _refuse(path, f"explained: unknown check {key}", CHECKS)
    if table.get("documented") and not table["documented"].get("source"):
        raise DescriptionError(f"{path}: documented.source is missing: where the documentation recommends these values")
    lists = {key: tuple(table[key]) for key in ("lights", "command", "search", "own_picture") if key in table}
    return Engine(name=folder.name, folder=folder, **{**table, **lists})


def all_engines(folder=ENGINES):
    """The engines that have a league.toml, by name."""
    return {path.parent.name: read_engine(path.parent) for path in sorted(folder.glob("*/league.toml"))}


def chosen(engines, names, is_quick):
    """The named engines, or all. is_quick: up to three installed ones, those of QUICK first.

    Raises DescriptionError for an unknown name.
    """
    for name in names:
        if name not in engines:
            _refuse("league", f"unknown engine {name}", engines)
    if names:
        return [engines[name] for name in names]
    if not is_quick:
        return list(engines.values())
    installed = [engine for engine in engines.values() if not engine.missing()]
    first = [engine for engine in installed if engine.name in QUICK]
    return (first + [engine for engine in installed if engine.name not in QUICK])[:3]
