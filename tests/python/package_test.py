"""The package as a whole: its interface, lists, keys and program."""

import inspect
import json
import os
import subprocess
import sys
import unittest

import gnomon
import numpy as np
from gnomon.keys import flat, toml
from support import PROGRAM


class ReferenceTest(unittest.TestCase):
    def public_functions(self):
        for name in gnomon.__all__:
            value = getattr(gnomon, name)
            if inspect.isfunction(value):
                yield name, value
            elif inspect.isclass(value) and value.__module__.startswith("gnomon."):
                for member, own in vars(value).items():
                    function = own.fget if isinstance(own, property) else own
                    if inspect.isfunction(function) and not member.startswith("_"):
                        yield f"{name}.{member}", function

    def test_everything_public_has_types_and_a_sentence(self):
        names = [name for name, _ in self.public_functions()]
        self.assertIn("compare", names)
        self.assertIn("Comparison.findings", names)
        for name, function in self.public_functions():
            signature = inspect.signature(function)
            self.assertIsNot(signature.return_annotation, inspect.Signature.empty, name)
            for parameter in signature.parameters.values():
                if parameter.name != "self":
                    self.assertIsNot(parameter.annotation, inspect.Parameter.empty, f"{name}({parameter.name})")
            self.assertTrue(function.__doc__, name)


class ListsTest(unittest.TestCase):
    def test_methods_are_the_program_s(self):
        said = json.loads(subprocess.run([PROGRAM, "methods", "--json"], capture_output=True, check=True).stdout)
        self.assertEqual(gnomon.methods(), said)


class KeysTest(unittest.TestCase):
    def test_values_are_written_as_toml(self):
        cases = [(True, "true"), (3, "3"), (0.1, "0.1"), (np.float32(0.5), "0.5"), (float("inf"), "inf")]
        cases += [('a"b', '"a\\"b"'), ([1, "x"], '[1, "x"]'), (np.array([1.5, 2]), "[1.5, 2.0]")]
        for value, text in cases:
            self.assertEqual(toml(value), text)
        with self.assertRaises(gnomon.InputError):
            toml(object())

    def test_tables_are_flattened(self):
        given = {"bias": {"constant": 1, "slope": None}, "image.width": 2}
        self.assertEqual(list(flat(given)), [("bias.constant", 1), ("image.width", 2)])


class WithoutGlTest(unittest.TestCase):
    def test_truth_and_evaluate_work_and_compare_says_what_is_missing(self):
        script = """
import gnomon, numpy as np
scene = gnomon.builtin("wall")
assert len(gnomon.truth(scene, [[0, 1, 5]], {"direction": [0, -1, 0]})) == 1
try:
    gnomon.compare("wall")
except gnomon.EnvironmentError as error:
    print(error)
"""
        environment = {**os.environ, "__EGL_VENDOR_LIBRARY_DIRS": "/nonexistent"}
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, env=environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, "^[^\n]*(EGL|GL driver)[^\n]*\n$")


class ProgramTest(unittest.TestCase):
    def test_the_module_is_the_program(self):
        environment = {**os.environ, "PATH": os.path.dirname(PROGRAM) + ":" + os.environ["PATH"]}
        command = [sys.executable, "-m", "gnomon", "--version"]
        done = subprocess.run(command, capture_output=True, text=True, env=environment)
        self.assertIn(gnomon.__version__, done.stdout)
