#!/usr/bin/env python3
"""The order inside the layers: include_order.py CHECKOUT.

A unit is a .cpp with its .hpp. No units may include each other in a circle, in the whole house. Of the subjects of
`analysis` the lower ones, in the order below, know none of those above them: what may be read by itself comes first. Of
`cli` the shared ones are in such an order, too, and a command's folder includes them and no other command's.

Exit status: 0 all is in order; 1 it is not, and a line says each place.
"""

import re
import sys
from pathlib import Path

LAYERS = ["scene", "methods", "raster_gl", "reference_rt", "analysis", "store", "reports", "cli"]

# A subject may include itself and those before it in this list.
ORDER = {
    "analysis": ["pixels", "depth", "lookup", "bias", "causes", "limits", "metrics", "recommendation", "results"],
    "cli": ["system", "options", "session", "figures", "renderer", "runs", "units"],
}
# Headers of the layer's own folder that every subject may include.
GROUND = {"analysis/renderers.hpp", "cli/commands.hpp", "cli/exit_codes.hpp"}


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
    """The subjects of its layer that one may include; None: all."""
    order = ORDER[layer]
    if subject in order:
        return order[: order.index(subject) + 1]
    return [*order, subject] if layer == "cli" else None


def check_subjects(files):
    problems = []
    for file, headers in files.items():
        layer, subject = file.split("/")[:2]
        if layer not in ORDER or subject.endswith((".cpp", ".hpp")):
            continue
        allowed = allowed_subjects(layer, subject)
        for header in headers:
            is_own = header.startswith(layer + "/") and header not in GROUND
            if is_own and allowed is not None and header.split("/")[1] not in allowed:
                problems.append(f"{file}: {subject} may include {', '.join(allowed)} of {layer}, not {header}")
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
