"""clusters/dask_driver.py hands out units, tries again, and ends when nobody listens. A fake program computes them."""
import os
import pathlib
import unittest

from dask_cluster import Cluster
from driver_case import DriverCase
from processes import PATIENCE_S, children_of, wait_until


class DaskDriver(DriverCase):
    script = "dask_driver.py"

    def test_computes_each_unit_once_the_longest_first(self):
        units = {f"u{i}": i for i in range(6)}
        driver = self.start("local:1", units)
        events = self.events(driver)
        self.assertEqual(driver.returncode, 0)
        self.assertEqual([event["unit"] for event in events if "unit" in event],
                         ["u5", "u4", "u3", "u2", "u1", "u0"])
        self.assertEqual([event["environment"]["gl_renderer"] for event in events if "environment" in event],
                         ["one renderer"])
        self.assertEqual(sorted(self.computed()), sorted(units))
        for name in units:
            self.assertEqual((self.units / f"{name}.unit").read_text(), f"bytes of {name}")

    def test_tries_again_where_a_worker_dies_and_says_what_fails_three_times(self):
        driver = self.start("local:2", {"once-a": 3, "bad-b": 2, "c": 1})
        events = self.events(driver)
        self.assertEqual(driver.returncode, 0)
        self.assertEqual(sorted(event["unit"] for event in events if "unit" in event), ["c", "once-a"])
        failed = [event for event in events if "failed" in event]
        self.assertEqual([event["failed"] for event in failed], ["bad-b"])
        self.assertIn("this unit is bad", failed[0]["message"])
        computed = self.computed()
        self.assertEqual(computed.count("once-a"), 2)
        self.assertEqual(computed.count("bad-b"), 3)
        self.assertEqual(computed.count("c"), 1)

    def test_ends_with_its_children_when_its_input_does(self):
        driver = self.start("local:2", {"slow-3000": 2, "slow-3001": 1})
        wait_until(lambda: len(self.computed()) == 2, "both units have begun")
        family = children_of(driver.pid)
        driver.stdin.close()
        self.assertEqual(driver.wait(PATIENCE_S), 0)
        wait_until(lambda: not any(pathlib.Path(f"/proc/{pid}").exists() for pid in family[1:]),
                   "its children have ended")
        self.assertEqual(list(self.units.glob("*.unit")), [])

    def test_refuses_workers_of_several_kinds_unless_they_are_allowed(self):
        os.environ["FAKE_MIXED"] = "1"
        self.addCleanup(os.environ.pop, "FAKE_MIXED")
        driver = self.start("local:2", {"a": 1})
        events = self.events(driver)
        self.assertEqual(driver.returncode, 1)
        self.assertRegex(events[-1]["error"], r"workers differ: .*renderer \d+.*renderer \d+.*--allow-mixed")
        self.assertFalse((self.folder / "log").exists())
        allowed = self.start("local:2", {"a": 1}, "--allow-mixed")
        self.assertEqual([event["unit"] for event in self.events(allowed) if "unit" in event], ["a"])

    def test_brings_files_from_workers_elsewhere_and_outlives_a_scheduler(self):
        cluster = Cluster(self.folder, 2)
        self.addCleanup(cluster.stop)
        driver = self.start(cluster.address, {"slow-20": 3, "slow-21": 2, "slow-22": 1})
        wait_until(lambda: (self.folder / "log").exists(), "a unit has begun")
        cluster.stop()
        port = cluster.port
        cluster.workers.clear()
        cluster.start_scheduler(port)
        for number in range(2):
            cluster.start_worker(number)
        events = self.events(driver)
        self.assertEqual(driver.returncode, 0, events)
        self.assertEqual(sorted(event["unit"] for event in events if "unit" in event),
                         ["slow-20", "slow-21", "slow-22"])
        self.assertEqual((self.units / "slow-22.unit").read_text(), "bytes of slow-22")

    def scenes_seen(self):
        """The scenes of each unit."""
        return dict(line.split(" ", 1) for line in (self.folder / "scenes").read_text().splitlines())

    def test_sends_scenes_to_workers_which_keep_them_within_a_limit(self):
        cluster = Cluster(self.folder, 1)
        self.addCleanup(cluster.stop)
        packed = self.folder / "packed"
        packed.mkdir()
        for scene in "xyz":
            (packed / f"{scene}-b.scene").write_text(f"content of {scene}")
        units = {"u1": ["x"], "u2": ["x", "y"], "u3": []}
        self.write_plan("xy", units)
        self.events(self.start(cluster.address, dict.fromkeys(units, 1), "--scenes", str(packed)))
        self.assertEqual(self.scenes_seen(), {"u1": "content of x", "u2": "content of x content of y"})
        self.assertEqual(sorted(self.computed()), ["u1", "u2", "u3"])

        (cache,) = self.folder.glob("gnomon-*/scenes-1")
        self.assertEqual(sorted(path.name for path in cache.iterdir()), ["x-b.scene", "y-b.scene"])
        (packed / "x-b.scene").write_text("not sent again")
        os.utime(cache / "y-b.scene", (1, 1))
        self.write_plan("xz", {"u4": ["x", "z"]})
        os.environ["DASK_GNOMON__SCENE_CACHE"] = "30 B"  # of two
        self.addCleanup(os.environ.pop, "DASK_GNOMON__SCENE_CACHE")
        self.events(self.start(cluster.address, {"u4": 1}, "--scenes", str(packed)))
        self.assertEqual(self.scenes_seen()["u4"], "content of x content of z")
        self.assertEqual(sorted(path.name for path in cache.iterdir()), ["x-b.scene", "z-b.scene"])
        self.assertEqual([path.name for path in self.folder.rglob(".scenes-*")], [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
