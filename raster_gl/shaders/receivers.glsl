// Writes the G-buffer: triangle index, light clip position and world position. Precedes scene.frag.
in vec4 light_clip;
in vec3 world_position;
#if VERTEX_NORMALS
in vec3 world_normal;
#endif

layout(location = 0) out uint receiver_triangle;
layout(location = 1) out vec4 receiver_light_clip;
layout(location = 2) out vec4 receiver_world_position;
#if VERTEX_NORMALS
layout(location = 3) out vec4 receiver_vertex_normal;
#endif

void write_fragment(uint triangle)
{
    receiver_triangle = triangle;
    receiver_light_clip = light_clip;
    receiver_world_position = vec4(world_position, 1.0);
#if VERTEX_NORMALS
    receiver_vertex_normal = vec4(world_normal, 0.0);
#endif
}
