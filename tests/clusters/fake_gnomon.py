#!/usr/bin/python3
"""Replaces the program on a worker: `doctor --json`, and `run-unit PLAN UNIT --out DIR`, controlled by the unit's name.

slow-N waits for N tenths of a second; bad-… fails; once-… kills the worker that it runs on, and dies-…
itself, the first time.
"""
import json
import os
import pathlib
import signal
import sys
import time

log = pathlib.Path(os.environ["FAKE_LOG"])

if sys.argv[1] == "doctor":
    is_mixed = "FAKE_MIXED" in os.environ
    renderer = f"renderer {os.getpid()}" if is_mixed else "one renderer"
    print(json.dumps({"gnomon": "1", "gl": {"renderer": renderer, "version": "4.5"}, "embree": "3"}))
    sys.exit(0)

unit, folder = sys.argv[3], pathlib.Path(sys.argv[5])
with log.open("a") as file:
    file.write(f"{unit}\n")
if "--scenes" in sys.argv:
    scenes = sorted(pathlib.Path(sys.argv[sys.argv.index("--scenes") + 1]).iterdir())
    with log.with_name("scenes").open("a") as file:
        file.write(f"{unit} " + " ".join(scene.read_text() for scene in scenes) + "\n")
if unit.startswith("bad"):
    sys.exit("gnomon: this unit is bad")
if unit.startswith("once") and log.read_text().split().count(unit) == 1:
    os.kill(os.getppid(), signal.SIGKILL)
if unit.startswith("dies") and log.read_text().split().count(unit) == 1:
    os.kill(os.getpid(), signal.SIGKILL)
if unit.startswith("slow"):
    time.sleep(int(unit.rsplit("-", 1)[1]) / 10)
(folder / f"{unit}.unit").write_text(f"bytes of {unit}")
