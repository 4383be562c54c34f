"""The draw calls of a job, from the trace that Mesa's drivers write into the file that GALLIUM_TRACE names."""

import os
import re
import subprocess
import tempfile
from pathlib import Path

from measured_job import NotMeasured, once, program

CALL = re.compile(r"<call no='\d+' class='pipe_context' method='(\w+)'>(.*?)</call>", re.DOTALL)
TRIANGLES = "<member name='mode'><uint>4</uint></member>"
CORNERS = re.compile(r"<member name='count'><uint>(\d+)</uint></member>")
# A new target, program, or depth and stencil state begins another pass.
BEGINS_PASS = {"set_framebuffer_state", "bind_fs_state", "bind_depth_stencil_alpha_state"}


def _passes_in(text):
    """The triangle corners that each pass draws."""
    passes = []
    is_new = True
    for method, body in CALL.findall(text):
        if method in BEGINS_PASS:
            is_new = True
        elif method == "draw_vbo" and TRIANGLES in body:
            if is_new:
                passes.append(0)
                is_new = False
            passes[-1] += sum(map(int, CORNERS.findall(body)))
    return passes


def passes(job, case):
    """The triangle corners that each pass of a comparison draws, without its diagnosis.

    Raises NotMeasured if the driver writes no trace.
    """
    # The trace holds the pixels that are read back, so the image is small.
    command = ("compare", str(job.path), *job.options(case), "--truth", "float",
               "--set", "image.width=32", "--set", "image.height=32")

    def run():
        with tempfile.TemporaryDirectory() as folder:
            notes = Path(folder) / "notes.xml"
            subprocess.run([program(), *command], check=True, capture_output=True,
                           env={**os.environ, "GALLIUM_TRACE": str(notes)})
            if not notes.exists():
                raise NotMeasured("the driver writes no trace of its draw calls")
            return _passes_in(notes.read_text())

    return once(("passes", *command), run)
