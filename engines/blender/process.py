"""A Blender in the background, whose worker.py is called by name."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
SYSTEM_PATH = "/usr/bin:/bin"  # Blender takes the modules of the first python3 on its path, which must be those that it was built for


class Blender:
    """Started with the given environment beside its own; its files are in a temporary folder, which goes with it."""

    def __init__(self, environment):
        program = shutil.which("blender")
        if program is None:
            raise OSError("there is no blender; apt-get install blender")
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="blender-"))
        self.words = open(self.folder / "words", "w+b")
        to_blender, self.requests = os.pipe()
        self.answers, from_blender = os.pipe()
        self.requests, self.answers = os.fdopen(self.requests, "w"), os.fdopen(self.answers)
        own = {name: str(self.folder) for name in ("HOME", "TMPDIR", "XDG_CONFIG_HOME", "XDG_CACHE_HOME")}
        try:
            self.process = subprocess.Popen(
                ["setpriv", "--pdeathsig", "KILL", program, "-b", "--factory-startup", "-noaudio", "--python-exit-code", "1",
                 "--python", str(HERE / "worker.py"), "--", str(to_blender), str(from_blender)],
                pass_fds=[to_blender, from_blender], stdin=subprocess.DEVNULL, stdout=self.words, stderr=subprocess.STDOUT,
                env={**os.environ, **own, "PATH": SYSTEM_PATH, "PYTHONDONTWRITEBYTECODE": "1", **environment})
        finally:
            os.close(to_blender)
            os.close(from_blender)

    def call(self, name, **told):
        """What the worker's method answers.

        @throws OSError  if Blender ended, with its last words.
        """
        try:
            self.requests.write(json.dumps({"call": name, **told}) + "\n")
            self.requests.flush()
            line = self.answers.readline()
        except BrokenPipeError:
            line = ""
        if not line:
            raise OSError(f"Blender ended (status {self.process.wait()}); its last words: {self.last_words()}")
        return json.loads(line)

    def last_words(self):
        self.words.seek(0)
        lines = [line for line in self.words.read().decode(errors="replace").splitlines() if line.strip()]
        said = [line for line in lines if line != "Blender quit"]
        return said[-1].strip() if said else "none"

    def close(self):
        """Ends Blender at once: all that it might leave is in its folder."""
        self.process.kill()
        self.process.wait()
        for one in (self.requests, self.answers, self.words):
            try:
                one.close()
            except BrokenPipeError:  # of a request that nobody reads any more
                pass
        shutil.rmtree(self.folder, ignore_errors=True)
