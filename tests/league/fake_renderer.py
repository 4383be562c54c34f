#!/usr/bin/env python3
"""A renderer with keys to be set well or badly, and with mistakes to be made on purpose: rays.py, and what is done to its mask.

fake_renderer.py [--dark] [--always] [--aside] [--unequal] [--turned]
--dark: lit pixels are in shadow; --always: there are shadows where they are off; --aside: they lie elsewhere, unless `other` is 3; --unequal: equal
requests give other frames; --turned: the camera stands elsewhere.
"""

import json
import pathlib
import subprocess
import sys

import numpy as np

RAYS = pathlib.Path(__file__).resolve().parents[2] / "examples" / "renderers" / "rays.py"
WORDS = sys.argv[1:]
KEYS = [{"name": "soft", "type": "number", "range": [0, 1], "default": 0.25, "unit": "", "help": "how dark lit pixels are"},
        {"name": "other", "type": "integer", "range": [0, 3], "default": 0, "unit": "", "help": "changes nothing but what --aside does"},
        {"name": "shadows", "type": "boolean", "default": True, "unit": "", "help": "whether there are any"}]


def told(lit, engine, draws):
    """Changes the true mask."""
    if "--aside" in WORDS and engine["other"] != 3:
        lit = np.roll(lit, lit.shape[1] // 3, axis=1)
    if not engine["shadows"] and "--always" not in WORDS:
        return np.ones_like(lit)
    if not (lit == 0).any():
        return lit
    lit = lit * np.float32(0.25 if "--dark" in WORDS else 1 - engine["soft"])
    if "--unequal" in WORDS:
        lit[:] = 1 / draws
    return lit.astype(np.float32)


class Relay:
    """Passes requests to rays.py, and returns its answers."""

    def __init__(self):
        self.rays = subprocess.Popen([sys.executable, "-B", str(RAYS)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.draws = 0

    def ask(self, request):
        self.rays.stdin.write(json.dumps(request) + "\n")
        self.rays.stdin.flush()
        return json.loads(self.rays.stdout.readline())

    def draw(self, request):
        engine = request["draw"]["engine"]
        answer = self.ask({**request, "draw": {**request["draw"], "engine": {"bias_m": 0.001}}})
        if "files" in answer:
            self.draws += 1
            path = pathlib.Path(request["frame"]).with_name("shadow.npy")
            np.save(path, told(np.load(path), engine, self.draws))
            answer["case"] = {"channels": {"fractions": True, "mask_range": [0, 1]}}
        return answer

    def answer(self, request):
        if "draw" in request:
            return self.draw(request)
        if "open" in request and "--turned" in WORDS:
            request["open"]["camera"]["eye"][1] *= 2
        answer = self.ask(request)
        return {**answer, "name": "fake", "keys": KEYS} if "hello" in request else answer


def main():
    relay = Relay()
    for line in sys.stdin:
        request = json.loads(line)
        if "close" in request:
            break
        print(json.dumps(relay.answer(request)), flush=True)
    relay.rays.stdin.close()
    relay.rays.wait()


main()
