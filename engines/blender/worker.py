"""Runs inside Blender: builds and renders scenes. Requests and answers are lines of JSON on the two pipes named after `--`."""
import json
import math
import os
import sys

import bpy
import mathutils

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "common", "python"))

import glb  # noqa: E402

LARGEST_HALF_INTEGER = 2048
WATTS, WATTS_A_SQUARE_METRE = 1000, 1  # of lamps and of the sun; they cancel out in the mask


def looking(position, forward, up):
    """The matrix of a camera or light that looks along its -z."""
    forward = mathutils.Vector(forward).normalized()
    right = forward.cross(mathutils.Vector(up)).normalized()
    matrix = mathutils.Matrix((right, right.cross(forward), -forward)).transposed().to_4x4()
    matrix.translation = position
    return matrix


def any_up(forward):
    """A direction that is not parallel to the given one."""
    return (0, 1, 0) if abs(mathutils.Vector(forward).normalized().y) < 0.9 else (1, 0, 0)


def add_camera(camera, reach):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    if "orthographic_height" in camera:
        data.type, data.ortho_scale = "ORTHO", camera["orthographic_height"]
    else:
        data.angle = math.radians(camera["vertical_fov_deg"])
    data.clip_start, data.clip_end = reach / 1000, reach
    forward = mathutils.Vector(camera["target"]) - mathutils.Vector(camera["eye"])
    placed = bpy.data.objects.new("camera", data)
    placed.matrix_world = looking(camera["eye"], forward, camera["up"])
    bpy.context.collection.objects.link(placed)
    bpy.context.scene.camera = placed


def add_light(light):
    kind = {"directional": "SUN", "spot": "SPOT", "point": "POINT"}[light["type"]]
    data = bpy.data.lights.new("light", kind)
    data.energy = WATTS_A_SQUARE_METRE if kind == "SUN" else WATTS
    data.shadow_soft_size = 0
    if kind == "SUN":
        data.angle = 0
    elif kind == "SPOT":
        data.spot_size, data.spot_blend = math.radians(light["cone_deg"]), 0
    position = light.get("position", (0, 0, 0))
    forward = light["direction"] if kind == "SUN" else (0, -1, 0)
    if kind == "SPOT":
        forward = mathutils.Vector(light["target"]) - mathutils.Vector(position)
    placed = bpy.data.objects.new("light", data)
    placed.matrix_world = looking(position, forward, any_up(forward))
    bpy.context.collection.objects.link(placed)
    return data


def add_position_outputs(tree, scale):
    """Outputs the world position P in nine exact halves: floor(s P), floor(1024 fract(s P)) and fract(1024 fract(s P))."""
    def vector(operation, source, factor=None):
        node = tree.nodes.new("ShaderNodeVectorMath")
        node.operation = operation
        tree.links.new(source, node.inputs[0])
        if factor is not None:
            node.inputs[1].default_value = (factor, factor, factor)
        return node.outputs[0]

    scaled = vector("MULTIPLY", tree.nodes.new("ShaderNodeNewGeometry").outputs["Position"], scale)
    finer = vector("MULTIPLY", vector("FRACTION", scaled), 1024)
    for name, value in (("whole", vector("FLOOR", scaled)), ("fine", vector("FLOOR", finer)), ("finest", vector("FRACTION", finer))):
        output = tree.nodes.new("ShaderNodeOutputAOV")
        output.name = name
        tree.links.new(value, output.inputs["Color"])


def material_of(name, scale, is_seen, casts):
    """White and diffuse; unseen objects are transparent, but cast full shadows."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.shadow_method = "OPAQUE" if casts else "NONE"
    tree = material.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    surface = tree.nodes.new("ShaderNodeBsdfDiffuse" if is_seen else "ShaderNodeBsdfTransparent")
    tree.links.new(surface.outputs[0], output.inputs["Surface"])
    if is_seen:
        surface.inputs["Color"].default_value = (1, 1, 1, 1)
        add_position_outputs(tree, scale)
    else:
        material.blend_method = "BLEND"
    return material


def add_object(name, positions, triangles, mesh, scale, is_cycles):
    data = bpy.data.meshes.new(name)
    data.from_pydata(positions.tolist(), [], triangles.tolist())
    is_seen, casts = name not in mesh["no_receive"], name not in mesh["no_cast"]
    placed = bpy.data.objects.new(name, data)
    if is_cycles:
        placed.visible_camera, placed.visible_shadow = is_seen, casts
        data.materials.append(material_of(name, scale, True, True))
    else:
        data.materials.append(material_of(name, scale, is_seen, casts))
    bpy.context.collection.objects.link(placed)


def prepare_render(image, is_cycles):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES" if is_cycles else "BLENDER_EEVEE"
    scene.render.resolution_x, scene.render.resolution_y = image["width"], image["height"]
    scene.render.film_transparent = True
    scene.render.filter_size = 0
    scene.view_settings.view_transform = "Raw"
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR_MULTILAYER", "32", "NONE"
    layer = bpy.context.view_layer
    if is_cycles:
        scene.cycles.samples, scene.cycles.max_bounces, scene.cycles.use_denoising = 1, 0, False
        scene.cycles.use_adaptive_sampling = False
        scene.cycles.light_sampling_threshold = 0  # else faint light is skipped at random
        scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 0.01
        layer.use_pass_position = layer.use_pass_diffuse_direct = True
    else:
        scene.eevee.taa_render_samples = 1
        layer.use_pass_shadow = True
        for name in ("whole", "fine", "finest"):
            aov = layer.aovs.add()
            aov.name, aov.type = name, "COLOR"


class Worker:
    def open(self, told):
        """Builds the scene; returns the scale of `add_position_outputs`."""
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.context.scene.world = bpy.data.worlds.new("dark")
        bpy.context.scene.world.color = (0, 0, 0)
        scene, is_cycles = told["scene"], told["is_cycles"]
        objects = glb.read_objects(scene["mesh"]["file"])
        least, most = (mathutils.Vector(corner) for corner in glb.corners(objects))
        largest = max(abs(x) for x in (*least, *most, 1e-3))
        scale = 2.0 ** math.floor(math.log2(LARGEST_HALF_INTEGER / largest))
        reach = (most - least).length + ((least + most) / 2 - mathutils.Vector(scene["camera"]["eye"])).length
        for name, (positions, triangles) in objects.items():
            add_object(name, positions, triangles, scene["mesh"], scale, is_cycles)
        add_camera(scene["camera"], reach)
        self.light = add_light(scene["light"])
        prepare_render(scene["image"], is_cycles)
        return {"scale": scale}

    def draw(self, told):
        """Sets the properties, and renders into a file."""
        scene = bpy.context.scene
        owners = {"light": [self.light], "light.cycles": [self.light.cycles], "eevee": [scene.eevee],
                  "material": bpy.data.materials, "object": [o for o in bpy.data.objects if o.type == "MESH"],
                  "object.cycles": [o.cycles for o in bpy.data.objects if o.type == "MESH"]}
        for owner, name, value in told["settings"]:
            for one in owners[owner]:
                setattr(one, name, value)
        scene.render.filepath = told["file"]
        bpy.ops.render.render(write_still=True)
        return {}

    def hello(self, _):
        return {"version": bpy.app.version_string}


def main():
    reading, writing = (int(word) for word in sys.argv[sys.argv.index("--") + 1:])
    worker = Worker()
    with os.fdopen(reading) as requests, os.fdopen(writing, "w") as answers:
        for line in requests:
            told = json.loads(line)
            answers.write(json.dumps(getattr(worker, told["call"])(told)) + "\n")
            answers.flush()


main()
