"""Godot's own keys, and a draw's settings in its terms."""
from keys import boolean, choice, number, refusals

SHADOW_MODES = {"orthogonal": 0, "parallel_2_splits": 1, "parallel_4_splits": 2}
CASTS = {"on": 1, "double_sided": 2}
FILTERS = {"disabled": 0, "pcf5": 1, "pcf13": 2}
KEYS = [
    boolean("shadow_enabled", True, "Light: false draws no shadows"),
    number("shadow_bias", -16, 16, 0.15, "m", "Light: casters are pushed along the map's axis before they are projected; positive is against acne"),
    number("directional_shadow_bias", -16, 16, 0.1, "m", "DirectionalLight: its own default of shadow_bias"),
    number("shadow_contact", 0, 16, 0, "m", "Light: how far rays through the depth buffer go on"),
    boolean("shadow_reverse_cull_face", False, "Light: what faces the light does not cast, and what faces away does"),
    choice("cull_mode", ["back", "front", "disabled"], "back", "SpatialMaterial.params_cull_mode: which faces are not seen, and do not cast"),
    choice("cast_shadow", list(CASTS), "on", "GeometryInstance: on casts as cull_mode says, double_sided with both faces"),
    choice("filter_mode", list(FILTERS), "pcf5", "rendering/quality/shadows/filter_mode: one sample, 5 or 13"),
    choice("omni_shadow_mode", ["dual_paraboloid", "cube"], "cube", "OmniLight: two maps, or six that are made into two"),
    choice("directional_shadow_mode", list(SHADOW_MODES), "parallel_4_splits", "DirectionalLight: one map, two or four"),
    boolean("directional_shadow_blend_splits", False, "DirectionalLight: neighbours among the maps are mixed"),
    number("directional_shadow_normal_bias", 0, 16, 0.8, "", "DirectionalLight: casters are pushed farther the more they are tilted against the light"),
    number("directional_shadow_bias_split_scale", 0, 1, 0.25, "", "DirectionalLight: how much larger the bias of far maps is"),
    choice("directional_shadow_depth_range", ["stable", "optimized"], "stable", "DirectionalLight: whether maps keep their size as the camera turns"),
    number("directional_shadow_max_distance", 0.1, 8192, 100, "m", "DirectionalLight: where shadows end, from the camera"),
]
SIZES = [32, 64, 128, 256, 512, 1024, 2048, 4096]
SPOT_NEAR = 0.01


def refused(order, light):
    """A sentence for each key that Godot does not support."""
    layout = {"directional": "single" if order["engine"]["directional_shadow_mode"] == "orthogonal" else "cascades",
              "spot": "single", "point": "cube"}[light["type"]]
    problems = refusals(order, KEYS, {"lookup.outside": ("lit",), "shadow_map.reversed": (False,), "shadow_map.layout": (layout,)},
                        "Godot has no such setting")
    if order["shadow_map"]["resolution"] not in SIZES:
        problems["shadow_map.resolution"] = f"Godot has maps of {', '.join(map(str, SIZES))} texels"
    return problems


def atlas_of(order):
    """The side of the atlas, of which a spot or point light's map fills a quarter [texels]."""
    return 2 * order["shadow_map"]["resolution"]


def directional_size_of(order, light):
    """The side of the texture that holds a directional light's maps [texels]; None for other lights."""
    if light["type"] != "directional":
        return None
    return order["shadow_map"]["resolution"] * (1 if order["engine"]["directional_shadow_mode"] == "orthogonal" else 2)


def light_of(order, light):
    """The light's properties for a draw."""
    engine = order["engine"]
    told = {name: engine[name] for name in ("shadow_contact", "shadow_reverse_cull_face")}
    if light["type"] == "directional":
        told["shadow_bias"] = engine["directional_shadow_bias"]
        told |= {name: engine[name] for name in ("directional_shadow_blend_splits", "directional_shadow_normal_bias",
                                                 "directional_shadow_bias_split_scale", "directional_shadow_max_distance")}
        told["directional_shadow_mode"] = SHADOW_MODES[engine["directional_shadow_mode"]]
        told["directional_shadow_depth_range"] = ["stable", "optimized"].index(engine["directional_shadow_depth_range"])
        return told
    told["shadow_bias"] = engine["shadow_bias"]
    if light["type"] == "point":
        told["omni_shadow_mode"] = ["dual_paraboloid", "cube"].index(engine["omni_shadow_mode"])
    return {**told, ("omni_range" if light["type"] == "point" else "spot_range"): order["shadow_map"]["far"]}
