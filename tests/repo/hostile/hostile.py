#!/usr/bin/python3
"""Hostile inputs, outputs and early ends: the program exits with one of its own codes, prints one line of error, and
leaves no partial file.

    hostile.py GNOMON [--few] [-k TEXT]

Each case runs in its own folder. It has a preparation, a command, the accepted exit codes and a part of the error. In
every case there is no signal but the one sent, no text of a crash, at most one line of error, and no existing file is
damaged. --few: a second's worth of each kind. -k: cases whose name contains TEXT.
"""

import argparse
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from bad_ends import bad_outputs, early_ends, others
from bad_files import absurd_values, bad_jobs, bad_scenes
from bad_results import bad_results
from case import LONGEST_S, Skip

CRASH = re.compile(r"terminate called|core dumped|Sanitizer|Assertion|internal error|std::|Traceback|report it with")
PROGRESS = re.compile(r"^gnomon sweep: |^gnomon tune: |^\s*$|^gnomon: interrupted; finishing")


def all_cases(gnomon):
    for group in (bad_jobs(), bad_scenes(), bad_results(gnomon), bad_outputs(), early_ends(), others(gnomon),
                  absurd_values(gnomon)):
        yield from group


def start(gnomon, case, d):
    """The exit status and the error output."""
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
