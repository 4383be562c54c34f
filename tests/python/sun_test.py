"""Positions and directions of the sun."""

import datetime
import random
import unittest

import gnomon
import numpy as np
from support import SMALL, SUN, plate


class SunTest(unittest.TestCase):
    BERLIN = 52.52, 13.40
    SUN = {"latitude_deg": 52.52, "longitude_deg": 13.40, "time": "2026-06-21T12:00:00Z"}

    def test_of_many_times_is_that_of_each(self):
        times = [f"2026-06-21T{hour:02}:00:00Z" for hour in range(24)]
        azimuths, elevations = gnomon.sun_position(*self.BERLIN, times)
        directions = gnomon.sun_direction(*self.BERLIN, times, north=[1, 0, 0])
        for number, time in enumerate(times):
            self.assertEqual(gnomon.sun_position(*self.BERLIN, time), (azimuths[number], elevations[number]))
            one = gnomon.sun_direction(*self.BERLIN, time, north=[2, 9, 0])
            self.assertTrue(np.array_equal(one, directions[number]))
        self.assertTrue(np.allclose(np.linalg.norm(directions, axis=1), 1))
        self.assertEqual(azimuths[10:13].round().tolist(), sorted(azimuths[10:13].round().tolist()))

    def test_times_are_the_same_in_every_form(self):
        zone = datetime.timezone(datetime.timedelta(hours=2))
        forms = ["2026-06-21T12:00:00Z", "2026-06-21T14:00+02:00", np.datetime64("2026-06-21T12:00")]
        forms.append(datetime.datetime(2026, 6, 21, 14, 0, tzinfo=zone))
        found = {gnomon.sun_position(*self.BERLIN, form) for form in forms}
        self.assertEqual(len(found), 1)

    def test_is_the_sun_of_a_job(self):
        sun = self.SUN
        direction = gnomon.sun_direction(52.52, 13.40, "2026-06-21T12:00:00Z")
        points = np.random.default_rng(3).uniform(-3, 3, (200, 3))
        scene = gnomon.builtin("columns")
        self.assertTrue(
            np.array_equal(
                gnomon.truth(scene, points, {"sun": sun}).point_class,
                gnomon.truth(scene, points, {"direction": direction}).point_class,
            )
        )
        of_sun = gnomon.compare("columns", light={"sun": sun}, **SMALL)
        of_direction = gnomon.compare("columns", light={"direction": direction}, **SMALL)
        self.assertEqual(of_sun.metrics, of_direction.metrics)
        turned = gnomon.compare("columns", light={"sun": sun}, scene={"north": [1, 0, 0]}, **SMALL)
        self.assertNotEqual(turned.metrics, of_sun.metrics)
        as_datetime = {**sun, "time": datetime.datetime(2026, 6, 21, 12, tzinfo=datetime.timezone.utc)}
        self.assertEqual(gnomon.compare("columns", light={"sun": as_datetime}, **SMALL).metrics, of_sun.metrics)

    def test_stands_by_the_north_of_a_scene(self):
        scene = gnomon.builtin("columns", north=[1, 0, 0])
        compared = gnomon.compare(scene, light={"sun": self.SUN}, bias={"constant": 0.003}, **SMALL)
        evaluated = gnomon.evaluate(compared.verdict, scene, {"sun": self.SUN}, compared.positions)
        self.assertLess(evaluated.metrics["error_rate"], 0.2)
        direction = gnomon.sun_direction(*self.BERLIN, self.SUN["time"], north=[1, 0, 0])
        points = np.random.default_rng(5).uniform(-3, 3, (100, 3))
        of_sun = gnomon.truth(scene, points, {"sun": self.SUN})
        of_direction = gnomon.truth(scene, points, {"direction": direction})
        self.assertTrue(np.array_equal(of_sun.point_class, of_direction.point_class))

    def test_takes_the_place_of_a_direction_of_a_dict(self):
        job = {"scene": {"builtin": "columns"}, "light": {"sun": self.SUN}, **SMALL}
        of_direction = gnomon.compare(job, light={"direction": [0, -1, 0]})
        self.assertEqual(of_direction.metrics, gnomon.compare("columns", light={"direction": [0, -1, 0]}, **SMALL).metrics)

    def test_refuses_what_is_no_place_or_time(self):
        for call, words in [
            (lambda: gnomon.sun_position(91, 0, "2026-06-21T12:00Z"), "latitude_deg = 91"),
            (lambda: gnomon.sun_position(0, float("nan"), "2026-06-21T12:00Z"), "longitude_deg = nan"),
            (lambda: gnomon.sun_position(0, 0, "2026-06-21T12:00"), "must be such as"),
            (lambda: gnomon.sun_position(0, 0, datetime.datetime(2026, 6, 21)), "has no time zone"),
            (lambda: gnomon.sun_position(0, 0, ["2026-06-21T12:00Z", "2209-06-21T12:00Z"]), r"time\[1\]: must be in the years"),
            (lambda: gnomon.sun_position(0, 0, np.datetime64("NaT")), "must be a string"),
            (lambda: gnomon.sun_position(0, 0, 5), "time = 5: must be a string"),
            (lambda: gnomon.sun_position(0, 0, datetime.date(2026, 6, 21)), "time = datetime.date"),
            (lambda: gnomon.sun_position(0, 0, np.array([["2026-06-21"]], "datetime64[ms]")), "2 dimensions"),
            (lambda: gnomon.sun_position(10**400, 0, "2026-06-21T12:00Z"), "latitude_deg = 1000"),
            (lambda: gnomon.sun_direction(0, 0, "2026-06-21T12:00Z", north="abc"), "north = 'abc'"),
            (lambda: gnomon.truth(plate(), [[0, 1, 0]], {"sun": {"latitude_deg": 1}}), "latitude_deg, longitude_deg and time"),
            (
                lambda: gnomon.truth(plate(), [[0, 1, 0]], {"sun": {**self.SUN, "time": "2026-06-21T23:00Z"}}),
                "below the horizon",
            ),
            (lambda: gnomon.sun_direction(0, 0, "2026-06-21T12:00Z", north=[0, 1, 0]), "horizontal part"),
            (lambda: gnomon.compare("wall", light={"sun": {"latitude_deg": 1}}), "longitude_deg is missing"),
        ]:
            with self.assertRaisesRegex(gnomon.InputError, words):
                call()
