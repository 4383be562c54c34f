"""A virtual X server for engines that need a display."""
import os
import subprocess

# The environment of each rasterizer.
RASTERIZERS = {"system": {}, "softpipe": {"LIBGL_ALWAYS_SOFTWARE": "1", "GALLIUM_DRIVER": "softpipe"}}


class XServer:
    """An Xvfb on a free display. It uses an abstract socket and no lock file, so it leaves no files. It ends with its parent,
    even if that is killed."""

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
        """The environment for a program that draws here with a rasterizer."""
        return {"DISPLAY": self.display, **RASTERIZERS[rasterizer]}

    def device(self, rasterizer):
        """The name of the GL renderer, at most 124 bytes.

        @throws OSError  if glxinfo or GL is missing.
        """
        environment = {**os.environ, **self.environment(rasterizer)}
        said = subprocess.run(["glxinfo", "-B"], capture_output=True, text=True, check=False, env=environment).stdout
        for line in said.splitlines():
            name, _, value = line.partition(": ")
            if name == "OpenGL renderer string":
                return value[:124]
        raise OSError("glxinfo names no OpenGL renderer; apt-get install libgl1-mesa-dri")

    def close(self):
        """Kills the server, which has no files to clean up."""
        self.process.kill()
        self.process.communicate()
