"""Made-up rows of the league's table."""

import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "league"))

import checks  # noqa: E402
import rows  # noqa: E402

LIT, BLOCKED = 10000, 1000


def row(engine="one", scene="columns", setting="defaults", light="directional", false_shadow=0.0, false_lit=0.0, mean=0.0, **others):
    """A measured row; false_shadow, false_lit, mean: shares."""
    counts = {"false_shadow": round(false_shadow * LIT), "false_lit": round(false_lit * BLOCKED)}
    made = {**dict.fromkeys(rows.COLUMNS), "engine": engine, "title": engine.title(), "version": f"{engine} 1", "device": "a device",
            "machine": "2 x a processor", "scene": scene, "light": light, "setting": setting, "status": "done", "settings_said": "{}",
            "engine_settings": json.dumps({"bias": 0}), "map_size": 1024, "lit": LIT, "blocked": BLOCKED, **counts,
            "false_shadow_rate": false_shadow, "false_lit_rate": false_lit, "error_rate": sum(counts.values()) / (LIT + BLOCKED),
            "shadow_amount": mean * LIT, "light_amount": 0.0, "mean_abs_error": mean, "frame_seconds": 0.5, "surprising": False,
            **{f"check_{name}": "passed: it did" for name in checks.CHECKS}, "trust": "checked", "limit_mask": "its own",
            "limit_map_size": "set", "took_s": 60.0, "command": f"gnomon compare league/jobs/{scene}.toml --renderer {engine}"}
    return {**made, **others}


def tuned(scene="columns", mean=0.001, single=50.0, **others):
    """A row of what a search found: from 100 px of error to 10, with one key alone to `single`."""
    return row(scene=scene, setting="tuned", mean=mean, settings_said='{"bias": -0.001, "radius": 0}', search_drawn=60,
               search_error_before=100.0, search_error_after=10.0, single_key="bias", single_value="-0.001", single_error=single, **others)
