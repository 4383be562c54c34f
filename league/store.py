"""The league's store: a file for each thing that was measured, named by a hash of all that it depends on."""

import hashlib
import json
import os
import tempfile
from pathlib import Path


class Store:
    """A folder of results. A file is there whole or not at all, so that killing the league loses nothing that was measured."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)

    def _path(self, name, depends_on):
        text = json.dumps(depends_on, sort_keys=True)
        return self.folder / f"{name}.{hashlib.sha256(text.encode()).hexdigest()[:16]}.json"

    def read(self, name, depends_on):
        """What was measured of just this; None where nothing was."""
        try:
            return json.loads(self._path(name, depends_on).read_text())["outcome"]
        except (FileNotFoundError, json.JSONDecodeError, KeyError):
            return None

    def write(self, name, depends_on, outcome):
        path = self._path(name, depends_on)
        with tempfile.NamedTemporaryFile("w", dir=self.folder, suffix=".part", delete=False) as file:
            json.dump({"depends_on": depends_on, "outcome": outcome}, file, indent=1)
            file.flush()
            os.fsync(file.fileno())
        os.replace(file.name, path)
