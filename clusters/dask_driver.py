"""Computes units of a planned sweep on the workers of a Dask cluster. `gnomon sweep --on` starts it.

driver.py describes its input and output. CLUSTER is dask://HOST:PORT, or local:N for N workers of one thread each on this
machine.
"""

import importlib.util
import json
import os
import secrets
import sys
import threading
import time

from driver import Work, retry_words, run_driver, say

# After this silence a worker counts as dead, and its units go to others.
silence_s = 30
# How long the scheduler may be unreachable, for example during a restart.
absence_s = 120
# Scenes are sent in pieces of this size.
piece_bytes = 16 << 20
# Scenes used within this time are not removed from a worker to make room.
recent_s = 60
# Interval for checking the number of workers.
asking_s = 1
# Dask profiles its tasks, which are assumed to take milliseconds. Ours take seconds or minutes; longer intervals reduce the load of a
# waiting worker from 5 % to 1 % of a processor.
quiet_dask = {
    "distributed.worker.profile.enabled": False,
    "distributed.worker.profile.interval": "10 s",
    "distributed.admin.tick.interval": "1 s",
    "distributed.admin.tick.limit": f"{silence_s} s",
    "distributed.admin.system-monitor.interval": "5 s",
}


def environment_of_worker(program):
    """Runs on a worker: returns its versions of GL, Embree and Gnomon."""
    import json
    import subprocess

    done = subprocess.run([program, "doctor", "--json"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip() or f"{program} doctor ends with {done.returncode}")
    found = json.loads(done.stdout)
    return {"gl_renderer": found["gl"]["renderer"], "gl_version": found["gl"]["version"],
            "embree": found["embree"], "gnomon": found["gnomon"]}


def folder_of_worker(name):
    """Runs on a worker: creates a folder of this user, and returns its path."""
    import os
    import tempfile

    folder = os.path.join(tempfile.gettempdir(), f"gnomon-{os.getuid()}", name)
    os.makedirs(folder, mode=0o700, exist_ok=True)
    return folder


def lacking_scenes(cache, names):
    """Runs on a worker: returns the scenes that it lacks."""
    import os

    folder = folder_of_worker(cache)
    return [name for name in names if not os.path.exists(os.path.join(folder, name))]


def take_piece(cache, name, token, piece, is_last, most_bytes):
    """Runs on a worker: appends to a scene. After the last piece, removes the least recently used scenes if space runs out."""
    import os
    import time

    folder = folder_of_worker(cache)
    temporary = os.path.join(folder, f".{name}.{token}.tmp")
    with open(temporary, "ab") as file:
        file.write(piece)
    if not is_last:
        return
    os.rename(temporary, os.path.join(folder, name))
    known = []
    for other in os.scandir(folder):
        status = other.stat()
        known.append((status.st_mtime, status.st_size, other.path))
    total = sum(size for _, size, _ in known)
    for used, size, path in sorted(known):
        if total > most_bytes and time.time() - used > recent_s:
            os.remove(path)
            total -= size


def link_scenes(cache, names, place):
    """Runs on a worker: links cached scenes into a folder, so that they stay; returns the missing ones."""
    import os

    folder = folder_of_worker(cache)
    lacking = []
    for name in names:
        path = os.path.join(folder, name)
        try:
            os.link(path, os.path.join(place, name))
            os.utime(path)
        except FileNotFoundError:
            lacking.append(name)
    return lacking


def forget_scenes(cache, names):
    """Runs on a worker: removes scenes that may be damaged, so that the next try gets them again."""
    import contextlib
    import os

    for name in names:
        with contextlib.suppress(FileNotFoundError):
            os.remove(os.path.join(folder_of_worker(cache), name))


def compute_unit(plan, plan_id, unit, program, words, stop_name, folder, cache, scenes):
    """Runs on a worker: computes a unit, and returns the bytes of its file, unless the folder is shared.

    If the worker lacks scenes, returns their names instead.
    """
    import ctypes
    import os
    import shutil
    import signal
    import subprocess
    import tempfile
    import time

    from distributed import Event, get_worker

    units = folder or folder_of_worker(plan_id)
    plan_file = os.path.join(units, "plan.jsonl")
    if not os.path.exists(plan_file):
        handle, temporary = tempfile.mkstemp(dir=units)
        with os.fdopen(handle, "wb") as file:
            file.write(plan)
        os.rename(temporary, plan_file)

    def end_with_worker():
        ctypes.CDLL(None).prctl(1, signal.SIGTERM)  # PR_SET_PDEATHSIG

    command = [program, "run-unit", plan_file, unit, "--out", units, "--quiet", *words]
    place = None
    if scenes:
        place = tempfile.mkdtemp(prefix=".scenes-", dir=units)
        lacking = link_scenes(cache, scenes, place)
        if lacking:
            shutil.rmtree(place)
            return {"lacking": lacking, "address": get_worker().address}
        command += ["--scenes", place]
    with subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
        errors="replace", preexec_fn=end_with_worker,
    ) as process:
        stop = Event(stop_name)
        asked = time.monotonic()
        while process.poll() is None:
            time.sleep(0.05)
            if time.monotonic() - asked > 1:
                asked = time.monotonic()
                if stop.is_set():
                    process.terminate()
        message = process.stderr.read().strip()
    if place:
        shutil.rmtree(place)
    path = os.path.join(units, unit + ".unit")
    if process.returncode in (2, 4) and not os.path.exists(path):
        forget_scenes(cache, scenes)
    # 4 and 5: the file exists, but contains failures, which the run will report.
    if process.returncode not in (0, 4, 5) or not os.path.exists(path):
        raise RuntimeError(message or f"gnomon run-unit ends with {process.returncode}")
    content = None
    if not folder:
        with open(path, "rb") as file:
            content = file.read()
    return {"content": content, "worker": get_worker().name}


