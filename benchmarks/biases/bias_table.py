#!/usr/bin/python3
"""Compares the bias terms: prints the table of docs/methods/biases.md.

    benchmarks/biases/bias_table.py build/release/bin/gnomon [--mesh FILE.obj] [--scene NAME …]

Each term is combined with the recommended constant bias (docs/bias_curve.md) of 49, pooled over the 8 views of
`gnomon compare --views`. One sweep a scene gives all results.
"""

import argparse
import csv
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

SCENES = ("tilted-plane", "sphere-cube", "columns", "terrain")
VIEWS = 8
IMAGE = {"image.width": 320, "image.height": 180}
BIASES = [0.0] + [10 ** (-7 + 6 * i / 47) for i in range(48)]
FILTERS = ("nearest", "pcf5")


def terms(adaptive_m):
    """The variants of each term, with several sizes if it needs one."""
    return {
        "constant": [{}],
        "slope": [{"bias.slope_kernels": factor} for factor in (0.5, 1, 2)],
        "polygon offset": [{"bias.polygon_offset_factor": factor, "bias.polygon_offset_units": units}
                           for factor in (1, 2, 4) for units in (1, 16)],
        "bias and normal offset": [{"bias.normal_texels": texels} for texels in (0.5, 1, 2, 3)],
        "receiver plane": [{"bias.receiver_plane": "analytic"}],
        "receiver plane, derivatives": [{"bias.receiver_plane": "derivatives"}],
        "receiver plane, clamp 0.01": [{"bias.receiver_plane": "analytic", "bias.receiver_plane_clamp": 0.01}],
        "adaptive": [{"bias.adaptive_m": adaptive_m}],
    }


def toml(value):
    if isinstance(value, bool):
        return str(value).lower()
    return json.dumps(value)


def run(command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(str(part) for part in command)}: {done.stderr.strip()}")
    return done.stdout


def scene_arguments(scene):
    return ["--builtin", scene] if scene in SCENES else [scene, "--set", "scene.ground=true"]


def find_views(program, scene):
    """Cameras around the job's own, and the depth of the light's frustum [m]."""
    small = ["--set", "image.width=96", "--set", "image.height=54", "--set", "shadow_map.resolution=64"]
    told = json.loads(run([program, "compare", *scene_arguments(scene), *small, "--advise", "--views", VIEWS - 1, "--json"]))
    depth_m = told["frustum"]["far_m"] - told["frustum"]["near_m"]
    return [{f"camera.{key}": view[key] for key in ("eye", "target", "up")} for view in told["views"]], depth_m


def case_text(name, keys):
    lines = [f"{key} = {toml(value)}" for key, value in keys.items()]
    return "\n".join(["[[case]]", f"name = {toml(name)}", *lines, ""])


def sweep(program, scene, lookup, views, choices, folder):
    """Rows of the sweep, by case."""
    cases = [case_text(f"{term}/{choice}/{view}", {**keys, **pose})
             for term, variants in choices.items() for choice, keys in enumerate(variants)
             for view, pose in enumerate(views)]
    head = (f"[scene]\nbuiltin = {toml(scene)}\n" if scene in SCENES
            else f"[scene]\nfile = {toml(str(Path(scene).resolve()))}\nground = true\n")
    job = folder / "job.toml"
    job.write_text(head + f"[sweep]\n\"bias.constant\" = {BIASES}\n" + "".join(cases), encoding="utf-8")
    settings = {**IMAGE, "lookup.filter": lookup, "shadow_map.depth_format": "d32f"}
    sets = [text for key, value in settings.items() for text in ("--set", f"{key}={value}")]
    run([program, "sweep", job, *sets, "--no-keep-pixels", "--quiet", "--force", "--out", folder / "run"])
    by_case = {}
    with open(folder / "run" / "results.csv", encoding="utf-8") as rows:
        for row in csv.DictReader(rows):
            by_case.setdefault(row["case"], []).append(row)
    return by_case


def number(row, column):
    return float(row[column]) if row[column] else 0.0


def pooled(rows_of_views):
    """By bias: error without softening, shadow, light [px], worst gap [m], scored pixels."""
    at_biases = []
    for rows in zip(*rows_of_views):
        shadow = sum(number(row, "shadow_amount") - number(row, "shadow_softening") for row in rows)
        light = sum(number(row, "light_amount") - number(row, "light_softening") for row in rows)
        at_biases.append({
            "error": shadow + light, "shadow": shadow, "light": light,
            "gap": max(number(row, "peter_panning_gap_m.max") for row in rows),
            "lit": sum(number(row, "pixels.lit") for row in rows),
            "blocked": sum(number(row, "pixels.blocked") for row in rows)})
    return at_biases


def recommended(errors):
    """The index of the bias in the middle of the lowest broad valley (docs/bias_curve.md)."""
    least = min(errors)
    level = least + math.sqrt(least)
    for bound in sorted(error for error in errors if error >= least):
        if bound < level and bound != max(errors):
            continue
        first = None
        for i in range(len(errors) + 1):
            if i < len(errors) and errors[i] <= bound:
                first = i if first is None else first
            elif first is not None:
                if first == 0:
                    return 0
                if BIASES[i - 1] >= 1.5 * BIASES[first]:
                    is_unlimited = i == len(errors)
                    middle = 2 * BIASES[first] if is_unlimited else math.sqrt(BIASES[first] * BIASES[i - 1])
                    return min(range(first, i), key=lambda at: abs(math.log(BIASES[at] / middle)))
                first = None
    return errors.index(least)


def short_name(key):
    """The short name of a key in the table: "factor" for bias.polygon_offset_factor."""
    name = key.removeprefix("bias.")
    return name.removeprefix("polygon_offset_").removeprefix("receiver_plane_")


def table_of_scene(program, scene, filters):
    views, depth_m = find_views(program, scene)
    choices = terms(1e-4 * depth_m)
    for lookup in filters:
        with tempfile.TemporaryDirectory() as folder:
            by_case = sweep(program, scene, lookup, views, choices, Path(folder))
        for term, variants in choices.items():
            found = []
            for choice, keys in enumerate(variants):
                curve = pooled([by_case[f"{term}/{choice}/{view}"] for view in range(len(views))])
                at = recommended([point["error"] for point in curve])
                found.append((curve[at]["error"], BIASES[at], curve[at], keys))
            _, bias, point, keys = min(found, key=lambda one: one[0])
            setting = ", ".join(f"{short_name(key)} {value:.3g}" for key, value in keys.items()
                                if not isinstance(value, str)) or "–"
            print(f"| {Path(scene).stem} | {lookup} | {term} | {setting} | {bias:.2g} | {point['shadow']:.0f} | "
                  f"{point['light']:.0f} | {100 * point['error'] / (point['lit'] + point['blocked']):.3f} | "
                  f"{point['gap']:.3g} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path, help="gnomon")
    parser.add_argument("--scene", nargs="*", default=list(SCENES), help="built-in scenes")
    parser.add_argument("--mesh", nargs="*", default=[], help="scene files, each put on ground")
    parser.add_argument("--filter", nargs="*", default=list(FILTERS), help="values of lookup.filter")
    options = parser.parse_args()
    print("| scene | filter | term | its setting | constant | shadow [px] | light [px] | error [%] | worst gap [m] |")
    print("|---|---|---|---|---|---|---|---|---|")
    for scene in [*options.scene, *options.mesh]:
        table_of_scene(options.program, scene, options.filter)


if __name__ == "__main__":
    main()
