"""The rows of docs/league.csv: one for each engine, scene and setting."""

import csv
import json

import checks
from engine_run import SETTINGS

# Name and type: text, number, whole or truth.
COLUMNS = {
    "engine": "text", "title": "text", "version": "text", "device": "text", "machine": "text", "scene": "text", "light": "text",
    "setting": "text", "status": "text", "message": "text", "settings_said": "text", "engine_settings": "text", "map_size": "whole",
    "lit": "whole", "blocked": "whole", "false_shadow": "whole", "false_lit": "whole", "false_shadow_rate": "number",
    "false_lit_rate": "number", "error_rate": "number", "shadow_amount": "number", "light_amount": "number", "mean_abs_error": "number",
    "peter_panning_gap_m": "number", "false_lit_gap_m": "number", "frame_seconds": "number", "surprising": "truth",
    **{f"check_{name}": "text" for name in checks.CHECKS}, "trust": "text", "second_rasterizer": "text",
    "second_false_shadow_rate": "number", "second_false_lit_rate": "number", "second_mean_abs_error": "number", "again": "text",
    "search_drawn": "whole", "search_error_before": "number", "search_error_after": "number", "single_key": "text", "single_value": "text",
    "single_error": "number", "documented_source": "text", "limit_mask": "text", "limit_read_back": "text", "limit_anti_aliasing": "text",
    "limit_depths": "text", "limit_map_size": "text", "took_s": "number", "command": "text",
}
KEY = ("engine", "scene", "setting")


def is_trusted(row):
    """Whether a row was measured, and no check found a mistake of the adapter."""
    return row["status"] == "done" and not row["trust"].startswith("not trusted")


def absent(engine, message):
    """The row of an engine that was not measured, with the reason."""
    return {**dict.fromkeys(COLUMNS), "engine": engine.name, "title": engine.title, "status": "absent", "message": message}


def _numbers(result):
    pixels, evaluate = result["pixels"], result["evaluate"]
    row = {key: result[key] for key in ("false_shadow", "false_lit", "false_shadow_rate", "false_lit_rate", "error_rate",
                                        "shadow_amount", "light_amount", "mean_abs_error")}
    settings = {key.removeprefix("engine."): value for key, value in result["job"].items() if key.startswith("engine.")}
    return {**row, "lit": pixels["lit"], "blocked": pixels["blocked"], "engine_settings": json.dumps(settings),
            "map_size": result["job"].get("shadow_map.resolution"), "frame_seconds": evaluate.get("frame_seconds"),
            "peter_panning_gap_m": result["peter_panning_gap_m"]["median"],
            "false_lit_gap_m": (evaluate["false_lit_gap_m"] or {}).get("median")}


def _search(tune):
    """The result of the search, and its best setting that differs from the defaults in one key."""
    said = tune["json"]

    def error(setting):
        return setting["shadow_amount"] + setting["light_amount"]

    own = said["own"]
    row = {"search_drawn": len(said["tried"]), "search_error_before": error(own), "search_error_after": error(said["recommended"])}
    single = []
    for setting in said["tried"]:
        changed = [key for key, value in setting["engine"].items() if value != own["engine"][key]]
        if "message" not in setting and len(changed) == 1:
            single.append((error(setting), changed[0], setting["engine"][changed[0]]))
    if single:
        least, key, value = min(single, key=lambda one: one[0])
        row.update(single_key=key, single_value=json.dumps(value), single_error=least)
    return row


