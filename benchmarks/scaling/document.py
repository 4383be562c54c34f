"""Writes the blocks of docs/scaling.md from docs/scaling_measurements.csv and the fitted model."""

import csv
import math
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "docs"))

import blocks  # noqa: E402

PATH = ROOT / "docs" / "scaling.md"
MEASUREMENTS = ROOT / "docs" / "scaling_measurements.csv"
MODEL = ROOT / "docs" / "scaling_model.csv"
CHECKS = ROOT / "docs" / "scaling_checks.csv"

PARTS = {"start_s": ("a process's start", "s"), "scene_s": ("scene: its file read", "s"),
         "hierarchies_s": ("scene: GL's buffers, Embree's hierarchies", "s"),
         "receivers_s": ("receivers", "s"), "truth_s": ("truth", "s"), "map_s": ("map", "s"),
         "lookup_s": ("lookup", "s"), "curve_s": ("curve, with its causes", "s"),
         "sweep_s": ("a whole sweep of one curve with 2,500 rows", "s"), "small_sweep_s": ("a small sweep: rows, database, CSV files", "s"),
         "merge_s": ("merge, with the CSV files", "s"), "memory_bytes": ("memory of a sweep", "B"),
         "database_bytes": ("database", "B"),
         "csv_bytes": ("CSV files", "B")}
EACH = {"once": "", "triangles": "a triangle", "pixels": "a pixel", "texels": "a texel", "rows": "a row", "cached database": "a byte of the database, of which at most 32 MiB are cached", "biases": "a bias of one curve", "curves": "a curve",
        "pixels log2(triangles)": "a pixel and log₂ of the triangles",
        "triangles log2(triangles)": "a triangle and log₂ of them"}
SCALES = {"s": ((1, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"), (1e-12, "ps")),
          "B": ((2**30, "GiB"), (2**20, "MiB"), (2**10, "KiB"), (1, "B"))}
HOUR_S = 3600
YEAR_H = 24 * 365

# The example: a scene of 100,000 triangles, images of 1280 × 720, maps of 2048².
TRIANGLES, PIXELS, TEXELS = 100_000, 1280 * 720, 2048**2
UNIT_CURVES = 200


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def model_of(rows):
    """Coefficients by quantity and term."""
    model = {}
    for row in rows:
        model.setdefault(row["quantity"], {})[row["term"]] = float(row["coefficient"])
    return model


def amount(value, unit):
    """Three digits with a prefix: 1.23 ms, 45.6 MiB."""
    factor, name = next(((factor, name) for factor, name in SCALES[unit] if abs(value) >= factor), SCALES[unit][-1])
    return f"{three_digits(value / factor)} {name}"


def three_digits(value):
    digits = 2 if abs(value) < 10 else 1 if abs(value) < 100 else 0
    return f"{value:,.{digits}f}"


def table(head, rows):
    return "\n".join([f"| {' | '.join(head)} |", f"|{'---|' * len(head)}", *(f"| {' | '.join(row)} |" for row in rows)])


def terms_text(terms, unit):
    return " + ".join(" ".join(filter(None, (amount(value, unit), EACH[term]))) for term, value in terms.items())


def worst_check(quantity, checks):
    own = [row for row in checks if row["quantity"] == quantity]
    if not own:
        return "–"
    found = max(own, key=lambda row: abs(deviation(row)))
    return f"{100 * deviation(found):+.0f} % ({int(float(found['size'])):,} {found['series']})"


def deviation(check):
    return float(check["predicted"]) / float(check["measured"]) - 1


def model_text(model, checks):
    return table(("part", "costs", "worst check, predicted against measured"),
                 [(label, terms_text(model[quantity], unit), worst_check(quantity, checks))
                  for quantity, (label, unit) in PARTS.items()])


def predict(model, quantity, **terms):
    return sum(value * terms.get(term, 0) for term, value in model[quantity].items())


def plan_costs(model, scenes, truths, maps, lookups, curves, rows):
    """Core seconds of each part of a sweep, by name, in units of UNIT_CURVES curves."""
    size = {"once": 1, "triangles": TRIANGLES, "pixels": PIXELS, "texels": TEXELS,
            "pixels log2(triangles)": PIXELS * math.log2(TRIANGLES),
            "triangles log2(triangles)": TRIANGLES * math.log2(TRIANGLES)}
    units = curves / UNIT_CURVES
    of_row = model["small_sweep_s"]["rows"]
    whole = model["sweep_s"]
    return {"start and scene": units * (predict(model, "start_s", **size) + whole["triangles"] * TRIANGLES),
            "truth and receivers": truths * (predict(model, "truth_s", **size) + predict(model, "receivers_s", **size)),
            "maps": maps * predict(model, "map_s", **size), "lookups": lookups * predict(model, "lookup_s", **size),
            "curves": curves * predict(model, "curve_s", **size), "rows": rows * of_row,
            "merge": curves * model["merge_s"].get("curves", 0) + rows * model["merge_s"]["rows"]}


def bytes_of(model, quantity, curves, rows):
    return model[quantity].get("curves", 0) * curves + model[quantity]["rows"] * rows


# 1,000 scenes, 10 lights, 2 cameras; 50 maps a light, or so many that each configuration has its own.
EXAMPLES = {"1,000 biases a curve": {"scenes": 1_000, "truths": 20_000, "maps": 500_000, "lookups": 10**6, "curves": 10**6, "rows": 10**9},
            "1 bias a curve": {"scenes": 1_000, "truths": 20_000, "maps": 5 * 10**8, "lookups": 10**9, "curves": 10**9, "rows": 10**9}}


def hours(seconds):
    value = seconds / HOUR_S
    return f"{value:,.0f} h" if value >= 10 else f"{value:.1f} h"


def example_text(model):
    costs = {name: plan_costs(model, **counts) for name, counts in EXAMPLES.items()}
    rows = [(part, *(hours(cost[part]) for cost in costs.values())) for part in next(iter(costs.values()))]
    rows.append(("**all, core hours**", *(f"**{hours(sum(cost.values()))}**" for cost in costs.values())))
    rows.append(("on 1,000 cores, but for the merge", *(hours((sum(cost.values()) - cost["merge"]) / 1000) for cost in costs.values())))
    for quantity in ("database_bytes", "csv_bytes"):
        rows.append((PARTS[quantity][0], *(f"{bytes_of(model, quantity, counts['curves'], counts['rows']) / 1e12:.2f} TB" for counts in EXAMPLES.values())))
    return table(("10⁹ configurations", *EXAMPLES), rows)


def block_texts():
    """The blocks of the document by name."""
    model, checks = model_of(read(MODEL)), read(CHECKS)
    return {"cost model": model_text(model, checks), "a thousand million": example_text(model)}


def write():
    blocks.write_blocks(PATH, block_texts())
