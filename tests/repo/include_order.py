#!/usr/bin/env python3
"""include_order.py CHECKOUT: checks what each source includes.

- A layer includes only the layers that MAY_INCLUDE names, by "LAYER/…" in quotes.
- Only raster_gl calls GL, and only reference_rt calls Embree.
- The certificate shares no code with what it certifies.
- No units (a .cpp with its .hpp) include each other in a circle.
- The subjects of ORDER include only themselves and those before them. A command's own folder in `cli` includes the
  folders that commands share, and no other command's.
- A header has #pragma once and no using namespace.

Exit status: 0 all is in order; 1 it is not, and a line names each place.
"""

import re
import sys
from pathlib import Path

# By layer, the others that it may include.
MAY_INCLUDE = {
    "scene": [],
    "methods": ["scene"],
    "renderers": ["methods", "scene"],
    "raster_gl": ["renderers", "methods", "scene"],
    "reference_rt": ["renderers", "scene"],
    "analysis": ["renderers", "methods", "scene"],
    "store": ["analysis", "renderers", "methods", "scene"],
    "reports": ["store", "analysis", "renderers", "methods", "scene"],
    "api": ["reports", "store", "analysis", "reference_rt", "raster_gl", "renderers", "methods", "scene"],
}
LAYERS = [*MAY_INCLUDE, "cli", "python"]
MAY_INCLUDE["cli"] = MAY_INCLUDE["python"] = list(MAY_INCLUDE)

# Libraries of one layer alone.
OWN_LIBRARIES = {"raster_gl": r"epoxy/|EGL/|GL/|GLES", "reference_rt": r"embree\d/"}

CERTIFICATE = "reference_rt/certificate/"

# A subject may include itself and those before it in this list.
ORDER = {
    "scene": ["geometry", "camera", "light", "depth", "pixels", "settings", "import", "builtin", "job", "view", "load",
              "case"],
    "analysis": ["pixels", "depth", "lookup", "bias", "causes", "limits", "metrics", "recommendation", "results", "rays",
                 "diagnosis", "comparison", "evaluate", "presets", "gate", "sweep", "advice", "tune"],
    "cli": ["system", "options", "figures", "renderer", "runs", "units"],
}


def includes(root):
    """{file: [(header, has quotes), …]} of all sources, as paths from the checkout's root."""
    found = {}
    for layer in LAYERS:
        for source in sorted((root / layer).rglob("*.?pp")):
            text = source.read_text(encoding="utf-8")
            headers = re.findall(r'^[ \t]*#[ \t]*include[ \t]*(["<])([^">]+)', text, re.M)
            found[source.relative_to(root).as_posix()] = [(header, mark == '"') for mark, header in headers]
    return found


def check_include(file, header, has_quotes):
    """Why a file may not include a header, as far as the layers decide; None if it may."""
    layer, target = file.split("/")[0], header.split("/")[0]
    if not has_quotes:
        if target in LAYERS:
            return f"own headers are included with quotes, not as <{header}>"
        owners = [owner for owner, libraries in OWN_LIBRARIES.items() if re.match(libraries, header)]
        return f"only {owners[0]} may include <{header}>" if owners and owners != [layer] else None
    if target not in LAYERS:
        return f'"{header}" does not start with a layer\'s folder'
    if target != layer and target not in MAY_INCLUDE[layer]:
        return f'{layer} may not include {target} ("{header}")'
    if layer == target == "reference_rt" and file.startswith(CERTIFICATE) != header.startswith(CERTIFICATE):
        return f"the certificate and the rest of reference_rt may not include each other ({header})"
    return None


def check_layers(files):
    problems = [(file, check_include(file, *include)) for file, found in files.items() for include in found]
    return [f"{file}: {problem}" for file, problem in problems if problem]


def check_headers(root):
    problems = []
    for folder in (*LAYERS, "tests", "benchmarks", "examples"):
        for header in sorted((root / folder).rglob("*.hpp")):
            text = header.read_text(encoding="utf-8")
            for rule, is_broken in (("a header has #pragma once", not re.search(r"^#pragma once$", text, re.M)),
                                    ("a header has no using namespace",
                                     re.search(r"^[ \t]*using[ \t]+namespace", text, re.M))):
                if is_broken:
                    problems.append(f"{header.relative_to(root)}: {rule}")
    return problems


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


def own_headers(headers):
    return [header for header, has_quotes in headers if has_quotes]


def check_circles(files):
    graph = {}
    for file, headers in files.items():
        unit = file[: -len(".cpp")]
        others = {header[: -len(".hpp")] for header in own_headers(headers)} - {unit}
        graph.setdefault(unit, set()).update(others)
    return [f"these include each other in a circle: {', '.join(members)}" for members in circles(graph)]


def allowed_subjects(layer, subject):
    """The subjects of its layer that one may include; empty for files in the layer's own folder, which all may include."""
    order = ORDER[layer]
    if subject in order:
        return order[: order.index(subject) + 1]
    return [*order, subject] if layer == "cli" else []


def subject_of(layer, file):
    """The folder below the layer's; empty for a file in the layer's own."""
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
        for header in own_headers(headers):
            other = subject_of(layer, header) if header.startswith(layer + "/") else ""
            if other and other not in allowed:
                may = ", ".join(allowed) or "no subject"
                problems.append(f"{file}: {subject or layer} may include {may} of {layer}, not {header}")
    return problems


def main():
    sys.setrecursionlimit(10_000)
    root = Path(sys.argv[1])
    files = includes(root)
    if not any(file.startswith(CERTIFICATE) for file in files):
        sys.exit(f"include_order: {root / CERTIFICATE}: no sources found; is it the checkout?")
    problems = check_layers(files) + check_headers(root) + check_circles(files) + check_subjects(files)
    for problem in problems:
        print(f"include_order: {problem}", file=sys.stderr)
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
