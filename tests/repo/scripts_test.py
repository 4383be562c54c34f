"""scripts_test.py BUILD: the repository's own scripts notice what they are there to notice.

BUILD is the build folder whose unit_paths.txt says what the libraries' unit tests are made of.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
BUILD = pathlib.Path(sys.argv.pop())


class ScriptTest(unittest.TestCase):
    """A test in an empty folder."""

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def run_script(self, program, script, *arguments, said=""):
        """The exit status and both outputs together."""
        done = subprocess.run([program, HERE / script, *arguments], input=said, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, cwd=self.folder, check=False)
        return done.returncode, done.stdout


class DocumentLinks(ScriptTest):
    def test_names_each_broken_link(self):
        # Not spelled out, or document_links.sh would look for these documents in this checkout.
        docs = "docs"
        self.write(f"{docs}/formulas.md", "# Formulas\n\n## Driver bound, B\n")
        job = "scene/settings/job.hpp"
        for page, comment, message in (
            (f"[a]({docs}/formulas.md#driver-bound-b) [b](#read-me) [c](https://example.org/x)",
             f"{docs}/formulas.md#driver-bound-b.", ""),
            ("`scene/settings/job` `scene/settings/job.hpp` `scene/settings/`", "", ""),
            (f"[a]({docs}/lost.md)", "", f"README.md: {docs}/lost.md does not exist\n"),
            (f"[a]({docs}/formulas.md#lost)", "", f"README.md: {docs}/formulas.md has no heading #lost\n"),
            ("[a](#read-me)", f"{docs}/methods/lost.md", f"{job}: {docs}/methods/lost.md does not exist\n"),
            ("[a](#read-me)", f"{docs}/formulas.md#lost", f"{job}: {docs}/formulas.md has no heading #lost\n"),
            ("`scene/lost`", "", "README.md: scene/lost does not exist\n"),
        ):
            with self.subTest(page=page, comment=comment):
                self.write("README.md", f"# Read me\n{page}\n")
                self.write(job, f"/// {comment}\n")
                self.assertEqual(self.run_script("bash", "document_links.sh", self.folder), (bool(message), message))


class ReadmeCommands(ScriptTest):
    def run_document(self, text):
        self.write("bin/gnomon", '#!/bin/sh\n[ "$1" = compare ] && echo "compared $2"\n').chmod(0o755)
        document = self.write("document.md", text)
        return self.run_script("bash", "readme_commands.sh", document, self.folder / "bin", self.folder / "run")

    def test_runs_shell_blocks_in_one_folder(self):
        status, said = self.run_document("```sh\n./dev build\n# a comment\ngnomon compare \\\n    yard > kept.txt\n"
                                         "grep 'compared yard' kept.txt\n```\n```toml\ngnomon refuse\n```\n")
        self.assertEqual(status, 0, said)
        self.assertIn("\ncompared yard\n", said)

    def test_names_the_command_that_fails(self):
        status, said = self.run_document("```sh\ngnomon refuse\ngnomon compare yard\n```\n")
        self.assertEqual(status, 1)
        self.assertIn("failed with 1: gnomon refuse", said)

    def test_refuses_a_document_without_commands(self):
        self.assertEqual(self.run_document("no commands here")[0], 1)


class TestFiles(ScriptTest):
    def check(self):
        return self.run_script("bash", "test_files.sh", self.folder)

    def test_names_each_forgotten_file_and_folder(self):
        parent = self.write("tests/CMakeLists.txt", "add_subdirectory(layer)\n")
        self.write("tests/layer/CMakeLists.txt",
                   "gnomon_test(layer SOURCES a_test.cpp helper.cpp)\n# b_test.sh runs the rest\n")
        self.write("tests/layer/b_test.sh", "python3 -m unittest c_test\nnode --test d_test.mjs\n")
        for name in ("a_test.cpp", "helper.cpp", "c_test.py", "d_test.mjs"):
            self.write(f"tests/layer/{name}", "")
        self.assertEqual(self.check(), (0, ""))
        for name in ("other_helper.cpp", "aa_test.cpp", "lost_test.py", "lost_test.mjs", "lost_test.sh"):
            forgotten = self.write(f"tests/layer/{name}", "")
            status, said = self.check()
            self.assertEqual((status, said.split(": ")[0]), (1, f"tests/layer/{name}"))
            forgotten.unlink()
        parent.write_text("# nothing\n")
        status, said = self.check()
        self.assertEqual((status, said.split(": ")[0]), (1, "tests/layer/CMakeLists.txt"))


class ChangedUnits(ScriptTest):
    def setUp(self):
        super().setUp()
        for name, text in (("one.hpp", ""), ("one.cpp", '#include "one.hpp"\n'), ("user.cpp", '#include "one.hpp"\n'),
                           ("alone.hpp", ""), ("other.cpp", '#include "alone.hpp"\n'), (".gitignore", "/build/\n"),
                           (".clang-tidy", "Checks: none\n")):
            self.write(name, text)
        self.write("build/compile_commands.json", json.dumps([
            {"directory": str(self.folder / "build"), "command": f"g++ -o {name}.o -c ../{name}.cpp",
             "file": str(self.folder / f"{name}.cpp")} for name in ("one", "user", "other")]))
        for command in (("init", "-q"), ("add", "-A"), ("-c", "user.name=x", "-c", "user.email=x@y", "commit", "-qm", "x")):
            subprocess.run(["git", *command], cwd=self.folder, check=True)

    def units(self, *options):
        status, said = self.run_script("python3", "changed_units.py", self.folder, "build", "HEAD", *options)
        self.assertEqual(status, 0, said)
        return said.splitlines()

    def test_are_one_for_each_changed_file(self):
        self.assertEqual(self.units(), [])
        for changed, unit in (("other.cpp", "other"), ("one.hpp", "one"), ("alone.hpp", "other")):
            with self.subTest(changed=changed):
                before = (self.folder / changed).read_text()
                self.write(changed, before + "// more\n")
                (found,) = self.units()
                self.assertEqual(found.replace("\\", ""), f"^{self.folder}/{unit}.cpp$")
                self.write(changed, before)
        self.write("new.hpp", "")
        self.write("user.cpp", '#include "new.hpp"\n')
        self.assertEqual(len(self.units()), 1)

    def test_are_all_where_the_checks_changed(self):
        self.write(".clang-tidy", "Checks: all\n")
        self.assertEqual(len(self.units()), 3)

    def test_are_compiled_without_output(self):
        self.write("other.cpp", "// more\n")
        self.assertEqual(self.units("--commands"), [f"cd {self.folder}/build && g++ -c ../other.cpp -fsyntax-only"])


def entry(name, status, output="", skipped=""):
    """An entry of CTest's JUnit file."""
    message = f'\t\t<skipped message="{skipped}"/>\n' if skipped else ""
    return (f'\t<testcase name="{name}" classname="{name}" time="0.1" status="{status}">\n{message}'
            f"\t\t<system-out>begin\n{output}\n</system-out>\n\t</testcase>\n")


