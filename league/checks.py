"""What an adapter is tried by, so that no mistake of its own passes for its engine's; and what the league thinks of a row then."""

FALSE_SHADOW, FALSE_LIT, MEAN = 0.05, 0.30, 0.10  # a row beyond one of these is surprising
SAME = 0.01  # share by which scored pixels may differ from those that Gnomon's own GL shows
FEW = 1e-4  # share of pixels that a seam or a silhouette may cost
DIM = 0.01  # of the light: masks that are quotients of 8-bit pictures are not exactly 1
LANDS = 0.9  # agreement of mask and truth: a shadow elsewhere has about 0, none at all 0
APART, SHARE_APART = 0.005, 0.25  # how far two rasterizers' rates may be apart: half a point, or a quarter of the larger
TOO_DARK = 0.5  # share of the lit or of the blocked pixels without which a picture shows too little

CHECKS = ("positions", "same_view", "shadows_off", "no_caster", "known_shape", "second_rasterizer", "own_picture")
RATES = ("false_shadow_rate", "false_lit_rate", "mean_abs_error")


def passed(sentence):
    return f"passed: {sentence}"


def failed(sentence):
    return f"failed: {sentence}"


def not_done(sentence):
    return f"not done: {sentence}"


def is_surprising(result):
    """Whether a row needs every check before it is believed."""
    limits = zip(RATES, (FALSE_SHADOW, FALSE_LIT, MEAN))
    return any((result[rate] or 0) > limit for rate, limit in limits)


def _unless_done(outcome):
    """Why there is nothing to check; empty where there is."""
    if outcome is None:
        return not_done("not measured")
    return "" if outcome["status"] == "done" else not_done(outcome["message"])


def positions(outcome):
    """What was drawn lies on the mesh: gnomon's import check, which refuses the frame else."""
    missing = _unless_done(outcome)
    if missing:
        return missing
    check = outcome["json"]["evaluate"]["import_check"]
    if outcome["json"]["evaluate"]["positions"] == "camera":
        return not_done("the engine gives no positions; they are the camera's")
    far, most = check["distance_m"]["p99"], check["tolerance_m"]
    return (passed if far <= most else failed)(f"99 % within {far:.2g} m of the mesh, {most:.2g} m are tolerated")


def same_view(outcome, own):
    """It shows what Gnomon's own GL shows of the job: another camera, or a setting that hides surfaces, does not."""
    missing = _unless_done(outcome) or _unless_done(own)
    if missing:
        return missing
    pairs = [(outcome["json"]["pixels"][key], own["json"]["pixels"][key]) for key in ("lit", "blocked")]
    aside = outcome["json"]["evaluate"].get("silhouette_pixels") or 0  # positions that are the camera's leave these out
    is_same = all(abs(seen - true) <= SAME * true + aside for seen, true in pairs)
    sentence = f"{pairs[0][0]:,} lit and {pairs[1][0]:,} blocked pixels, {pairs[0][1]:,} and {pairs[1][1]:,} by Gnomon's own GL"
    return (passed if is_same else failed)(sentence)


def _darkness(result):
    lit = result["pixels"]["lit"]
    is_light = result["false_shadow"] <= FEW * lit and (result["shadow_amount_rate"] or 0) <= DIM
    dark = f"{result['false_shadow']:,} of {lit:,} lit pixels in shadow"
    return is_light, f"{dark}, {100 * (result['shadow_amount_rate'] or 0):.2g} % of the light is missing"


def shadows_off(outcome):
    """Without shadows all is lit."""
    missing = _unless_done(outcome)
    if missing:
        return missing
    result = outcome["json"]
    is_light, dark = _darkness(result)
    blocked = result["pixels"]["blocked"]
    is_light = is_light and result["false_lit"] >= (1 - FEW) * blocked and (result["light_amount_rate"] or 0) >= 1 - DIM
    return (passed if is_light else failed)(f"{dark}, {result['false_lit']:,} of {blocked:,} blocked ones lit")


def no_caster(outcome):
    """Where nothing casts nothing is in shadow."""
    missing = _unless_done(outcome)
    if missing:
        return missing
    if outcome["json"]["pixels"]["blocked"]:
        return failed("the job's case no-caster leaves casters")
    is_light, dark = _darkness(outcome["json"])
    return (passed if is_light else failed)(dark)


def known_shape(outcomes, light):
    """The sphere's shadow lies where it must, with the best settings that were found. outcomes: of that scene, by setting."""
    done = [outcome["json"] for outcome in outcomes.values() if outcome["status"] == "done"]
    if not done:
        return not_done(f"sphere-plane was not drawn under a {light} light")
    best = min(done, key=lambda result: result["mean_abs_error"])
    agreement = best["evaluate"]["import_check"]["agreement"]
    sentence = f"mask and truth agree by {agreement:.3f} on sphere-plane under a {light} light"
    return (passed if agreement >= LANDS else failed)(sentence)


def rates_text(result):
    return ", ".join(f"{100 * (result[rate] or 0):.2f} %" for rate in RATES)


def second_rasterizer(first, second, name):
    """Another rasterizer gives about the same. name: the second's; empty where the engine has none."""
    if not name:
        return not_done("there is no second rasterizer for it here")
    missing = _unless_done(second)
    if missing:
        return missing
    pairs = [(first["json"][rate] or 0, second["json"][rate] or 0) for rate in RATES]
    agree = all(abs(a - b) <= max(APART, SHARE_APART * max(a, b)) for a, b in pairs)
    return (passed if agree else failed)(f"{name} has {rates_text(second['json'])}")


def own_picture(first, pictured, has_pictures):
    """The engine's own picture of a white surface has the same errors, but for pixels that are too dark in it without shadows.

    Equal masks have equal errors; half a point is left to masks that roundings move over one half.
    """
    if not has_pictures:
        return not_done("the adapter makes no mask of pictures")
    missing = _unless_done(first) or _unless_done(pictured)
    if missing:
        return missing
    pairs = [[outcome["json"]["pixels"][key] for outcome in (first, pictured)] for key in ("lit", "blocked")]
    dark = max((1 - told / most for most, told in pairs if most), default=0)
    if dark > TOO_DARK:
        return not_done(f"without shadows {100 * dark:.0f} % of the lit or of the blocked pixels are too dark in the picture")
    differences = [abs((first["json"][rate] or 0) - (pictured["json"][rate] or 0)) for rate in RATES]
    sentence = f"the picture has {rates_text(pictured['json'])}, and {100 * max(dark, 0):.2g} % of the pixels are too dark in it"
    return (passed if max(differences) <= APART + max(dark, 0) else failed)(sentence)


def trust(result, checks, explained):
    """Whether the row is the engine's: a word, and after a colon why not.

    `checked`; `driver`, where the rasterizers do not agree; `explained`, where a check fails by what the engine is known to do;
    `not trusted`, where one fails; `unchecked`, where a surprising row lacks one.
    """
    wrong = [name for name in CHECKS if checks[name].startswith("failed") and name != "second_rasterizer"]
    if [name for name in wrong if name not in explained]:
        return "not trusted: " + "; ".join(f"{name}: {checks[name].removeprefix('failed: ')}" for name in wrong)
    if wrong:
        return "explained: " + "; ".join(explained[name] for name in wrong)
    if checks["second_rasterizer"].startswith("failed"):
        return "driver: " + checks["second_rasterizer"].removeprefix("failed: ")
    lacking = [name for name in CHECKS if checks[name].startswith("not done")]
    if is_surprising(result) and lacking:
        return "unchecked: " + "; ".join(f"{name}: {checks[name].removeprefix('not done: ')}" for name in lacking)
    return "checked"
