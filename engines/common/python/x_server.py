"""A virtual X server for engines that draw on a display only."""
import os
import subprocess

# Mesa's drivers by what the adapters call them.
RASTERIZERS = {"system": {}, "softpipe": {"LIBGL_ALWAYS_SOFTWARE": "1", "GALLIUM_DRIVER": "softpipe"}}


class XServer:
    """An Xvfb on a free display. It listens on an abstract socket and has no lock file, so that no file can be left of it; it ends
    with who started it, however that comes about."""

    def __init__(self):
        reading, writing = os.pipe()
        try:
            self.process = subprocess.Popen(
                ["setpriv", "--pdeathsig", "TERM", "Xvfb", "-displayfd", str(writing), "-screen", "0", "64x64x24", "+extension", "GLX",
                 "-nolisten", "tcp", "-nolisten", "unix", "-listen", "local", "-nolock"],
                pass_fds=[writing], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        finally:
            os.close(writing)
        with os.fdopen(reading) as display:
            self.display = ":" + display.readline().strip()
        if self.display == ":":
            words = self.process.communicate()[1].strip().splitlines()
            raise OSError(f"Xvfb did not start; {'its last words: ' + words[-1] if words else 'apt-get install xvfb'}")

    def environment(self, rasterizer):
        """What a program needs in its environment to draw here by a rasterizer."""
        return {"DISPLAY": self.display, **RASTERIZERS[rasterizer]}

    def device(self, rasterizer):
        """What GL calls that which draws here, at most 124 bytes.

        @throws OSError  if there is no glxinfo, or no GL.
        """
        environment = {**os.environ, **self.environment(rasterizer)}
        said = subprocess.run(["glxinfo", "-B"], capture_output=True, text=True, check=False, env=environment).stdout
        for line in said.splitlines():
            name, _, value = line.partition(": ")
            if name == "OpenGL renderer string":
                return value[:124]
        raise OSError("glxinfo names no OpenGL renderer; apt-get install libgl1-mesa-dri")

    def close(self):
        """Ends it at once: it has no files to leave."""
        self.process.kill()
        self.process.communicate()
