"""An SVG chart of a scene: the mean |error| of each engine by setting, on a logarithmic axis."""

import html
import math

from engine_run import SETTINGS
from sentences import percent

LEAST, MOST = 1e-4, 1.0  # of mean |error|; smaller values stand at the left end
WIDTH, LEFT, RIGHT, LINE, TOP = 640, 150, 24, 34, 40
# Okabe and Ito's colours, as on Gnomon's other pages; shapes distinguish the settings, too.
COLOURS = {"defaults": "#D55E00", "documented": "#E69F00", "tuned": "#0072B2"}


def place(error):
    """The x coordinate [px]."""
    share = math.log(min(MOST, max(LEAST, error)) / LEAST) / math.log(MOST / LEAST)
    return LEFT + share * (WIDTH - LEFT - RIGHT)


def mark(setting, x, y, is_trusted):
    """A circle, a square or a diamond; hollow if the row is not trusted."""
    paint = f'fill="{COLOURS[setting]}"' if is_trusted else 'fill="none"'
    paint += f' stroke="{COLOURS[setting]}" stroke-width="2.5"'
    if setting == "defaults":
        return f'<circle cx="{x:.1f}" cy="{y}" r="7" {paint}/>'
    if setting == "documented":
        return f'<rect x="{x - 6:.1f}" y="{y - 6}" width="12" height="12" {paint}/>'
    return f'<path d="M{x:.1f} {y - 9}l9 9l-9 9l-9 -9z" {paint}/>'


def axis(height):
    parts = []
    for power in range(-4, 1):
        x = place(10.0**power)
        parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{TOP - 12}" y2="{height - 8}" class="grid"/>'
                     f'<text x="{x:.1f}" y="{TOP - 18}" text-anchor="middle">{"≤ " if power == -4 else ""}{100 * 10.0**power:g} %</text>')
    return "".join(parts)


def engine_line(rows, title, y):
    """An engine's name, and its marks joined by a line."""
    parts = [f'<text x="{LEFT - 14}" y="{y + 5}" text-anchor="end">{html.escape(title)}</text>']
    places = [place(row["mean_abs_error"]) for row in rows]
    parts.append(f'<line x1="{min(places):.1f}" x2="{max(places):.1f}" y1="{y}" y2="{y}" class="joint"/>')
    for row, x in zip(rows, places):
        told = html.escape(f"{title}, {row['setting']}: {percent(row['mean_abs_error'])}; {row['trust']}")
        parts.append(f"<g><title>{told}</title>{mark(row['setting'], x, y, not row['trust'].startswith('not trusted'))}</g>")
    return "".join(parts)


def chart(rows, scene):
    """The chart of a scene, with a line for each engine; empty if none was measured."""
    done = [row for row in rows if row["scene"] == scene and row["status"] == "done"]
    engines = list(dict.fromkeys(row["engine"] for row in done))
    if not engines:
        return ""
    height = TOP + LINE * len(engines) + 8
    lines = [engine_line(own, own[0]["title"], TOP + LINE * i + LINE // 2)
             for i, own in enumerate([row for row in done if row["engine"] == engine] for engine in engines)]
    return (f'<svg viewBox="0 0 {WIDTH} {height}" role="img" aria-label="mean error on {html.escape(scene)} by engine and setting">'
            f"{axis(height)}{''.join(lines)}</svg>")


def legend():
    """What the marks mean."""
    parts = []
    for i, setting in enumerate(SETTINGS):
        parts.append(f'{mark(setting, 14 + 170 * i, 16, True)}<text x="{32 + 170 * i}" y="21">{setting}</text>')
    parts.append(f'{mark("defaults", 14 + 510, 16, False)}<text x="{32 + 510}" y="21">hollow: not to be trusted</text>')
    return f'<svg viewBox="0 0 760 32" class="legend" role="img" aria-label="legend">{"".join(parts)}</svg>'
