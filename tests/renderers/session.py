"""Drives a renderer by docs/renderer_protocol.md, and evaluates its frames with `gnomon evaluate`."""
import json
import os
import pathlib
import subprocess
import tomllib

GNOMON = os.environ["GNOMON"]


def run_gnomon(*arguments):
    return subprocess.run([GNOMON, *map(str, arguments)], capture_output=True, text=True, check=False)


def export_case(folder, scene, **settings):
    """Exports the case of a built-in scene that GL drew. Returns its description and the comparison's JSON."""
    choices = [f"--set={key.replace('__', '.')}={json.dumps(value)}" for key, value in settings.items()]
    result = run_gnomon("compare", "--builtin", scene, *choices, "--export-case", folder, "--json")
    if result.returncode != 0:
        raise AssertionError(result.stderr)
    return tomllib.loads((folder / "case.toml").read_text()), json.loads(result.stdout)


def toml(value):
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value)


def light_of(description):
    """The light of a request. A directional light has its direction alone."""
    light = dict(description["light"])
    if light["type"] == "directional" and "position" in light:
        light["direction"] = [t - p for t, p in zip(light.pop("target"), light.pop("position"))]
    return light


class Session:
    """A started renderer. The end of a `with` block closes it and checks that it ends."""

    def __init__(self, command):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.number = 0
        self.hello = self.ask(hello=1)

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if kind is None:
            self.process.stdin.write(json.dumps({"id": self.number + 1, "close": True}) + "\n")
        self.process.stdin.close()
        status = self.process.wait(timeout=30)
        if kind is None and (status != 0 or self.process.stdout.read()):
            raise AssertionError(f"the renderer ended with status {status}, or wrote more lines")
        self.process.stdout.close()

    def ask(self, **request):
        self.number += 1
        self.process.stdin.write(json.dumps({"id": self.number, **request}) + "\n")
        self.process.stdin.flush()
        answer = json.loads(self.process.stdout.readline())
        if answer.pop("id") != self.number:
            raise AssertionError("the answer belongs to another request")
        return answer

    def open(self, mesh, description, width, height, **objects):
        return self.ask(open={"mesh": {"file": str(mesh), "no_cast": [], "no_receive": [], **objects},
                              "camera": description["camera"], "light": light_of(description),
                              "image": {"width": width, "height": height}})

    def draw(self, folder, shadow_map, engine=None, **tables):
        """The answer to a draw request. Other keys of the engine have their defaults."""
        folder.mkdir(exist_ok=True)
        keys = {key["name"]: key["default"] for key in self.hello["keys"]}
        return self.ask(draw={"shadow_map": shadow_map, "lookup": {}, "bias": {}, **tables,
                              "engine": {**keys, **(engine or {})}}, frame=str(folder / "frame.exr"))


def judge(folder, mesh, description, answer, *options, **objects):
    """Evaluates a frame with `gnomon evaluate`: its JSON, or with options its exit status."""
    tables = {"files": answer.get("files", {}), "mesh": {"file": str(mesh), **objects}, "camera": description["camera"],
              "light": light_of(description), **answer.get("case", {})}
    lines = ["schema = 1", 'renderer = "a renderer under test"']
    if (folder / "frame.exr").exists():
        lines.append('image = "frame.exr"')
    for name, table in tables.items():
        lines.append(f"[{name}]")
        lines += [f"{key} = {toml(value)}" for key, value in table.items()]
    (folder / "case.toml").write_text("\n".join(lines) + "\n")
    result = run_gnomon("evaluate", folder, *(options or ["--json"]))
    if options:
        return result.returncode
    if result.returncode != 0:
        raise AssertionError(result.stderr)
    return json.loads(result.stdout)


def here(*names):
    """A path of the checkout."""
    return pathlib.Path(__file__).resolve().parents[2].joinpath(*names)
