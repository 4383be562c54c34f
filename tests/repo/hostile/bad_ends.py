"""Unwritable places, early ends, second writers, and commands that fit nothing."""

import os
import signal
import subprocess
import time

from bad_results import aov_of, exported, run_of
from case import LONGEST_S, TINY, Case, Skip, compare, write


def small_disk(d):
    if os.geteuid() != 0 or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k", "none", str(d)],
                                           capture_output=True).returncode != 0:
        raise Skip("mounting a small disk needs root")


def unwritable(d):
    if os.geteuid() == 0:
        raise Skip("root may write in a read-only folder")
    d.chmod(0o500)


def bad_outputs():
    """The output is a folder, a device, a pipe or on a full disk. An existing file stays."""
    options = {"--aov": "x.exr", "--picture": "x.png", "--depth-map": "d.exr"}
    for option, name in options.items():
        quick = option == "--picture"
        target = "{d}/" + name
        yield Case(f"output: {option}: a folder", compare(option, target), (4,), "cannot write",
                   lambda d, n=name: (d / n).mkdir())
        yield Case(f"output: {option}: no folder", compare(option, "{d}/none/" + name), (4,), "create the folder",
                   is_quick=quick)
        yield Case(f"output: {option}: full device", compare(option, "/dev/full"), (4,), "No space left", is_quick=quick)
        yield Case(f"output: {option}: full disk", compare(option, target), (0, 4), "", small_disk)
        yield Case(f"output: {option}: read-only folder", compare(option, target), (4,), "may be written", unwritable)
        yield Case(f"output: {option}: another format", compare(option, "{d}/x.jpg"), (2,), "name it so",
                   write("x.jpg", b"mine"), kept=("x.jpg",))
    yield Case("output: the case's own image", ["init", "{d}/a.json"], (2,), "name it so", absent=("a.json",))
    yield Case("output: stdout is full", compare("--json"), (4,), "", stdout="/dev/full", is_quick=True)
    yield Case("output: export over a case", compare("--export-case", "{d}"), (2,), "--force",
               write("case.toml", b"mine"), kept=("case.toml",), absent=("mesh.glb",), is_quick=True)
    yield Case("output: init over a file", ["init", "{d}/j.toml"], (2,), "--force", write("j.toml", b"mine"),
               kept=("j.toml",))
    yield Case("output: run is a file", compare("--out", "{d}/run"), (2, 4), "", write("run", b"mine"), kept=("run",))
    yield Case("output: run is on a full disk", ["sweep", "--builtin", "wall", *TINY, "--axis", "bias.constant=0,0.1",
                                                 "--out", "{d}/run", "--quiet"], (4,), "", small_disk)
    yield Case("output: report over a file", ["report", "{d}/run", "--out", "{d}/run/results.csv"], (2, 4), "")


SWEEP = ["sweep", "--builtin", "wall", "--set", "image.width=320", "--set", "image.height=200", "--axis",
         "shadow_map.resolution=64,128,256,512", "--axis", "bias.slope=0,1,2,3", "--out", "{d}/run", "--quiet",
         "--no-keep-pixels"]


def resumed(gnomon, d):
    """The same command completes the run, with the tables of an undisturbed run."""
    command = [w.replace("{d}", str(d)) for w in SWEEP]
    assert subprocess.run([gnomon, *command], capture_output=True, timeout=LONGEST_S).returncode == 0, "does not resume"
    whole = [w.replace("{d}/run", str(d / "whole")) for w in SWEEP]
    subprocess.run([gnomon, *whole], check=True, capture_output=True)
    for table in ("results.csv", "bias_curves.csv", "error_vs_z.csv"):
        assert (d / "run" / table).read_bytes() == (d / "whole" / table).read_bytes(), f"{table} differs"


def early_ends():
    """Signals while it works, and a second one at once."""
    for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGKILL", "SIGPIPE"):
        number = getattr(signal, name)
        # On an idle machine the sweep may end before the signal.
        codes = {"SIGKILL": (-9, 0), "SIGPIPE": (0,)}.get(name, (130, 128 + number, 0))
        yield Case(f"end: {name} and resuming", SWEEP, codes, "", signals=((0.6, number),), inspect=resumed,
                   is_quick=name == "SIGTERM", lines=2)
        yield Case(f"end: {name} while comparing", ["compare", "--builtin", "sphere-plane", "--aov", "{d}/a.exr"],
                   (*codes, 0), "", write("a.exr", b"mine"), signals=((0.3, number),), inspect=whole_exr)
    yield Case("end: twice SIGINT", SWEEP, (130, 0), "", signals=((0.5, signal.SIGINT), (0.1, signal.SIGINT)),
               inspect=resumed, lines=3)


def whole_exr(_, d):
    data = (d / "a.exr").read_bytes()
    assert data == b"mine" or data.startswith(b"\x76\x2f\x31\x01"), "a.exr is partial"


def second_writer(gnomon):
    """Two functions: one starts a first writer and waits until it writes, one waits for its end."""
    writers = []

    def prepare(d):
        command = [w.replace("{d}", str(d)) for w in SWEEP]
        first = subprocess.Popen([gnomon, *command], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not (d / "run" / "lock").exists() and first.poll() is None:
            time.sleep(0.01)
        writers.append(first)

    def finish(_, d):
        assert writers.pop().wait(LONGEST_S) == 0, "the first writer failed"
        resumed(gnomon, d)

    return prepare, finish


def others(gnomon):
    prepare, finish = second_writer(gnomon)
    yield Case("two writers on one run", SWEEP, (2,), "", prepare, inspect=finish, is_quick=True)
    for value in ("nan", "-1", "inf", "x", "1e999"):
        yield Case(f"evaluate: tolerance {value}", ["evaluate", "{d}/case", "--tolerance-m", value], (2,),
                   "--tolerance-m", exported(gnomon))
    yield Case("spot: near of nothing", compare("--set", "shadow_map.near=1e-300", scene="sphere-cube"), (2,),
               'shadow_map.near = 1e-300 is too small', is_quick=True)
    directional = ["--set", "light.type=directional", "--set", "light.direction=[0,-1,0.3]"]
    yield Case("directional: range of nothing", compare("--set", "shadow_map.near=1e-300", "--set",
               "shadow_map.far=2e-300", *directional, scene="yard"), (2,), "too close", is_quick=True)
    yield Case("certify: of another job", ["certify", "{d}/a.exr", "--builtin", "yard", *TINY], (2,), "",
               aov_of(gnomon))
    yield Case("certify: no AOV", ["certify", "{d}/none.exr", "--builtin", "wall"], (2,), "none.exr")
    yield Case("merge: into one of its runs", ["merge", "{d}/run", "{d}/run"], (2,), "", run_of(gnomon))
    yield Case("merge: no run", ["merge", "{d}/all", "{d}/none"], (2,), "none", absent=("all",))
    yield Case("merge: a run that is a file", ["merge", "{d}/all", "{d}/mine"], (2,), "mine", write("mine", b"mine"),
               kept=("mine",), absent=("all",))
    for limit in (80, 200, 400, 800):
        yield Case(f"memory: {limit} MiB", ["compare", "--builtin", "sphere-plane", "--set",
                                            "shadow_map.resolution=4096"], (0, 2, 4), "", prepare=("limit", limit))
