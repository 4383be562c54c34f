"""examples/clusters/kubernetes.yaml is a Job, and what its pods run computes a plan: one machine's sweep."""
import copy
import json
import os
import pathlib
import subprocess
import unittest

import jsonschema
import yaml

from processes import ROOT
from sweep_case import GNOMON, JOB, SweepCase

SCHEMA = json.loads(pathlib.Path(__file__).with_name("kubernetes_job.schema.json").read_text())
MANIFEST = yaml.safe_load((ROOT / "examples/clusters/kubernetes.yaml").read_text())
RULES = MANIFEST["spec"]["podFailurePolicy"]["rules"]
AXES = '[sweep]\nshadow_map.resolution = [16, 24, 32]\nbias.constant = [0, 0.001, 0.02]\n'


def place(manifest, *keys):
    for key in keys:
        manifest = manifest[key]
    return manifest


POD = ("spec", "template", "spec")
CONTAINER = (*POD, "containers", 0)


class Manifest(unittest.TestCase):
    def test_is_a_job(self):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)
        jsonschema.validate(MANIFEST, SCHEMA, jsonschema.Draft202012Validator)

    def test_would_not_be_one_with_a_fault(self):
        faults = [((), "apiVersion", "batch/v1beta1"), (("spec",), "completionMode", "indexed"),
                  (("spec",), "completion", 3), (("spec",), "completions", "200"), (POD, "restartPolicy", "OnFailure"),
                  (CONTAINER, "workdir", "/sweep"), (CONTAINER, "command", "/bin/sh"),
                  ((*CONTAINER, "resources", "requests"), "cpu", 1),
                  (("spec", "podFailurePolicy", "rules", 0), "action", "Fail"),
                  (("spec", "podFailurePolicy", "rules", 2, "onPodConditions", 0), "status", True)]
        for keys, name, value in faults:
            broken = copy.deepcopy(MANIFEST)
            place(broken, *keys)[name] = value
            with self.subTest(name=name), self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate(broken, SCHEMA, jsonschema.Draft202012Validator)

    def test_names_what_it_has(self):
        container = place(MANIFEST, *CONTAINER)
        volumes = [volume["name"] for volume in place(MANIFEST, *POD, "volumes")]
        self.assertEqual([mount["name"] for mount in container["volumeMounts"]], volumes)
        self.assertEqual(container["workingDir"], container["volumeMounts"][0]["mountPath"])
        rules = [rule["onExitCodes"] for rule in RULES if "onExitCodes" in rule]
        self.assertEqual({rule["containerName"] for rule in rules}, {container["name"]})


class Pods(SweepCase):
    """The container's command, where its volume would be mounted."""

    axes = []
    job = JOB + AXES

    def run_index(self, index):
        container = place(MANIFEST, *CONTAINER)
        path = f"{pathlib.Path(GNOMON).parent}:{os.environ['PATH']}"
        return subprocess.run([*container["command"], *container["args"]], cwd=self.folder, capture_output=True, text=True,
                              check=False, env=dict(os.environ, PATH=path, JOB_COMPLETION_INDEX=str(index)))

    def test_compute_the_plan(self):
        self.run_gnomon("plan", "job.toml", "--units", "3", "--out", "plan.jsonl")
        for index in (2, 0, 1, 1):
            done = self.run_index(index)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.run_gnomon("merge", "run", "units")
        self.expect_same("run")
        beyond = self.run_index(3)
        actions = [rule["action"] for rule in RULES if beyond.returncode in rule.get("onExitCodes", {}).get("values", [])]
        self.assertEqual(actions, ["FailJob"], beyond.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