def _checked(results, shape, setting, engine):
    outcome, second, pictured = results.rows[setting], results.second.get(setting), results.pictured.get(setting)
    found = {"positions": checks.positions(outcome), "same_view": checks.same_view(outcome, results.own),
             "shadows_off": checks.shadows_off(results.trials.get("shadows_off")),
             "no_caster": checks.no_caster(results.trials.get("no_caster")), "known_shape": shape,
             "second_rasterizer": checks.second_rasterizer(outcome, second, engine.second_for(results.scene.light).get("name", "")),
             "own_picture": checks.own_picture(outcome, pictured, bool(engine.own_picture))}
    row = {f"check_{name}": text for name, text in found.items()}
    row.update(surprising=checks.is_surprising(outcome["json"]), trust=checks.trust(outcome["json"], found, engine.explained_for(results.scene.light)))
    if second and second["status"] == "done":
        row.update({f"second_{rate}": second["json"][rate] for rate in checks.RATES}, second_rasterizer=engine.second["name"])
    return row


def _took(results, setting):
    """The duration of a row with its searches and trials [s]."""
    outcomes = [results.rows[setting], results.second.get(setting), results.pictured.get(setting)]
    outcomes += [results.tune] if setting == "tuned" and results.tune is not results.rows[setting] else []
    outcomes += results.trials.values() if setting == "defaults" else []
    return round(sum(outcome.get("wall_s", 0) for outcome in outcomes if outcome), 1)


def rows_of(engine, device, all_results):
    """The rows of a measured engine.

    all_results: by scene, in their order.
    """
    shapes = {}
    for results in all_results:
        if results.scene.known_shape:
            tried = {**results.rows, "known_shape": results.trials.get("known_shape")}
            seen = {setting: outcome for setting, outcome in tried.items()
                    if outcome and not checks.same_view(outcome, results.own).startswith("failed")}
            shapes[results.scene.light] = checks.known_shape(seen, results.scene.light)
    limits = {f"limit_{key}": engine.limits.get(key) for key in ("mask", "read_back", "anti_aliasing", "depths")}
    rows = []
    for results in all_results:
        for setting, outcome in results.rows.items():
            row = {**dict.fromkeys(COLUMNS), **limits, "limit_map_size": engine.map_size, "engine": engine.name, "title": engine.title,
                   "version": device.version, "device": device.device, "machine": outcome.get("machine"), "scene": results.scene.name,
                   "light": results.scene.light, "setting": setting, "status": outcome["status"], "message": outcome["message"],
                   "again": outcome.get("again"), "took_s": _took(results, setting)}
            if setting in results.calls:
                call = results.calls[setting]
                row.update(settings_said=json.dumps(call.settings), command=call.text())
            if setting == "documented":
                row["documented_source"] = engine.documented["source"]
            if setting == "tuned" and results.tune["status"] == "done":
                row.update(_search(results.tune))
            if outcome["status"] == "done":
                shape = shapes.get(results.scene.light, checks.not_done("sphere-plane was not drawn under this light"))
                row.update(_numbers(outcome["json"]), **_checked(results, shape, setting, engine))
            rows.append(row)
    return rows


def write(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows({key: "" if value is None else value for key, value in row.items()} for row in rows)


PARSE = {"text": str, "number": float, "whole": int, "truth": lambda text: text == "True"}


def read(path):
    """The rows of a file. Empty cells are None, and so are columns that older files lack."""
    with open(path, newline="") as file:
        return [{**dict.fromkeys(COLUMNS), **{key: PARSE[COLUMNS[key]](text) if text else None for key, text in row.items()}}
                for row in csv.DictReader(file)]


def merged(old, new):
    """The new rows, and old ones that were not measured now, by engine and in the order of scenes."""
    measured = {tuple(row[key] for key in KEY) for row in new}
    kept = [row for row in old if row["status"] != "absent" and tuple(row[key] for key in KEY) not in measured]
    known = {row["engine"] for row in kept}
    merged_rows = [row for row in new if row["status"] != "absent" or row["engine"] not in known] + kept
    order = {scene: i for i, scene in enumerate(dict.fromkeys(row["scene"] for row in old + new))}
    return sorted(merged_rows, key=lambda row: (row["engine"], order[row["scene"]], SETTINGS.index(row["setting"]) if row["setting"] else 0))