GOOGLE_TEST = """[==========] Running 4 tests from 1 test suite.
[       OK ] Metrics.CountsClasses (0 ms)
[ RUN      ] Metrics.ReadsMeshes
/tests/metrics_test.cpp:5: Skipped
no meshes &lt;here&gt;
[  SKIPPED ] Metrics.ReadsMeshes (0 ms)
[  FAILED  ] Sizes/Metrics.AddUp/1, where GetParam() = 2 (0 ms)
[       OK ] Sizes/Metrics.AddUp/2 (0 ms)
[  PASSED  ] 2 tests.
[  SKIPPED ] 1 test, listed below:
[  SKIPPED ] Metrics.ReadsMeshes
[  FAILED  ] Sizes/Metrics.AddUp/1, where GetParam() = 2"""
README = entry("readme", "notrun", "SKIPPED: no program", "SKIP_RETURN_CODE=77")
ENTRIES = (
    entry("metrics_test", "fail", GOOGLE_TEST), README, entry("include_order", "run"), entry("late", "fail"),
    entry("empty_shard", "run", "[==========] Running 0 tests from 0 test suites.\n[  PASSED  ] 0 tests."),
    entry("crash", "fail", "[==========] Running 2 tests from 1 test suite.\n[       OK ] Crash.Never (0 ms)"),
    entry("lost", "notrun", "Unable to find executable: lost", "Unable to find executable"),
)
MESHES, PROGRAM = "  Metrics.ReadsMeshes: no meshes <here>", "  readme: no program"
ALLOWED = "# TEST CONDITION REASON\nMetrics.Reads* no-meshes they are not ours\n\nreadme no-program it cannot run\n" \
          "readme never nor now\n"
REFUSED = "Skipped, and tests/allowed_skips does not allow it here:"


