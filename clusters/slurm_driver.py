"""Computes units of a planned sweep as array jobs of Slurm. `gnomon sweep --on slurm` starts it.

driver.py describes its input and output. CLUSTER is slurm, or slurm:OPTIONS with options of sbatch. FOLDER, PROGRAM and the
scenes must have the same paths on all nodes.

FOLDER/slurm holds TOKEN.units for each array, with the units of its tasks, a line each; a log for each task; and unit files until
they are moved to FOLDER. The names of arrays contain FOLDER and TOKEN, so a restarted driver finds what an earlier one submitted.
"""

import hashlib
import os
import re
import secrets
import shlex
import shutil
import subprocess
import sys
import threading
import time

from driver import Work, retry_words, run_driver, say

# Interval of requests to the controller, which may serve thousands of users.
asking_s = 3
# Interval of checks for new unit files.
looking_s = 0.5
# A shared folder may show a file this long after its writer ended.
settling_s = 5
# How long the controller may be unreachable, for example during a restart.
absence_s = 120
# Time limit for cancelled tasks to end; they keep their partial results.
stopping_s = 12

# States of squeue in which a task will not write its file any more.
ended_states = {"BOOT_FAIL", "CANCELLED", "COMPLETED", "DEADLINE", "FAILED", "NODE_FAIL", "OUT_OF_MEMORY", "PREEMPTED",
                "REVOKED", "TIMEOUT"}

script = """\
#!/bin/sh
echo "$(hostname)"
unit=$(sed -n "${{SLURM_ARRAY_TASK_ID}}p" {units})
exec {program} run-unit {plan} "$unit" --out {folder} --quiet --threads {threads} {retry}
"""


def ask(*command, text=None):
    # Jobs inherit the environment, which must not name this process's temporary folder.
    environment = {name: value for name, value in os.environ.items() if name != "TMPDIR"}
    done = subprocess.run(
        command, input=text, capture_output=True, text=True, errors="replace", check=False, env=environment)
    if done.returncode != 0:
        raise RuntimeError(f"{command[0]}: {done.stderr.strip() or f'ends with {done.returncode}'}")
    return done.stdout


class Arrays:
    """The array jobs submitted for a folder: their names, and the units of their tasks, numbered from 1."""

    def __init__(self, options):
        self.options = options
        self.sbatch_options = shlex.split(options.cluster.partition(":")[2])
        self.folder = os.path.join(options.folder, "slurm")
        os.makedirs(self.folder, exist_ok=True)
        self.prefix = "gnomon-" + hashlib.sha256(os.fsencode(options.folder)).hexdigest()[:8] + "-"
        self.units = {}
        for file in os.listdir(self.folder):
            token, kind = os.path.splitext(file)
            if kind == ".units":
                with open(os.path.join(self.folder, file), encoding="utf-8") as lines:
                    self.units[self.prefix + token] = lines.read().split()
        self.most_tasks = None

    def size_limit(self):
        """The greatest number of tasks in an array."""
        if self.most_tasks is None:
            found = re.search(r"^MaxArraySize\s*=\s*(\d+)", ask("scontrol", "show", "config"), re.MULTILINE)
            if not found or int(found[1]) < 2:
                raise RuntimeError("Slurm allows no array jobs here: its MaxArraySize must be at least 2")
            self.most_tasks = int(found[1]) - 1  # indices start at 1 and must be below MaxArraySize
        return self.most_tasks

    def submit(self, units):
        """Submits an array of units, which Slurm starts in order; returns its name."""
        token = secrets.token_hex(4)
        name = self.prefix + token
        list_file = os.path.join(self.folder, token + ".units")
        # Written before the array is submitted, so that no task is forgotten after a crash.
        with open(list_file, "w", encoding="utf-8") as file:
            file.write("".join(f"{unit}\n" for unit in units))
            file.flush()
            os.fsync(file.fileno())
        threads = self.options.threads
        text = script.format(
            units=shlex.quote(list_file), program=shlex.quote(self.options.program), plan=shlex.quote(self.options.plan),
            folder=shlex.quote(self.folder), threads=threads or '"${SLURM_CPUS_PER_TASK:-1}"', retry=shlex.join(retry_words(self.options)))
        try:
            ask("sbatch", *([f"--cpus-per-task={threads}"] if threads else []), *self.sbatch_options, "--parsable",
                f"--job-name={name}", f"--array=1-{len(units)}", f"--chdir={self.folder}", "--output=%x-%a.log",
                text=text)
        except RuntimeError:
            os.remove(list_file)
            raise
        self.units[name] = units
        return name

    def tasks(self):
        """The tasks of this folder that Slurm knows, some of which have ended: array's name, task, job, state."""
        found = []
        for line in ask("squeue", "--noheader", "--array", "--me", "--states=all", "--format=%j|%K|%F|%T").splitlines():
            name, task, job, state = line.strip().split("|")
            if name.startswith(self.prefix) and task.isdigit():
                found.append((name, int(task), job, state))
        return found

    def cancel(self, tasks):
        """Cancels the jobs of these tasks, and waits for their end."""
        jobs = {job for _, _, job, state in tasks if state not in ended_states}
        if not jobs:
            return
        ask("scancel", *sorted(jobs))
        deadline = time.monotonic() + stopping_s
        while time.monotonic() < deadline:
            if not any(job in jobs and state not in ended_states for _, _, job, state in self.tasks()):
                return
            time.sleep(looking_s)


