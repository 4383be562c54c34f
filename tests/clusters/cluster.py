"""A Dask scheduler and its workers, as somebody else would have started them."""
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
DRIVER = ROOT / "clusters" / "dask_driver.py"
# A busy machine starts a program slowly.
PATIENCE_S = 120


def wait_until(holds, what):
    latest = time.monotonic() + PATIENCE_S
    while not holds():
        if time.monotonic() > latest:
            raise AssertionError(f"waited in vain until {what}")
        time.sleep(0.05)


def children_of(pid):
    """The process and all below it, by id."""
    parents = {}
    for entry in pathlib.Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                stat = (entry / "stat").read_text()
            except OSError:
                continue
            parents.setdefault(int(stat.rsplit(")", 1)[1].split()[1]), []).append(int(entry.name))
    found, todo = [], [pid]
    while todo:
        found.append(todo.pop())
        todo += parents.get(found[-1], [])
    return found


class Cluster:
    """One scheduler, and so many workers of one thread."""

    def __init__(self, folder, workers):
        self.folder = pathlib.Path(folder)
        self.workers = []
        self.start_scheduler(0)
        for number in range(workers):
            self.start_worker(number)

    def start(self, name, module, *arguments):
        log = open(self.folder / f"{name}.log", "ab")
        return subprocess.Popen(
            [sys.executable, "-m", module, *arguments], stdin=subprocess.DEVNULL, stdout=log, stderr=log,
            env=dict(os.environ, TMPDIR=str(self.folder)), cwd=self.folder)

    def start_scheduler(self, port):
        log = self.folder / "scheduler.log"
        begin = log.stat().st_size if log.exists() else 0
        self.scheduler = self.start(
            "scheduler", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", str(port),
            "--no-dashboard")
        found = []

        def is_listening():
            found[:] = re.findall(r"tcp://127\.0\.0\.1:(\d+)", log.read_text()[begin:])
            return bool(found)

        wait_until(is_listening, "the scheduler listens")
        self.port = int(found[0])

    def start_worker(self, number):
        self.workers.append(self.start(
            f"worker{number}", "distributed.cli.dask_worker", f"tcp://127.0.0.1:{self.port}", "--nthreads", "1",
            "--no-nanny", "--no-dashboard", "--name", f"w{number}", "--local-directory", str(self.folder)))

    @property
    def address(self):
        return f"dask://127.0.0.1:{self.port}"

    def stop(self):
        for process in [*self.workers, self.scheduler]:
            if process.poll() is None:
                process.send_signal(signal.SIGCONT)
                process.kill()
            process.wait()
