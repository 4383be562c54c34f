"""make.py writes reproducible files, and refuses bad tables and arguments in one line."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

from figure_inputs import HERE, path, paths

import make  # noqa: E402  found by figure_inputs

DOCS = HERE.parents[1] / "docs"


class CommandLine(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def run_make(self, *arguments):
        """The exit status and what went to stderr."""
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            try:
                status = make.main([str(argument) for argument in arguments])
            except SystemExit as ended:
                status = ended.code
        return status, said.getvalue()

    def assert_refused(self, reason, *arguments):
        status, said = self.run_make(*arguments)
        self.assertEqual(status, 2, said)
        self.assertRegex(said, reason)
        self.assertEqual(said.count("\n"), 1, said)

    def test_draws_each_figure_the_same_twice(self):
        for name, inputs in (
            ("error-vs-z", ("formula8", "formula24")),
            ("tolerance-vs-z", ("tolerance32",)),
            ("reversed-float", ("d24", "d32f", "d32f_reversed")),
            ("measured-against-formula", ("d16", "d24")),
            ("shadow-errors-on-depth-error", ("two-distances/error_vs_z", "two-distances/results")),
            ("cascades", ("cascades/tight", "cascades/one_map")),
        ):
            for kind, magic in (("png", b"\x89PNG"), ("svg", b"<?xml")):
                with self.subTest(name=name, kind=kind):
                    written = []
                    for run in range(2):
                        output = self.folder / f"{name}{run}.{kind}"
                        ended = self.run_make(name, *paths(*inputs), "-o", output)
                        self.assertEqual(ended, (0, ""))
                        written.append(output.read_bytes())
                    self.assertTrue(written[0].startswith(magic))
                    self.assertEqual(written[0], written[1])

    def test_refuses_bad_tables_in_one_line(self):
        output = self.folder / "figure.png"
        header, *rows = path("d16").read_text().splitlines()
        for text, reason in (
            ("", "cannot be read as CSV: the file is empty"),
            (header + "\n", "no rows under the header"),
            (header.replace("envelope_m", "envelope") + "\n" + rows[0] + "\n",
             "no column envelope_m"),
            (header + "\nnear" + rows[0][1:] + "\n", "line 2: zeta_m is not a number: near"),
            ('a,b\n"1,2\n', "cannot be read as CSV"),
            (b"\xff\xfe\x00".decode("latin-1") + "\n1\n", "no column zeta_m"),
        ):
            with self.subTest(reason=reason):
                bad = self.folder / "bad.csv"
                bad.write_text(text)
                self.assert_refused(f"^make.py: {bad}: {reason}", "error-vs-z", bad, "-o", output)
        self.assertFalse(output.exists())

    def test_refuses_missing_files_and_wrong_arguments_in_one_line(self):
        output = self.folder / "figure.png"
        (d16,) = paths("d16")
        nowhere = self.folder / "nowhere.csv"
        self.assert_refused(f"{nowhere}: no such file", "error-vs-z", nowhere, "-o", output)
        self.assert_refused("results.csv: no such file; is .* a run", "error-vs-z", self.folder, "-o", output)
        self.assert_refused("invalid choice: 'pie'", "pie", d16, "-o", output)
        self.assert_refused("-o --out is required", "error-vs-z", d16)
        self.assert_refused("must end in .pdf, .svg or .png", "error-vs-z", d16, "-o", "figure.gif")
        self.assert_refused("1 files given", "shadow-errors-on-depth-error", d16, "-o", output)

    def test_has_every_listed_figure_on_its_page(self):
        pages = [(DOCS / name).read_text() for name in ("figures.md", "depth_precision.md")]
        for name in make.FIGURES:
            with self.subTest(figure=name):
                self.assertTrue(any(f"`{name}`" in page for page in pages))

    def test_says_where_it_cannot_write(self):
        output = self.folder / "nowhere" / "figure.svg"
        status, said = self.run_make("error-vs-z", *paths("d16"), "-o", output)
        self.assertEqual((status, said), (4, f"make.py: {output}: No such file or directory\n"))


if __name__ == "__main__":
    unittest.main()
