"""Describes an engine's keys to Gnomon, and refuses keys that the engine does not support."""


def number(name, least, most, default, unit, text):
    return {"name": name, "type": "number", "range": [least, most], "default": default, "unit": unit, "help": text}


def integer(name, least, most, default, unit, text):
    return {**number(name, least, most, default, unit, text), "type": "integer"}


def boolean(name, default, text):
    return {"name": name, "type": "boolean", "default": default, "help": text}


def choice(name, values, default, text):
    return {"name": name, "type": "choice", "values": values, "default": default, "help": text}


# Keys of [shadow_map] that every draw has, or that the map's camera already implies.
SAID_OF_EVERY_MAP = ("resolution", "near", "far", "light_clip_from_world", "vertical_fov_deg", "half_extent", "light_camera", "maps")


def refusals(order, keys, allowed, why):
    """A sentence for each key of a draw that the engine does not support.

    @param keys     the engine's own, as in its hello.
    @param allowed  the supported values by `table.key`; None if all are.
    @param why      the sentence for keys that are not in `allowed`.
    """
    known = {**{f"shadow_map.{key}": None for key in SAID_OF_EVERY_MAP},
             **{f"engine.{key['name']}": None for key in keys}, **allowed}
    problems = {}
    for table in ("shadow_map", "lookup", "bias", "method", "engine"):
        for key, value in order.get(table, {}).items():
            name = f"{table}.{key}"
            if name not in known:
                problems[name] = why
            elif known[name] is not None and value not in known[name]:
                problems[name] = f"only {' or '.join(map(str, known[name]))} is supported"
    return problems