class Task:
    """A submitted unit."""

    def __init__(self, unit, array, number, folder):
        self.unit = unit
        self.key = (array, number)
        self.log = os.path.join(folder, f"{array}-{number}.log")
        self.ended_since = None  # when it was first found ended without a file

    def words(self):
        """The lines of its log: the node's name, then error messages."""
        try:
            with open(self.log, encoding="utf-8", errors="replace") as file:
                return [line.strip() for line in file if line.strip()]
        except OSError:
            return []

    def reason(self, state):
        """Why the task left no file."""
        told = self.words()
        text = f"array job {self.key[0]}, task {self.key[1]}, ended as {state}"
        if state == "TIMEOUT":
            return f"{text}: it ran over its time limit: set a longer one, or plan more units with --units"
        if not told:
            return f"{text} and wrote nothing: do the nodes share this folder?"
        return f"{text} on {': '.join(told[:1] + told[1:][-1:])}"


class Driver:
    def __init__(self, options, units):
        self.options = options
        self.work = Work(units)
        self.arrays = Arrays(options)
        self.tasks = {}  # by unit name
        self.asked = time.monotonic()  # when the controller last answered
        self.ends = threading.Event()

    def add(self, unit, array, number):
        self.tasks[unit["unit"]] = Task(unit, array, number, self.arrays.folder)

    def follow_earlier(self):
        """Follows tasks of an earlier driver, and cancels those of another plan."""
        places = {}
        forgotten = []
        for task in self.arrays.tasks():
            array, number, _, state = task
            if array not in self.arrays.units:
                forgotten.append(task)
            elif state not in ended_states:
                places[self.arrays.units[array][number - 1]] = (array, number)
        self.arrays.cancel(forgotten)
        for array, units in self.arrays.units.items():
            for number, unit in enumerate(units, 1):
                if os.path.exists(os.path.join(self.arrays.folder, unit + ".unit")):
                    places[unit] = (array, number)
        for unit in self.work.take(places):
            self.add(unit, *places[unit["unit"]])

    def submit(self):
        """Submits waiting units, the longest first, in arrays of the greatest size."""
        while self.work.waiting and not self.ends.is_set():
            count = min(len(self.work.waiting), self.arrays.size_limit())
            units = [self.work.next() for _ in range(count)]
            try:
                array = self.arrays.submit([unit["unit"] for unit in units])
            except RuntimeError:
                for unit in reversed(units):
                    self.work.give_back(unit)
                if count > 1:  # a user's limit of tasks may be below an array's
                    self.arrays.most_tasks = count // 2
                    continue
                if self.tasks:
                    return  # submit again when some of them have ended
                raise
            for number, unit in enumerate(units, 1):
                self.add(unit, array, number)

    def collect(self):
        """Moves new unit files to the folder."""
        for file in os.listdir(self.arrays.folder):
            name, kind = os.path.splitext(file)
            if kind == ".unit" and name in self.tasks:
                task = self.tasks.pop(name)
                node = task.words()[:1]
                os.rename(os.path.join(self.arrays.folder, file), os.path.join(self.options.folder, file))
                if os.path.exists(task.log):
                    os.remove(task.log)
                say(unit=name, worker=f"Slurm's {node[0]}" if node else "Slurm")

    def look_after(self):
        """Retries units whose tasks ended without a file."""
        try:
            states = {(array, number): state for array, number, _, state in self.arrays.tasks()}
        except RuntimeError:
            if time.monotonic() - self.asked > absence_s:
                raise
            return  # the controller is unreachable for now; its tasks continue
        self.asked = time.monotonic()
        for name, task in list(self.tasks.items()):
            state = states.get(task.key, "UNKNOWN")  # Slurm forgets ended tasks
            if state not in ended_states and state != "UNKNOWN":
                task.ended_since = None
                continue
            task.ended_since = task.ended_since or (self.asked, state)
            since, state = task.ended_since
            if self.asked - since >= settling_s:
                self.give_up(name, task, state)

    def give_up(self, name, task, state):
        del self.tasks[name]
        if state == "CANCELLED":
            say(failed=name, message="its task was cancelled: the same command submits it again")
        else:
            self.work.fail(task.unit, task.reason(state))

    def run(self):
        self.follow_earlier()
        self.submit()
        while (self.work.waiting or self.tasks) and not self.ends.is_set():
            self.collect()
            if time.monotonic() - self.asked > asking_s:
                self.look_after()
                self.submit()
            self.ends.wait(looking_s)
        if self.ends.is_set():
            self.arrays.cancel(self.arrays.tasks())
            self.collect()

    def stop(self):
        """Cancels running tasks. They continue when the sweep is resumed."""
        self.ends.set()

    def close(self):
        pass


def lacks():
    missing = [program for program in ("sbatch", "squeue", "scancel", "scontrol") if not shutil.which(program)]
    return f"Slurm is not installed ({missing[0]} is missing): apt-get install slurm-wlm" if missing else None


if __name__ == "__main__":
    sys.exit(run_driver(Driver, lacks, __doc__))
