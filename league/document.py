"""Writes the blocks of docs/league.md: tables and sentences about the rows of docs/league.csv."""

import sys

from engines import all_engines
from scenes import ROOT, all_scenes
from engine_run import SETTINGS
from sentences import percent, sentences_of, settings_text

sys.path.append(str(ROOT / "docs"))

import blocks  # noqa: E402

PATH = ROOT / "docs" / "league.md"
CSV = ROOT / "docs" / "league.csv"
IMAGES = ROOT / "docs" / "images" / "league"
LIGHT_WORDS = {"spot": "a spot light", "directional": "the sun", "point": "a point light"}


def table(head, rows):
    return "\n".join([f"| {' | '.join(head)} |", f"|{'---|' * len(head)}", *(f"| {' | '.join(row)} |" for row in rows)])


def engines_in(rows):
    """The measured engines, and the rows of absent ones."""
    measured = list(dict.fromkeys(row["engine"] for row in rows if row["status"] != "absent"))
    return measured, [row for row in rows if row["status"] == "absent"]


def minutes(rows):
    return sum(row["took_s"] or 0 for row in rows) / 60


def again_text(rows):
    """The result of measuring again."""
    twice = [row for row in rows if row["again"] is not None]
    if not twice:
        return "not yet"
    differ = [row for row in twice if row["again"] != "same"]
    told = "; ".join(f"{row['scene']} {row['setting']}: {row['again']}" for row in differ)
    return f"{len(twice) - len(differ)} of {len(twice)} rows the same" + (f"; {told}" if differ else "")


def overview(rows):
    """A table of engines, versions, devices, repeated measurements and time, with absent engines."""
    measured, absent = engines_in(rows)
    lines = []
    for engine in measured:
        own = [row for row in rows if row["engine"] == engine]
        done = [row for row in own if row["status"] == "done"]
        surprising = [row for row in done if row["surprising"]]
        checked = [row for row in surprising if row["trust"] == "checked"]
        lines.append((own[0]["version"], own[0]["device"], f"{len(done)} of {len(own)}", f"{len(surprising)}, {len(checked)} with every check",
                      again_text(own), f"{minutes(own):.0f} min"))
    for row in absent:
        lines.append((row["title"], row["message"], "–", "–", "–", "–"))
    head = ("engine", "device", "rows measured", "surprising", "measured anew", "took")
    machines = sorted({row["machine"] for row in rows if row["machine"]})
    total = f"All of it took {minutes(rows):.0f} minutes on {'; '.join(machines)}." if machines else "Nothing is measured yet."
    return f"{table(head, lines)}\n\n{total}"


def scenes_text(scenes):
    return table(("scene", "light", "what is in it"), [(scene.name, scene.light, scene.sentence) for scene in scenes.values()])


def joined(names):
    """'One, two and three'."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def frustum_text(engines):
    """Explains `defaults`, and which adapters set what of the map's frustum."""
    told = [f"{engine.title} ({engine.frustum})" for engine in engines.values() if engine.frustum]
    own = [engine.title for engine in engines.values() if not engine.frustum]
    return "`defaults` means the engine's own filter, bias and culling **in Gnomon's frustum**, as far as its adapter can set it: near and " \
           "far planes, and where the map looks, are not the engine's defaults there. A bias stands for other lengths between other planes, so such a " \
           f"row is not what a user sees who changes nothing. Adapters that set the frustum: {joined(told)}. " \
           f"{joined(own)} fit their maps themselves. So rows of `defaults` do not say which engine is better, and this page has no ranks."


def note_of(engines, name):
    """The note beside an engine's rows; may be empty."""
    return engines[name].note if name in engines else ""


def _cell(row):
    if row is None:
        return "–"
    if row["status"] != "done":
        return row["status"]
    rates = (row["false_shadow_rate"], row["false_lit_rate"], row["mean_abs_error"])
    mark = "" if row["trust"] == "checked" else f" ({row['trust'].partition(':')[0]})"
    return " / ".join(percent(rate).removesuffix(" %") for rate in rates) + mark


def engine_table(rows, scenes):
    """A line for each scene: false shadow / false lit / mean |error| by setting, and the settings that tune found."""
    by = {(row["scene"], row["setting"]): row for row in rows}
    lines = []
    for scene in scenes.values():
        own = [by.get((scene.name, setting)) for setting in SETTINGS]
        if any(own):
            found = settings_text(own[2]["settings_said"]) if own[2] and own[2]["status"] == "done" else "–"
            seconds = [row["frame_seconds"] for row in own if row and row["frame_seconds"] is not None]
            lines.append((scene.name, scene.light, *map(_cell, own), found, f"{min(seconds):.2g}" if seconds else "–"))
    return table(("scene", "light", *(f"{setting} [%]" for setting in SETTINGS), "tuned is", "s a frame"), lines)


def limits_text(row):
    """The limits of the adapter that a reader should know."""
    names = {"limit_mask": "mask", "limit_read_back": "read back", "limit_anti_aliasing": "anti-aliasing", "limit_depths": "depths",
             "limit_map_size": "map size"}
    return "; ".join(f"{name}: {row[key]}" for key, name in names.items() if row[key])


def engine_text(rows, engine, scenes, images, note=""):
    """An engine's section: version, table, sentences and worst picture."""
    own = [row for row in rows if row["engine"] == engine]
    parts = [f"### {own[0]['title']}", f"{own[0]['version']} on {own[0]['device']}. {limits_text(own[0])}."]
    sources = sorted({row["documented_source"] for row in own if row["documented_source"]})
    if sources:
        parts.append(f"*Documented*: {'; '.join(sources)}.")
    parts += [note, engine_table(own, scenes), "\n".join(f"- {one.markdown()}" for one in sentences_of(rows, engine))]
    if (images / f"{engine}.png").exists():
        parts.append(f"![Its worst row: what the engine draws, the truth, and where they differ](images/league/{engine}.png)")
    return "\n\n".join(part for part in parts if part)


def block_texts(rows, scenes=None, images=IMAGES):
    """The blocks of the document by name."""
    scenes = scenes or all_scenes()
    measured, _ = engines_in(rows)
    known = all_engines()
    engines = "\n\n".join(engine_text(rows, engine, scenes, images, note_of(known, engine)) for engine in measured)
    return {"frustum": frustum_text(known), "scenes": scenes_text(scenes), "engines": overview(rows),
            "rows": engines or "Nothing is measured yet."}


def write(rows, path=PATH):
    blocks.write_blocks(path, block_texts(rows))