class Summary(ScriptTest):
    def expect(self, status, lines, entries, conditions="no-meshes no-program", allowed=ALLOWED):
        files = self.write("allowed", allowed), self.write("results.xml", "".join(entries))
        found, said = self.run_script("awk", "summary.awk", *files, conditions=conditions)
        self.assertEqual((found, [line for line in said.splitlines() if line]), (status, lines))

    def run_script(self, program, script, *arguments, conditions=""):
        done = subprocess.run([program, "-v", f"conditions={conditions}", "-f", HERE / script, *arguments],
                              capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def test_counts_cases_and_entries(self):
        start, end = "empty_shard: it ran no test", "4 passed, 5 failed, 2 skipped"
        for conditions, allowed, lines in (
            ("no-meshes no-program", ALLOWED, ["Skipped:", MESHES, PROGRAM]),
            ("no-program", ALLOWED, ["Skipped:", PROGRAM, REFUSED, MESHES]),
            ("no-meshes no-program", ALLOWED.replace("readme", "read"), ["Skipped:", MESHES, REFUSED, PROGRAM]),
            ("no-meshes no-program", "# none\n", [REFUSED, MESHES, PROGRAM]),
        ):
            self.expect(4, [start, *lines, end], ENTRIES, conditions, allowed)

    def test_accepts_allowed_skips(self):
        self.expect(0, ["Skipped:", PROGRAM, "0 passed, 0 failed, 1 skipped"], [README])

    def test_sees_what_suites_hide(self):
        hidden = ("OK (skipped=2)", "ℹ skipped 1", "# skipped 3", "  YOU HAVE 1 DISABLED TEST")
        self.expect(3, [REFUSED, *(f"  suite: {line}" for line in hidden), "6 passed, 0 failed, 0 skipped"],
                    [entry("suite", "run", f"...\n{line}") for line in (*hidden, "OK", "ℹ skipped 0")])


class UnchangedEntries(ScriptTest):
    def left_out(self, changed, paths):
        status, said = self.run_script("bash", "unchanged_entries.sh", paths, said=changed + "\n")
        self.assertEqual(status, 0, said)
        return set(said.split())

    def test_are_those_whose_paths_have_no_changed_file(self):
        paths = self.write("paths.txt", "drawn scene/ tests/drawn/\ntold notes/a.md\n")
        for changed, expected in (("scene/job.cpp", {"told"}), ("tests/drawn/x_test.cpp", {"told"}),
                                  ("notes/a.md", {"drawn"}), ("notes/aXmd", {"drawn", "told"}),
                                  ("old/scene/job.cpp", {"drawn", "told"}), ("", {"drawn", "told"})):
            self.assertEqual(self.left_out(changed, paths), expected, changed)

    def test_follow_the_layers(self):
        below = ("scene_tests", "methods_tests", "analysis_tests", "store_run_store_test", "reports_table_test")
        lines = (BUILD / "unit_paths.txt").read_text().splitlines(keepends=True)
        paths = self.write("units.txt", "".join(line for line in lines if line.split()[0] in below))
        # The tests of store and reports share the support library.
        for changed, count in (("scene/settings/job.cpp", 0), ("methods/list.cpp", 1), ("analysis/metrics/metrics.cpp", 2),
                               ("reports/table.cpp", 3), ("cli/main.cpp", 5)):
            self.assertEqual(self.left_out(changed, paths), set(below[:count]), changed)
        self.assertEqual(self.left_out("docs/metrics.md", paths), set(below) - {"analysis_tests"})
        self.assertEqual(self.left_out("examples/job.toml", paths), set(below) - {"scene_tests"})
        for common in ("CMakeLists.txt", "cmake/GnomonLibrary.cmake", "tests/support/lane.hpp", "tests/CMakeLists.txt", "dev"):
            self.assertEqual(self.left_out(common, paths), set(), common)


class TestsBeside(ScriptTest):
    def beside(self, *files):
        status, said = self.run_script("bash", "tests_beside.sh", *files)
        self.assertEqual(status, 0, said)
        return said

    def test_each_source_of_a_library_has_tests(self):
        for layer in ("scene", "methods", "raster_gl", "reference_rt", "analysis", "store", "reports"):
            for folder, _, _ in os.walk(ROOT / layer):
                source = f"{pathlib.Path(folder).relative_to(ROOT)}/any.cpp"
                self.assertRegex(self.beside(source), rf"^{layer}_tests .*\..*\n$", source)

    def test_are_those_of_the_file_or_its_subject(self):
        test = "tests/store/csv_text_test.cpp"
        self.assertEqual(self.beside(test), "store_tests CsvNumber.*:*/CsvNumber.*:CsvText.*:*/CsvText.*\n")
        self.assertEqual(self.beside("store/csv/csv_text.cpp", test), self.beside("store/csv/csv_text.cpp"))
        self.assertEqual(self.beside("cli/main.cpp", "docs/building.md", "README.md"), "")


if __name__ == "__main__":
    unittest.main()
