"""Runs a driver of clusters/ like `gnomon sweep --on`, with a fake program for the units."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from processes import PATIENCE_S, ROOT

FAKE = str(pathlib.Path(__file__).with_name("fake_gnomon.py"))


class DriverCase(unittest.TestCase):
    script = None  # of clusters/

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)
        self.units = self.folder / "units"
        self.units.mkdir()
        self.write_plan([], {})
        os.environ["FAKE_LOG"] = str(self.folder / "log")

    def write_plan(self, scenes, units):
        """A plan with scenes, and units that need some of them."""
        first = {"plan": "0123456789abcdef", "gnomon": "1",
                 "scenes": [{"keys": "", "hash": scene, "brought": "b"} for scene in scenes]}
        lines = [first, *({"unit": unit, "scenes": needed} for unit, needed in units.items())]
        (self.folder / "plan.jsonl").write_text("".join(json.dumps(line) + "\n" for line in lines))

    def start(self, cluster, units, *options, environment=None):
        """Starts the driver with units: names and estimates."""
        driver = subprocess.Popen(
            [sys.executable, "-B", str(ROOT / "clusters" / self.script), cluster, str(self.folder / "plan.jsonl"),
             str(self.units), FAKE, *options],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment)
        for name, seconds in units.items():
            driver.stdin.write(json.dumps({"unit": name, "seconds": seconds}) + "\n")
        driver.stdin.write("\n")
        driver.stdin.flush()
        self.addCleanup(self.close, driver)
        return driver

    def close(self, driver):
        driver.kill()
        driver.wait()
        for stream in (driver.stdin, driver.stdout, driver.stderr):
            stream.close()

    def events(self, driver):
        events = [json.loads(line) for line in driver.stdout]
        self.assertIsNotNone(driver.wait(PATIENCE_S))
        return events

    def computed(self):
        log = self.folder / "log"
        return log.read_text().split() if log.exists() else []
