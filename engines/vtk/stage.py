"""A scene in VTK, its shadow map and its frame."""
import math

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_FLOAT, vtkFloatArray, vtkPoints, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkRenderingCore import vtkActor, vtkCamera, vtkLight
from vtkmodules.vtkRenderingOpenGL2 import (
    vtkCameraPass, vtkLightsPass, vtkOpaquePass, vtkOpenGLPolyDataMapper, vtkOpenGLRenderer, vtkRenderPassCollection, vtkSequencePass,
    vtkShadowMapBakerPass, vtkShadowMapPass, vtkXOpenGLRenderWindow)

import glb
from picture import mask_of_pictures

VTK_VERSION = vtkVersion.GetVTKVersion()
# Values of the uniform `shows`, which selects the output of the modified shaders.
COLOURS, POSITION, SHADOW = 0, 1, 2
# The line of VTK's shader that uses a light's shadow factor, and the end of its fragment shader.
LIGHT_USED = "diffuse += (df * factor0.r * lightColor0);"
LAST_TAG = "//VTK::Coincident::Impl"


def add_own_outputs(properties):
    """Adds outputs of the world position and VTK's `factor0.r`, which is 1 without a shadow map."""
    properties.AddVertexShaderReplacement("//VTK::Normal::Dec", True, "//VTK::Normal::Dec\nout vec3 worldOfVertex;\n", False)
    properties.AddVertexShaderReplacement("//VTK::Normal::Impl", True, "//VTK::Normal::Impl\nworldOfVertex = vertexMC.xyz;\n", False)
    properties.AddFragmentShaderReplacement("//VTK::Normal::Dec", True,
                                            "//VTK::Normal::Dec\nin vec3 worldOfVertex;\nfloat shadowOfLight = 1.0;\n", False)
    properties.AddFragmentShaderReplacement(LIGHT_USED, False, LIGHT_USED + " shadowOfLight = factor0.r;", False)
    properties.AddFragmentShaderReplacement(
        LAST_TAG, False, f"if (shows == {POSITION}) {{ fragOutput0 = vec4(worldOfVertex, 1.0); }}\n"
        f"if (shows == {SHADOW}) {{ fragOutput0 = vec4(shadowOfLight, 0.0, 0.0, 1.0); }}\n", False)


def actor_of(positions, triangles):
    points, cells = vtkPoints(), vtkCellArray()
    points.SetData(numpy_to_vtk(positions, deep=True))
    cells.SetData(3, numpy_to_vtk(triangles.astype(numpy.int64).ravel(), deep=True))
    mesh = vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(cells)
    mapper = vtkOpenGLPolyDataMapper()
    mapper.SetInputData(mesh)
    mapper.SetVBOShiftScaleMethod(0)  # keeps the exact bits of the mesh in vertexMC
    actor = vtkActor()
    actor.SetMapper(mapper)
    add_own_outputs(actor.GetShaderProperty())
    return actor


def camera_of(camera, corners):
    """The camera. Its near plane is a thousandth of the scene's diagonal, or of the distance to the scene if that is longer."""
    result = vtkCamera()
    result.SetPosition(camera["eye"])
    result.SetFocalPoint(camera["target"])
    result.SetViewUp(camera["up"])
    if "orthographic_height" in camera:
        result.SetParallelProjection(True)
        result.SetParallelScale(camera["orthographic_height"] / 2)
    else:
        result.SetViewAngle(camera["vertical_fov_deg"])
    reach = numpy.linalg.norm(corners[1] - corners[0])
    farthest = numpy.linalg.norm((corners[0] + corners[1]) / 2 - camera["eye"]) + reach
    result.SetClippingRange(max(reach, farthest - reach) / 1000, farthest)
    return result


def look_into_corner(camera, image, window):
    """Sets a projection that draws the image into the lower left of the window, pixel by pixel."""
    projection = camera.GetProjectionTransformMatrix(image[0] / image[1], -1, 1)
    corner = vtkMatrix4x4()
    for i in range(2):
        share = image[i] / window[i]
        corner.SetElement(i, i, share)
        corner.SetElement(i, 3, share - 1)
    whole = vtkMatrix4x4()
    vtkMatrix4x4.Multiply4x4(corner, projection, whole)
    camera.SetExplicitProjectionTransformMatrix(whole)
    camera.UseExplicitProjectionTransformMatrixOn()


def light_of(light):
    result = vtkLight()
    result.SetLightTypeToSceneLight()
    if light["type"] == "directional":
        result.SetPositional(False)
        result.SetPosition(0, 0, 0)
        result.SetFocalPoint(light["direction"])
    else:
        result.SetPositional(True)
        result.SetPosition(light["position"])
        result.SetFocalPoint(light["target"])
        result.SetConeAngle(light["cone_deg"] / 2)
    return result


def in_sequence(*passes):
    """A camera pass that runs the passes in sequence."""
    collection, sequence, camera = vtkRenderPassCollection(), vtkSequencePass(), vtkCameraPass()
    for one in passes:
        collection.AddItem(one)
    sequence.SetPasses(collection)
    camera.SetDelegatePass(sequence)
    return camera


def near_and_far(map_from_world, light_camera):
    """Near and far of the map along its axis, from the position of Gnomon's map camera [m]."""
    z, w = map_from_world[2], map_from_world[3]
    if numpy.linalg.norm(w[:3]) > 1e-9:
        share = numpy.dot(z[:3], w[:3]) / numpy.dot(w[:3], w[:3])
        rest = z[3] - share * w[3]
        return -rest / share, -rest / (share - 1)
    length = numpy.linalg.norm(z[:3])
    start = (-z[3] / length) - numpy.dot(z[:3] / length, light_camera["position"])
    return start, start + 1 / length


