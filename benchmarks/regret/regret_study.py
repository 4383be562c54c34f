#!/usr/bin/python3
"""How well does a recommended constant bias serve views that it was not made from?

    regret_study.py GNOMON [--scenes DIR] [--out FILE.csv] [--jobs N] [--lights] [--only NAME] [--keep DIR]
                    [--below-ground]

Jobs: the built-in scenes and the meshes suzanne.obj, bunny.obj and nefertiti.obj of DIR (default $GNOMON_SHARED_SCENES)
on ground, under a directional light and a spot, with maps of 512 and 2048 texels; nearest, d24, 640 x 360 pixels, the
job's own camera, map and planes fitted to the scene. Both lights shine the way of the program's default light; the
spot stands 1.5 diagonals of the scene's box from its centre, where a cone of 40 degrees holds the box's sphere.

Views: the job's own and those of views.py; one that scores less than a tenth of the job's own is passed over, as is one
from below everything in the scene (--below-ground keeps those). The own one and the first three are fitted to, the
next seven are held out.

Regret of a bias: the worst share of wrong pixels over the held-out views, less the same of the single bias that
makes it smallest, of every float32, negative ones included; in percentage points.

With --lights each job's light is turned by up to 30 degrees, four ways; a spot is turned about its target. The bias
from four views under the own light is scored in the own view under each of them, carried in depth units, and in
metres along the light's axis at the median receiver; its regret is that of this view under this light. What it is under
the own light stands beside them.

The tables go to standard output, a row per job to FILE.csv and with --lights a row per job and light to
FILE_lights.csv. --keep leaves what was read of each view in a folder, from which another run goes on.

Exit status: 0 done; 1 a job failed; 77 OpenImageIO or numpy is missing.
"""

import argparse
import csv
import os
import sys
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

from comparisons import Program, Scene
from recommendation import ErrorCurve, bare_minimum, recommend
from regret import (LIGHT_ROWS, PROMISED_POINTS, WAYS, carried, distribution_table, regret_of,
                    smallest_worst_share)
from views import turned

IMAGE = (640, 360)
MESHES = ("suzanne.obj", "bunny.obj", "nefertiti.obj")
LIGHTS = ("directional", "spot")
RESOLUTIONS = (512, 2048)
LIGHT_DIRECTION = numpy.array([-0.4, -1, -0.3])
SPOT_DIAGONALS, SPOT_CONE_DEG = 1.5, 40
FITTED, HELD_OUT = 4, 7
OTHER_LIGHTS = 4
LEAST_SCORED = 0.1  # of the pixels that the job's own view scores
PLAIN = {"shadow_map.depth_format": "d24", "shadow_map.fit": "scene", "shadow_map.near": "auto",
         "shadow_map.far": "auto", "shadow_map.cull": "none", "shadow_map.reversed": False, "shadow_map.roll_deg": 0,
         "lookup.filter": "nearest", "lookup.outside": "lit", "bias.constant": 0, "bias.slope": 0,
         "bias.normal_texels": 0}


@dataclass(frozen=True)
class StudyJob:
    scene: Scene
    camera: object
    box: tuple
    light: str
    resolution: int

    @property
    def name(self):
        return f"{self.scene.name} {self.light} {self.resolution}"

    def settings(self, camera_keys, direction=LIGHT_DIRECTION):
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
        return {**PLAIN, "shadow_map.resolution": self.resolution, **camera_keys, **light}


def gather(view_of, wanted, own_scored):
    """The first `wanted` of view_of(1), view_of(2), ... that are views and score enough, up to 4 times as many tries;
    their indices, and how many were passed over."""
    views, indices, tries = [], [], 0
    while len(views) < wanted and tries < 4 * wanted:
        tries += 1
        view = view_of(tries)
        if view is not None and view.curve.scored > 0 and view.curve.scored >= LEAST_SCORED * own_scored:
            views.append(view)
            indices.append(tries)
    return views, indices, tries - len(views)


def study_views(program, job, below_ground):
    """The views of a job, and its row."""
    own = program.view(job.scene, job.settings(job.camera.keys()))
    lowest_m = min(job.box[0][1], job.camera.eye[1])

    def around(k):
        keys = job.camera.generated(k)
        is_below = keys["camera.eye"][1] < lowest_m
        return None if is_below and not below_ground else program.view(job.scene, job.settings(keys))

    others, _, passed_over = gather(around, FITTED + HELD_OUT - 1, own.curve.scored)
    fitted, held_out = [own, *others[:FITTED - 1]], others[FITTED - 1:]
    row = {"scene": job.scene.name, "light": job.light, "resolution": job.resolution, "scored_own": own.curve.scored,
           "lit_own": own.curve.lit.size, "fitted": len(fitted), "held_out": len(held_out), "passed_over": passed_over}
    if not held_out:
        return fitted, row
    curves = [view.curve for view in held_out]
    best = smallest_worst_share(curves)
    row |= {"best_bias": best.bias, "best_worst_percent": 100 * best.share,
            "best_worst_percent_from_zero": 100 * smallest_worst_share(curves, least=0).share}
    for count, name in ((1, "one"), (FITTED, "four")):
        curve = ErrorCurve.pooled([view.curve for view in fitted[:count]])
        recommended = recommend(curve)
        if recommended is None:
            continue
        for way, bias in (("recommended", recommended.bias), ("minimum", bare_minimum(curve))):
            row |= {f"{way}_{name}": bias, f"regret_{way}_{name}": regret_of(bias, curves, best.share)}
        row |= {f"low_{name}": recommended.low, f"high_{name}": recommended.high}
    return fitted, row


