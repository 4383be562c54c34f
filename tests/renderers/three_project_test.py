"""examples/engines/three: the workflow gates a project's own page, and Gnomon measures the page as the project sets it."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from session import GNOMON, here, run_gnomon

EXAMPLE = here("examples", "engines", "three")
ADAPTER = here("engines", "three", "adapter.mjs")
SIZE = ("--set", "image.width=320", "--set", "image.height=180")


def workflow_lines(step):
    """The commands of a step of the example's workflow, with this checkout's paths."""
    text = (EXAMPLE / "github.yml").read_text()
    block = re.search(rf"- name: {step}\n        run: \|\n((?:          .*\n)+)", text).group(1)
    return re.sub("^ {10}", "", block, flags=re.M).replace("/opt/gnomon", str(here())).replace("--out run", f"--out run {' '.join(SIZE)}")


class Project(unittest.TestCase):
    """A copy of the example that tests may change."""

    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.folder = pathlib.Path(place.name) / "project"
        shutil.copytree(EXAMPLE, cls.folder, ignore=shutil.ignore_patterns("node_modules"))
        cls.scene = (cls.folder / "scene.mjs").read_text()

    def change(self, *changes):
        """Writes the example's module with these replacements."""
        text = self.scene
        for before, after in changes:
            self.assertIn(before, text)
            text = text.replace(before, after)
        (self.folder / "scene.mjs").write_text(text)

    def run_step(self, step):
        environment = {**os.environ, "PATH": f"{pathlib.Path(GNOMON).parent}:{os.environ['PATH']}"}
        return subprocess.run(["bash", "-e", "-c", workflow_lines(step)], cwd=self.folder, env=environment, capture_output=True, text=True, check=False)

    def draw(self):
        """Draws, and returns the result of the only configuration."""
        shutil.rmtree(self.folder / "run", ignore_errors=True)
        drawn = self.run_step("Draw")
        self.assertEqual(drawn.returncode, 0, drawn.stderr)
        said = json.loads(next((self.folder / "run" / "pixels").glob("*.json")).read_text())
        self.assertEqual(said["job"]["image.width"], 320)
        return said


class GatedProject(Project):
    def test_PassesUnchangedAndFailsWhereShadowsGotWorse(self):
        first = self.draw()
        self.assertGreater(first["pixels"]["blocked"], 1000)
        self.assertLess(first["false_shadow"] + first["false_lit"], 200)
        saved = run_gnomon("baseline", "save", self.folder / "run", "--baseline", self.folder / "shadows.json")
        self.assertEqual(saved.returncode, 0, saved.stderr)
        self.assertEqual(self.draw()["false_lit"], first["false_lit"])
        self.assertEqual(self.run_step("Gate").returncode, 0)
        for changes in ([("shadow.bias = -0.0005", "shadow.bias = -0.005")], [("THREE.FrontSide", "THREE.DoubleSide"), ("shadow.bias = -0.0005", "shadow.bias = 0")]):
            self.change(*changes)
            self.draw()
            gated = self.run_step("Gate")
            self.assertEqual(gated.returncode, 1, gated.stdout + gated.stderr)
        self.change()


class JudgedProject(Project):
    def compared(self, *options):
        """Compares the exported job again."""
        return run_gnomon("compare", self.folder / "drawn" / "job.toml", "--renderer-command", f"node {ADAPTER} {self.folder / 'scene.mjs'}", *SIZE, *options)

    def test_SaysWhatTheProjectSetsAndLeavesOutWhatReceivesNoShadow(self):
        self.change(("shadow.bias = -0.0005", "shadow.bias = -0.002"), ("THREE.PCFShadowMap", "THREE.BasicShadowMap"), ("mapSize.set(1024, 1024)", "mapSize.set(512, 512)"),
                    ("scene.add(light,", 'scene.getObjectByName("ground").receiveShadow = false;\n  scene.add(light,'))
        said = self.draw()
        self.assertEqual([said["job"][key] for key in ("engine.bias", "engine.type", "shadow_map.resolution")], [-0.002, "basic", 512])
        self.assertEqual([said["job"][key] for key in ("shadow_map.near", "shadow_map.far")], [1, 25])
        judged = [one["object"].split("_")[0] for one in said["by_object"] if one["lit"] + one["blocked"] > 0]
        self.assertNotIn("ground", judged)
        self.assertIn("dome", judged)

    def test_LightsWhatNothingCastsOnAndRefusesAnotherLight(self):
        self.change(("mesh.castShadow = true", 'mesh.castShadow = name === "ground"'))
        said = self.draw()
        self.assertLess(said["pixels"]["blocked"], said["pixels"]["lit"] / 1000)
        self.assertLess(said["false_shadow"], said["pixels"]["lit"] / 1000)
        refused = self.compared("--set", "light.direction=[0, -1, 0]")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("the job's light differs from the project's", refused.stderr)

    def test_LightsAllWithoutShadows(self):
        self.change(("sun.castShadow = true", "sun.castShadow = false"))
        said = self.draw()
        self.assertGreater(said["pixels"]["blocked"], 1000)
        self.assertEqual([said["false_shadow"], said["false_lit"]], [0, said["pixels"]["blocked"]])

    def test_NamesWhatIsWrongWithTheModule(self):
        self.change(("export function makeProject", "export function makeOther"))
        drawn = self.run_step("Draw")
        self.assertEqual(drawn.returncode, 1)
        self.assertRegex(drawn.stderr, "^export.mjs: .*scene.mjs exports no makeProject")
        self.change(('color: "tan"', 'alphaTest: 0.5, color: "tan"'))
        self.assertRegex(self.run_step("Draw").stderr, "^export.mjs: .*\"ground\" is cut out by its material's alpha")


if __name__ == "__main__":
    unittest.main()
