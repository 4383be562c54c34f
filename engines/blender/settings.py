"""Blender's own keys for EEVEE and Cycles, and a draw's settings in its terms."""
from keys import boolean, integer, number, refusals

EEVEE_KEYS = [
    boolean("use_shadow", True, "light.use_shadow: false draws no shadows"),
    number("shadow_buffer_bias", 0.001, 9999, 1, "m", "light: subtracted from the receiver's depth, after a factor of EEVEE's own; positive is against acne"),
    number("shadow_buffer_clip_start", 1e-6, 9999, 0.05, "m", "light: where a spot's or a point's map begins"),
    boolean("use_shadow_high_bitdepth", False, "scene.eevee: maps of 32 in place of 16 bits"),
    boolean("use_soft_shadows", True, "scene.eevee: lights that have a size are sampled over it; here none has"),
    boolean("use_contact_shadow", False, "light: rays through the depth buffer add shadows that the map misses"),
    number("contact_shadow_distance", 0, 9999, 0.2, "m", "light: how far contact rays go"),
    number("contact_shadow_bias", 0.001, 9999, 0.03, "m", "light: where contact rays begin"),
    number("contact_shadow_thickness", 0, 9999, 0.2, "m", "light: how thick contact rays take things for"),
    integer("shadow_cascade_count", 1, 4, 4, "", "sun: number of maps"),
    number("shadow_cascade_max_distance", 1e-3, 9999, 200, "m", "sun: where the last map ends, from the camera"),
    number("shadow_cascade_exponent", 0, 1, 0.8, "", "sun: 1 makes the nearest map small, 0 all alike"),
    number("shadow_cascade_fade", 0, 1, 0.1, "", "sun: share of a map over which it fades into the next"),
    boolean("use_backface_culling", False, "material: back faces are not seen"),
]
CYCLES_KEYS = [
    boolean("cast_shadow", True, "light.cycles.cast_shadow: false draws no shadows"),
    number("shadow_terminator_geometry_offset", 0, 1, 0.1, "", "object.cycles: how far rays begin off the surface where light grazes it"),
    number("shadow_terminator_offset", 0, 1, 0, "", "object.cycles: takes light from where smooth normals would let facets show"),
]
OWNERS = {"use_shadow": "light", "use_shadow_high_bitdepth": "eevee", "use_soft_shadows": "eevee", "use_contact_shadow": "light",
          "use_backface_culling": "material", "cast_shadow": "light.cycles",
          "shadow_terminator_geometry_offset": "object.cycles", "shadow_terminator_offset": "object.cycles"}
MAP_SIZES = [64, 128, 256, 512, 1024, 2048, 4096]
SUN_ONLY = {"shadow_cascade_count", "shadow_cascade_max_distance", "shadow_cascade_exponent", "shadow_cascade_fade"}


def keys_of(is_cycles):
    return CYCLES_KEYS if is_cycles else EEVEE_KEYS


def refused(order, light, is_cycles):
    """A sentence for each key that Blender does not support."""
    if is_cycles:
        return refusals(order, CYCLES_KEYS, {}, "Cycles casts rays, and has no map")
    problems = refusals(order, EEVEE_KEYS, {"lookup.outside": ("lit",), "shadow_map.reversed": (False,),
                                            "shadow_map.layout": ("cascades" if light["type"] == "directional" else "cube",)},
                        "EEVEE has no such setting")
    if order["shadow_map"]["resolution"] not in MAP_SIZES:
        problems["shadow_map.resolution"] = f"EEVEE has maps of {', '.join(map(str, MAP_SIZES))} texels"
    return problems


def settings_of(order, light, is_cycles):
    """The properties of Blender that a draw sets, as owner, name and value."""
    told = [(OWNERS.get(name, "light"), name, value) for name, value in order["engine"].items()
            if light["type"] == "directional" or name not in SUN_ONLY]
    if not is_cycles:
        size = str(order["shadow_map"]["resolution"])
        told += [("eevee", "shadow_cube_size", size), ("eevee", "shadow_cascade_size", size)]
    return told


def without_shadows(settings):
    """The settings with shadows turned off."""
    return [(owner, name, False if name in ("use_shadow", "cast_shadow") else value) for owner, name, value in settings]
