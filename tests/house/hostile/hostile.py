#!/usr/bin/python3
"""Hostile inputs, outputs and ends: the program ends with one of its own exit codes, says one line, and leaves
no half of a file.

    hostile.py GNOMON [--few] [-k TEXT]

Each case runs in a folder of its own. It names what is prepared there, the command, the exit codes that are right
and words of the error. Whatever it is about, these hold: no signal but the one sent, no text of a crash, at most
one line of error, and every file that was there before is as it was, or whole. --few: a second's worth of each
kind; -k: cases whose name contains TEXT.
"""

import argparse
import os
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

TINY = ["--set", "image.width=16", "--set", "image.height=16", "--set", "shadow_map.resolution=16"]
LONGEST_S = 300
CRASH = re.compile(r"terminate called|core dumped|Sanitizer|Assertion|internal error|std::|Traceback|report it with")
PROGRESS = re.compile(r"^gnomon sweep: |^gnomon tune: |^\s*$|^gnomon: interrupted; finishing")


class Skip(Exception):
    """A case that cannot be tried here, and why."""


@dataclass
class Case:
    name: str
    command: list  # words after gnomon; "{d}" is the case's folder
    codes: tuple
    words: str = ""
    prepare: Callable = None
    is_quick: bool = False
    kept: tuple = ()  # files that must be as they were
    absent: tuple = ()  # files that must not be there
    signals: tuple = ()  # (seconds, signal), …
    stdout: str = None
    inspect: Callable = None
    lines: int = 1  # of error, at most


def compare(*more, scene="wall"):
    return ["compare", "--builtin", scene, *TINY, *more]


def job_of(text):
    return ["compare", "{d}/job.toml", *TINY], lambda d: (d / "job.toml").write_bytes(text)


def write(name, data):
    return lambda d: (d / name).write_bytes(data if isinstance(data, bytes) else data.encode())


NOISE = random.Random(1).randbytes(4096)


def bad_jobs():
    """Garbage, encodings, sizes and values in job files."""
    texts = {
        "noise": NOISE, "empty name": b"=1\n", "NUL": b"[scene]\nbuiltin = \"wall\0\"\n",
        "UTF-16": "[scene]\n".encode("utf-16"), "bad UTF-8": b"[scene]\nbuiltin = \"\xff\xfe\"\n",
        "endless text": b"[scene]\nbuiltin = \"wall", "deep arrays": b"a = " + b"[" * 100_000,
        "long key": b"a" * 1_000_000 + b" = 1\n", "twice": b"[scene]\nbuiltin=\"wall\"\nbuiltin=\"wall\"\n",
        "date": b"[image]\nwidth = 2020-01-01\n", "table for a number": b"[image.width]\na=1\n",
        "huge integer": b"[image]\nwidth = 99999999999999999999999\n", "negative": b"[image]\nwidth = -5\n",
        "huge image": b"[image]\nwidth = 2147483647\nheight = 2147483647\n",
        "many axes": b"[scene]\nbuiltin=\"wall\"\n[sweep]\n\"bias.constant\" = {from=0, to=1, count=99999999999}\n",
        "a folder as scene": b"[scene]\nfile = \"/\"\n", "a device as scene": b"[scene]\nfile = \"/dev/zero.obj\"\n",
        "nan": b"[bias]\nconstant = nan\n", "inf": b"[camera]\neye = [inf, 0, 0]\n",
    }
    for name, text in texts.items():
        command, prepare = job_of(text)
        if name == "many axes":
            command = ["sweep", "{d}/job.toml", "--out", "{d}/run"]
        yield Case(f"job: {name}", command, (2,), "gnomon: ", prepare, is_quick=name in ("noise", "deep arrays"))


def glb(json_text, length=None):
    body = json_text.encode() + b" " * (-len(json_text) % 4)
    return struct.pack("<4sIIII", b"glTF", 2, length or 20 + len(body), len(body), 0x4E4F534A) + body


PLY = "ply\nformat ascii 1.0\nelement vertex {v}\nproperty float x\nproperty float y\nproperty float z\n" \
      "element face {f}\nproperty list uchar int vertex_indices\nend_header\n{body}"


def obj(x):
    return f"v 0 0 0\nv 1 0 0\nv 0 {x} 0\nf 1 2 3\n"