def study_lights(program, job, fitted):
    """A row for the job's own light and for each other one, all in the job's own view."""
    own = fitted[0]
    recommended = recommend(ErrorCurve.pooled([view.curve for view in fitted]))

    def under(k):
        return program.view(job.scene, job.settings(job.camera.keys(), turned(LIGHT_DIRECTION, k)[0]))

    others, indices, passed_over = gather(under, OTHER_LIGHTS, own.curve.scored)
    rows = []
    for index, view in zip([0, *indices], [own, *others]):
        best = smallest_worst_share([view.curve])
        row = {"scene": job.scene.name, "light": job.light, "resolution": job.resolution, "turn": index,
               "turned_deg": turned(LIGHT_DIRECTION, index)[1] if index else 0.0, "passed_over": passed_over,
               "best_bias": best.bias, "best_percent": 100 * best.share}
        if recommended is not None:
            for way, bias in (("depth", recommended.bias), ("metres", carried(recommended.bias, own, view))):
                row |= {f"bias_{way}": bias, f"regret_{way}": regret_of(bias, [view.curve], best.share)}
        rows.append(row)
    return rows


class Progress:
    """A line per job on standard error."""

    def __init__(self, total):
        self.total, self.done, self.start = total, 0, time.monotonic()

    def __call__(self, name, what):
        self.done += 1
        print(f"[{self.done}/{self.total}, {time.monotonic() - self.start:.0f} s] {name}: {what}", file=sys.stderr,
              flush=True)


def study(program, job, arguments, progress):
    """The job's row and its lights' rows; the row says what failed."""
    try:
        fitted, row = study_views(program, job, arguments.below_ground)
        light_rows = study_lights(program, job, fitted) if arguments.lights else []
    except (RuntimeError, ValueError, OSError) as error:
        progress(job.name, f"FAILED: {error}")
        return {"scene": job.scene.name, "light": job.light, "resolution": job.resolution, "failed": str(error)}, []
    regret = row.get("regret_recommended_four")
    progress(job.name, "nothing recommended" if regret is None else f"regret {regret:.4f} points")
    return row, light_rows


def beyond_promise(rows):
    """Which jobs' regret from four views is above what is promised."""
    known = [row for row in rows if row.get("regret_recommended_four") is not None]
    beyond = sorted((row for row in known if row["regret_recommended_four"] > PROMISED_POINTS),
                    key=lambda row: -row["regret_recommended_four"])
    lines = [f"From four views {len(beyond)} of {len(known)} jobs are above {PROMISED_POINTS} points"
             f"{':' if beyond else '.'}"]
    for row in beyond:
        lines.append(f"- {row['scene']} {row['light']} {row['resolution']}: {row['regret_recommended_four']:.3f}; "
                     f"the best single bias leaves {row['best_worst_percent']:.3f} % wrong in one of the views")
    return "\n".join(lines)


def plain_cell(value):
    """float32 as the shortest text that reads back as it."""
    return str(value) if isinstance(value, numpy.floating) else value


def write_csv(path, rows):
    columns = list(dict.fromkeys(name for row in sorted(rows, key=len, reverse=True) for name in row))
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows([{name: plain_cell(value) for name, value in row.items()} for row in rows])


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("gnomon", type=Path, help="the program")
    parser.add_argument("--scenes", type=Path, default=os.environ.get("GNOMON_SHARED_SCENES"),
                        help="folder of the meshes; without one only the built-in scenes are studied")
    parser.add_argument("--out", type=Path, help="CSV file, a row per job")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="comparisons that run side by side")
    parser.add_argument("--lights", action="store_true", help="turn the lights, too")
    parser.add_argument("--only", action="append", help="a scene's name; repeatable")
    parser.add_argument("--keep", type=Path, help="folder for what is read of each view")
    parser.add_argument("--below-ground", action="store_true", help="keep views from below everything in the scene")
    return parser.parse_args()


def study_scenes(program, arguments):
    scenes = [Scene.builtin(name) for name in program.builtin_names()]
    if arguments.scenes:
        scenes += [Scene.file(Path(arguments.scenes) / name) for name in MESHES]
    else:
        print("Without --scenes or $GNOMON_SHARED_SCENES the meshes are left out.", file=sys.stderr)
    return [scene for scene in scenes if not arguments.only or scene.name in arguments.only]


def main():
    arguments = parse_arguments()
    threads = max(1, (os.cpu_count() or 1) // arguments.jobs)
    program = Program(arguments.gnomon, threads, IMAGE, arguments.keep)
    with ThreadPoolExecutor(arguments.jobs) as pool:
        scenes = study_scenes(program, arguments)
        framed = list(pool.map(program.camera_and_box, scenes))
        jobs = [StudyJob(scene, camera, box, light, resolution) for scene, (camera, box) in zip(scenes, framed)
                for light in LIGHTS for resolution in RESOLUTIONS]
        progress = Progress(len(jobs))
        results = list(pool.map(lambda job: study(program, job, arguments, progress), jobs))
    rows = [row for row, _ in results]
    light_rows = [row for _, rows_of_job in results for row in rows_of_job]
    print(distribution_table(rows, WAYS, "bias"), beyond_promise(rows), sep="\n\n")
    if arguments.lights:
        print()
        print(distribution_table(light_rows, LIGHT_ROWS, "light"))
    if arguments.out:
        write_csv(arguments.out, rows)
        if arguments.lights:
            write_csv(arguments.out.with_name(f"{arguments.out.stem}_lights.csv"), light_rows)
    return 1 if any("failed" in row for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