def forget_plan(plan_id):
    """Runs on a worker: removes the folder of a finished plan."""
    import shutil

    shutil.rmtree(folder_of_worker(plan_id), ignore_errors=True)


class Driver:
    def __init__(self, options, units):
        self.options = options
        self.work = Work(units)
        self.failed_on = {unit["unit"]: set() for unit in units}
        self.running = {}  # futures, and their units
        self.client = None
        self.cluster = None
        is_local = options.cluster.startswith("local:")
        self.shared_folder = options.folder if is_local else None
        threads = options.threads or (1 if is_local else 0)
        self.words = [*(["--threads", str(threads)] if threads else []), *retry_words(options)]
        with open(options.plan, "rb") as file:
            self.plan = file.read()
        first, *lines = [json.loads(line) for line in self.plan.splitlines()]
        self.plan_id = first["plan"]
        self.cache = f"scenes-{first.get('gnomon')}"  # packed scenes depend on the version
        self.scenes = self.scenes_of_units(first, lines) if options.scenes else {}
        self.home = {}  # workers that hold the scenes of a unit
        self.stop_name = f"gnomon-stop-{self.plan_id}-{os.getpid()}-{time.time_ns()}"
        self.ends = threading.Event()

    def scenes_of_units(self, first, lines):
        """The files in options.scenes that each unit needs."""
        files = {}
        for scene in first["scenes"]:
            name = f"{scene['hash']}-{scene['brought']}.scene"
            if os.path.exists(os.path.join(self.options.scenes, name)):
                files.setdefault(scene["hash"], set()).add(name)
        return {line["unit"]: sorted(set().union(*(files.get(content, ()) for content in line["scenes"])))
                for line in lines}

    def connect(self):
        import dask
        from distributed import Client, LocalCluster

        dask.config.set({"distributed.scheduler.worker-ttl": f"{silence_s} s", **quiet_dask})
        kind, _, place = self.options.cluster.partition(":")
        if kind == "local":
            self.cluster = LocalCluster(
                n_workers=int(place), threads_per_worker=1, processes=True, dashboard_address=None)
            self.client = Client(self.cluster)
        else:
            self.client = Client("tcp:" + place, timeout=f"{absence_s} s")
        self.client.wait_for_workers(1, timeout=absence_s)

    def check_environments(self):
        """Refuses workers with different GL renderers, whose results may differ."""
        known = self.client.run(environment_of_worker, self.options.program, on_error="return")
        first = None
        for worker, environment in sorted(known.items()):
            if isinstance(environment, BaseException):
                raise RuntimeError(f"worker {worker}: {environment}")
            say(worker=worker, environment=environment)
            first = first or (worker, environment)
            if environment != first[1] and not self.options.allow_mixed:
                raise RuntimeError(
                    f"workers differ: {first[0]} has {environment_text(first[1])}, {worker} has "
                    f"{environment_text(environment)}: use workers of one kind, or pass --allow-mixed")

    def submit(self):
        """Gives each idle thread a unit, the longest first."""
        workers = self.client.scheduler_info()["workers"]
        threads = sum(worker["nthreads"] for worker in workers.values())
        while self.work.waiting and len(self.running) < threads:
            unit = self.work.next()
            name = unit["unit"]
            home = self.home.pop(name, None)
            others = [home] if home in workers else [
                address for address in workers if address not in self.failed_on[name]]
            future = self.client.submit(
                compute_unit, self.plan, self.plan_id, name, self.options.program, self.words, self.stop_name,
                self.shared_folder, self.cache, self.scenes.get(name, []),
                key=f"gnomon-{name}-{self.work.tries[name]}-{time.time_ns()}", pure=False,
                workers=others or None, allow_other_workers=True)
            self.running[future] = unit

    def finish(self, future):
        from distributed.scheduler import KilledWorker

        unit = self.running.pop(future)
        name = unit["unit"]
        try:
            result = future.result(timeout=absence_s)
            if "lacking" in result:
                self.bring(result["lacking"], result["address"])
                self.home[name] = result["address"]
                self.work.give_back(unit)
                return
        except Exception as error:  # any error: the unit has no file
            if self.ends.is_set():
                return
            if isinstance(error, KilledWorker):
                self.failed_on[name].add(error.last_worker.address)
            self.work.fail(unit, error)
            return
        if result["content"] is not None:
            self.keep(name, result["content"])
        say(unit=name, worker=str(result["worker"]))

    def bring(self, names, address):
        """Sends scenes that a worker still lacks."""
        import dask
        from dask.utils import parse_bytes

        most_bytes = parse_bytes(dask.config.get("gnomon.scene-cache", "10 GiB"))
        for name in self.client.run(lacking_scenes, self.cache, names, workers=[address])[address]:
            token = secrets.token_hex(4)
            with open(os.path.join(self.options.scenes, name), "rb") as file:
                piece = file.read(piece_bytes)
                while piece:
                    rest = file.read(piece_bytes)
                    self.client.run(
                        take_piece, self.cache, name, token, piece, not rest, most_bytes, workers=[address])
                    piece = rest

    def keep(self, name, content):
        """Writes a unit's file into the folder, atomically."""
        temporary = os.path.join(self.options.folder, f".{name}.unit.{os.getpid()}-0.tmp")
        with open(temporary, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.rename(temporary, os.path.join(self.options.folder, name + ".unit"))

    def reconnect(self):
        """Reconnects after the scheduler went away. Running units are requested again; workers keep computed ones."""
        for unit in self.running.values():
            self.work.give_back(unit)
        self.running.clear()
        close_part(self.client, 1)
        self.connect()

    def run(self):
        self.connect()
        self.check_environments()
        asked = -asking_s
        while (self.work.waiting or self.running) and not self.ends.is_set():
            if time.monotonic() - asked > asking_s:
                try:
                    self.submit()
                except (OSError, TimeoutError, ValueError):
                    self.reconnect()
                    continue
                asked = time.monotonic()
            ended = [future for future in self.running if future.done()]
            for future in ended:
                if future.status in ("lost", "cancelled") and not self.ends.is_set():
                    self.reconnect()
                    break
                self.finish(future)
            if ended:
                asked = -asking_s  # a thread is free
            else:
                time.sleep(0.05)
        if not self.ends.is_set() and not self.shared_folder:
            self.client.run(forget_plan, self.plan_id, on_error="ignore")

    def stop(self):
        """Ends units that run on the workers. They continue when the sweep is resumed."""
        from distributed import Event

        self.ends.set()
        if self.client is not None and self.running:
            try:
                Event(self.stop_name, client=self.client).set()
                deadline = time.monotonic() + 10
                while time.monotonic() < deadline and not all(future.done() for future in self.running):
                    time.sleep(0.05)
            except Exception:  # the scheduler may be gone; the children of its workers end with them
                pass

    def close(self):
        for part in (self.client, self.cluster):
            if part is not None:
                close_part(part, 5)


def close_part(part, timeout_s):
    try:
        part.close(timeout=timeout_s)
    except Exception:  # it is not needed any more
        pass


def environment_text(environment):
    return ", ".join(str(environment[key]) for key in ("gl_renderer", "gl_version", "embree", "gnomon"))


def lacks():
    is_there = importlib.util.find_spec("distributed")
    return None if is_there else "Dask is not installed: apt-get install python3-distributed"


if __name__ == "__main__":
    sys.exit(run_driver(Driver, lacks, __doc__))
