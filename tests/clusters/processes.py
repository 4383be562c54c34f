"""Queries about processes for the tests of clusters."""
import pathlib
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
# A busy machine starts a program slowly.
PATIENCE_S = 120


def wait_until(holds, what):
    latest = time.monotonic() + PATIENCE_S
    while not holds():
        if time.monotonic() > latest:
            raise AssertionError(f"waited in vain until {what}")
        time.sleep(0.05)


def children_of(pid):
    """The ids of a process and its descendants."""
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


def words_of(pid):
    """The command line of a process; empty if it has ended."""
    try:
        return pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().decode(errors="replace").split("\0")
    except OSError:
        return []


def unit_processes_of(pid):
    """The ids of descendants that compute a unit."""
    words = ((below, words_of(below)) for below in children_of(pid))
    return [below for below, said in words if "run-unit" in said and "python" not in said[0]]
