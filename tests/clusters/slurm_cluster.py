"""Starts a Slurm of one node for this user, with its own configuration, key and ports in one folder."""
import contextlib
import getpass
import os
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile

from processes import wait_until

CONFIGURATION = """\
ClusterName=gnomon
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge/socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,batch_sched_delay=0,sched_min_interval=0
MinJobAge=10
OverTimeLimit=0
KillWait={kill_wait_s}
MaxArraySize={most_tasks}
NodeName=here NodeHostname={host} NodeAddr=127.0.0.1 CPUs={processors} State=UNKNOWN
PartitionName=main Nodes=here Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Slurm:
    """munged, slurmctld and slurmd. Slurm's programs find them by SLURM_CONF in `environment`."""

    def __init__(self, folder, processors=2, most_tasks=1001, kill_wait_s=5):
        self.folder = pathlib.Path(folder).resolve() / "slurm"
        self.daemons = []
        for name in ("munge", "state", "spool"):
            (self.folder / name).mkdir(parents=True)
            (self.folder / name).chmod(0o755)
        self.environment = dict(os.environ, SLURM_CONF=str(self.folder / "slurm.conf"))
        controller_port, node_port = free_ports(2)
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(
            host=socket.gethostname(), user=getpass.getuser(), folder=self.folder, controller_port=controller_port,
            node_port=node_port, processors=processors, most_tasks=most_tasks, kill_wait_s=kill_wait_s))
        try:
            self.start_munge()
            self.start_controller()
            self.start("slurmd", "/usr/sbin/slurmd", "-D", "-N", "here")
            wait_until(self.is_up, "the node is idle")
        except BaseException:
            self.stop()
            raise

    def start(self, name, *command):
        with open(self.folder / f"{name}.out", "ab") as log:
            daemon = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                      env=self.environment, cwd=self.folder)
        self.daemons.append(daemon)
        return daemon

    def start_munge(self):
        place = self.folder / "munge"
        key = place / "key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        # --force: the parent folder may be writable for everybody.
        self.start("munged", "/usr/sbin/munged", "--foreground", "--force", f"--key-file={key}",
                   f"--socket={place}/socket", f"--pid-file={place}/pid", f"--log-file={place}/log",
                   f"--seed-file={place}/seed")
        wait_until((place / "socket").exists, "munge listens")

    def start_controller(self):
        self.controller = self.start("slurmctld", "/usr/sbin/slurmctld", "-D")

    def ask(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False).stdout

    def is_up(self):
        for daemon in self.daemons:
            if daemon.poll() is not None:
                raise AssertionError(f"{daemon.args[0]} ended with {daemon.returncode}: {self.last_words()}")
        return self.ask("sinfo", "--noheader", "--format=%T").strip() == "idle"

    def last_words(self):
        texts = [path.read_text(errors="replace")[-1000:] for path in (*self.folder.glob("*.out"), *self.folder.glob("*.log"))]
        return "\n".join(texts)

    def tasks(self):
        """Waiting and running array tasks, as squeue prints them."""
        return self.ask("squeue", "--noheader", "--array", "--format=%F_%K").split()

    def cancel_all(self):
        self.ask("scancel", f"--user={getpass.getuser()}")
        wait_until(lambda: not self.tasks(), "what was cancelled has ended")

    def restart_controller(self):
        self.controller.terminate()  # it writes down what runs
        self.controller.wait()
        self.daemons.remove(self.controller)
        self.start_controller()

    def processes(self):
        """The daemons and all processes that they started, even if those have another parent now."""
        mark = f"SLURM_CONF={self.environment['SLURM_CONF']}".encode()
        for entry in pathlib.Path("/proc").iterdir():
            if entry.name.isdigit() and int(entry.name) != os.getpid():
                try:
                    if mark in (entry / "environ").read_bytes().split(b"\0"):
                        yield int(entry.name)
                except OSError:
                    continue  # it has ended, or is somebody else's

    def stop(self):
        for daemon in reversed(self.daemons):
            daemon.kill()
            daemon.wait()
        self.daemons.clear()
        for pid in self.processes():
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)


def main():
    """Prints why no Slurm can be started on this machine; nothing if one can."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            Slurm(folder).stop()
        except (AssertionError, OSError) as reason:
            return f"Slurm does not start here: {str(reason).splitlines()[0]}"
    return None


if __name__ == "__main__":
    sys.exit(main())
