#!/usr/bin/python3
"""What do the parts of a sweep cost, and how does that grow?

    scaling_study.py BIN [--out MEASUREMENTS.csv] [--work DIR] [--repeats N] [--only SERIES]

BIN is the folder of the built programs gnomon and scaling_parts. Each series varies one size four times or five; one of
them checks what is fitted to the others. The other sizes stay. The scene is a height field that is read from an OBJ file.

Measured is processor time, of all threads together, which says little of what else the machine does; the least of the
repeats. Memory is the largest resident set of a whole `gnomon sweep`; bytes are those of its files.

The table, with docs/scaling.md's columns, goes to FILE; scaling_fit makes the model of it.

Exit status: 0 done; 1 a program failed.
"""

import argparse
import csv
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass, replace

import hills

COLUMNS = ("series", "is_check", "triangles", "pixels", "texels", "biases", "curves", "quantity", "value")
CSV_FILES = ("results.csv", "bias_curves.csv", "error_vs_z.csv")
LONG_S = 20  # longer runs are not repeated
LEAST_ROWS = 2_500  # smaller sweeps also keep errors by object and light distance (docs/sweep.md)


@dataclass(frozen=True)
class Size:
    """The sizes that a sweep's cost depends on."""

    cells: int = 128
    image: tuple = (640, 360)
    resolution: int = 1024
    biases: int = 1
    curves: int = 1

    def with_rows(self):
        """The size with enough biases to count as a large sweep."""
        return self if self.biases * self.curves >= LEAST_ROWS else replace(self, biases=LEAST_ROWS)

    def columns(self):
        return (hills.triangles_of(self.cells), self.image[0] * self.image[1], self.resolution**2, self.biases, self.curves)

    def job(self, folder):
        axes = hills.near_axis(self.curves) + hills.bias_axis(self.biases)
        return hills.job(hills.write(folder, self.cells), *self.image, self.resolution, f"[sweep]\n{axes}" if axes else "")


SMALL = {"cells": 16, "image": (160, 90), "resolution": 256}
SERIES = {
    "start": [Size(cells=1, image=(16, 16), resolution=16)],
    "triangles": [Size(cells=cells) for cells in (64, 181, 512, 724, 1024)],
    "pixels": [Size(image=(320 * n, 180 * n)) for n in (1, 2, 4, 6)],
    "texels": [Size(image=(320, 180), resolution=side) for side in (1024, 2048, 4096, 8192)],
    "biases": [Size(**SMALL, biases=count) for count in (4_000, 12_000, 36_000, 100_000)],
    "configurations": [Size(**SMALL, biases=50, curves=count) for count in (60, 200, 600, 2_000)],
}
CHECKED = {"triangles": 3, "pixels": 3, "texels": 3, "biases": 2, "configurations": 3}  # index of the size that is excluded from the fit
WITH_PARTS = ("triangles", "pixels", "texels")


class Study:
    def __init__(self, options):
        self.bin = pathlib.Path(options.bin).resolve()
        self.work = pathlib.Path(options.work)
        self.repeats = options.repeats

    def parts(self, job):
        """The seconds of each part in one process."""
        done = subprocess.run([self.bin / "scaling_parts", job, str(self.repeats)], capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit(done.stderr)
        return {f"{part}_s": float(seconds) for part, seconds in (line.split(",") for line in done.stdout.split())}

    def gnomon(self, *arguments):
        """Runs the program; returns its processor time [s] and its largest resident set [bytes]."""
        process = subprocess.Popen([self.bin / "gnomon", *arguments], stdout=subprocess.DEVNULL)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            sys.exit(f"gnomon {' '.join(map(str, arguments))} ends with {process.returncode}")
        return used.ru_utime + used.ru_stime, used.ru_maxrss * 1024

    def sweep_once(self, job):
        run = self.work / "run"
        shutil.rmtree(run, ignore_errors=True)
        seconds, memory = self.gnomon("sweep", job, "--out", run, "--no-keep-pixels", "--quiet")
        return {"sweep_s": seconds, "memory_bytes": memory,
                "database_bytes": (run / "results.sqlite").stat().st_size,
                "csv_bytes": sum((run / name).stat().st_size for name in CSV_FILES)}

    def merge(self):
        """Measures the merge of the last run alone, in which each row passes once."""
        out = self.work / "merged"
        shutil.rmtree(out, ignore_errors=True)
        seconds, memory = self.gnomon("merge", out, self.work / "run")
        return {"merge_s": seconds, "merge_memory_bytes": memory}

    def sweep(self, job):
        """The costs of a whole sweep: the least of the repeats."""
        least = self.sweep_once(job)
        for _ in range(self.repeats - 1):
            if least["sweep_s"] > LONG_S:
                break
            least = {name: min(value, least[name]) for name, value in self.sweep_once(job).items()}
        return least

    def job(self, size):
        path = self.work / "job.toml"
        path.write_text(size.job(self.work))
        return path

    def measure(self, series, size):
        """Pairs of a size and its measured quantities by name."""
        swept = size if series == "start" else size.with_rows()
        whole = self.sweep(self.job(swept))
        if series == "start":
            whole["start_s"] = whole["sweep_s"]
        if series in ("biases", "configurations"):
            whole["small_sweep_s"] = whole["sweep_s"]
            whole |= self.merge()
        yield swept, whole
        if series in WITH_PARTS:
            yield size, self.parts(self.job(size))

    def rows(self, series):
        for place, size in enumerate(SERIES[series]):
            is_check = int(place == CHECKED.get(series))
            for measured, found in self.measure(series, size):
                for quantity, value in found.items():
                    print(series, measured, quantity, value, flush=True)
                    yield (series, is_check, *measured.columns(), quantity, f"{value:.6g}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin")
    parser.add_argument("--out", default="scaling_measurements.csv")
    parser.add_argument("--work")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--only", nargs="*", choices=SERIES, default=list(SERIES))
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        options.work = options.work or place
        study = Study(options)
        rows = [row for series in options.only for row in study.rows(series)]
    with open(options.out, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([COLUMNS, *rows])


if __name__ == "__main__":
    main()
