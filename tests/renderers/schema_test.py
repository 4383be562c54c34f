"""The lines between Gnomon and a renderer fit docs/renderer_protocol.schema.json."""
import copy
import json
import pathlib
import tempfile
import unittest

import jsonschema

from session import here, run_gnomon

SCHEMA = json.loads(here("docs", "renderer_protocol.schema.json").read_text())
RAYS = here("examples", "renderers", "rays.py")
PROXY = here("tests", "renderers", "told_lines.py")


def validator(*names):
    """A validator of these kinds of lines."""
    return jsonschema.Draft202012Validator({"oneOf": [{"$ref": f"#/$defs/{name}"} for name in names], "$defs": SCHEMA["$defs"]})


REQUESTS = validator("hello_request", "open_request", "draw_request", "close_request")
ANSWERS = validator("hello_answer", "open_answer", "draw_answer", "error_answer")


class Lines(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as place:
            file = pathlib.Path(place) / "told.txt"
            said = run_gnomon("renderer-check", "--command", f"/usr/bin/python3 -B {PROXY} {file} /usr/bin/python3 -B {RAYS}")
            if said.returncode != 0:
                raise AssertionError(said.stdout + said.stderr)
            lines = file.read_text().splitlines()
        cls.requests = [json.loads(line[2:]) for line in lines if line[0] == ">"]
        cls.answers = [json.loads(line[2:]) for line in lines if line[0] == "<"]

    def test_AreOfTheSchema(self):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)
        for kind, allowed in (("hello", 1), ("open", 2), ("draw", 10)):
            self.assertGreaterEqual(sum(kind in request for request in self.requests), allowed, kind)
        for request in self.requests:
            REQUESTS.validate(request)
        for answer in self.answers:
            ANSWERS.validate(answer)
        self.assertGreater(sum("error" in answer for answer in self.answers), 0)

    def test_ThatAreAnotherThingAreNot(self):
        draw = next(request for request in self.requests if "draw" in request)
        hello, drawn = self.answers[0], next(answer for answer in self.answers if "seconds" in answer)

        def changed(line, change):
            line = copy.deepcopy(line)
            change(line)
            return line

        for change in (lambda line: line.pop("id"), lambda line: line.pop("frame"), lambda line: line.update(more=1),
                       lambda line: line["draw"]["shadow_map"].pop("resolution"), lambda line: line.update(id="1")):
            self.assertFalse(REQUESTS.is_valid(changed(draw, change)))
        for change in (lambda line: line.pop("device"), lambda line: line.update(protocol="1"), lambda line: line.update(more=1),
                       lambda line: line["keys"].append({"name": "bias"})):
            self.assertFalse(ANSWERS.is_valid(changed(hello, change)))
        for change in (lambda line: line.pop("seconds"), lambda line: line.update(ok="yes"),
                       lambda line: line.update(case={"scene": {}})):
            self.assertFalse(ANSWERS.is_valid(changed(drawn, change)))


if __name__ == "__main__":
    unittest.main()
