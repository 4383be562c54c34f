"""Writes the league's page: one self-contained HTML file."""

import base64
import html
import re

import chart
import checks
import document
from engines import all_engines
from scenes import ROOT, all_scenes
from engine_run import SETTINGS
from sentences import percent, sentences_of, settings_text

STYLES = ROOT / "reports" / "page" / "assets" / "styles"
OWN_STYLE = """
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 34rem), 1fr)); gap: 2rem 3rem; }
svg { width: 100%; max-width: 46rem; height: auto; font: 16px system-ui, "DejaVu Sans", sans-serif; fill: var(--ink); }
svg .grid { stroke: var(--rule); } svg .joint { stroke: var(--control); stroke-width: 2; }
.wrong { color: var(--wrong); } td.rows { white-space: nowrap; } li { margin-bottom: 0.4rem; max-width: 60rem; }
details { margin: 0.75rem 0; } summary { cursor: pointer; color: var(--accent); } table.all td, table.all th { padding-right: 0.9rem; }
"""


def text(value):
    return html.escape("" if value is None else str(value))


def marked_up(markdown):
    """Converts the Markdown of sentences to HTML."""
    escaped = html.escape(markdown)
    escaped = re.sub(r"`([^`]+)`", r"<code>\1</code>", escaped)
    escaped = re.sub(r"\*\*([^*]+)\*\*", r"<strong>\1</strong>", escaped)
    return re.sub(r"\*\(([^*]+)\)\*", r'<span class="hint">(\1)</span>', escaped)


def table(caption, head, lines, name=""):
    """A table; the cells of `lines` are HTML."""
    heads = "".join(f'<th scope="col">{text(one)}</th>' for one in head)
    body = "".join(f"<tr>{''.join(f'<td>{cell}</td>' for cell in line)}</tr>\n" for line in lines)
    return f'<div class="scroll"><table class="{name}"><caption>{text(caption)}</caption>\n<thead><tr>{heads}</tr></thead>\n' \
           f"<tbody>\n{body}</tbody></table></div>"


def engines_section(rows):
    measured, absent = document.engines_in(rows)
    lines = []
    for engine in measured:
        own = [row for row in rows if row["engine"] == engine]
        done = [row for row in own if row["status"] == "done"]
        lines.append([text(own[0]["version"]), text(own[0]["device"]), f"{len(done)} of {len(own)}",
                      str(sum(bool(row["surprising"]) for row in done)), text(document.again_text(own)), f"{document.minutes(own):.0f} min"])
    lines += [[text(row["title"]), text(row["message"]), "–", "–", "–", "–"] for row in absent]
    head = ("engine", "device", "rows measured", "surprising", "measured anew", "took")
    return f"<section><h2>Engines</h2>{table('What was measured, and what is absent', head, lines)}</section>"


def charts_section(rows, scenes):
    figures = "".join(f"<figure><figcaption>{text(scene.name)}, {text(document.LIGHT_WORDS[scene.light])}</figcaption>{drawn}"
                      f'<p class="hint">{text(scene.sentence)}</p></figure>'
                      for scene in scenes if (drawn := chart.chart(rows, scene.name)))
    return f'<section><h2>Mean |error| by scene</h2>{chart.legend()}<div class="charts">{figures}</div></section>'


def engine_section(rows, engine, images, note=""):
    own = [row for row in rows if row["engine"] == engine]
    picture = images / f"{engine}.png"
    parts = [f"<h3>{text(own[0]['title'])}</h3>", f"<p>{text(document.limits_text(own[0]))}</p>",
             f"<p>{marked_up(note)}</p>" if note else "",
             "<ul>" + "".join(f"<li>{marked_up(one.markdown())}</li>" for one in sentences_of(rows, engine)) + "</ul>"]
    if picture.exists():
        data = base64.b64encode(picture.read_bytes()).decode()
        parts.append("<figure><figcaption>Its worst row: what the engine draws, the truth, and where they differ</figcaption>"
                     f'<img alt="the worst row of {text(engine)}" src="data:image/png;base64,{data}"></figure>')
    return "".join(parts)


def checks_cell(row):
    """The row's checks with their results."""
    word, _, why = row["trust"].partition(": ")
    items = "".join(f"<li>{text(name)}: {text(row[f'check_{name}'] or checks.not_done('not measured'))}</li>" for name in checks.CHECKS)
    colour = "wrong" if word != "checked" else ""
    return f'<details><summary class="{colour}">{text(word)}</summary>{text(why)}<ul>{items}</ul></details>'


def row_cells(row):
    if row["status"] != "done":
        return [text(row[key]) for key in ("title", "scene", "light", "setting")] + [text(f"{row['status']}: {row['message']}")] + [""] * 8
    counts = [f"{row[count]:,}<br>{percent(row[rate])}" for count, rate in (("false_shadow", "false_shadow_rate"),
                                                                          ("false_lit", "false_lit_rate"))]
    amounts = [f"{row[key]:,.1f}" for key in ("shadow_amount", "light_amount")]
    gap = row["peter_panning_gap_m"] if row["peter_panning_gap_m"] is not None else row["false_lit_gap_m"]
    command = f"<details><summary>command</summary><code>{text(row['command'])}</code><br>{marked_up(settings_text(row['engine_settings']))}" \
              "</details>"
    return [*(text(row[key]) for key in ("title", "scene", "light", "setting")), marked_up(settings_text(row["settings_said"])), *counts,
            *amounts, percent(row["mean_abs_error"]), "–" if gap is None else f"{gap:.3g}",
            "–" if row["frame_seconds"] is None else f"{row['frame_seconds']:.2g}", checks_cell(row) + command]


def rows_section(rows):
    head = ("engine", "scene", "light", "setting", "its keys", "false shadow", "false lit", "shadow amount [px]", "light amount [px]",
            "mean |error|", "gap [m]", "s a frame", "checks and command")
    measured = [row for row in rows if row["status"] != "absent"]
    return f'<section><h2>Rows</h2>{table("Every row, with its checks and the command that repeats it", head, map(row_cells, measured), "all")}' \
           "</section>"


def whole(rows, images, scenes):
    """The HTML of the page."""
    style = "".join((STYLES / name).read_text() for name in ("base.css", "tables.css")) + OWN_STYLE
    measured, _ = document.engines_in(rows)
    engines_known = all_engines()
    engines = "".join(engine_section(rows, engine, images, document.note_of(engines_known, engine)) for engine in measured)
    body = f"<header><h1>The league of real shadows</h1><p>{len(rows)} rows; every number is of a frame that the engine drew, held " \
           "to the exact truth. docs/league.md says how.</p>" \
           f"<p>{marked_up(document.frustum_text(engines_known))}</p></header>"
    body += engines_section(rows) + charts_section(rows, scenes)
    body += f"<section><h2>What the rows say</h2>{engines}</section>{rows_section(rows)}"
    return '<!DOCTYPE html>\n<html lang="en" data-paper>\n<head>\n<meta charset="utf-8">\n' \
           '<meta http-equiv="Content-Security-Policy" content="default-src \'none\'; style-src \'unsafe-inline\'; img-src data:">\n' \
           '<meta name="viewport" content="width=device-width, initial-scale=1">\n<title>The league of real shadows</title>\n' \
           f"<style>{style}</style>\n</head>\n<body>{body}</body>\n</html>\n"


def write(path, rows, images, scenes=None):
    path.write_text(whole(rows, images, list((scenes or all_scenes()).values())))