def linked_buffer(d):
    (d / "b.bin").symlink_to("/etc/passwd")
    (d / "a.gltf").write_text('{"asset":{"version":"2.0"},"buffers":[{"uri":"b.bin","byteLength":99}]}')


def bad_scenes():
    """Scene files that are garbage, lie about sizes, or hold numbers that are none."""
    for ending in ("obj", "ply", "gltf", "glb"):
        for kind, data in (("noise", NOISE), ("empty", b""), ("text", b"hello\n"), ("zeros", bytes(1000))):
            yield Case(f"{ending}: {kind}", ["compare", "{d}/a." + ending, *TINY], (2,), "", write("a." + ending, data),
                       is_quick=kind == "noise")
    for x in ("nan", "inf", "-inf", "1e30", "1e999"):
        yield Case(f"obj: vertex {x}", ["compare", "{d}/a.obj", *TINY], (2,), "", write("a.obj", obj(x)))
    files = {
        "obj: index beyond": ("a.obj", obj("1").replace("1 2 3", "1 2 99")),
        "obj: no area": ("a.obj", obj("0")),
        "ply: vertices that are not there": ("a.ply", PLY.format(v=4_000_000_000, f=1, body="0 0 0\n3 0 1 2\n")),
        "ply: index beyond": ("a.ply", PLY.format(v=3, f=1, body="0 0 0\n1 0 0\n0 1 0\n3 0 1 77\n")),
        "ply: cut": ("a.ply", PLY.format(v=3, f=1, body="0 0 0\n1 0")),
        "glb: length lies": ("a.glb", glb('{"asset":{"version":"2.0"}}', 0xFFFFFFF0)),
        "glb: cut": ("a.glb", glb('{"asset":{"version":"2.0"}}')[:25]),
        "gltf: buffer out of the folder": ("a.gltf", '{"asset":{"version":"2.0"},"buffers":'
                                           '[{"uri":"../../../../etc/passwd","byteLength":99}]}'),
        "gltf: buffer that lies": ("a.gltf", '{"asset":{"version":"2.0"},"buffers":[{"byteLength":9e18}]}'),
        "gltf: deep": ("a.gltf", "[" * 200_000),
    }
    for name, (file, data) in files.items():
        yield Case(name, ["compare", "{d}/" + file, *TINY], (2,), "", write(file, data))
    yield Case("gltf: link out of the folder", ["compare", "{d}/a.gltf", *TINY], (2,), "", linked_buffer)
    yield Case("scene: a pipe", ["compare", "{d}/a.obj", *TINY], (2,), "", lambda d: os.mkfifo(d / "a.obj"))
    yield Case("scene: a folder", ["compare", "{d}/a.obj", *TINY], (2,), "", lambda d: (d / "a.obj").mkdir())
    yield Case("job: a folder", ["compare", "{d}/job.toml"], (2,), "", lambda d: (d / "job.toml").mkdir())
    yield Case("job: nothing", ["compare", "{d}/job.toml"], (2,), "job.toml", is_quick=True)
    yield Case("job: a loop of links", ["compare", "{d}/job.toml"], (2,), "",
               lambda d: (d / "job.toml").symlink_to(d / "job.toml"))


def exported(gnomon):
    def prepare(d):
        subprocess.run([gnomon, *compare("--export-case", str(d / "case"))], check=True, capture_output=True)
    return prepare


def damaged(gnomon, make, name, change):
    def prepare(d):
        make(gnomon)(d)
        file = d / name
        file.write_bytes(change(file.read_bytes()))
    return prepare


