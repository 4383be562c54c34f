"""A background Blender that runs worker.py."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
SYSTEM_PATH = "/usr/bin:/bin"  # Blender loads modules from the first python3 on PATH, which must be the system's


class Blender:
    """A Blender process with additional environment variables. Its files are in a temporary folder, removed by `close`."""

    def __init__(self, environment):
        program = shutil.which("blender")
        if program is None:
            raise OSError("blender is missing; apt-get install blender")
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
        """Calls a method of the worker, and returns its answer.

        @throws OSError  with Blender's last output, if it ended.
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
        """Kills Blender and removes its folder."""
        self.process.kill()
        self.process.wait()
        for one in (self.requests, self.answers, self.words):
            try:
                one.close()
            except BrokenPipeError:  # an unread request
                pass
        shutil.rmtree(self.folder, ignore_errors=True)
