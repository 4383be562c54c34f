// The scene's vertices, and after them as many again that are carried away from the light: the far ends
// of shadow volumes. `light` is (L, 1), or of a directional light (-l, 0) where it travels along l:
// infinitely far ends are homogeneous points with w = 0. FINITE: an orthographic camera sees those of a
// directional light edge-on, so that they are `finite_end` away instead.
layout(location = 0) in vec3 position;

uniform mat4 camera_clip_from_world;
uniform vec4 light;
uniform vec3 finite_end;
uniform uint first_far_vertex;

invariant gl_Position;

void main()
{
    vec4 world = vec4(position, 1.0);
    if (uint(gl_VertexID) >= first_far_vertex) {
#if FINITE
        world.xyz = position + finite_end;
#else
        world = vec4(position * light.w - light.xyz, 0.0);
#endif
    }
    gl_Position = camera_clip_from_world * world;
}
