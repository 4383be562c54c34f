// A receiver seen by the camera. The light's clip coordinates are computed here and interpolated,
// as shadow-map lessons do; the lookup divides by w.
layout(location = 0) in vec3 position;
#if VERTEX_NORMALS
layout(location = 1) in vec3 normal;
#endif

uniform mat4 camera_clip_from_world;
uniform mat4 light_clip_from_world;

invariant gl_Position;
out vec4 light_clip;
out vec3 world_position;
#if VERTEX_NORMALS
out vec3 world_normal;
#endif

void main()
{
    gl_Position = camera_clip_from_world * vec4(position, 1.0);
    light_clip = light_clip_from_world * vec4(position, 1.0);
    world_position = position;
#if VERTEX_NORMALS
    world_normal = normal;
#endif
}
