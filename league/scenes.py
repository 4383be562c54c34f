"""The scenes of the league: the job files of league/jobs, in the order of scenes.toml."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
JOBS = ROOT / "league" / "jobs"


@dataclass(frozen=True)
class Scene:
    """A job file with its type of light. known_shape: its shadow's shape is known."""

    name: str
    path: Path
    light: str
    known_shape: bool = False
    quick: bool = False

    @property
    def sentence(self):
        """The description in its first line."""
        return self.path.read_text().splitlines()[0].removeprefix("# ")

    def image(self):
        """Its width and height [px]."""
        return tomllib.loads(self.path.read_text())["image"]

    def _mesh(self):
        file = tomllib.loads(self.path.read_text())["scene"].get("file")
        return self.path.parent / file if file else None

    def contents(self):
        """The bytes of the job file and of its mesh."""
        mesh = self._mesh()
        return self.path.read_bytes() + (mesh.read_bytes() if mesh else b"")

    def missing(self):
        """The missing mesh, in one line; empty if nothing is missing."""
        mesh = self._mesh()
        if mesh and not mesh.is_file():
            return f"{mesh} is missing; install it with: apt-get install assimp-testmodels"
        return ""


def all_scenes(folder=JOBS):
    """The scenes of a folder, by name."""
    table = tomllib.loads((folder / "scenes.toml").read_text())
    return {name: Scene(name, folder / f"{name}.toml", **keys) for name, keys in table.items()}
