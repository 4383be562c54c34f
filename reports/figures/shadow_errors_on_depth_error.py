"""Shadow errors by distance from the light, above the depth error of their map."""

import numpy

import distance_panels
import gnomon
import run_settings
import style
import tables as csv_tables

TEXTS = ("curve", "at")
COUNTS = ("lit", "blocked", "false_shadow", "false_lit")
MAP_ERRORS = ("map_error_m.min", "map_error_m.median", "map_error_m.p95", "map_error_m.max")
BINS = ("bias", "lower_m", "upper_m", *COUNTS, *MAP_ERRORS, "envelope_m")
SETTING_TEXTS = ("curve", "scene.builtin", "scene.file", "shadow_map.depth_format",
                 "lookup.filter")
SETTINGS = ("shadow_map.resolution", "map_near_m", "map_far_m")

# Neighbouring bins are merged until they have this many pixels, so that one pixel changes a rate
# by at most 0.1 % (lit) or 0.5 % (blocked).
LEAST_LIT = 1000
LEAST_BLOCKED = 200


def read(paths):
    """error_vs_z.csv and results.csv of one run, in this order."""
    if len(paths) != 2:
        raise csv_tables.InputError(
            f"{len(paths)} files given; error_vs_z.csv and results.csv of one run are needed"
        )
    bins = csv_tables.read_table(paths[0], BINS, TEXTS)
    results = csv_tables.read_table(paths[1], SETTINGS, SETTING_TEXTS)
    if not set(bins["curve"]) <= set(results["curve"]):
        raise csv_tables.InputError(f"{paths[1]}: from another run than {paths[0]}")
    if bins["envelope_m"].isna().all():
        raise csv_tables.InputError(f"{paths[0]}: no depth errors by distance")
    return [bins, results]


def data(tables):
    """One series per curve, or only the best of many: the map's depth errors in the run's bins [m],
    and rates in merged bins (NaN without pixels).

    Rates are at the job's bias, or at the best bias if no configuration has the job's.
    """
    rows, chosen, _ = _chosen(tables)
    titles = run_settings.panel_titles(_run(tables), rows, chosen)
    return [_series(_block(tables[0], rows, curve), title)
            for curve, title in zip(chosen["curve"], titles)]


def _run(tables):
    return gnomon.Run("", tables[1])


def _chosen(tables):
    """The rows with bins, one row for each curve to draw, and the reason for the choice."""
    bins, results = tables
    has_map_errors = bins.dropna(subset=["envelope_m"])["curve"]
    rows = results[results["curve"].isin(has_map_errors)].reset_index(drop=True)
    return rows, *run_settings.curves_of(None, rows)


def _block(bins, rows, curve):
    of_curve = bins[bins["curve"] == curve]
    blocks = {at: block for at, block in of_curve.groupby("at")}
    job = blocks.get("job_bias")
    is_of_job = job is not None and run_settings.has_bias(rows, curve, job["bias"].iloc[0])
    block = job if is_of_job or "best_bias" not in blocks else blocks["best_bias"]
    return block[block["bias"] == block["bias"].iloc[0]].reset_index(drop=True)


def _series(block, name):
    united = _unite(block)
    edges = numpy.append(united["lower_m"], united["upper_m"].iloc[-1])
    with numpy.errstate(invalid="ignore", divide="ignore"):
        false_shadow_rate = (united["false_shadow"] / united["lit"]).to_numpy()
        false_lit_rate = (united["false_lit"] / united["blocked"]).to_numpy()
    return {
        "name": name,
        "at": block["at"].iloc[0],
        "bias": block["bias"].iloc[0],
        "light_distance_m": (0.5 * (block["lower_m"] + block["upper_m"])).to_numpy(),
        "upper": block["upper_m"].to_numpy(),
        "envelope": block["envelope_m"].to_numpy(),
        **{name.split(".")[1]: block[name].to_numpy() for name in MAP_ERRORS},
        "edges": edges,
        "false_shadow_rate": false_shadow_rate,
        "false_lit_rate": false_lit_rate,
    }


def _unite(block):
    """Sums over neighbouring bins; if the last ones have too few pixels, they join the previous."""
    groups = []
    group, lit, blocked = 0, 0, 0
    for row_lit, row_blocked in zip(block["lit"], block["blocked"]):
        if lit >= LEAST_LIT and blocked >= LEAST_BLOCKED:
            group, lit, blocked = group + 1, 0, 0
        groups.append(group)
        lit += row_lit
        blocked += row_blocked
    if group > 0 and (lit < LEAST_LIT or blocked < LEAST_BLOCKED):
        groups = [min(one, group - 1) for one in groups]
    ways = {"lower_m": "first", "upper_m": "last", **dict.fromkeys(COUNTS, "sum")}
    return block.groupby(groups).agg(ways)


def draw(tables):
    """One column per curve: rates above, the map's depth error below, on one axis of distance."""
    curves = data(tables)
    figure = style.TitledFigure(_title(tables), _settings(tables, curves), 6.2)
    titles = style.panel_titles([curve["name"] for curve in curves], len(curves))
    grid = style.lay_out(figure, top_in=1.25 + style.title_height(titles), nrows=2,
                         ncols=len(curves), hspace=0.12, wspace=0.42, height_ratios=(1, 1.2))
    shared = None
    for column, (curve, title) in enumerate(zip(curves, titles)):
        rates = figure.add_subplot(grid[0, column], sharey=shared)
        shared = shared or rates
        distance_panels.draw_rates(rates, curve["edges"], curve["false_shadow_rate"],
                                   curve["false_lit_rate"])
        rates.set_title(title)
        rates.tick_params(labelbottom=False)
        errors = figure.add_subplot(grid[1, column], sharex=rates)
        distance_panels.draw_map_errors(errors, curve)
        style.label_columns(errors, column, len(curves), style.LIGHT_DISTANCE_LABEL)
    shared.set_ylabel(distance_panels.RATES_LABEL)
    style.set_rate_scale(shared)
    style.add_legend(figure, ncol=3)
    return figure


def _title(tables):
    scene = tables[1][["scene.builtin", "scene.file"]].bfill(axis=1).iloc[0, 0]
    return f"Shadow errors over the map's depth error: {run_settings.text_of(scene)}"


def _settings(tables, curves):
    _, chosen, why = _chosen(tables)
    shared = run_settings.settings_text(chosen.drop(columns=list(run_settings.CONSTANT_BIASES)))
    biases = [run_settings.biases_text(
        name, [curve["bias"] for curve in curves if curve["at"] == at])
        for at, name in run_settings.BIASES.items()]
    return "; ".join(filter(None, (shared, *biases, why)))
