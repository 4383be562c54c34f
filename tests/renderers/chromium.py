"""How engines in a headless Chromium end, beside what all engines are held to."""
import os
import subprocess

from driven import EndsCleanly


class EndsWithChromium(EndsCleanly):
    """To be mixed into a TestCase."""

    def test_OfChromiumIsSaid(self):
        process = self.started()
        started = subprocess.run(["ps", "-o", "pid=", "--ppid", str(process.pid)], capture_output=True, text=True, check=True)
        os.kill(int(started.stdout.split()[0]), 9)
        self.assertEqual(process.wait(timeout=10), 1)
        self.assertRegex(process.stderr.read(), f"^{self.NAME}: Chromium")
        self.expect_nothing_left()

    def test_WithoutChromiumNamesTheRemedy(self):
        process = self.start(CHROMIUM="/nonexistent/chromium")
        self.assertEqual(process.wait(timeout=10), 1)
        self.assertIn("apt-get install chromium", process.stderr.read())

    def test_OfAnUnknownOptionNamesTheKnownOnes(self):
        result = subprocess.run([*self.COMMAND, "--rasterizer=none"], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=10, check=False)
        self.assertEqual(result.returncode, 1)
        self.assertIn("--rasterizer=system|swiftshader", result.stderr)
