"""changed_units.py ROOT BUILD SINCE: the units of BUILD's compilation database that read a file of the checkout
ROOT which changed after the commit SINCE, as regular expressions for run-clang-tidy, a line each; all of them
where the checks themselves changed."""

import json
import pathlib
import re
import shlex
import subprocess
import sys


def changed_files(root, since):
    """Paths of what differs from the commit, committed or not, and of files that git does not know yet."""
    differing = subprocess.run(["git", "-C", root, "diff", "--name-only", since], check=True,
                               capture_output=True, text=True).stdout.splitlines()
    new = subprocess.run(["git", "-C", root, "ls-files", "--others", "--exclude-standard"], check=True,
                         capture_output=True, text=True).stdout.splitlines()
    return {root / name for name in differing + new}


def read_files(entry):
    """The files of this checkout, and generated ones, that the compiler reads for a unit."""
    command = shlex.split(entry["command"])
    del command[command.index("-o"):command.index("-o") + 2]
    rule = subprocess.run([*command, "-MM", "-MT", "unit"], cwd=entry["directory"], check=True,
                          capture_output=True, text=True).stdout
    names = re.split(r"(?<!\\)\s+", rule.removeprefix("unit:").replace("\\\n", " ").strip())
    names = [name.replace("\\ ", " ") for name in names]
    return {pathlib.Path(entry["directory"], name).resolve() for name in names}


def main():
    root, build = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    since = sys.argv[3]
    changed = changed_files(root, since)
    entries = json.loads((build / "compile_commands.json").read_text())
    checks = {".clang-tidy", "CMakePresets.json", "GnomonCompileOptions.cmake"}
    checks_changed = any(path.name in checks for path in changed)
    for entry in entries:
        if checks_changed or changed & read_files(entry):
            print("^" + re.escape(entry["file"]) + "$")


if __name__ == "__main__":
    main()
