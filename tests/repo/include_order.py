#!/usr/bin/env python3
"""The order inside the layers: include_order.py CHECKOUT.

A unit is a .cpp with its .hpp. No units may include each other in a circle, in the whole house. The subjects of `scene`
and `analysis` are in an order: each includes only itself and those before it. So are the folders that the commands of
`cli` share; a command's own folder includes these, and no other command's.

Exit status: 0 all is in order; 1 it is not, and a line says each place.
"""

import re
import sys
from pathlib import Path

LAYERS = ["scene", "methods", "renderers", "raster_gl", "reference_rt", "analysis", "store", "reports", "api", "cli",
          "python"]

# A subject may include itself and those before it in this list.
ORDER = {
    "scene": ["geometry", "camera", "light", "depth", "pixels", "settings", "import", "builtin", "job", "view", "load",
              "case"],
    "analysis": ["pixels", "depth", "lookup", "bias", "causes", "limits", "metrics", "recommendation", "results", "rays",
                 "diagnosis", "comparison", "evaluate", "presets", "gate", "sweep", "advice", "tune"],
    "cli": ["system", "options", "session", "figures", "renderer", "runs", "units"],
}


def includes(root):
    """{file: [header, …]} of all sources, as paths from the checkout's root."""
    found = {}
    for layer in LAYERS:
        for source in sorted((root / layer).rglob("*.?pp")):
            text = source.read_text(encoding="utf-8")
            found[source.relative_to(root).as_posix()] = re.findall(r'^[ \t]*#[ \t]*include "([^"]+)"', text, re.M)
    return found


def circles(graph):
    """The sets of units that reach each other, each sorted (Tarjan's algorithm)."""
    index, low, stack, found = {}, {}, [], []

    def visit(unit):
        index[unit] = low[unit] = len(index)
        stack.append(unit)
        for other in graph.get(unit, ()):
            if other not in index:
                visit(other)
                low[unit] = min(low[unit], low[other])
            elif other in stack:
                low[unit] = min(low[unit], index[other])
        if low[unit] == index[unit]:
            members = []
            while not members or members[-1] != unit:
                members.append(stack.pop())
            if len(members) > 1:
                found.append(sorted(members))

    for unit in graph:
        if unit not in index:
            visit(unit)
    return found


def check_circles(files):
    graph = {}
    for file, headers in files.items():
        unit = file[: -len(".cpp")]
        others = {header[: -len(".hpp")] for header in headers} - {unit}
        graph.setdefault(unit, set()).update(others)
    return [f"these include each other in a circle: {', '.join(members)}" for members in circles(graph)]


def allowed_subjects(layer, subject):
    """The subjects of its layer that one may include; empty for files in the layer's own folder, which all may include."""
    order = ORDER[layer]
    if subject in order:
        return order[: order.index(subject) + 1]
    return [*order, subject] if layer == "cli" else []


def subject_of(layer, file):
    """The folder below the layer's; empty: the file is in the layer's own."""
    folder, _, rest = file.removeprefix(layer + "/").partition("/")
    return folder if rest else ""


def check_subjects(files):
    problems = []
    for file, headers in files.items():
        layer = file.split("/")[0]
        if layer not in ORDER or file == "cli/main.cpp":
            continue
        subject = subject_of(layer, file)
        allowed = allowed_subjects(layer, subject)
        for header in headers:
            other = subject_of(layer, header) if header.startswith(layer + "/") else ""
            if other and other not in allowed:
                may = ", ".join(allowed) or "no subject"
                problems.append(f"{file}: {subject or layer} may include {may} of {layer}, not {header}")
    return problems


def main():
    sys.setrecursionlimit(10_000)
    files = includes(Path(sys.argv[1]))
    if not files:
        sys.exit(f"include_order: {sys.argv[1]}: no sources found; is it the checkout?")
    problems = check_circles(files) + check_subjects(files)
    for problem in problems:
        print(f"include_order: {problem}", file=sys.stderr)
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
