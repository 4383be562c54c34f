"""What the drivers of clusters share: what `gnomon sweep --on` tells them, what they say, and how often a unit is tried.

    DRIVER CLUSTER PLAN FOLDER PROGRAM [--threads N] [--scenes PACKED] [--allow-mixed] [--retry-failed]

PACKED is a folder of scenes for workers that lack their files. With --retry-failed a unit's file that a worker still has counts
only if nothing in it failed. On standard input comes a JSON object a line for each unit
that is to be computed, {"unit": ID, "seconds": ESTIMATE}, and an empty line after the last. Each unit's file is put into
FOLDER, and said on standard output, one JSON object a line:

    {"worker": NAME, "environment": {…}}      a worker, and what GL, Embree and Gnomon are there
    {"unit": ID, "worker": NAME}              the file is in FOLDER
    {"failed": ID, "message": TEXT}           it was tried often enough, in vain
    {"error": TEXT}                           nothing more can be done; the last line

When standard input ends, the driver stops what runs and ends: nobody waits for it any more.
"""

import argparse
import json
import sys
import threading

most_tries = 3


def say(**event):
    print(json.dumps(event), flush=True)


class Work:
    """The units that wait, and how often each was tried."""

    def __init__(self, units):
        self.waiting = sorted(units, key=lambda unit: unit["seconds"])  # the longest is the last
        self.tries = {unit["unit"]: 0 for unit in units}

    def next(self):
        """The longest that waits; this is a try."""
        unit = self.waiting.pop()
        self.tries[unit["unit"]] += 1
        return unit

    def take(self, names):
        """The units of these names that wait; each is under way already, and this is a try."""
        taken = [unit for unit in self.waiting if unit["unit"] in names]
        self.waiting = [unit for unit in self.waiting if unit["unit"] not in names]
        for unit in taken:
            self.tries[unit["unit"]] += 1
        return taken

    def give_back(self, unit):
        """It was not tried after all."""
        self.tries[unit["unit"]] -= 1
        self.waiting.append(unit)

    def fail(self, unit, why):
        """A try that left no file: it waits for the next, or is said to have failed."""
        if self.tries[unit["unit"]] < most_tries:
            self.waiting.append(unit)
        else:
            say(failed=unit["unit"], message=f"tried {most_tries} times, at last: {why}")


def retry_words(options):
    """What `gnomon run-unit` is told of failures."""
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
    """Runs a driver, `make(options, units)`, which has run(), stop() and close(); `lacks()` says what is not installed."""
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
