"""A Godot that runs worker.gd."""
import json
import os
import pathlib
import shutil
import socket
import struct
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = """config_version=4

[application]
config/name="renderer"
run/main_scene=""

[display]
window/size/width=64
window/size/height=64

[logging]
file_logging/enable_file_logging=false

[rendering]
quality/directional_shadow/size={directional_size}
quality/directional_shadow/size.mobile={directional_size}
quality/filters/use_debanding=false
"""
LONGEST_START_S = 55  # below the time limit of an answer


class Godot:
    """A Godot process with additional environment variables. Its project is in a temporary folder, removed by `close`."""

    def __init__(self, environment, api, directional_size):
        if shutil.which("godot3-runner") is None:
            raise OSError("godot3-runner is missing; apt-get install godot3-runner")
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="godot-"))
        (self.folder / "project.godot").write_text(PROJECT.format(directional_size=directional_size))
        shutil.copy(HERE / "worker.gd", self.folder)
        self.words = open(self.folder / "words", "w+b")
        self.connection = None
        own = {name: str(self.folder) for name in ("HOME", "TMPDIR", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_DATA_HOME")}
        with socket.create_server(("127.0.0.1", 0)) as server:
            server.settimeout(LONGEST_START_S)
            self.process = subprocess.Popen(
                ["setpriv", "--pdeathsig", "KILL", "godot3-runner", "--audio-driver", "Dummy", "--video-driver", api.upper(),
                 "--disable-render-loop", "--path", str(self.folder), "-s", "worker.gd", str(server.getsockname()[1])],
                stdin=subprocess.DEVNULL, stdout=self.words, stderr=subprocess.STDOUT, env={**os.environ, **own, **environment})
            try:
                self.connection = server.accept()[0]
            except TimeoutError as problem:
                words = self.last_words()
                self.close()
                raise OSError(f"Godot did not start; its last words: {words}") from problem

    def call(self, name, **told):
        """Calls a function of the worker, and returns its answer.

        @throws OSError  with Godot's last output, if it ended.
        """
        request = json.dumps({"call": name, **told}).encode()
        try:
            self.connection.sendall(struct.pack("<i", len(request)) + request)
            return json.loads(self._received(struct.unpack("<i", self._received(4))[0]))
        except (BrokenPipeError, ConnectionResetError, EOFError) as problem:
            raise OSError(f"Godot ended (status {self.process.wait()}); its last words: {self.last_words()}") from problem

    def _received(self, count):
        parts = b""
        while len(parts) < count:
            part = self.connection.recv(count - len(parts))
            if not part:
                raise EOFError
            parts += part
        return parts

    def last_words(self):
        lines = (self.folder / "words").read_text(errors="replace").splitlines()
        return next((line.strip() for line in reversed(lines) if line.strip()), "none")

    def close(self):
        """Kills Godot and removes its folder."""
        self.process.kill()
        self.process.wait()
        if self.connection:
            self.connection.close()
        self.words.close()
        shutil.rmtree(self.folder, ignore_errors=True)
