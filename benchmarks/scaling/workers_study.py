#!/usr/bin/python3
"""Does a sweep on workers take longer than the same sweep in shards that are started by hand?

    workers_study.py GNOMON [--curves N] [--biases N] [--repeats N] [--units N]

The sweep is of scaling_study.py's scene at 1280 × 720, with a map and a lookup for each curve. It is run on `--on local:2`, and
as two simultaneous shards of one thread each, which are merged; turn about, so that what else the machine does meets both.
Clock time is that of the whole, processor time that of all its processes; the shards' are said without their merge and
with it. The CSV files of both must have the same bytes. A virtual machine's speed may differ by a fifth from one minute to the
next, so several repeats are better than one long run: the last lines are medians of what the repeats gave.

Exit status: 0 done; 1 a program failed, or the files differ.
"""

import argparse
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

import scaling_study

CSV_FILES = scaling_study.CSV_FILES


class Watch:
    """Measures clock time, and processor time of ended children, since its creation."""

    def __init__(self):
        self.begin = time.monotonic()
        self.spent = self.processors()

    @staticmethod
    def processors():
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return used.ru_utime + used.ru_stime

    def read(self):
        return time.monotonic() - self.begin, self.processors() - self.spent


def run_all(commands):
    """Runs commands at the same time; exits if one fails."""
    processes = [subprocess.Popen(command, stdout=subprocess.DEVNULL) for command in commands]
    for command, process in zip(commands, processes):
        if process.wait():
            sys.exit(f"{' '.join(map(str, command))} ends with {process.returncode}")


class Runs:
    def __init__(self, options, folder):
        self.gnomon, self.folder, self.units = options.gnomon, folder, options.units
        size = scaling_study.Size(image=(1280, 720), biases=options.biases, curves=options.curves)
        self.job = folder / "job.toml"
        self.job.write_text(size.job(folder))
        self.count = 0

    def sweep(self, out, *options):
        return [self.gnomon, "sweep", self.job, "--out", out, "--quiet", "--no-keep-pixels", *options]

    def on_workers(self):
        out = self.folder / f"workers{self.count}"
        watch = Watch()
        run_all([[self.gnomon, "sweep", self.job, "--out", out, "--quiet", "--on", "local:2", "--units", str(self.units)]])
        return out, watch.read()

    def by_hand(self):
        """The run, and the times without and with the merge."""
        shards = [self.folder / f"shard{self.count}.{part}" for part in (1, 2)]
        watch = Watch()
        run_all([self.sweep(shard, "--shard", f"{part}/2", "--threads", "1") for part, shard in enumerate(shards, 1)])
        computed = watch.read()
        out = self.folder / f"merged{self.count}"
        run_all([[self.gnomon, "merge", out, *shards]])
        return out, computed, watch.read()

    def compare(self):
        """Runs both once; returns the times."""
        self.count += 1
        out, workers = self.on_workers()
        merged, shards, with_merge = self.by_hand()
        for name in CSV_FILES:
            if (out / name).read_bytes() != (merged / name).read_bytes():
                sys.exit(f"{name} of workers and of shards differ")
        return {"workers": workers, "shards": shards, "shards and merge": with_merge}


def print_ratios(name, ratios):
    print(f"workers / {name:<24} clock {ratios[0]:.3f}   processors {ratios[1]:.3f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("gnomon", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--curves", type=int, default=100)
    parser.add_argument("--biases", type=int, default=1_000)
    parser.add_argument("--repeats", type=int, default=1)
    parser.add_argument("--units", type=int, default=10)
    options = parser.parse_args()
    print(f"{options.curves * options.biases:,} configurations in {options.curves:,} curves; load {os.getloadavg()[0]:.1f}")
    with tempfile.TemporaryDirectory() as place:
        runs = Runs(options, pathlib.Path(place))
        ratios = {name: [] for name in ("shards", "shards and merge")}
        for _ in range(options.repeats):
            times = runs.compare()
            for name, (clock, processors) in times.items():
                print(f"{name:<18} clock {clock:7.1f} s   processors {processors:7.1f} s")
            for name, known in ratios.items():
                known.append([workers / hand for workers, hand in zip(times["workers"], times[name])])
                print_ratios(name, known[-1])
        for name, known in ratios.items():
            print_ratios(f"{name}, median", [statistics.median(values) for values in zip(*known)])


if __name__ == "__main__":
    main()
