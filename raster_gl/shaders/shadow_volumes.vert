// The scene's vertices, and after them as many again that are carried away from the light: the far ends
// of shadow volumes. `light` is (L, 1), or of a directional light (-l, 0) where it travels along l:
// infinitely far ends are homogeneous points with w = 0. FINITE: parallel rays of an orthographic camera
// all meet such points in one, so that ends are `directional_end` away instead, or `extension` times the
// vertex's own distance from the light.
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
