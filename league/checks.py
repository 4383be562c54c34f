"""Checks of adapters, which tell an adapter's mistakes from errors of its engine, and the trust in a row that follows."""

FALSE_SHADOW, FALSE_LIT, MEAN = 0.05, 0.30, 0.10  # a row above one of these is surprising
SAME = 0.01  # relative difference allowed from the scored pixels of Gnomon's own GL
FEW = 1e-4  # share of pixels allowed to be wrong at seams and silhouettes
DIM = 0.01  # of the light; quotients of 8-bit pictures are not exactly 1
LANDS = 0.9  # agreement of mask and truth; about 0 if the shadow is misplaced or missing
APART, SHARE_APART = 0.005, 0.25  # allowed difference of two rasterizers' rates: half a point, or a quarter of the larger
TOO_DARK = 0.5  # share of lit or blocked pixels; with more dark ones a picture shows too little

CHECKS = ("positions", "same_view", "shadows_off", "no_caster", "known_shape", "second_rasterizer", "own_picture")
RATES = ("false_shadow_rate", "false_lit_rate", "mean_abs_error")


def passed(sentence):
    return f"passed: {sentence}"


def failed(sentence):
    return f"failed: {sentence}"


def not_done(sentence):
    return f"not done: {sentence}"


def is_surprising(result):
    """Whether a row needs every check before it is trusted."""
    limits = zip(RATES, (FALSE_SHADOW, FALSE_LIT, MEAN))
    return any((result[rate] or 0) > limit for rate, limit in limits)


def _unless_done(outcome):
    """Why the check cannot be done; empty if it can."""
    if outcome is None:
        return not_done("not measured")
    return "" if outcome["status"] == "done" else not_done(outcome["message"])


def positions(outcome):
    """Checks that positions lie on the mesh, by the import check, which otherwise refuses the frame."""
    missing = _unless_done(outcome)
    if missing:
        return missing
    check = outcome["json"]["evaluate"]["import_check"]
    if outcome["json"]["evaluate"]["positions"] == "camera":
        return not_done("the engine gives no positions; they are the camera's")
    far, most = check["distance_m"]["p99"], check["tolerance_m"]
    return (passed if far <= most else failed)(f"99 % within {far:.2g} m of the mesh, {most:.2g} m are tolerated")


def same_view(outcome, own):
    """Checks that the frame shows the same pixels as Gnomon's own GL, so that the camera agrees and no surface is hidden."""
    missing = _unless_done(outcome) or _unless_done(own)
    if missing:
        return missing
    pairs = [(outcome["json"]["pixels"][key], own["json"]["pixels"][key]) for key in ("lit", "blocked")]
    aside = outcome["json"]["evaluate"].get("silhouette_pixels") or 0  # left out if the camera gives the positions
    is_same = all(abs(seen - true) <= SAME * true + aside for seen, true in pairs)
    sentence = f"{pairs[0][0]:,} lit and {pairs[1][0]:,} blocked pixels, {pairs[0][1]:,} and {pairs[1][1]:,} by Gnomon's own GL"
    return (passed if is_same else failed)(sentence)


def _darkness(result):
    lit = result["pixels"]["lit"]
    is_light = result["false_shadow"] <= FEW * lit and (result["shadow_amount_rate"] or 0) <= DIM
    dark = f"{result['false_shadow']:,} of {lit:,} lit pixels in shadow"
    return is_light, f"{dark}, {100 * (result['shadow_amount_rate'] or 0):.2g} % of the light is missing"


def shadows_off(outcome):
    """Checks that everything is lit without shadows."""
    missing = _unless_done(outcome)
    if missing:
        return missing
    result = outcome["json"]
    is_light, dark = _darkness(result)
    blocked = result["pixels"]["blocked"]
    is_light = is_light and result["false_lit"] >= (1 - FEW) * blocked and (result["light_amount_rate"] or 0) >= 1 - DIM
    return (passed if is_light else failed)(f"{dark}, {result['false_lit']:,} of {blocked:,} blocked ones lit")


def no_caster(outcome):
    """Checks that nothing is in shadow without casters."""
    missing = _unless_done(outcome)
    if missing:
        return missing
    if outcome["json"]["pixels"]["blocked"]:
        return failed("the job's case no-caster leaves casters")
    is_light, dark = _darkness(outcome["json"])
    return (passed if is_light else failed)(dark)


def known_shape(outcomes, light):
    """Checks the place of the sphere's shadow, with the best settings found.

    outcomes: of that scene, by setting.
    """
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
    """Checks that a second rasterizer gives similar rates.

    name: of the second rasterizer; empty if the engine has none.
    """
    if not name:
        return not_done("there is no second rasterizer for it here")
    missing = _unless_done(second)
    if missing:
        return missing
    pairs = [(first["json"][rate] or 0, second["json"][rate] or 0) for rate in RATES]
    agree = all(abs(a - b) <= max(APART, SHARE_APART * max(a, b)) for a, b in pairs)
    return (passed if agree else failed)(f"{name} has {rates_text(second['json'])}")


def own_picture(first, pictured, has_pictures):
    """Checks that the engine's own picture of white surfaces has the same errors, except for pixels that are too dark without shadows.

    Allows half a point for masks that rounding moves across one half.
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
    """Whether the row measures the engine: a word, and after a colon why not.

    `checked`; `driver`, if the rasterizers disagree; `explained`, if a check fails because of known behaviour of the engine;
    `not trusted`, if a check fails; `unchecked`, if a surprising row lacks a check.
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
