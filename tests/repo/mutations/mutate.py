"""Inserts defects one at a time, and reports those that no test notices.

    python3 tests/repo/mutations/mutate.py [NAME…]
    python3 tests/repo/mutations/mutate.py --check    only check that each text occurs once

Works in this checkout, which must have no uncommitted changes, with its release build. First all tests must pass.
For each mutation of mutations.toml it replaces the text, runs the tests of the layer, then if they pass all of
`./dev test`, up to the first failure, and restores the text. build/mutations.json records the results, so that the
same command resumes; remove the file to start over.
Exits with 1 if a mutation survived.
"""

import json
import pathlib
import subprocess
import sys
import time
import tomllib

here = pathlib.Path(__file__).resolve().parent
root = here.parents[2]
record_file = root / "build" / "mutations.json"


def fail(text):
    sys.exit(f"mutate: {text}")


def tests_pass(arguments):
    """Whether everything builds and passes, and the first failure's line."""
    # The check of the mutations' texts would notice every mutation.
    done = subprocess.run(["./dev", "test", "--", "--stop-on-failure", "-E", "^mutations_fit_the_code$", *arguments],
                          cwd=root, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    (root / "build" / "mutation.log").write_text(done.stdout)
    if done.returncode == 0:
        return True, ""
    # These failures are not the tests'.
    if "no entry matches" in done.stdout:
        fail(f"no test is called {arguments[-1]}")
    if "ninja: build stopped" in done.stdout:
        fail("it does not build; build/mutation.log says why")
    for line in done.stdout.splitlines():
        if line.startswith("[  FAILED  ]") or "***Failed" in line or "***Timeout" in line:
            return False, line.strip()[:160]
    return False, f"./dev test ended with {done.returncode}"


def check(mutation):
    text = (root / mutation["file"]).read_text()
    if (count := text.count(mutation["old"])) != 1:
        fail(f"mutations.toml: {mutation['name']}: {mutation['file']} has its text {count} times instead of once")


def judged(mutation):
    """Whether the tests of the layer, all tests or none noticed the mutation, and the failure."""
    path = root / mutation["file"]
    text = path.read_text()
    try:
        path.write_text(text.replace(mutation["old"], mutation["new"]))
        for stage, arguments in [("layer", ["-R", mutation["tests"]]), ("all", [])]:
            passed, failure = tests_pass(arguments)
            if not passed:
                return {"noticed_by": stage, "failure": failure}
        return {"noticed_by": None, "failure": ""}
    finally:
        path.write_text(text)


def main():
    mutations = tomllib.loads((here / "mutations.toml").read_text())["mutation"]
    for mutation in mutations:
        check(mutation)
    if sys.argv[1:] == ["--check"]:
        return
    if unknown := set(sys.argv[1:]) - {mutation["name"] for mutation in mutations}:
        fail(f"mutations.toml has no {', '.join(sorted(unknown))}")
    if subprocess.run(["git", "diff", "--quiet", "HEAD"], cwd=root).returncode != 0:
        fail("the checkout has uncommitted changes; commit them, or git restore the file that a killed run changed")
    record = json.loads(record_file.read_text()) if record_file.exists() else {}
    if "unchanged" not in record:
        print("unchanged …", file=sys.stderr, flush=True)
        passed, failure = tests_pass([])
        if not passed:
            fail(f"the tests fail without a mutation: {failure}")
        record["unchanged"] = {"noticed_by": None, "failure": ""}
        record_file.write_text(json.dumps(record, indent=1) + "\n")
    for mutation in mutations:
        name = mutation["name"]
        if name in record or sys.argv[1:] and name not in sys.argv[1:]:
            continue
        begin = time.monotonic()
        print(f"{name} …", file=sys.stderr, flush=True)
        record[name] = judged(mutation) | {"seconds": round(time.monotonic() - begin)}
        record_file.write_text(json.dumps(record, indent=1) + "\n")
    survivors = 0
    for mutation in mutations:
        if result := record.get(mutation["name"]):
            survivors += result["noticed_by"] is None
            print(f"{result['noticed_by'] or 'SURVIVED':8}  {result['seconds']:4} s  {mutation['name']:40}  "
                  f"{result['failure']}")
    print(f"{len(record) - 1} of {len(mutations)} mutations tried, {survivors} survived")
    sys.exit(1 if survivors else 0)


if __name__ == "__main__":
    main()
