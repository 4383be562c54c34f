#!/usr/bin/python3
"""Compares Gnomon's results with recorded ones.

    recorded_results.py check PROGRAM [--shared] [--keep DIR]
    recorded_results.py record PROGRAM
    recorded_results.py is-recorded PROGRAM

Runs PROGRAM, a `gnomon`, over the jobs of recorded_jobs.py and hashes the results part by part: each member of the
JSON, each channel of the EXR and its header, each column of the CSV files. It ignores what may differ between runs, CPUs
or versions: times, ids, the environment, and what depends on the order in which Embree visits triangles (witnesses, and
the number of signs decided). A table in this folder holds the hashes of one environment of driver and libraries.
`record` rewrites it, for an intended change that the commit explains.

check    lists the parts that differ. Parts that are not recorded are only counted.
         --shared: the jobs of the meshes in $GNOMON_SHARED_SCENES instead of those of built-in scenes.
         --keep: keeps the results in DIR, to compare with those of another program.
         Exit status: 0 nothing differs; 1 something does; 77 nothing is recorded for this environment.
"""

import argparse
import csv
import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from recorded_jobs import recorded_jobs

HERE = Path(__file__).resolve().parent
VERSIONED = {"environment", "seconds", "gnomon:gl_renderer", "gnomon:gl_version", "gnomon:embree", "gnomon:version",
             "id", "curve", "witness", "truth_signs"}


def fail(text, status=2):
    print(f"recorded_results: {text}", file=sys.stderr)
    sys.exit(status)


def short_hash(data):
    return hashlib.sha256(data).hexdigest()[:8]


def json_parts(text):
    for name, value in json.loads(text).items():
        if name not in VERSIONED:
            yield f"json.{name}", json.dumps(without_seconds(value), sort_keys=True).encode()


def without_seconds(value):
    """The value without times and versions at any depth."""
    if isinstance(value, dict):
        return {name: without_seconds(held) for name, held in value.items() if name not in VERSIONED}
    if isinstance(value, list):
        return [without_seconds(held) for held in value]
    return value


def image_parts(path):
    import OpenImageIO  # `is-recorded` does not need it

    image = OpenImageIO.ImageInput.open(str(path))
    if image is None:
        fail(f"{path}: cannot be read: {OpenImageIO.geterror()}")
    spec = image.spec()
    header = {attribute.name: attribute.value for attribute in spec.extra_attribs
              if attribute.name.startswith("gnomon:") and attribute.name not in VERSIONED}
    yield "exr.header", json.dumps(header, sort_keys=True).encode()
    for channel, name in enumerate(spec.channelnames):
        if name not in VERSIONED:
            pixels = image.read_image(0, 0, channel, channel + 1, spec.channelformat(channel))
            yield f"exr.{name}", pixels.tobytes()
    image.close()


def csv_parts(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    for column, name in enumerate(rows[0]):
        cells = [row[column] for row in rows[1:]]
        if name not in VERSIONED and any(cells):
            yield f"{path.stem}.{name}", "\n".join(cells).encode()


def kept_pixel_parts(folder):
    """The parts of all configurations joined, in the order of the rows."""
    with open(folder / "results.csv", newline="", encoding="utf-8") as file:
        ids = [row["id"] for row in csv.DictReader(file)]
    together = {}
    for name in ids:
        detail = folder / "pixels" / f"{name}.json"
        if detail.exists():
            for part, data in [*json_parts(detail.read_text()), *image_parts(detail.with_suffix(".exr"))]:
                together.setdefault(f"pixels.{part}", []).append(short_hash(data).encode())
    for part, hashes in together.items():
        yield part, b" ".join(hashes)


class Runner:
    def __init__(self, program, keep):
        self.program = Path(program).resolve()
        self.keep = keep

    def hashes(self, job):
        """The hash of each part of a job's results, by name."""
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary) if self.keep is None else self.keep / job.name
            folder.mkdir(parents=True, exist_ok=True)
            if job.is_shared and not (folder / job.scene).exists():
                (folder / job.scene).symlink_to(Path(os.environ["GNOMON_SHARED_SCENES"]) / job.scene)
            return {part: short_hash(data) for part, data in getattr(self, job.kind)(job, folder)}

    def run(self, folder, *arguments):
        """Standard output, or the refusal as JSON."""
        done = subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True,
                              cwd=folder)
        if done.returncode not in (0, 1, 2) or (done.returncode == 2 and not done.stderr):
            fail(f"{' '.join(map(str, arguments))}: ended with {done.returncode}: {done.stderr}")
        if done.returncode == 2:
            print(f"recorded_results: refused: {done.stderr.strip()}", file=sys.stderr)
            return json.dumps({"refusal": done.stderr.replace(str(folder), "")})
        return done.stdout

    def compare(self, job, folder):
        image = folder / "layers.exr"
        text = self.run(folder, "compare", *job.scene_arguments(), *job.arguments, "--json", "--aov", image)
        (folder / "result.json").write_text(text)
        yield from json_parts(text)
        if image.exists():
            yield from image_parts(image)

    def evaluate(self, job, folder):
        case, image = "case", folder / "layers.exr"  # the path is part of the result
        self.run(folder, "compare", *job.scene_arguments(), *job.arguments, "--json", "--export-case", case)
        text = self.run(folder, "evaluate", case, "--json", "--aov", image)
        (folder / "result.json").write_text(text)
        yield from json_parts(text)
        if image.exists():
            yield from image_parts(image)

    def tune(self, job, folder):
        text = self.run(folder, "tune", *job.scene_arguments(), *job.arguments, "--json")
        (folder / "result.json").write_text(text)
        yield from json_parts(text)

    def sweep(self, job, folder):
        run = folder / "run"
        self.run(folder, "sweep", *job.scene_arguments(), *job.arguments, "--out", run, "--quiet")
        for name in ("results", "error_vs_z", "bias_curves"):
            yield from csv_parts(run / f"{name}.csv")
        yield from kept_pixel_parts(run)


