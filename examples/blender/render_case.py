"""Renders a case for `gnomon evaluate` with Blender's Cycles: a mesh on a plane under a point light.

    blender --background --factory-startup --python render_case.py -- MESH.obj CASE

writes CASE/case.toml, CASE/mesh.obj and CASE/aov.exr. Mask and position come from the same single sample
of each pixel; surfaces are flat, white and diffuse, light does not bounce and its source has no radius: a
pixel is lit where any light arrives. Made for Blender 3.4, which Debian 12 packages.
"""

import argparse
import pathlib
import sys

import bpy
from mathutils import Vector

CASE = """\
schema = 1
name = "{name}"
renderer = "Blender {version}, Cycles on the CPU"
image = "aov.exr"

[mesh]
file = "mesh.obj"

[light]
type = "point"
position = [{light}]

[camera]
eye = [{eye}]

[conventions]
from = "blender"
axes = ["x", "y", "z"]           # the mesh was written in Blender's own axes

[channels]
shadow = "ViewLayer.Combined.R"
lit_above = 0
object = "ViewLayer.IndexOB.X"

[objects]
{objects}
"""


def parse_arguments():
    parser = argparse.ArgumentParser(prog="render_case.py", description=__doc__.splitlines()[0])
    parser.add_argument("mesh", type=pathlib.Path, help="an OBJ file, y up")
    parser.add_argument("case", type=pathlib.Path, help="the folder to write")
    parser.add_argument("--width", type=int, default=1280, help="[px]")
    parser.add_argument("--height", type=int, default=720, help="[px]")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:])


def load_mesh(path):
    """The mesh as one flat object, in Blender's axes."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.obj_import(filepath=str(path))
    parts = [o for o in bpy.context.scene.objects if o.type == "MESH"]
    bpy.ops.object.select_all(action="DESELECT")
    for part in parts:
        part.select_set(True)
    bpy.context.view_layer.objects.active = parts[0]
    if len(parts) > 1:
        bpy.ops.object.join()
    bpy.ops.object.transform_apply(location=True, rotation=True, scale=True)
    model = bpy.context.active_object
    model.name = path.stem
    return model


def box_of(model):
    corners = [Vector(v.co) for v in model.data.vertices]
    lower = Vector(min(c[k] for c in corners) for k in range(3))
    upper = Vector(max(c[k] for c in corners) for k in range(3))
    return lower, upper


def add_ground(lower, upper):
    centre = 0.5 * (lower + upper)
    bpy.ops.mesh.primitive_plane_add(size=6 * (upper - lower).length,
                                     location=(centre.x, centre.y, lower.z))
    bpy.ops.object.transform_apply(location=True, rotation=True, scale=True)
    ground = bpy.context.active_object
    ground.name = "ground"
    return ground


def finish_surfaces(objects):
    white = bpy.data.materials.new("white")
    white.use_nodes = True
    nodes = white.node_tree.nodes
    nodes.clear()
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    output = nodes.new("ShaderNodeOutputMaterial")
    white.node_tree.links.new(diffuse.outputs["BSDF"], output.inputs["Surface"])
    for number, item in enumerate(objects, start=1):
        item.data.materials.clear()
        item.data.materials.append(white)
        item.data.use_auto_smooth = False
        for polygon in item.data.polygons:
            polygon.use_smooth = False
        item.pass_index = number


def add_light_and_camera(lower, upper):
    centre, size = 0.5 * (lower + upper), (upper - lower).length
    light = bpy.data.lights.new("light", type="POINT")
    light.shadow_soft_size = 0
    light.energy = 1000 * size * size
    light_object = bpy.data.objects.new("light", light)
    light_object.location = centre + size * Vector((1.1, -0.8, 1.6))
    bpy.context.scene.collection.objects.link(light_object)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = centre + size * Vector((0.2, -1.9, 0.9))
    camera.rotation_euler = (centre - camera.location).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera
    return light_object, camera


def set_up_cycles(width, height, path):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 1
    scene.cycles.use_denoising = False
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.max_bounces = 0
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 0.01  # the narrowest: the sample is at the pixel's centre
    scene.view_layers[0].name = "ViewLayer"
    for name in ("use_pass_position", "use_pass_normal", "use_pass_object_index"):
        setattr(scene.view_layers[0], name, True)
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.render.film_transparent = True
    image = scene.render.image_settings
    image.file_format, image.color_depth, image.exr_codec = "OPEN_EXR_MULTILAYER", "32", "ZIP"
    scene.render.filepath = str(path)


def write_mesh(objects, path):
    """Nine digits bring every float32 back; Blender's exporters write six."""
    first = 1
    with open(path, "w", encoding="utf-8") as file:
        for item in objects:
            item.data.calc_loop_triangles()
            file.write(f"o {item.name}\n")
            for vertex in item.data.vertices:
                file.write("v {:.9g} {:.9g} {:.9g}\n".format(*vertex.co))
            for triangle in item.data.loop_triangles:
                file.write("f {} {} {}\n".format(*(first + i for i in triangle.vertices)))
            first += len(item.data.vertices)


def main():
    arguments = parse_arguments()
    folder = arguments.case.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    model = load_mesh(arguments.mesh.resolve())
    lower, upper = box_of(model)
    objects = [model, add_ground(lower, upper)]
    finish_surfaces(objects)
    light, camera = add_light_and_camera(lower, upper)
    set_up_cycles(arguments.width, arguments.height, folder / "aov.exr")
    bpy.context.view_layer.update()
    bpy.ops.render.render(write_still=True)
    write_mesh(objects, folder / "mesh.obj")
    numbers = lambda v: ", ".join(f"{x:.9g}" for x in v)  # noqa: E731
    (folder / "case.toml").write_text(CASE.format(
        name=f"{model.name} by Cycles", version=bpy.app.version_string,
        light=numbers(light.matrix_world.translation), eye=numbers(camera.matrix_world.translation),
        objects="\n".join(f'"{o.name}" = {o.pass_index}' for o in objects)), encoding="utf-8")


main()
