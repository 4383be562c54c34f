"""The bias of a mesh: what is wrong with its shadow map, and which constant bias to take.

    python3 bias_of_a_mesh.py [model.glb]
"""

import sys

import gnomon

job = sys.argv[1] if len(sys.argv) > 1 else "columns"
result = gnomon.compare(
    job,
    image={"width": 640, "height": 360},
    shadow_map={"resolution": 1024, "depth_format": "d24"},
)

for sentence in result.findings:
    print("*", sentence)

print()
print("bias        false shadow [px]   false lit [px]")
for bias in (0, 0.0001, 0.001, 0.01):
    print(f"{bias:<8g} {result.curve.false_shadow(bias):>19,} {result.curve.false_lit(bias):>16,}")

recommended = result.to_dict()["bias_curve"]["recommended"]
if recommended:
    print(f"\nrecommended: bias.constant = {recommended['bias']:.2g}")

result.save_picture("bias_of_a_mesh.png")
print("bias_of_a_mesh.png shows the shadows, the true ones and the errors")
