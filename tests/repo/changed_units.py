"""changed_units.py ROOT BUILD SINCE [--commands]: the compilation units of BUILD to check after the changes in ROOT since
the commit SINCE: each changed source, and for each changed header the nearest unit that includes it. All units, if the
checks changed. Prints regular expressions for run-clang-tidy, or with --commands shell commands that check the units."""

import collections
import json
import pathlib
import re
import shlex
import subprocess
import sys

CHECKS = {".clang-tidy", "CMakePresets.json", "GnomonCompileOptions.cmake"}


def git(root, *arguments):
    done = subprocess.run(["git", "-C", root, *arguments], check=True, capture_output=True, text=True)
    return [root / name for name in done.stdout.splitlines()]


def included_files(path, folders):
    """The files that a file includes in quotes."""
    for name in re.findall(r'^#include "([^"]+)"', path.read_text(errors="replace"), re.MULTILINE):
        for folder in (path.parent, *folders):
            if (found := folder / name).is_file():
                yield found.resolve()
                break


def include_folders(entries):
    """The project's include folders, in the order of their first use."""
    folders = {}
    for entry in entries:
        for folder in re.findall(r"-I(\S+)", entry["command"]):
            folders[pathlib.Path(entry["directory"], folder).resolve()] = None
    return list(folders)


def includers(files, folders):
    """By file, those that include it directly."""
    of = collections.defaultdict(list)
    for path in files:
        for found in included_files(path, folders):
            of[found].append(path)
    return of


def nearest_unit(path, units, of):
    """The unit that is the file or includes it in the fewest steps; a source of the header's name comes first."""
    own = path.with_suffix(".cpp")
    seen, queue = {path}, collections.deque([path, *([own] if own in of[path] else [])])
    while queue:
        here = queue.popleft()
        if here in units:
            return here
        fresh = [includer for includer in of[here] if includer not in seen]
        seen.update(fresh)
        queue.extend(fresh)
    return None


def checking_command(entry):
    """The shell command that compiles a unit without output."""
    words = shlex.split(entry["command"])
    del words[words.index("-o"):words.index("-o") + 2]
    return f"cd {shlex.quote(entry['directory'])} && {shlex.join([*words, '-fsyntax-only'])}"


def main():
    root, build = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    new = git(root, "ls-files", "--others", "--exclude-standard")
    changed = {*git(root, "diff", "--name-only", sys.argv[3]), *new}
    entries = json.loads((build / "compile_commands.json").read_text())
    units = {pathlib.Path(entry["directory"], entry["file"]).resolve(): entry for entry in entries}
    if any(path.name in CHECKS for path in changed):
        chosen = list(units)
    else:
        files = {path for path in (*git(root, "ls-files", "*.cpp", "*.hpp"), *new, *units) if path.is_file()}
        of = includers(sorted(files), include_folders(entries))
        nearest = [nearest_unit(path, units, of) for path in sorted(changed) if path.suffix in (".cpp", ".hpp")]
        chosen = dict.fromkeys(unit for unit in nearest if unit)
    for unit in chosen:
        if sys.argv[4:] == ["--commands"]:
            print(checking_command(units[unit]))
        else:
            print("^" + re.escape(units[unit]["file"]) + "$")


if __name__ == "__main__":
    main()
