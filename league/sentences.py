"""Sentences about the rows for the authors of an engine, each by a rule and with its rows."""

import json
from dataclasses import dataclass

from rows import is_trusted

HALF_MENDED = 0.5  # share of the search's gain; a single key that reaches it is named
NOTABLE = 0.005  # of mean |error|; below half a point there is no sentence
SOFT_MEAN, SOFT_RATIO = 0.02, 5  # wrong by amount, and by count at most a fifth of that
NO_SHADOW = 0.99
LEFT = 0.02  # of mean |error|; rows above it after a search are named


@dataclass(frozen=True)
class Sentence:
    """A rule's name, its text in Markdown, and (scene, setting) of its rows."""

    rule: str
    text: str
    rows: tuple

    def markdown(self):
        return f"{self.text} *(rows: {', '.join(f'{scene} {setting}' for scene, setting in self.rows)})*"


def percent(rate):
    """A rate in percent with three digits."""
    return "–" if rate is None else f"{100 * rate:.3g} %" if rate else "0 %"


def settings_text(text):
    """Formats JSON of keys as code; `the defaults` without keys."""
    keys = json.loads(text or "{}")
    return ", ".join(f"`{key} = {number_text(value)}`" for key, value in keys.items()) or "the defaults"


def number_text(value):
    return f"{value:.4g}" if isinstance(value, float) else json.dumps(value).strip('"')


def _of(rows, setting):
    return {row["scene"]: row for row in rows if row["setting"] == setting and is_trusted(row)}


def _triple(row):
    return (f"{percent(row['false_shadow_rate'])} false shadow, {percent(row['false_lit_rate'])} false lit, "
            f"mean |error| {percent(row['mean_abs_error'])}")


def _named(rows):
    return tuple((row["scene"], row["setting"]) for row in rows)


def worst_defaults(rows):
    """The scene on which the defaults are worst."""
    own = _of(rows, "defaults")
    if not own:
        return []
    row = max(own.values(), key=lambda one: one["mean_abs_error"])
    if row["mean_abs_error"] < NOTABLE:
        return [Sentence("defaults", f"The defaults are nowhere more wrong than {percent(row['mean_abs_error'])} of mean |error| "
                         f"({row['scene']}).", _named([row]))]
    side = "surfaces shadow themselves or are shadowed by what is not there" if row["shadow_amount"] >= row["light_amount"] else \
        "light falls where none may"
    return [Sentence("defaults", f"The defaults are most wrong on **{row['scene']}**: {_triple(row)}; mostly {side}.", _named([row]))]


def mends(rows):
    """The single keys that bring most of the search's gain, with their scenes, and the errors that remain."""
    defaults, by_key = _of(rows, "defaults"), {}
    for scene, row in _of(rows, "tuned").items():
        if scene not in defaults or defaults[scene]["mean_abs_error"] - row["mean_abs_error"] < NOTABLE or not row["single_key"]:
            continue
        gain = row["search_error_before"] - row["search_error_after"]
        is_enough = row["search_error_before"] - row["single_error"] >= HALF_MENDED * gain
        by_key.setdefault(row["single_key"] if is_enough else None, []).append(row)
    sentences = []
    for key, mended in by_key.items():
        told = []
        for row in mended:
            before = defaults[row["scene"]]["mean_abs_error"]
            alone = f"`{key} = {number_text(json.loads(row['single_value']))}` alone takes away " \
                    f"{percent(1 - row['single_error'] / row['search_error_before'])} of the error; " if key else ""
            told.append(f"{row['scene']}: {alone}{settings_text(row['settings_said'])} gives mean |error| "
                        f"{percent(row['mean_abs_error'])} in place of {percent(before)}")
        start = f"**`{key}` mends it.**" if key else "**Several keys together mend it.**"
        used = [row for one in mended for row in (defaults[one["scene"]], one)]
        sentences.append(Sentence("mends", f"{start} {'. '.join(told)}.", _named(used)))
    return sentences


