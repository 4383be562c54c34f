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
# What a draw shows: a value of the uniform `shows`, in which the shaders below differ from VTK's own.
COLOURS, POSITION, SHADOW = 0, 1, 2
# Where VTK's shadow pass has computed a light's share, and where its fragment shader ends.
LIGHT_USED = "diffuse += (df * factor0.r * lightColor0);"
LAST_TAG = "//VTK::Coincident::Impl"


def add_own_outputs(properties):
    """The world position and VTK's own `factor0.r` in place of colours. Where there is no shadow map, there is no factor, and 1."""
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
    mapper.SetVBOShiftScaleMethod(0)  # vertexMC has the mesh's own bits then
    actor = vtkActor()
    actor.SetMapper(mapper)
    add_own_outputs(actor.GetShaderProperty())
    return actor


def camera_of(camera, corners):
    """The camera, with the near plane at a thousandth of the scene's diagonal, or of the way to the eye where that is longer."""
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
    """Lets the camera draw the image into the lower left of the window, to the pixel: a projection of its own."""
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
    """The passes one after the other, as the renderer's camera sees them."""
    collection, sequence, camera = vtkRenderPassCollection(), vtkSequencePass(), vtkCameraPass()
    for one in passes:
        collection.AddItem(one)
    sequence.SetPasses(collection)
    camera.SetDelegatePass(sequence)
    return camera


def near_and_far(map_from_world, light_camera):
    """Where the planes of the map's depths lie along its axis, from where Gnomon's own map has its camera [m]."""
    z, w = map_from_world[2], map_from_world[3]
    if numpy.linalg.norm(w[:3]) > 1e-9:
        share = numpy.dot(z[:3], w[:3]) / numpy.dot(w[:3], w[:3])
        rest = z[3] - share * w[3]
        return -rest / share, -rest / (share - 1)
    length = numpy.linalg.norm(z[:3])
    start = (-z[3] / length) - numpy.dot(z[:3] / length, light_camera["position"])
    return start, start + 1 / length


class Stage:
    """One window, in which scenes are drawn one after the other."""

    def __init__(self):
        self.window = vtkXOpenGLRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.renderer = None

    def device(self):
        """GL's name of what draws."""
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
        """The map of what casts, and the pass that looks it up, for another frame than the one that baked it."""
        baker, looker = vtkShadowMapBakerPass(), vtkShadowMapPass()
        baker.SetResolution(resolution)
        looker.SetShadowMapBakerPass(baker)
        self._render(in_sequence(baker), COLOURS, self.scene["mesh"]["no_cast"])
        return baker, looker

    def _map_from_world(self, looker):
        """The matrix of the last lookup, into [0, 1] of texels and depth; None where nothing was looked up."""
        values = looker.ShadowMapTransforms()
        if not values:
            return None
        seen = self.renderer.GetActiveCamera().GetViewTransformMatrix()
        view = [[seen.GetElement(i, j) for j in range(4)] for i in range(4)]
        return numpy.reshape(values, (4, 4)).T @ view

    def _pictures(self, image, drawing, without_shadows, hidden):
        """Mask and `valid` of VTK's own pictures of its own material, by shaders that nothing is added to."""
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
        """The frame's planes by their names in a case, and near and far of the map, None where there is none [m]."""
        image, window = self._prepare(engine)
        baker, looker = self._bake(shadow_map["resolution"])
        without_shadows = in_sequence(vtkLightsPass(), vtkOpaquePass())
        drawing = in_sequence(looker) if engine["ShadowMapPass"] else without_shadows
        # VTK's own has 8 bits. It makes another one where the window changes its size alone.
        self.window.GetRenderFramebuffer().PopulateFramebuffer(*window, True, 1, VTK_FLOAT, True, 32, 0, False)
        hidden = self.scene["mesh"]["no_receive"]
        self._render(drawing, POSITION, hidden)
        position = self._pixels(image)
        self._render(drawing, SHADOW, hidden)
        # Outside its map VTK's lookup multiplies the light by 8. A mask is a share, and there it takes nothing away.
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