DAMAGES = {"noise": lambda b: NOISE, "empty": lambda b: b"", "half": lambda b: b[: len(b) // 2],
           "end cut": lambda b: b[:-1], "zeros": lambda b: bytes(len(b)),
           "middle": lambda b: b[: len(b) // 3] + NOISE[:64] + b[len(b) // 3 + 64:]}


def run_of(gnomon):
    def prepare(d):
        subprocess.run([gnomon, "sweep", "--builtin", "wall", *TINY, "--axis", "bias.constant=0,0.1", "--out",
                        str(d / "run"), "--quiet"], check=True, capture_output=True)
        subprocess.run([gnomon, "baseline", "save", str(d / "run"), "--baseline", str(d / "b.json")], check=True,
                       capture_output=True)
    return prepare


def aov_of(gnomon):
    def prepare(d):
        subprocess.run([gnomon, *compare("--aov", str(d / "a.exr"))], check=True, capture_output=True)
    return prepare


def bad_results(gnomon):
    """Cases, runs, baselines and tables of which something is damaged. What a change leaves sound may pass."""
    for what, change in DAMAGES.items():
        quick = what == "half"
        for file in ("aov.exr", "mesh.glb", "case.toml"):
            codes = (0, 2) if what in ("end cut", "middle") else (2,)
            yield Case(f"case: {file}: {what}", ["evaluate", "{d}/case"], codes, "",
                       damaged(gnomon, exported, f"case/{file}", change), is_quick=quick and file == "aov.exr")
        for verb in ("report", "status", "gate"):
            more = ["--baseline", "{d}/b.json"] if verb == "gate" else []
            yield Case(f"{verb}: database: {what}", [verb, "{d}/run", *more], (0, 2, 4, 5), "",
                       damaged(gnomon, run_of, "run/results.sqlite", change), is_quick=quick and verb == "status")
        yield Case(f"merge: one database: {what}", ["merge", "{d}/all", "{d}/run"], (0, 2, 4, 5), "",
                   damaged(gnomon, run_of, "run/results.sqlite", change))
        # What a change leaves readable may be certified, or refuted.
        codes = (0, 1, 2) if what in ("end cut", "middle") else (2,)
        yield Case(f"certify: AOV: {what}", ["certify", "{d}/a.exr", "--builtin", "wall", *TINY], codes, "",
                   damaged(gnomon, aov_of, "a.exr", change), is_quick=quick)
        yield Case(f"gate: baseline: {what}", ["gate", "{d}/run", "--baseline", "{d}/b.json"], (0, 1, 2, 3), "",
                   damaged(gnomon, run_of, "b.json", change))
        yield Case(f"figure: table: {what}", ["figure", "bias-curve", "{d}/run", "-o", "{d}/f.svg"], (0, 2, 4), "",
                   damaged(gnomon, run_of, "run/bias_curves.csv", change))
        yield Case(f"resume: database: {what}", ["sweep", "--builtin", "wall", *TINY, "--axis", "bias.constant=0,0.1",
                                                 "--out", "{d}/run", "--quiet"], (0, 2, 4), "",
                   damaged(gnomon, run_of, "run/results.sqlite", change))


def small_disk(d):
    if os.geteuid() != 0 or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k", "none", str(d)],
                                           capture_output=True).returncode != 0:
        raise Skip("mounting a small disk needs root")


def unwritable(d):
    if os.geteuid() == 0:
        raise Skip("root may write in a read-only folder")
    d.chmod(0o500)


def bad_outputs():
    """Folders, devices, pipes and full disks where a file is to go; a file that is there already stays."""
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
    """After any end the same command completes the run, and the tables are those of an undisturbed one."""
    command = [w.replace("{d}", str(d)) for w in SWEEP]
    assert subprocess.run([gnomon, *command], capture_output=True, timeout=LONGEST_S).returncode == 0, "does not resume"
    whole = [w.replace("{d}/run", str(d / "whole")) for w in SWEEP]
    subprocess.run([gnomon, *whole], check=True, capture_output=True)
    for table in ("results.csv", "bias_curves.csv", "error_vs_z.csv"):
        assert (d / "run" / table).read_bytes() == (d / "whole" / table).read_bytes(), f"{table} differs"


def early_ends():
    """Signals while it works; a second one at once; and what is left of it."""
    for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGKILL", "SIGPIPE"):
        number = getattr(signal, name)
        # On an idle machine the sweep may be done before the signal comes.
        codes = {"SIGKILL": (-9, 0), "SIGPIPE": (0,)}.get(name, (130, 128 + number, 0))
        yield Case(f"end: {name} and resuming", SWEEP, codes, "", signals=((0.6, number),), inspect=resumed,
                   is_quick=name == "SIGTERM", lines=2)
        yield Case(f"end: {name} while comparing", ["compare", "--builtin", "sphere-plane", "--aov", "{d}/a.exr"],
                   (*codes, 0), "", write("a.exr", b"mine"), signals=((0.3, number),), inspect=whole_exr)
    yield Case("end: twice SIGINT", SWEEP, (130, 0), "", signals=((0.5, signal.SIGINT), (0.1, signal.SIGINT)),
               inspect=resumed, lines=3)


def whole_exr(_, d):
    data = (d / "a.exr").read_bytes()
    assert data == b"mine" or data.startswith(b"\x76\x2f\x31\x01"), "a.exr is half"


def second_writer(gnomon):
    """What starts a first writer and waits until it writes, and what waits for its end."""
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


VALUES = ("0", "-1", "1e-300", "1e300", "nan", "inf", "-inf", "1e-8", "-0.0", "9e15", "true", '"x"', "[]")


def absurd_values(gnomon):
    """Every key with numbers that nobody means."""
    text = subprocess.run([gnomon, "init"], capture_output=True, text=True, check=True).stdout
    table = ""
    for line in text.splitlines():
        line = line.lstrip("# ")
        if match := re.match(r"\[(\w+)\]", line):
            table = match[1]
        elif (match := re.match(r"(\w+) *= *(.*)", line)) and table and table != "sweep":
            key = f"{table}.{match[1]}"
            for value in VALUES:
                value = f"[{value}, 1, 1]" if match[2].startswith("[") and value != "[]" else value
                for scene in ("sphere-plane", "yard"):
                    yield Case(f"key: {scene}: {key} = {value}", compare("--set", f"{key}={value}", scene=scene),
                               (0, 2), "")


def all_cases(gnomon):
    for group in (bad_jobs(), bad_scenes(), bad_results(gnomon), bad_outputs(), early_ends(), others(gnomon),
                  absurd_values(gnomon)):
        yield from group


def start(gnomon, case, d):
    """What the program printed, and how it ended."""
    limit = case.prepare[1] if isinstance(case.prepare, tuple) else 0
    shell = ["bash", "-c", f'ulimit -v {limit * 1024}; exec "$@"', "bash"] if limit else []
    command = shell + [gnomon] + [word.replace("{d}", str(d)) for word in case.command]
    out = open(case.stdout, "wb") if case.stdout else subprocess.DEVNULL
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.PIPE, cwd=d)
    for delay, number in case.signals:
        time.sleep(delay)
        process.send_signal(number)
    try:
        error = process.communicate(timeout=LONGEST_S)[1].decode(errors="replace")
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        raise AssertionError(f"ran longer than {LONGEST_S} s") from None
    return process.returncode, error


def check(gnomon, case, d):
    if callable(case.prepare):
        case.prepare(d)
    before = {name: (d / name).read_bytes() for name in case.kept}
    code, error = start(gnomon, case, d)
    lines = [line for line in error.splitlines() if not PROGRESS.match(line)]
    assert code in case.codes, f"exit code {code}, not in {case.codes}: {error.strip()[:300]}"
    assert not CRASH.search(error), f"text of a crash: {error.strip()[:300]}"
    assert len(lines) <= case.lines, f"{len(lines)} lines of error: {error.strip()[:400]}"
    assert code in (0, 1, 5) or code < 0 or lines, "an error without a line"
    assert case.words in error, f"no \"{case.words}\" in: {error.strip()[:300]}"
    for name, data in before.items():
        assert (d / name).read_bytes() == data, f"{name} was changed"
    for name in case.absent:
        assert not (d / name).exists(), f"{name} was left"
    if code != -signal.SIGKILL:
        halves = [p.name for p in d.rglob(".*.tmp")]
        assert not halves, f"left {halves}"
    if case.inspect:
        case.inspect(gnomon, d)


def run_case(gnomon, case):
    d = Path(tempfile.mkdtemp(prefix="gnomon-hostile-"))
    try:
        check(gnomon, case, d)
    finally:
        subprocess.run(["umount", str(d)], capture_output=True, check=False)
        d.chmod(0o700)
        shutil.rmtree(d, ignore_errors=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("gnomon")
    parser.add_argument("--few", action="store_true")
    parser.add_argument("-k", default="", metavar="TEXT")
    options = parser.parse_args()
    gnomon = str(Path(options.gnomon).resolve())
    tried = failed = 0
    for case in all_cases(gnomon):
        if options.k not in case.name or (options.few and not case.is_quick):
            continue
        tried += 1
        try:
            run_case(gnomon, case)
        except Skip as reason:
            print(f"skipped: {case.name}: {reason}")
        except AssertionError as wrong:
            failed += 1
            print(f"FAILED: {case.name}: {wrong}", flush=True)
    print(f"{tried} cases, {failed} failed")
    return 1 if failed or not tried else 0


if __name__ == "__main__":
    sys.exit(main())
