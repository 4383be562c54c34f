"""`gnomon plan --scenes` packs scene files, and `gnomon run-unit --scenes` needs none of them."""
import json
import shutil
import unittest

from tent_case import OBJ, TentCase


class PackedScenes(TentCase):
    def setUp(self):
        super().setUp()
        self.packed = self.folder / "packed"
        self.elsewhere = self.folder / "elsewhere"
        self.elsewhere.mkdir()
        self.run_gnomon("plan", "job.toml", "--units", "3", "--out", "elsewhere/plan.jsonl", "--scenes", "packed")

    def compute(self, unit, code=0):
        return self.run_gnomon("run-unit", str(self.elsewhere / "plan.jsonl"), unit, "--out", str(self.elsewhere / "units"),
                               "--scenes", str(self.packed), "--quiet", code=code)

    def test_take_the_place_of_files(self):
        first = json.loads((self.elsewhere / "plan.jsonl").read_text().splitlines()[0])
        names = [f"{scene['hash']}-{scene['brought']}.scene" for scene in first["scenes"]]
        self.assertEqual([path.name for path in self.packed.iterdir()], names)
        for name in ("tent.obj", "tent.mtl"):
            (self.folder / name).unlink()
        for unit in "123":
            self.compute(unit)
        self.run_gnomon("merge", "run", "elsewhere/units")
        self.expect_same("run")

    def test_are_no_part_of_the_plan(self):
        self.run_gnomon("plan", "job.toml", "--units", "3", "--out", "plain.jsonl")
        self.assertEqual((self.folder / "plain.jsonl").read_bytes(), (self.elsewhere / "plan.jsonl").read_bytes())

    def test_that_are_damaged_or_others_are_refused_in_a_line(self):
        (path,) = self.packed.iterdir()
        whole = path.read_bytes()
        (self.folder / "tent.obj").write_text(OBJ.replace("1.5", "1.6"))
        self.run_gnomon("plan", "job.toml", "--scenes", "others", "--out", "others.jsonl")
        (other,) = (self.folder / "others").iterdir()
        damaged = f"{path.name}: the packed scene is damaged"
        for content, code, words in ((whole[:len(whole) // 2], 4, damaged), (b"", 4, damaged),
                                     (other.read_bytes(), 2, "has the content .* here, and .* in plan")):
            path.write_bytes(content)
            refused = self.compute("1", code).stderr
            self.assertRegex(refused, words)
            self.assertEqual(refused.count("\n"), 1)

    def test_that_are_missing_are_read_where_the_job_says(self):
        shutil.rmtree(self.packed)
        self.compute("1")


if __name__ == "__main__":
    unittest.main(verbosity=2)
