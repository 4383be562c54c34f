#!/usr/bin/python3
"""How well does a recommended constant bias serve pictures that it was not made from?

    regret_study.py GNOMON [--part views|contact|lights|resolutions] [--scenes DIR] [--out FILE.csv] [--jobs N]
                    [--only NAME] [--keep DIR] [--filter nearest|linear] [--size W H] [--seeds N] [--below-ground]

Three rules are compared: three texels above the lower end of the lowest broad valley (what Gnomon recommends), the
middle of that valley, and the middle of the interval with the fewest errors.

Jobs: the built-in scenes and the meshes suzanne.obj, bunny.obj and nefertiti.obj of DIR (default $GNOMON_SHARED_SCENES)
on ground, under a directional light and a spot, with maps of 512 and 2048 texels; d24, the job's own camera, map and
planes fitted to the scene. Both lights shine the way of the program's default light; the spot stands 1.5 diagonals of
the scene's box from its centre, where a cone of 40 degrees holds the box's sphere. The filter is `nearest` or `linear`:
both make one comparison, so that the critical biases tell the errors of every bias.

Parts; each is measured if none is named:

views        The job's own view and those of views.py; one that scores less than a tenth of the job's own is passed
             over, as is one from below everything in the scene (--below-ground keeps those). A bias is made from the
             own one, or from it and the first three, and tried on the next seven.
contact      Pairs of scenes (scenes.py), of which the second is the first with its things put down, or changed
             otherwise. A bias is made from the first and used, in depth units, in the second.
lights       The light turned by 10 degrees, four ways; a spot is turned about its target. A bias is made under the own
             light and used, with its length in metres, under each of them.
resolutions  Half and twice the map's resolution. A bias is used with its length in texels, and with its depth units.

Regret of a bias: the share of wrong pixels with it, less the same of the bias that makes it smallest, of every float32,
negative ones included; in percentage points. Over several views it is the worst share less the smallest worst share of a
single bias.

The tables go to standard output, and a row per measured regret to FILE.csv. --keep leaves what was read of each view in
a folder, from which another run goes on.

Exit status: 0 done; 1 a job failed; 77 OpenImageIO or numpy is missing.
"""

import argparse
import csv
import os
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

try:
    import numpy
    import OpenImageIO  # pylint: disable=unused-import  (comparisons.py reads images with it)
except ImportError:
    print("SKIPPED: Debian's python3-openimageio and python3-numpy are missing")
    sys.exit(77)

import parts
from comparisons import Program, Scene
from regret import RULE_NAMES, RULES, distribution_table
from scenes import meshes_in, pairs

MESHES = ("suzanne.obj", "bunny.obj", "nefertiti.obj")
LIGHTS = ("directional", "spot")
RESOLUTIONS = (512, 2048)
SPOT_DIAGONALS, SPOT_CONE_DEG = 1.5, 40
PROMISED_POINTS = {"views": 0.1, "contact": 0.2, "lights": 0.2, "resolutions": 0.2}
PLAIN = {"shadow_map.depth_format": "d24", "shadow_map.fit": "scene", "shadow_map.near": "auto",
         "shadow_map.far": "auto", "shadow_map.cull": "none", "shadow_map.reversed": False, "shadow_map.roll_deg": 0,
         "lookup.outside": "lit", "bias.constant": 0, "bias.slope": 0, "bias.normal_texels": 0}


@dataclass(frozen=True)
class StudyJob:
    scene: Scene
    camera: object
    box: tuple
    light: str
    resolution: int
    filter: str

    @property
    def name(self):
        return f"{self.scene.name} {self.light} {self.resolution} {self.filter}"

    def settings(self, camera_keys=None, direction=parts.LIGHT_DIRECTION, resolution=None):
        """Every key of the job, so that nothing of a built-in scene's own settings remains."""
        lower, upper = self.box
        light = {"light.type": self.light}
        if self.light == "directional":
            light["light.direction"] = list(map(float, direction))
        else:
            centre = 0.5 * (lower + upper)
            back = direction / numpy.linalg.norm(direction) * SPOT_DIAGONALS * numpy.linalg.norm(upper - lower)
            light["light.position"] = list(map(float, centre - back))
            light["light.target"] = list(map(float, centre))
            light["light.cone_deg"] = SPOT_CONE_DEG
        return {**PLAIN, "lookup.filter": self.filter, "shadow_map.resolution": resolution or self.resolution,
                **(camera_keys or self.camera.keys()), **light}


class Progress:
    """A line per job on standard error."""

    def __init__(self, total):
        self.total, self.done, self.start = total, 0, time.monotonic()

    def __call__(self, name, what):
        self.done += 1
        print(f"[{self.done}/{self.total}, {time.monotonic() - self.start:.0f} s] {name}: {what}", file=sys.stderr,
              flush=True)


