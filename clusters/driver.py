"""Shared by the cluster drivers: the protocol of `gnomon sweep --on`, and the number of tries of a unit.

    DRIVER CLUSTER PLAN FOLDER PROGRAM [--threads N] [--scenes PACKED] [--allow-mixed] [--retry-failed]

PACKED is a folder of scenes for workers that lack their files. With --retry-failed, a unit's file that a worker still has counts
only if it holds no failures. Standard input lists the units to compute, {"unit": ID, "seconds": ESTIMATE} on a line each, then an
empty line. The driver puts each unit's file into FOLDER, and reports on standard output, one JSON object a line:

    {"worker": NAME, "environment": {…}}      a worker, and its versions of GL, Embree and Gnomon
    {"unit": ID, "worker": NAME}              the file is in FOLDER
    {"failed": ID, "message": TEXT}           all tries failed
    {"error": TEXT}                           the driver gives up; the last line

When standard input ends, the driver stops all units and ends.
"""

import argparse
import json
import sys
import threading

most_tries = 3


def say(**event):
    print(json.dumps(event), flush=True)


class Work:
    """The waiting units, and the number of tries of each."""

    def __init__(self, units):
        self.waiting = sorted(units, key=lambda unit: unit["seconds"])  # the longest last
        self.tries = {unit["unit"]: 0 for unit in units}

    def next(self):
        """Takes the longest waiting unit, and counts a try."""
        unit = self.waiting.pop()
        self.tries[unit["unit"]] += 1
        return unit

    def take(self, names):
        """Takes waiting units that are already being computed, and counts a try of each."""
        taken = [unit for unit in self.waiting if unit["unit"] in names]
        self.waiting = [unit for unit in self.waiting if unit["unit"] not in names]
        for unit in taken:
            self.tries[unit["unit"]] += 1
        return taken

    def give_back(self, unit):
        """Puts a unit back without counting the try."""
        self.tries[unit["unit"]] -= 1
        self.waiting.append(unit)

    def fail(self, unit, why):
        """Handles a try without a file: the unit waits for the next try, or is reported as failed."""
        if self.tries[unit["unit"]] < most_tries:
            self.waiting.append(unit)
        else:
            say(failed=unit["unit"], message=f"tried {most_tries} times, at last: {why}")


def retry_words(options):
    """The options of `gnomon run-unit` about failures."""
    return ["--retry", "failed"] if options.retry_failed else []


def read_units():
    units = []
    for line in sys.stdin:
        if not line.strip():
            return units
        units.append(json.loads(line))
    raise SystemExit("standard input ended before its empty line")


def parse(arguments, description):
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cluster")
    parser.add_argument("plan")
    parser.add_argument("folder")
    parser.add_argument("program")
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--scenes")
    parser.add_argument("--allow-mixed", action="store_true")
    parser.add_argument("--retry-failed", action="store_true")
    return parser.parse_args(arguments)


def run_driver(make, lacks, description):
    """Runs a driver, `make(options, units)`, which has run(), stop() and close(). `lacks()` names a missing installation."""
    options = parse(sys.argv[1:], description)
    missing = lacks()
    if missing:
        say(error=missing)
        return 1
    driver = make(options, read_units())

    def wait_for_end():
        while sys.stdin.readline():
            pass
        driver.stop()

    threading.Thread(target=wait_for_end, daemon=True).start()
    try:
        driver.run()
    except Exception as error:
        say(error=" ".join(str(error).split()) or type(error).__name__)
        return 1
    finally:
        driver.close()
    return 0