class Stage:
    """A window that draws one scene after the other."""

    def __init__(self):
        self.window = vtkXOpenGLRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.renderer = None

    def device(self):
        """The name of the GL renderer."""
        self.window.Render()
        lines = dict(line.split(":", 1) for line in self.window.ReportCapabilities().splitlines() if ":" in line)
        return lines["OpenGL renderer string"].strip()

    def open(self, scene):
        if self.renderer is not None:
            self.window.RemoveRenderer(self.renderer)
        self.renderer = vtkOpenGLRenderer()
        self.renderer.SetAutomaticLightCreation(False)
        self.window.AddRenderer(self.renderer)
        self.scene = scene
        objects = glb.read_objects(scene["mesh"]["file"])
        self.corners = glb.corners(objects)
        self.actors = {name: actor_of(*mesh) for name, mesh in objects.items()}
        for actor in self.actors.values():
            self.renderer.AddActor(actor)

    def _render(self, passes, shows, hidden):
        for name, actor in self.actors.items():
            actor.SetVisibility(name not in hidden)
            actor.GetShaderProperty().GetFragmentCustomUniforms().SetUniformi("shows", shows)
        self.renderer.SetPass(passes)
        self.window.Render()

    def _pixels(self, image):
        values = vtkFloatArray()
        self.window.GetRGBAPixelData(0, 0, image[0] - 1, image[1] - 1, 0, values)
        return vtk_to_numpy(values).reshape(image[1], image[0], 4)[::-1]

    def _prepare(self, engine):
        image = self.scene["image"]["width"], self.scene["image"]["height"]
        window = image if engine["Window"] == "image" else (max(image), max(image))
        self.window.SetSize(*window)
        camera = camera_of(self.scene["camera"], self.corners)
        look_into_corner(camera, image, window)
        self.renderer.SetActiveCamera(camera)
        self.renderer.RemoveAllLights()
        light = light_of(self.scene["light"])
        light.SetShadowAttenuation(engine["ShadowAttenuation"])
        self.renderer.AddLight(light)
        for actor in self.actors.values():
            actor.GetProperty().SetFrontfaceCulling(engine["FrontfaceCulling"])
            actor.GetProperty().SetBackfaceCulling(engine["BackfaceCulling"])
        return image, window

    def _bake(self, resolution):
        """Bakes the map, and returns the passes that bake it and look it up, for use in later frames."""
        baker, looker = vtkShadowMapBakerPass(), vtkShadowMapPass()
        baker.SetResolution(resolution)
        looker.SetShadowMapBakerPass(baker)
        self._render(in_sequence(baker), COLOURS, self.scene["mesh"]["no_cast"])
        return baker, looker

    def _map_from_world(self, looker):
        """The matrix of the last lookup from world space to [0, 1]; None without a lookup."""
        values = looker.ShadowMapTransforms()
        if not values:
            return None
        seen = self.renderer.GetActiveCamera().GetViewTransformMatrix()
        view = [[seen.GetElement(i, j) for j in range(4)] for i in range(4)]
        return numpy.reshape(values, (4, 4)).T @ view

    def _pictures(self, image, drawing, without_shadows, hidden):
        """Mask and `valid` from VTK's own pictures, with unmodified shaders."""
        for actor in self.actors.values():
            actor.GetShaderProperty().ClearAllShaderReplacements()
        pictures = []
        for passes in (drawing, without_shadows):
            self._render(passes, COLOURS, hidden)
            pictures.append(self._pixels(image)[..., 0].astype(float))
        for actor in self.actors.values():
            add_own_outputs(actor.GetShaderProperty())
        return mask_of_pictures(*pictures)

    def draw(self, engine, shadow_map, is_picture):
        """The frame's planes by their names in a case, and near and far of the map [m], None without a map."""
        image, window = self._prepare(engine)
        baker, looker = self._bake(shadow_map["resolution"])
        without_shadows = in_sequence(vtkLightsPass(), vtkOpaquePass())
        drawing = in_sequence(looker) if engine["ShadowMapPass"] else without_shadows
        # VTK's own framebuffer has 8 bits, and is only replaced when the window changes its size.
        self.window.GetRenderFramebuffer().PopulateFramebuffer(*window, True, 1, VTK_FLOAT, True, 32, 0, False)
        hidden = self.scene["mesh"]["no_receive"]
        self._render(drawing, POSITION, hidden)
        position = self._pixels(image)
        self._render(drawing, SHADOW, hidden)
        # Outside its map, VTK's lookup multiplies the light by 8; a mask is at most 1.
        shadow = numpy.minimum(self._pixels(image)[..., 0], 1)
        matrix = self._map_from_world(looker)
        shows = position[..., 3] == 1
        planes = {"position": numpy.where(shows[..., None], position[..., :3], math.nan).astype(numpy.float32),
                  "shadow": numpy.where(shows, shadow, 0).astype(numpy.float32)}
        if is_picture:
            planes |= self._pictures(image, drawing, without_shadows, hidden)
        for one in (baker, looker, drawing, without_shadows):
            one.ReleaseGraphicsResources(self.window)
        near, far = (None, None) if matrix is None else near_and_far(matrix, shadow_map.get("light_camera"))
        return planes, near, far

    def close(self):
        self.window.Finalize()
