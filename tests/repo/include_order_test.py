"""include_order.py names each violation that is planted."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).with_name("include_order.py")
CERTIFICATE = "reference_rt/certificate/rationals.hpp"

# Files by name with what each includes, and a part of what is said; None: nothing is wrong.
CASES = (
    ({"raster_gl/a.hpp": '"raster_gl/b.hpp"', "raster_gl/b.hpp": '"scene/c.hpp"'}, None),
    ({"cli/main.cpp": '"raster_gl/a.hpp"'}, None),
    ({"reference_rt/truth.cpp": '"raster_gl/a.hpp"'}, "truth.cpp: reference_rt may not include raster_gl"),
    ({"raster_gl/a.cpp": '"reference_rt/truth.hpp"'}, "raster_gl may not include reference_rt"),
    ({"reference_rt/truth.cpp": '"methods/a.hpp"'}, "reference_rt may not include methods"),
    ({"scene/a.cpp": '  "analysis/a.hpp"'}, "scene may not include analysis"),
    ({"reports/a.cpp": '"cli/a.hpp"'}, "reports may not include cli"),
    ({"scene/a.cpp": '"helpers/a.hpp"'}, "does not start with a layer's folder"),
    ({"scene/a.cpp": '"a.hpp"'}, "does not start with a layer's folder"),
    ({"reference_rt/truth.cpp": "<raster_gl/a.hpp>"}, "own headers are included with quotes"),
    ({"raster_gl/a.cpp": "<epoxy/gl.h>", "reference_rt/a.cpp": "<embree3/rtcore.h>"}, None),
    ({"analysis/a.cpp": "<epoxy/gl.h>"}, "only raster_gl may include <epoxy/gl.h>"),
    ({"reports/a.cpp": "<embree4/rtcore.h>"}, "only reference_rt may include <embree4/rtcore.h>"),
    ({CERTIFICATE: '"reference_rt/exact/a.hpp"'}, "rationals.hpp: the certificate and the rest"),
    ({"reference_rt/truth.cpp": f'"{CERTIFICATE}"'}, "truth.cpp: the certificate and the rest"),
    ({"reference_rt/certificate/a.cpp": f'"{CERTIFICATE}"'}, None),
    ({"scene/a.cpp": '"scene/a.hpp"', "scene/a.hpp": '"scene/b.hpp"'}, None),
    ({"scene/a.hpp": '"scene/b.hpp"', "scene/b.cpp": '"scene/a.hpp"'}, "in a circle: scene/a, scene/b"),
    ({"methods/a.hpp": '"methods/b/b.hpp"', "methods/b/b.hpp": '"methods/c/c.hpp"', "methods/c/c.cpp": '"methods/a.hpp"'},
     "in a circle: methods/a, methods/b/b, methods/c/c"),
    ({"scene/a.hpp": '"scene/b.hpp"', "scene/a.cpp": '"scene/c.hpp"', "scene/b.hpp": '"scene/d.hpp"',
      "scene/c.hpp": '"scene/d.hpp"'}, None),  # a diamond
    ({"analysis/metrics/a.hpp": '"analysis/bias/b.hpp"'}, None),
    ({"analysis/bias/b.cpp": '"analysis/metrics/a.hpp"'},
     "analysis/bias/b.cpp: bias may include pixels, depth, lookup, bias of analysis"),
    ({"analysis/lookup/a.hpp": '"analysis/renderers.hpp"', "cli/compare/a.cpp": '"cli/exit_codes.hpp"'}, None),
    ({"cli/compare/a.cpp": '"cli/runs/b.hpp"'}, None),
    ({"cli/compare/a.cpp": '"cli/tune/b.hpp"'}, "not cli/tune/b.hpp"),
    ({"cli/session/a.cpp": '"cli/compare/b.hpp"'}, "not cli/compare/b.hpp"),
)


class IncludeOrder(unittest.TestCase):
    def said(self, files, pragma="#pragma once\n"):
        """The errors of a checkout of these files."""
        with tempfile.TemporaryDirectory() as folder:
            for name, header in files.items():
                file = pathlib.Path(folder, name)
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(f"{pragma}  #  include {header}\n")
            done = subprocess.run([sys.executable, "-B", SCRIPT, folder], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1 if done.stderr else 0)
        return done.stderr

    def test_names_each_include_that_breaks_a_rule(self):
        for files, expected in CASES:
            with self.subTest(files=files):
                said = self.said({CERTIFICATE: "<gmpxx.h>", **files})
                self.assertIn(expected or "", said)
                self.assertEqual(said.count("\n"), 1 if expected else 0, said)

    def test_names_headers_without_a_guard_or_with_a_using_directive(self):
        header = {"reference_rt/certificate/a.cpp": "<gmpxx.h>", "tests/scene/a.hpp": "<string>"}
        self.assertIn("tests/scene/a.hpp: a header has #pragma once", self.said(header, pragma=""))
        self.assertIn("tests/scene/a.hpp: a header has no using namespace",
                      self.said(header, pragma="#pragma once\n  using namespace std;\n"))

    def test_refuses_a_folder_that_is_no_checkout(self):
        self.assertIn("no sources found", self.said({"nowhere/a.hpp": "<string>"}))


if __name__ == "__main__":
    unittest.main()
