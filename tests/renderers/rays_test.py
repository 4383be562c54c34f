"""rays_test.py COMMAND…: an example renderer draws true shadows, and wrong ones with a wrong bias."""
import pathlib
import sys
import tempfile
import unittest

from session import Session, export_case, judge

COMMAND = sys.argv[1:]
WIDTH, HEIGHT = 64, 36
SIZE = {"image__width": WIDTH, "image__height": HEIGHT}
MAP = {"resolution": 64, "near": 0.1, "far": 100, "light_clip_from_world": [0.0] * 16}


class Rays(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.cases = pathlib.Path(place.name)
        cls.described = {name: export_case(cls.cases / name, name, **SIZE)[0] for name in ("yard", "sphere-plane")}

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)

    def frame(self, scene, engine=None, camera=None, **objects):
        """Gnomon's evaluation of a built-in scene that the renderer drew."""
        mesh, frame = self.cases / scene / "mesh.glb", self.folder / "frame"
        description = {**self.described[scene], **({"camera": camera} if camera else {})}
        with Session(COMMAND) as session:
            self.assertEqual(session.open(mesh, description, WIDTH, HEIGHT, **objects), {"ok": True})
            answer = session.draw(frame, MAP, engine)
        self.assertTrue(answer.get("ok"), answer)
        self.assertEqual(judge(frame, mesh, description, answer, "--check", **objects), 0)
        return judge(frame, mesh, description, answer, **objects)

    def opened(self, session):
        return session.open(self.cases / "sphere-plane" / "mesh.glb", self.described["sphere-plane"], WIDTH, HEIGHT)

    def test_AreTrueUnderADirectionalLight(self):
        said = self.frame("yard")
        self.assertGreater(said["pixels"]["blocked"], 100)
        self.assertEqual(said["false_shadow"] + said["false_lit"], 0)

    def test_AreTrueUnderASpot(self):
        said = self.frame("sphere-plane")
        self.assertGreater(said["pixels"]["blocked"], 100)
        self.assertEqual(said["false_shadow"] + said["false_lit"], 0)

    def test_AreTrueWithACameraWithoutPerspective(self):
        camera = {**self.described["sphere-plane"]["camera"], "orthographic_height": 9}
        del camera["vertical_fov_deg"]
        said = self.frame("sphere-plane", camera=camera)
        self.assertGreater(said["pixels"]["blocked"], 100)
        self.assertEqual(said["false_shadow"] + said["false_lit"], 0)

    def test_ShadowThemselvesWithoutABias(self):
        # P is rounded to float32: about half of the points of tilted faces lie behind their face.
        said = self.frame("yard", {"bias_m": 0})
        self.assertGreater(said["false_shadow"], said["pixels"]["lit"] / 20)
        self.assertEqual(said["false_lit"], 0)

    def test_LightEverythingWithABiasBeyondTheScene(self):
        said = self.frame("sphere-plane", {"bias_m": 1000})
        self.assertEqual(said["false_lit"], said["pixels"]["blocked"])
        self.assertEqual(said["false_shadow"], 0)

    def test_LeaveOutWhatCastsNothing(self):
        said = self.frame("sphere-plane", no_cast=["sphere"])
        self.assertEqual(said["pixels"]["blocked"], 0)
        self.assertEqual(said["false_shadow"], 0)

    def test_LeaveOutWhatIsNotSeen(self):
        said = self.frame("sphere-plane", no_receive=["sphere"])
        self.assertGreater(said["pixels"]["blocked"], 100)
        self.assertEqual(said["false_shadow"] + said["false_lit"], 0)

    def test_DrawTheSameTwice(self):
        frames = []
        with Session(COMMAND) as session:
            self.opened(session)
            for name in ("first", "second"):
                answer = session.draw(self.folder / name, MAP)
                frames.append([(self.folder / name / file).read_bytes() for file in answer["files"].values()])
        self.assertEqual(frames[0], frames[1])

    def test_RefuseByKeyWhatRaysDoNotHave(self):
        with Session(COMMAND) as session:
            self.opened(session)
            answer = session.draw(self.folder / "frame", {**MAP, "depth_format": "d16"}, {"slices": 3}, bias={"slope": 0.1})
        self.assertEqual(sorted(answer["error"]), ["bias.slope", "engine.slices", "shadow_map.depth_format"])

    def test_SayWhatWentWrongAndGoOn(self):
        with Session(COMMAND) as session:
            self.assertIn("error", session.draw(self.folder / "frame", MAP))  # no scene yet
            self.assertIn("none.glb", session.open(
                self.folder / "none.glb", self.described["sphere-plane"], WIDTH, HEIGHT)["error"])
            self.opened(session)
            self.assertTrue(session.draw(self.folder / "frame", MAP).get("ok"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
