"""Draws small pictures of each engine's worst row for the documents."""

import shlex
import subprocess
import tempfile
from pathlib import Path

from PIL import Image, PngImagePlugin

from measure import TIMEOUT_S, TRIES, program
from rows import is_trusted
from scenes import ROOT

WIDTH_PX, COLOURS = 1200, 192


def worst(rows, engine):
    """The engine's trusted row with the largest mean |error|; None if there is none."""
    own = [row for row in rows if row["engine"] == engine and row["status"] == "done"]
    return max((row for row in own if is_trusted(row)), key=lambda row: row["mean_abs_error"], default=None)


def _says(path):
    """The row that the picture was made of; None without a picture."""
    try:
        with Image.open(path) as image:
            return image.info.get("row")
    except FileNotFoundError:
        return None


def draw(row, path):
    """Draws the row's frame beside the truth, unless the file is up to date. Returns whether there is a picture."""
    says = f"{row['version']}, {row['device']}: {row['command']}: {row['false_shadow']} {row['false_lit']} {row['mean_abs_error']}"
    if _says(path) == says:
        return True
    with tempfile.TemporaryDirectory() as folder:
        large = Path(folder) / "large.png"
        words = [program(), *shlex.split(row["command"])[1:], "--renderer-timeout-s", str(TIMEOUT_S), "--picture", str(large)]
        if all(subprocess.run(words, cwd=ROOT, capture_output=True).returncode != 0 for _ in range(TRIES)):
            return False
        with Image.open(large) as image:
            small = image.convert("RGB").resize((WIDTH_PX, round(image.height * WIDTH_PX / image.width)), Image.LANCZOS)
    about = PngImagePlugin.PngInfo()
    about.add_text("row", says)
    path.parent.mkdir(parents=True, exist_ok=True)
    # Few pixels are wrong, so a palette by frequency would lack their colours.
    small.quantize(COLOURS, method=Image.Quantize.MAXCOVERAGE).save(path, pnginfo=about, optimize=True)
    return True
