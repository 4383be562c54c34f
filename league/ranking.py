"""Who is least wrong: by counts and by amounts, for they rank differently."""

LIGHTS = ("spot", "directional", "point")
MEASURES = {"error_rate": "by count", "mean_abs_error": "by amount"}


def is_ranked(row):
    """Whether a row counts: measured, and not by an adapter's mistake."""
    return row["status"] == "done" and not row["trust"].startswith("not trusted")


def means(rows, light, setting):
    """By engine the means of both measures over its scenes under a light; only engines that have every scene that any has."""
    of = [row for row in rows if row["light"] == light and row["setting"] == setting and is_ranked(row)]
    scenes = {row["scene"] for row in of}
    found = {}
    for engine in {row["engine"] for row in of}:
        own = [row for row in of if row["engine"] == engine]
        if {row["scene"] for row in own} == scenes:
            found[engine] = {measure: sum(row[measure] for row in own) / len(own) for measure in MEASURES}
    return found, sorted(scenes)


def ranked(found, measure):
    """The engines, the least wrong first."""
    return sorted(found, key=lambda engine: (found[engine][measure], engine))
