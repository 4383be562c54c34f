"""Checks of an adapter. If they pass, surprising shadows are the engine's own and not the adapter's."""


def contents(folder):
    """The bytes of a frame's files by name."""
    return {file.name: file.read_bytes() for file in sorted(folder.iterdir())}


class FairEngine:
    """A mixin of DrivenEngine, which must set what is None here: tries an adapter where the truth is known."""
    WITHOUT_SHADOWS = None  # settings that draw no shadows
    GOOD = None  # settings with nearly right shadows, by scene
    OTHERS = None  # two settings whose frames differ from each other
    CASTERS = ("sphere", "plane")  # all that casts in sphere-plane
    SOME = 100  # the fewest pixels that a check needs

    def positions_lie_on_the_mesh(self, said):
        check = said["evaluate"]["import_check"]
        self.assertIsNone(check["mistake"], check)
        # Positions are interpolated in float32, with steps of 9.5e-7 m at 8 m from the origin and larger ones farther off.
        self.assertLess(check["distance_m"]["p99"], 2e-5)

    def test_DrawsNoShadowsWhereTheyAreOff(self):
        for scene in self.SCENES:
            said = self.judged(scene, self.WITHOUT_SHADOWS)
            self.positions_lie_on_the_mesh(said)
            self.assertGreater(said["pixels"]["blocked"], self.SOME, scene)
            self.assertEqual(said["false_lit"], said["pixels"]["blocked"], scene)
            self.assertEqual(said["false_shadow"], 0, scene)

    def test_DrawsNoShadowOfWhatDoesNotCast(self):
        said = self.judged("sphere-plane", self.GOOD["sphere-plane"], no_cast=list(self.CASTERS))
        self.assertEqual(said["pixels"]["blocked"], 0)
        self.assertEqual(said["false_shadow"], 0)
        self.assertGreater(said["pixels"]["lit"], self.SOME)

    def test_DoesNotShowWhatDoesNotReceive(self):
        shown = self.judged("sphere-plane", self.GOOD["sphere-plane"])
        said = self.judged("sphere-plane", self.GOOD["sphere-plane"], no_receive=["sphere"])
        self.positions_lie_on_the_mesh(said)
        self.assertGreater(sum(said["pixels"][kind] for kind in ("lit", "blocked")), self.SOME)
        self.assertIn("sphere", [row["object"] for row in shown["by_object"]])
        self.assertNotIn("sphere", [row["object"] for row in said["by_object"] if row["lit"] + row["blocked"] > 0])

    def test_ShadowsLandWhereTheyMust(self):
        # A wrong light, map or mask makes at least half of the pixels wrong. Good settings leave borders: a few texels wide
        # in a map of 512, along shadows of some hundred texels.
        for scene in self.SCENES:
            said = self.judged(scene, self.GOOD[scene])
            self.positions_lie_on_the_mesh(said)
            self.assertLess(said["false_shadow"], said["pixels"]["lit"] * 0.03, scene)
            self.assertLess(said["false_lit"], said["pixels"]["blocked"] * 0.15, scene)

    def test_EqualRequestsGiveEqualFramesWhateverCameBetween(self):
        first, other = self.OTHERS
        frames = [contents(self.frame("sphere-plane", engine)[1]) for engine in (first, other, self.WITHOUT_SHADOWS, first)]
        self.assertEqual(frames[0], frames[3])
        self.assertNotEqual(frames[0], frames[1])
