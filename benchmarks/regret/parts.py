"""The measurements of the study: rows for each job, question and rule."""

import numpy

from recommendation import ErrorCurve, bare_minimum, middle, recommend, with_margin
from regret import RULES, carried, carried_in_texels, regret_of, shadow_lost, smallest_worst_share
from views import turned

LIGHT_DIRECTION = numpy.array([-0.4, -1, -0.3])
FITTED, HELD_OUT = 4, 7
TURNS = 4
LEAST_SCORED = 0.1  # share of the pixels scored in the job's own view


def biases_of(views):
    """The bias that each rule recommends for some views; None if nothing is lit. The first view converts biases to lengths."""
    curve = ErrorCurve.pooled([view.curve for view in views])
    margin = recommend(curve, views[0].lengthened, with_margin)
    if margin is None:
        return None
    return {"margin": margin.bias, "middle": middle(margin.low, margin.high), "fewest": bare_minimum(curve)}


def rows_of(question, biases, own, tried, convert=lambda bias, _: bias):
    """A row for each rule: the regret of its bias over the tried views.

    convert(bias, view) is the bias to use in that view.
    """
    curves = [view.curve for view in tried]
    best = smallest_worst_share(curves)
    rows = []
    for rule in RULES:
        used = convert(biases[rule], tried[0])
        lost = shadow_lost(used, curves[0])
        rows.append({"question": question, "rule": rule, "bias": biases[rule], "texels": own.texels(biases[rule]),
                     "used": used, "regret": regret_of(used, curves, best.share),
                     "best_percent": 100 * best.share, "lost_percent": None if lost is None else 100 * lost})
    return rows


def gather(view_of, wanted, own_scored):
    """The first `wanted` of view_of(1), view_of(2), ... that score enough pixels, of at most 4 times as many."""
    views, tries = [], 0
    while len(views) < wanted and tries < 4 * wanted:
        tries += 1
        view = view_of(tries)
        if view is not None and view.curve.scored > 0 and view.curve.scored >= LEAST_SCORED * own_scored:
            views.append(view)
    return views


def views(program, job, _, arguments):
    """Other cameras: each one, and the worst of all."""
    own = program.view(job.scene, job.settings())
    lowest_m = min(job.box[0][1], job.camera.eye[1])

    def around(k):
        keys = job.camera.generated(k)
        is_below = keys["camera.eye"][1] < lowest_m
        return None if is_below and not arguments.below_ground else program.view(job.scene, job.settings(keys))

    others = gather(around, FITTED + HELD_OUT - 1, own.curve.scored)
    fitted, held_out = [own, *others[:FITTED - 1]], others[FITTED - 1:]
    rows = []
    for count, name in ((1, "one view"), (FITTED, "four views")):
        biases = biases_of(fitted[:count])
        if biases is None or not held_out:
            continue
        sets = [(f"from {name}, the worst of the others", held_out)]
        sets += [(f"from {name}, each of the others", [view]) for view in held_out]
        for index, (question, tried) in enumerate(sets):
            about = {"made_of": count, "is_first": index == 0}
            rows += [{**row, **about} for row in rows_of(question, biases, own, tried)]
    return rows


def contact(program, job, pair, _):
    """The job's scene with its objects put down, or changed, in an unchanged view and light."""
    own = program.view(job.scene, job.settings())
    after = program.view(pair.second, job.settings())
    biases = biases_of([own])
    if biases is None or after.curve.scored == 0:
        return []
    question = "things put down" if pair.kind == "contact" else "scene changed"
    return rows_of(question, biases, own, [after])


def lights(program, job, _, __):
    """The light turned, in the job's own view."""
    own = program.view(job.scene, job.settings())
    biases = biases_of([own])
    rows = []
    for turn in range(TURNS if biases else 0):
        after = program.view(job.scene, job.settings(direction=turned(LIGHT_DIRECTION, turn)))
        if after.curve.scored >= max(1, LEAST_SCORED * own.curve.scored):
            rows += rows_of("light turned by 10°", biases, own, [after],
                            lambda bias, view: carried(bias, own, view))
    return rows


def resolutions(program, job, _, __):
    """Half and twice the map's resolution."""
    own = program.view(job.scene, job.settings())
    biases = biases_of([own])
    rows = []
    for name, resolution in (("half the map", job.resolution // 2), ("twice the map", 2 * job.resolution)):
        if biases is None:
            break
        after = program.view(job.scene, job.settings(resolution=resolution))
        rows += rows_of(f"{name}, as many texels", biases, own, [after],
                        lambda bias, view: carried_in_texels(bias, own, view))
        rows += rows_of(f"{name}, as many depth units", biases, own, [after])
    return rows


MEASURES = {"views": views, "contact": contact, "lights": lights, "resolutions": resolutions}
