"""A small sweep of a scene file that names another file."""
from sweep_case import SweepCase

# A tent over a square; normals at its corners, and a material in a file of its own.
OBJ = """mtllib tent.mtl
o tent
usemtl grey
v -1 0 -1
v 1 0 -1
v 1 0 1
v -1 0 1
v 0 1.5 0
vn -0.6 0.8 0
vn 0.6 0.8 0
f 1//1 5//2 2//2
f 2//2 5//1 3//2
f 3//2 5//1 4//1
f 4//1 5//2 1//1
"""
JOB = """scene.file = "tent.obj"
scene.ground = true
image.width = 64
image.height = 36
camera.eye = [4, 3, 5]
camera.target = [0, 0.5, 0]
light.type = "directional"
light.direction = [-1, -2, -0.5]
bias.normal_from = "vertices"
bias.normal_texels = 1
[sweep]
shadow_map.resolution = [16, 24, 32]
bias.constant = [0, 0.01]
"""


class TentCase(SweepCase):
    axes = []
    job = JOB

    def write_scenes(self):
        (self.folder / "tent.obj").write_text(OBJ)
        (self.folder / "tent.mtl").write_text("newmtl grey\nKd 0.5 0.5 0.5\n")
