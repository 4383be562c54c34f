"""Computes units of a planned sweep on the workers of a Dask cluster: a program that `gnomon sweep --on` starts.

It is told and says what driver.py describes. CLUSTER is dask://HOST:PORT, or local:N for N workers of one thread each on this
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

# A worker that is silent for so long has died, or is stopped: its units go to others.
silence_s = 30
# How long a scheduler may be away, restarted for instance.
absence_s = 120
# So much of a scene is sent at a time.
piece_bytes = 16 << 20
# What of a worker's scenes was used so lately is not removed for others.
recent_s = 60
# How often workers are asked whether there are more or fewer of them.
asking_s = 1
# Dask looks after Python tasks of milliseconds: it samples their stacks and its own delays. Here a task is a process of
# seconds or minutes, and with Dask's own intervals a worker that only waits takes 5 % of a processor, with these 1 %.
quiet_dask = {
    "distributed.worker.profile.enabled": False,
    "distributed.worker.profile.interval": "10 s",
    "distributed.admin.tick.interval": "1 s",
    "distributed.admin.tick.limit": f"{silence_s} s",
    "distributed.admin.system-monitor.interval": "5 s",
}


def environment_of_worker(program):
    """What GL, Embree and Gnomon are on the worker that this runs on."""
    import json
    import subprocess

    done = subprocess.run([program, "doctor", "--json"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip() or f"{program} doctor ends with {done.returncode}")
    found = json.loads(done.stdout)
    return {"gl_renderer": found["gl"]["renderer"], "gl_version": found["gl"]["version"],
            "embree": found["embree"], "gnomon": found["gnomon"]}


def folder_of_worker(name):
    """A folder of this user's on the worker that this runs on, which is made."""
    import os
    import tempfile

    folder = os.path.join(tempfile.gettempdir(), f"gnomon-{os.getuid()}", name)
    os.makedirs(folder, mode=0o700, exist_ok=True)
    return folder


def lacking_scenes(cache, names):
    """Runs on a worker: which of these scenes it lacks."""
    import os

    folder = folder_of_worker(cache)
    return [name for name in names if not os.path.exists(os.path.join(folder, name))]


def take_piece(cache, name, token, piece, is_last, most_bytes):
    """Runs on a worker: adds to a scene that is being sent; the last piece may cost those that were not used longest."""
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
    """Puts scenes of the worker's into a folder, where they stay whatever else is sent; returns those that it lacks."""
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
    """One of them may be damaged: the next try gets them anew."""
    import contextlib
    import os

    for name in names:
        with contextlib.suppress(FileNotFoundError):
            os.remove(os.path.join(folder_of_worker(cache), name))


def compute_unit(plan, plan_id, unit, program, words, stop_name, folder, cache, scenes):
    """Runs on a worker: computes a unit, and returns its file's bytes; with a folder that both have, leaves it there.

    Where the worker lacks some of the scenes, it returns their names instead.
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
    # 4 and 5: the file is there, but something in it failed. Both are for the run to say.
    if process.returncode not in (0, 4, 5) or not os.path.exists(path):
        raise RuntimeError(message or f"gnomon run-unit ends with {process.returncode}")
    content = None
    if not folder:
        with open(path, "rb") as file:
            content = file.read()
    return {"content": content, "worker": get_worker().name}


def forget_plan(plan_id):
    """Runs on a worker: removes what it kept of a plan that is computed."""
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
        self.cache = f"scenes-{first.get('gnomon')}"  # packed scenes are of one version
        self.scenes = self.scenes_of_units(first, lines) if options.scenes else {}
        self.home = {}  # of units whose scenes were sent there
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
        """Of a cluster with several GL renderers only one gives the results of one machine."""
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
                    f"{environment_text(environment)}: take workers of one kind, or pass --allow-mixed")

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
        except Exception as error:  # whatever it is, the unit is not there
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
        """Sends scenes to a worker, unless another of its units has just had them sent."""
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
        """Puts a unit's file into the folder: whole, or not at all."""
        temporary = os.path.join(self.options.folder, f".{name}.unit.{os.getpid()}-0.tmp")
        with open(temporary, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.rename(temporary, os.path.join(self.options.folder, name + ".unit"))

    def reconnect(self):
        """After the scheduler went away: what was under way is asked for again, and found where it was computed."""
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
                asked = -asking_s  # there is room for another
            else:
                time.sleep(0.05)
        if not self.ends.is_set() and not self.shared_folder:
            self.client.run(forget_plan, self.plan_id, on_error="ignore")

    def stop(self):
        """Ends what runs on the workers; it goes on there when the sweep is resumed."""
        from distributed import Event

        self.ends.set()
        if self.client is not None and self.running:
            try:
                Event(self.stop_name, client=self.client).set()
                deadline = time.monotonic() + 10
                while time.monotonic() < deadline and not all(future.done() for future in self.running):
                    time.sleep(0.05)
            except Exception:  # the scheduler may be gone; its workers' children end with them
                pass

    def close(self):
        for part in (self.client, self.cluster):
            if part is not None:
                close_part(part, 5)


def close_part(part, timeout_s):
    try:
        part.close(timeout=timeout_s)
    except Exception:  # nothing more is wanted of it
        pass


def environment_text(environment):
    return ", ".join(str(environment[key]) for key in ("gl_renderer", "gl_version", "embree", "gnomon"))


def lacks():
    is_there = importlib.util.find_spec("distributed")
    return None if is_there else "Dask is not installed: apt-get install python3-distributed"


if __name__ == "__main__":
    sys.exit(run_driver(Driver, lacks, __doc__))
