"""A renderer that draws by ray casting, and misbehaves in the way that its first argument names.

The second argument marks its processes for the tests. Nothing but Python is needed. Where FAKE_LOG names
a file, each start adds a line to it.

Its key `bias` does what biases do, where the way is "biased": without it one lit pixel in eight is
shadowed, with it shadows lose what is nearer than four times its length to what casts them. Where it is "hides", soft
shadows also lose every other pixel, and so the errors there.
"""

import json
import math
import os
import signal
import struct
import subprocess
import sys
import time

WAY = sys.argv[1]
MARK = sys.argv[2]
KEYS = [
    {"name": "bias", "type": "number", "range": [-1, 1], "default": 0, "unit": "depth",
     "help": "does nothing to a ray"},
    {"name": "smooth", "type": "boolean", "default": False, "help": "does nothing either"},
    {"name": "kind", "type": "choice", "values": ["soft", "hard"], "default": "hard",
     "help": "nor does this"},
]


def say(answer):
    sys.stdout.write(json.dumps(answer) + "\n")
    sys.stdout.flush()


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def unit(a):
    length = math.sqrt(dot(a, a))
    return (a[0] / length, a[1] / length, a[2] / length)


def read_triangles(path):
    """The triangles of a .glb file as Gnomon writes them: positions and indices, no transforms."""
    with open(path, "rb") as file:
        data = file.read()
    size = struct.unpack_from("<I", data, 12)[0]
    scene = json.loads(data[20:20 + size])
    binary = data[28 + size:]
    triangles = []
    for mesh in scene["meshes"]:
        primitive = mesh["primitives"][0]
        columns = []
        for number, letter, width in ((primitive["attributes"]["POSITION"], "f", 3),
                                      (primitive["indices"], "I", 1)):
            accessor = scene["accessors"][number]
            view = scene["bufferViews"][accessor["bufferView"]]
            columns.append(struct.unpack_from(f"<{accessor['count'] * width}{letter}", binary,
                                              view["byteOffset"]))
        points = [columns[0][3 * i:3 * i + 3] for i in range(len(columns[0]) // 3)]
        corners = [points[i] for i in columns[1]]
        triangles += [corners[i:i + 3] for i in range(0, len(corners), 3)]
    return [(a, sub(b, a), sub(c, a)) for a, b, c in triangles]


def hit(triangle, origin, way):
    """How far along the ray the triangle is met; None: it is not."""
    corner, side, other = triangle
    p = cross(way, other)
    det = dot(side, p)
    if abs(det) < 1e-12:
        return None
    t = sub(origin, corner)
    u = dot(t, p) / det
    q = cross(t, side)
    v = dot(way, q) / det
    if u < 0 or v < 0 or u + v > 1:
        return None
    return dot(other, q) / det


def draw_pixels(scene, triangles):
    """P and how far the nearest blocker is [m] of each pixel, row by row from the top."""
    camera, light, image = scene["camera"], scene["light"], scene["image"]
    eye = camera["eye"]
    forward = unit(sub(camera["target"], eye))
    right = unit(cross(forward, camera["up"]))
    up = cross(right, forward)
    half = math.tan(math.radians(camera["vertical_fov_deg"]) / 2)
    width, height = image["width"], image["height"]
    pixels = []
    for y in range(height):
        for x in range(width):
            sx = (2 * (x + 0.5) / width - 1) * width / height * half
            sy = (1 - 2 * (y + 0.5) / height) * half
            way = tuple(forward[k] + sx * right[k] + sy * up[k] for k in range(3))
            hits = [(t, i) for i, triangle in enumerate(triangles)
                    for t in [hit(triangle, eye, way)] if t is not None and t > 1e-6]
            if not hits:
                pixels.append((math.nan, math.nan, math.nan, math.inf))
                continue
            t, first = min(hits)
            point = tuple(eye[k] + t * way[k] for k in range(3))
            if light["type"] == "directional":
                to_light, far = tuple(-c for c in light["direction"]), math.inf
            else:
                to_light, far = sub(light["position"], point), 1.0
            blockers = [s for i, triangle in enumerate(triangles) if i != first
                        for s in [hit(triangle, point, to_light)]
                        if s is not None and 1e-9 < s < far]
            nearest = min(blockers, default=math.inf) * math.sqrt(dot(to_light, to_light))
            pixels.append(point + (nearest,))
    return pixels


def shadowed(pixels, width, engine):
    """P and the mask."""
    drawn = []
    for i, (*point, gap) in enumerate(pixels):
        is_lit = gap == math.inf
        if WAY == "hides" and engine["kind"] == "soft" and i % 2 == 0:
            point = [math.nan] * 3
        if WAY in ("biased", "hides"):
            is_lit = gap > 1e9 or gap < 4 * engine["bias"]
            if engine["bias"] < 0.001 and (3 * (i % width) + i // width) % 8 == 0:
                is_lit = False
        drawn.append((*point, 1.0 if is_lit else 0.0))
    return drawn


def write_npy(path, height, width, rows):
    """Rows of equally many numbers as NumPy's format has them."""
    count = len(rows[0])
    header = ("{'descr': '<f4', 'fortran_order': False, 'shape': "
              f"({height}, {width}, {count}), }}")
    header += " " * (63 - (len(header) + 10) % 64) + "\n"
    with open(path, "wb") as file:
        file.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode())
        file.write(struct.pack(f"<{len(rows) * count}f", *[n for row in rows for n in row]))


class Renderer:
    def __init__(self):
        self.scene = None
        self.triangles = None
        self.drawn = {}
        self.first = None
        self.draws = 0

    def hello(self, request):
        answer = {"id": request["id"], "protocol": 1, "name": "fake", "version": "1.0",
                  "device": "rays in Python", "keys": KEYS}
        if "FAKE_LOG" in os.environ:
            with open(os.environ["FAKE_LOG"], "a", encoding="utf-8") as log:
                log.write("started\n")
        if WAY == "dies_at_hello":
            sys.exit("no display to open")
        if WAY == "hangs_at_hello":
            time.sleep(1000)
        if WAY == "talks":
            print("Loading shaders ...")
        if WAY == "other_protocol":
            answer["protocol"] = 2
        if WAY == "key_twice":
            answer["keys"] = KEYS + KEYS[:1]
        if WAY == "default_outside":
            answer["keys"] = [dict(KEYS[0], default=7)]
        if WAY == "no_device":
            del answer["device"]
        if WAY == "name_twice":
            sys.stdout.write(json.dumps(answer)[:-1] + ', "name": "other"}\n')
            return sys.stdout.flush()
        if WAY == "closes_stdout":
            os.close(1)
            time.sleep(1000)
        if WAY == "forks":
            subprocess.Popen([sys.executable, __file__, "sleeps", MARK], start_new_session=True)
        return say(answer)

    def open(self, request):
        self.scene = request["open"]
        if WAY == "lights" and self.scene["light"]["type"] == "point":
            return say({"id": request["id"], "error": {"light.type": "there are no cubes here"}})
        self.triangles = read_triangles(self.scene["mesh"]["file"])
        if WAY == "bad_conventions":
            return say({"id": request["id"], "ok": True, "conventions": {"up": "w"}})
        return say({"id": request["id"], "ok": True})

    def refusals(self, draw):
        known = {"shadow_map": {"resolution", "near", "far", "light_clip_from_world",
                                "vertical_fov_deg", "half_extent", "light_camera", "maps"},
                 "lookup": set(), "bias": set(), "engine": {key["name"] for key in KEYS}}
        return {f"{table}.{key}": "rays have none" for table, keys in draw.items()
                for key in keys if key not in known.get(table, ())}

    def draw(self, request):
        number = request["id"]
        self.draws += 1
        refused = self.refusals(request["draw"])
        if refused and WAY != "says_yes":
            return say({"id": number, "error": refused if WAY != "blames_nobody" else "no"})
        if WAY == "dies_at_draw":
            sys.stderr.write("assertion failed: shadow atlas\n")
            sys.stderr.flush()
            os.kill(os.getpid(), signal.SIGSEGV)
        if WAY == "dies_of_soft" and request["draw"]["engine"]["kind"] == "soft":
            sys.exit("soft shadows need a newer driver")
        if WAY == "is_slow":
            time.sleep(0.2)
        if WAY == "hangs_at_draw":
            time.sleep(1000)
        if WAY == "floods_stdout":
            while True:
                sys.stdout.write("x" * 65536)
        if WAY == "floods_stderr":
            for _ in range(400):
                sys.stderr.write("warning: " + "y" * 65536 + "\n")
        if WAY == "floods_for_ever":
            while True:
                sys.stderr.write("z" * 4096 + "\n")
        if WAY == "dies_of_fork":
            subprocess.Popen([sys.executable, __file__, "sleeps", MARK], start_new_session=True)
            sys.exit("the GPU process is gone")
        key = json.dumps([self.scene["camera"], self.scene["light"], self.scene["image"]])
        if key not in self.drawn:
            self.drawn[key] = draw_pixels(self.scene, self.triangles)
        return self.write_frame(number, os.path.dirname(request["frame"]), request["frame"],
                                shadowed(self.drawn[key], self.scene["image"]["width"],
                                         request["draw"]["engine"]))

    def write_frame(self, number, folder, frame, pixels):
        width, height = self.scene["image"]["width"], self.scene["image"]["height"]
        self.first = self.first or pixels
        answer = {"id": number, "ok": True, "seconds": 0.01,
                  "files": {"position": "position.npy", "shadow": "mask.npy"}}
        if WAY == "old_frame" and len(self.first) == len(pixels):
            pixels = self.first
        if WAY == "links_old_files" and self.draws > 2:
            for name in answer["files"].values():
                os.link(os.path.join("kept", name), os.path.join(folder, name))
            return say(answer)
        seen = next(i for i, pixel in enumerate(pixels) if not math.isnan(pixel[0]))
        if WAY == "nan_mask":
            pixels[seen] = pixels[seen][:3] + (math.nan,)
        if WAY == "inverted":
            pixels = [pixel[:3] + (1 - pixel[3],) for pixel in pixels]
        if WAY == "unequal":
            pixels[seen] = pixels[seen][:3] + (1 / self.draws,)
        if WAY == "remembers" and self.draws > 6:
            pixels[seen] = pixels[seen][:3] + (1 - pixels[seen][3],)
        if WAY == "wrong_size":
            width, pixels = width - 1, pixels[:(width - 1) * height]
        write_npy(os.path.join(folder, "position.npy"), height, width,
                  [pixel[:3] for pixel in pixels])
        if WAY != "half_a_frame":
            write_npy(os.path.join(folder, "mask.npy"), height, width,
                      [pixel[3:] for pixel in pixels])
        if WAY == "links_old_files" and self.draws == 1:
            os.mkdir("kept")
            for name in answer["files"].values():
                os.link(os.path.join(folder, name), os.path.join("kept", name))
        if WAY in ("no_frame", "truncated_exr", "link", "pipe"):
            del answer["files"]
        if WAY == "truncated_exr":
            with open(frame, "wb") as file:
                file.write(b"\x76\x2f\x31\x01\x02\x00\x00\x00channels\x00chlist\x00")
        if WAY == "link":
            os.symlink("/etc/passwd", frame)
        if WAY == "pipe":
            os.mkfifo(frame)
        if WAY == "file_outside":
            answer["files"]["shadow"] = "../../../../etc/passwd"
        if WAY == "writes_outside":
            with open("../stray.txt", "w") as file:
                file.write("here")
            with open("temporary.txt", "w") as file:
                file.write("this is allowed")
        if WAY == "locks_folder":
            os.makedirs("locked/inside", exist_ok=True)
            os.chmod("locked", 0)
        if WAY == "no_seconds":
            del answer["seconds"]
        if WAY == "unknown_member":
            answer["file"] = {}
        if WAY == "bad_case":
            answer["case"] = {"lookup": {"filter": "blurry"}}
        if WAY == "says_method":
            answer["case"] = {"method": {"name": "pcf", "taps": 5}, "bias": {"normal_m": 0.01}}
        if WAY == "other_id":
            answer["id"] = number + 1
        say(answer)
        if WAY == "answers_twice":
            say(answer)
        return None

    def run(self):
        while True:
            line = sys.stdin.readline()
            request = json.loads(line) if line else {"close": True}
            for name in ("hello", "open", "draw"):
                if name in request:
                    getattr(self, name)(request)
            if "close" in request:
                if WAY == "stays":
                    time.sleep(1000)
                sys.exit(1 if WAY == "fails_at_close" else 0)


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    if WAY == "sleeps":
        time.sleep(1000)
    Renderer().run()