def measured(part, job, subject, program, arguments, progress):
    """The rows of a part for a job, and whether it failed."""
    try:
        rows = parts.MEASURES[part](program, job, subject, arguments)
    except (RuntimeError, ValueError, OSError) as error:
        progress(f"{part}: {job.name}", f"FAILED: {error}")
        return [], True
    progress(f"{part}: {job.name}", f"{len(rows)} rows")
    about = {"part": part, "scene": job.scene.name, "light": job.light, "resolution": job.resolution,
             "filter": job.filter}
    return [{**about, **row} for row in rows], False


def tables(part, rows):
    """The part's tables: a row for each question and rule."""
    questions = list(dict.fromkeys(row["question"] for row in rows))
    series = [(f"{question}; {RULE_NAMES[rule]}",
               [row["regret"] for row in rows if (row["question"], row["rule"]) == (question, rule)])
              for question in questions for rule in RULES]
    text = distribution_table(f"{part}: regret", "points", series, PROMISED_POINTS[part])
    lost = [(f"{question}; {RULE_NAMES[rule]}",
             [row["lost_percent"] for row in rows if (row["question"], row["rule"]) == (question, rule)])
            for question in questions for rule in RULES]
    if part == "contact":
        text += "\n\n" + distribution_table("contact: shadow lost [%]", "%", lost, 10)
    if part == "views":
        sizes = [(RULE_NAMES[rule], [row["texels"] for row in rows if row["rule"] == rule and row["made_of"] == 1 and
                                     row["is_first"]]) for rule in RULES]
        text += "\n\n" + distribution_table("size of the bias [texels]", "texels", sizes, 10)
    return text


def write_csv(path, rows):
    columns = list(dict.fromkeys(name for row in sorted(rows, key=len, reverse=True) for name in row))
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, restval="", lineterminator="\n")
        writer.writeheader()
        # float32 as the shortest text that reads back as it
        writer.writerows([{name: str(value) if isinstance(value, numpy.floating) else value
                           for name, value in row.items()} for row in rows])


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("gnomon", type=Path, help="the program")
    parser.add_argument("--part", action="append", choices=list(parts.MEASURES), help="what to measure; repeatable")
    parser.add_argument("--scenes", type=Path, default=os.environ.get("GNOMON_SHARED_SCENES"),
                        help="folder of the meshes; without one only the built-in scenes are studied")
    parser.add_argument("--out", type=Path, help="CSV file, a row per measured regret")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="comparisons that run side by side")
    parser.add_argument("--only", action="append", help="a scene's name; repeatable")
    parser.add_argument("--keep", type=Path, help="folder for what is read of each view")
    parser.add_argument("--filter", action="append", choices=["nearest", "linear"], help="repeatable; default nearest")
    parser.add_argument("--size", type=int, nargs=2, default=(640, 360), metavar=("W", "H"), help="of the pictures")
    parser.add_argument("--seeds", type=int, default=8, help="how many generated scenes there are")
    parser.add_argument("--below-ground", action="store_true", help="keep views from below everything in the scene")
    return parser.parse_args()


def study_scenes(program, arguments):
    scenes = [Scene.builtin(name) for name in program.builtin_names()]
    scenes += [Scene.file(mesh) for mesh in meshes_in(arguments.scenes, MESHES)]
    if not arguments.scenes:
        print("Without --scenes or $GNOMON_SHARED_SCENES the meshes are left out.", file=sys.stderr)
    return scenes


def jobs_of(program, subjects, arguments, pool):
    """A job for each subject's scene, light, map and filter: (job, subject)."""
    chosen = [(scene, subject) for scene, subject in subjects if not arguments.only or scene.name in arguments.only]
    framed = list(pool.map(lambda of: program.camera_and_box(of[0]), chosen))
    return [(StudyJob(scene, camera, box, light, resolution, name), subject)
            for (scene, subject), (camera, box) in zip(chosen, framed)
            for light in LIGHTS for resolution in RESOLUTIONS for name in arguments.filter or ["nearest"]]


def main():
    arguments = parse_arguments()
    threads = max(1, (os.cpu_count() or 1) // arguments.jobs)
    program = Program(arguments.gnomon, threads, arguments.size, arguments.keep)
    rows, has_failed = [], False
    with ThreadPoolExecutor(arguments.jobs) as pool, tempfile.TemporaryDirectory(prefix="gnomon_regret_") as folder:
        scenes = [(scene, None) for scene in study_scenes(program, arguments)]
        changed = [(pair.first, pair) for pair in pairs(Path(folder), meshes_in(arguments.scenes, MESHES),
                                                        range(arguments.seeds))]
        for part in arguments.part or parts.MEASURES:
            jobs = jobs_of(program, changed if part == "contact" else scenes, arguments, pool)
            progress = Progress(len(jobs))
            found = list(pool.map(lambda of, part=part, progress=progress:
                                  measured(part, *of, program, arguments, progress), jobs))
            has_failed |= any(failed for _, failed in found)
            of_part = [row for rows_of_job, _ in found for row in rows_of_job]
            rows += of_part
            print(tables(part, of_part), end="\n\n", flush=True)
    if arguments.out:
        write_csv(arguments.out, rows)
    return 1 if has_failed else 0


if __name__ == "__main__":
    sys.exit(main())
