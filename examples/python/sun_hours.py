"""Hours of sun in a courtyard, on the longest and the shortest day.

    python3 sun_hours.py [latitude_deg longitude_deg]

Every point of the ground asks each ten minutes whether the sun reaches it. The answers are exact: no offset keeps rays
off the ground, and none lets light in under a wall.
"""

import sys

import gnomon
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

latitude_deg, longitude_deg = map(float, sys.argv[1:3]) if len(sys.argv) > 2 else (52.52, 13.40)
DEPTH, WIDTH, HEIGHT = 20, 30, 9  # of the yard [m], and of the houses around it
MINUTES = 10


def box(low, high):
    """Corners and triangles of an axis-aligned box."""
    corners = np.array([[(low, high)[i >> axis & 1][axis] for axis in range(3)] for i in range(8)], float)
    sides = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    return corners, [triangle for a, b, c, d in sides for triangle in ((a, b, c), (a, c, d))]


houses = {  # north is −z; the yard has a passage in the south
    "north": ((-8, 0, -8), (WIDTH + 8, HEIGHT, 0)),
    "west": ((-8, 0, 0), (0, HEIGHT, DEPTH)),
    "east": ((WIDTH, 0, 0), (WIDTH + 8, HEIGHT, DEPTH)),
    "south, left": ((-8, 0, DEPTH), (12, HEIGHT, DEPTH + 8)),
    "south, right": ((18, 0, DEPTH), (WIDTH + 8, HEIGHT, DEPTH + 8)),
}
vertices, triangles, objects = [], [], {}
for name, (low, high) in houses.items():
    corners, faces = box(low, high)
    triangles += [[len(vertices) + corner for corner in face] for face in faces]
    vertices += corners.tolist()
    objects[name] = len(faces)
scene = gnomon.Scene(vertices, triangles, objects)

x, z = np.meshgrid(np.arange(0.125, WIDTH, 0.25), np.arange(0.125, DEPTH, 0.25))
points = np.stack([x, np.zeros_like(x), z], axis=-1).reshape(-1, 3)


def sun_hours(date):
    """Of each point of the ground [h], and how long the sun is up."""
    times = np.datetime64(date) + np.arange(0, 24 * 60, MINUTES).astype("timedelta64[m]")
    _, elevation_deg = gnomon.sun_position(latitude_deg, longitude_deg, times)
    directions = gnomon.sun_direction(latitude_deg, longitude_deg, times)
    hours = np.zeros(len(points))
    for direction in directions[elevation_deg > 0]:
        hours += gnomon.truth(scene, points, {"direction": direction}).lit * (MINUTES / 60)
    return hours.reshape(x.shape), (elevation_deg > 0).sum() * MINUTES / 60


figure, axes = plt.subplots(1, 2, figsize=(10, 3.8), sharey=True, layout="constrained")
for axis, date in zip(axes, ("2026-06-21", "2026-12-21")):
    hours, day = sun_hours(date)
    print(f"{date}: {hours.mean():.1f} h of {day:.1f} h on average, {hours.min():.1f} to {hours.max():.1f} h")
    shown = axis.imshow(hours, cmap="cividis", vmin=0, extent=(0, WIDTH, DEPTH, 0))
    axis.set(title=f"{date}: the sun is up for {day:.1f} h", xlabel="east [m]")
    figure.colorbar(shown, ax=axis, label="hours of sun [h]", shrink=0.85)
axes[0].set_ylabel("south [m]")
figure.suptitle(f"Sun in a yard among houses of {HEIGHT} m, at latitude {latitude_deg:.2f}°, longitude {longitude_deg:.2f}°")
figure.savefig("sun_hours.png", dpi=150)
print("sun_hours.png shows the ground from above")
