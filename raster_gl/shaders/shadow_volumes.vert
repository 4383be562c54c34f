// The scene's vertices, then a copy of each moved away from the light: the far ends of shadow
// volumes. `light` is (L, 1), or (-l, 0) for a directional light that travels along l. Infinite
// ends are homogeneous points with w = 0. FINITE: an orthographic camera sees all such points as
// one, so ends are `directional_end` away, or `extension` times the vertex's distance from the
// light.
layout(location = 0) in vec3 position;

uniform mat4 camera_clip_from_world;
uniform vec4 light;
uniform vec3 directional_end;
uniform float extension;
uniform uint first_far_vertex;

invariant gl_Position;

void main()
{
    vec4 world = vec4(position, 1.0);
    if (uint(gl_VertexID) >= first_far_vertex) {
#if FINITE
        world.xyz = position + (light.w == 0.0 ? directional_end : extension * (position - light.xyz));
#else
        world = vec4(position * light.w - light.xyz, 0.0);
#endif
    }
    gl_Position = camera_clip_from_world * world;
}
