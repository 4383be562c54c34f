"""Shadow errors by distance from the light, laid over the depth error of the map they come from."""

import numpy

import distance_panels
import style
import tables as csv_tables

TEXTS = ("curve", "at")
COUNTS = ("lit", "blocked", "false_shadow", "false_lit")
MAP_ERRORS = ("map_error_m.min", "map_error_m.median", "map_error_m.p95", "map_error_m.max")
BINS = ("bias", "lower_m", "upper_m", *COUNTS, *MAP_ERRORS, "envelope_m")
SETTING_TEXTS = ("curve", "scene.builtin", "scene.file", "shadow_map.depth_format",
                 "lookup.filter")
SETTINGS = ("shadow_map.resolution", "map_near_m", "map_far_m")

# Neighbouring bins are united until they have as many pixels, so that one pixel moves a rate by
# a tenth of a percent (lit) or half a percent (blocked) at most.
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
        raise csv_tables.InputError(f"{paths[1]}: not of the same run as {paths[0]}")
    return [bins, results]


def data(tables):
    """One series for each curve of the run at the job's bias: its settings, the map's depth errors
    in the run's bins [m], and rates in united bins (NaN without a pixel to divide by).
    """
    bins, results = tables
    at_job_bias = bins[bins["at"] == "job_bias"]
    settings = results.drop_duplicates("curve").set_index("curve")
    return [
        _series(block.reset_index(drop=True), settings.loc[curve])
        for curve, block in at_job_bias.groupby("curve", sort=False)
    ]


def _series(block, settings):
    united = _unite(block)
    edges = numpy.append(united["lower_m"], united["upper_m"].iloc[-1])
    with numpy.errstate(invalid="ignore", divide="ignore"):
        false_shadow_rate = (united["false_shadow"] / united["lit"]).to_numpy()
        false_lit_rate = (united["false_lit"] / united["blocked"]).to_numpy()
    return {
        "name": settings["shadow_map.depth_format"],
        "settings": settings,
        "bias": block["bias"].iloc[0],
        "zeta": (0.5 * (block["lower_m"] + block["upper_m"])).to_numpy(),
        "upper": block["upper_m"].to_numpy(),
        "envelope": block["envelope_m"].to_numpy(),
        **{name.split(".")[1]: block[name].to_numpy() for name in MAP_ERRORS},
        "edges": edges,
        "false_shadow_rate": false_shadow_rate,
        "false_lit_rate": false_lit_rate,
    }


def _unite(block):
    """Sums over neighbouring bins; the last ones, if too few pixels, join those before."""
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
    """A column a curve: rates above, the map's depth error below, on one axis of distance."""
    curves = data(tables)
    figure = style.TitledFigure(_title(curves), _settings(curves), 6.2)
    grid = style.lay_out(figure, top_in=1.35, nrows=2, ncols=len(curves), hspace=0.12,
                         wspace=0.26, height_ratios=(1, 1.2))
    shared = None
    for column, curve in enumerate(curves):
        rates = figure.add_subplot(grid[0, column], sharey=shared)
        shared = shared or rates
        distance_panels.draw_rates(rates, curve["edges"], curve["false_shadow_rate"],
                                   curve["false_lit_rate"])
        rates.set_title(curve["name"])
        rates.tick_params(labelbottom=False)
        distance_panels.draw_map_errors(figure.add_subplot(grid[1, column], sharex=rates), curve)
    style.set_rate_scale(shared)
    style.add_legend(figure, ncol=3)
    return figure


def _title(curves):
    settings = curves[0]["settings"]
    scene = settings[["scene.builtin", "scene.file"]].dropna().iloc[0]
    return f"Shadow errors over the map's depth error: {scene}"


def _settings(curves):
    settings = curves[0]["settings"]
    bias = f"{curves[0]['bias']:g}".replace("e-0", "e-")
    return (
        f"near {settings['map_near_m']:g} m, far {settings['map_far_m']:g} m;"
        f" {settings['shadow_map.resolution']:g}² map, filter {settings['lookup.filter']};"
        f" constant bias {bias} depth units"
    )