def documented(rows):
    """Whether the documented settings are better than the defaults."""
    defaults, said = _of(rows, "defaults"), _of(rows, "documented")
    both = [scene for scene in said if scene in defaults]
    changed = [scene for scene in both if abs(said[scene]["mean_abs_error"] - defaults[scene]["mean_abs_error"]) >= NOTABLE]
    if not both:
        return []
    used = [row for scene in changed or both for row in (defaults[scene], said[scene])]
    what = settings_text(said[both[0]]["settings_said"])
    if not changed:
        return [Sentence("documented", f"What the documentation recommends ({what}) changes the mean |error| of no scene by half a point.",
                         _named(used))]
    told = ", ".join(f"{scene} {percent(defaults[scene]['mean_abs_error'])} → {percent(said[scene]['mean_abs_error'])}"
                     for scene in changed)
    better = sum(said[scene]["mean_abs_error"] < defaults[scene]["mean_abs_error"] for scene in changed)
    return [Sentence("documented", f"What the documentation recommends ({what}) is better than the defaults on {better} and worse on "
                     f"{len(changed) - better} of {len(both)} scenes, by mean |error|: {told}.", _named(used))]


def soft(rows):
    """Rows that are nearly right by count, but wrong by amount."""
    found = [row for row in rows if is_trusted(row) and row["mean_abs_error"] >= SOFT_MEAN
             and row["error_rate"] * SOFT_RATIO <= row["mean_abs_error"]]
    if not found:
        return []
    told = ", ".join(f"{row['scene']} ({row['setting']}) {percent(row['error_rate'])} against {percent(row['mean_abs_error'])}"
                     for row in found)
    return [Sentence("soft", "Counts do not show all: verdicts stay on the right side of one half and are wrong by amount; "
                     f"wrong pixels against mean |error|: {told}.", _named(found))]


def no_shadow(rows):
    """Rows without any shadow."""
    found = [row for row in rows if is_trusted(row) and (row["false_lit_rate"] or 0) >= NO_SHADOW]
    if not found:
        return []
    told = ", ".join(f"{row['scene']} ({row['setting']})" for row in found)
    return [Sentence("no_shadow", f"No shadow is drawn, or none darker than one half: {told}.", _named(found))]


def of_the_driver(rows):
    """Rows that the second rasterizer does not confirm, with both rates."""
    found = [row for row in rows if row["status"] == "done" and row["trust"].startswith("driver")]
    return [Sentence("driver", f"{row['scene']} ({row['setting']}) is this driver's as well: {_triple(row)} here, and by "
                     f"{row['second_rasterizer']} {percent(row['second_false_shadow_rate'])}, {percent(row['second_false_lit_rate'])} and "
                     f"{percent(row['second_mean_abs_error'])}.", _named([row])) for row in found]


def left(rows):
    """Errors that remain after the search."""
    found = [row for row in _of(rows, "tuned").values() if row["mean_abs_error"] >= LEFT]
    if not found:
        return []
    told = ", ".join(f"{row['scene']} {percent(row['mean_abs_error'])} after {row['search_drawn']} settings" for row in found)
    return [Sentence("left", f"No setting that was tried brings these below {percent(LEFT)} of mean |error|: {told}.", _named(found))]


def not_drawn(rows):
    """Refusals and failures of the engine."""
    by_message = {}
    for row in rows:
        if row["status"] in ("refused", "failed"):
            by_message.setdefault((row["status"], row["message"]), []).append(row)
    return [Sentence("not_drawn", f"{status.capitalize()}: {message}.", _named(found)) for (status, message), found in by_message.items()]


def not_trusted(rows):
    """Rows with failed checks."""
    found = [row for row in rows if row["status"] == "done" and row["trust"].startswith(("not trusted", "explained"))]
    return [Sentence("not_trusted", f"{row['scene']} ({row['setting']}) is {row['trust']}.", _named([row])) for row in found]


RULES = (worst_defaults, mends, documented, soft, no_shadow, of_the_driver, left, not_drawn, not_trusted)


def sentences_of(rows, engine):
    """All sentences about an engine."""
    own = [row for row in rows if row["engine"] == engine and row["status"] != "absent"]
    return [sentence for rule in RULES for sentence in rule(own)]
