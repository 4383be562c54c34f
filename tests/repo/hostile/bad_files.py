"""Job files and scene files that are garbage, lie about sizes, or hold absurd values."""

import os
import random
import re
import struct
import subprocess

from case import TINY, Case, compare, job_of, write

NOISE = random.Random(1).randbytes(4096)


def bad_jobs():
    """Garbage, encodings, sizes and values in job files."""
    texts = {
        "noise": NOISE, "empty name": b"=1\n", "NUL": b"[scene]\nbuiltin = \"wall\0\"\n",
        "UTF-16": "[scene]\n".encode("utf-16"), "bad UTF-8": b"[scene]\nbuiltin = \"\xff\xfe\"\n",
        "endless text": b"[scene]\nbuiltin = \"wall", "deep arrays": b"a = " + b"[" * 100_000,
        "long key": b"a" * 1_000_000 + b" = 1\n", "twice": b"[scene]\nbuiltin=\"wall\"\nbuiltin=\"wall\"\n",
        "date": b"[image]\nwidth = 2020-01-01\n", "table for a number": b"[image.width]\na=1\n",
        "huge integer": b"[image]\nwidth = 99999999999999999999999\n", "negative": b"[image]\nwidth = -5\n",
        "huge image": b"[image]\nwidth = 2147483647\nheight = 2147483647\n",
        "many axes": b"[scene]\nbuiltin=\"wall\"\n[sweep]\n\"bias.constant\" = {from=0, to=1, count=99999999999}\n",
        "a folder as scene": b"[scene]\nfile = \"/\"\n", "a device as scene": b"[scene]\nfile = \"/dev/zero.obj\"\n",
        "nan": b"[bias]\nconstant = nan\n", "inf": b"[camera]\neye = [inf, 0, 0]\n",
    }
    for name, text in texts.items():
        command, prepare = job_of(text)
        if name == "many axes":
            command = ["sweep", "{d}/job.toml", "--out", "{d}/run"]
        yield Case(f"job: {name}", command, (2,), "gnomon: ", prepare, is_quick=name in ("noise", "deep arrays"))


def glb(json_text, length=None):
    body = json_text.encode() + b" " * (-len(json_text) % 4)
    return struct.pack("<4sIIII", b"glTF", 2, length or 20 + len(body), len(body), 0x4E4F534A) + body


PLY = "ply\nformat ascii 1.0\nelement vertex {v}\nproperty float x\nproperty float y\nproperty float z\n" \
      "element face {f}\nproperty list uchar int vertex_indices\nend_header\n{body}"


def obj(x):
    return f"v 0 0 0\nv 1 0 0\nv 0 {x} 0\nf 1 2 3\n"


def linked_buffer(d):
    (d / "b.bin").symlink_to("/etc/passwd")
    (d / "a.gltf").write_text('{"asset":{"version":"2.0"},"buffers":[{"uri":"b.bin","byteLength":99}]}')


def bad_scenes():
    """Scene files that are garbage, lie about sizes, or hold NaN and infinity."""
    for ending in ("obj", "ply", "gltf", "glb"):
        for kind, data in (("noise", NOISE), ("empty", b""), ("text", b"hello\n"), ("zeros", bytes(1000))):
            yield Case(f"{ending}: {kind}", ["compare", "{d}/a." + ending, *TINY], (2,), "", write("a." + ending, data),
                       is_quick=kind == "noise")
    for x in ("nan", "inf", "-inf", "1e30", "1e999"):
        yield Case(f"obj: vertex {x}", ["compare", "{d}/a.obj", *TINY], (2,), "", write("a.obj", obj(x)))
    files = {
        "obj: index beyond": ("a.obj", obj("1").replace("1 2 3", "1 2 99")),
        "obj: no area": ("a.obj", obj("0")),
        "ply: vertices that are not there": ("a.ply", PLY.format(v=4_000_000_000, f=1, body="0 0 0\n3 0 1 2\n")),
        "ply: index beyond": ("a.ply", PLY.format(v=3, f=1, body="0 0 0\n1 0 0\n0 1 0\n3 0 1 77\n")),
        "ply: cut": ("a.ply", PLY.format(v=3, f=1, body="0 0 0\n1 0")),
        "glb: length lies": ("a.glb", glb('{"asset":{"version":"2.0"}}', 0xFFFFFFF0)),
        "glb: cut": ("a.glb", glb('{"asset":{"version":"2.0"}}')[:25]),
        "gltf: buffer out of the folder": ("a.gltf", '{"asset":{"version":"2.0"},"buffers":'
                                           '[{"uri":"../../../../etc/passwd","byteLength":99}]}'),
        "gltf: buffer that lies": ("a.gltf", '{"asset":{"version":"2.0"},"buffers":[{"byteLength":9e18}]}'),
        "gltf: deep": ("a.gltf", "[" * 200_000),
    }
    for name, (file, data) in files.items():
        yield Case(name, ["compare", "{d}/" + file, *TINY], (2,), "", write(file, data))
    yield Case("gltf: link out of the folder", ["compare", "{d}/a.gltf", *TINY], (2,), "", linked_buffer)
    yield Case("scene: a pipe", ["compare", "{d}/a.obj", *TINY], (2,), "", lambda d: os.mkfifo(d / "a.obj"))
    yield Case("scene: a folder", ["compare", "{d}/a.obj", *TINY], (2,), "", lambda d: (d / "a.obj").mkdir())
    yield Case("job: a folder", ["compare", "{d}/job.toml"], (2,), "", lambda d: (d / "job.toml").mkdir())
    yield Case("job: nothing", ["compare", "{d}/job.toml"], (2,), "job.toml", is_quick=True)
    yield Case("job: a loop of links", ["compare", "{d}/job.toml"], (2,), "",
               lambda d: (d / "job.toml").symlink_to(d / "job.toml"))


VALUES = ("0", "-1", "1e-300", "1e300", "nan", "inf", "-inf", "1e-8", "-0.0", "9e15", "true", '"x"', "[]")


def absurd_values(gnomon):
    """Every key with absurd values."""
    text = subprocess.run([gnomon, "init"], capture_output=True, text=True, check=True).stdout
    table = ""
    for line in text.splitlines():
        line = line.lstrip("# ")
        if match := re.match(r"\[(\w+)\]", line):
            table = match[1]
        elif (match := re.match(r"(\w+) *= *(.*)", line)) and table and table != "sweep":
            key = f"{table}.{match[1]}"
            for value in VALUES:
                value = f"[{value}, 1, 1]" if match[2].startswith("[") and value != "[]" else value
                for scene in ("sphere-plane", "yard"):
                    yield Case(f"key: {scene}: {key} = {value}", compare("--set", f"{key}={value}", scene=scene),
                               (0, 2), "")