def environment_of(program):
    """Driver and libraries, as one line."""
    done = subprocess.run([program, "doctor", "--json"], capture_output=True, text=True)
    found = json.loads(done.stdout)
    if done.returncode != 0:
        fail(f"{program} doctor: GL or Embree does not work here", 4)
    return "; ".join(re.sub(r"\s+", " ", text) for text in
                     (found["gl"]["renderer"], found["gl"]["version"], found["embree"]))


def table_of(environment):
    return HERE / (re.sub(r"[^a-z0-9.]+", "-", environment.lower()).strip("-") + ".tsv")


def write_table(path, results):
    """Writes a block for each kind of job; a dash stands for a part that a job lacks."""
    lines = []
    kinds = {}
    for job, hashes in results:
        kinds.setdefault(job.kind, []).append((job, hashes))
    for held in kinds.values():
        parts = list(dict.fromkeys(part for _, hashes in held for part in hashes))
        lines.append("\t".join(["job", *parts]))
        for job, hashes in held:
            lines.append("\t".join([job.name, *(hashes.get(part, "-") for part in parts)]))
    path.write_text("\n".join(lines) + "\n")


def read_table(path):
    recorded = {}
    for line in path.read_text().splitlines():
        name, *cells = line.split("\t")
        if name == "job":
            parts = cells
        else:
            recorded[name] = {part: cell for part, cell in zip(parts, cells) if cell != "-"}
    return recorded


def run_all(runner, jobs):
    # Threads would deadlock with those of OpenImageIO.
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        return list(zip(jobs, pool.map(runner.hashes, jobs)))


def check(runner, path, jobs):
    recorded = read_table(path)
    differing = new = compared = 0
    for job, hashes in run_all(runner, jobs):
        before = recorded.get(job.name, {})
        different = [part for part in before if hashes.get(part) != before[part]]
        new += len(hashes.keys() - before.keys())
        compared += len(before)
        if different or not before:
            differing += 1
            print(f"{job.name}: {', '.join(different) or 'is not recorded'}\n"
                  f"  gnomon {job.kind} {' '.join([*job.scene_arguments(), *job.arguments])}")
    print(f"{len(jobs)} jobs, {compared} parts compared, {new} new; {differing} jobs differ from {path.name}")
    if differing:
        print("if this is intended: recorded_results.py record PROGRAM, and explain it in the commit")
    return 1 if differing else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("action", choices=("check", "record", "is-recorded"))
    parser.add_argument("program")
    parser.add_argument("--shared", action="store_true")
    parser.add_argument("--keep", type=Path)
    options = parser.parse_args()
    path = table_of(environment_of(options.program))
    if options.action == "is-recorded":
        sys.exit(0 if path.exists() else 1)
    needs_shared = options.shared or options.action == "record"
    if needs_shared and "GNOMON_SHARED_SCENES" not in os.environ:
        fail("GNOMON_SHARED_SCENES does not name the folder of the shared meshes", 77)
    runner = Runner(options.program, options.keep and options.keep.resolve())
    if options.action == "record":
        write_table(path, run_all(runner, recorded_jobs()))
        print(path)
        return
    if not path.exists():
        fail(f"nothing is recorded for this environment: {path.name}", 77)
    sys.exit(check(runner, path, [job for job in recorded_jobs() if job.is_shared == options.shared]))


if __name__ == "__main__":
    main()
