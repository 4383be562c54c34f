"""Starts a Dask scheduler and its workers, as a user would."""
import os
import pathlib
import re
import signal
import subprocess
import sys

from processes import wait_until


class Cluster:
    """A scheduler, and workers of one thread each."""

    def __init__(self, folder, workers):
        self.folder = pathlib.Path(folder)
        self.workers = []
        self.start_scheduler(0)
        for number in range(workers):
            self.start_worker(number)

    def start(self, name, module, *arguments):
        with open(self.folder / f"{name}.log", "ab") as log:
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
