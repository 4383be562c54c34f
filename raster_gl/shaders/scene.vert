// A vertex of the scene, seen by the camera, by the light, or by whoever else the matrix belongs to. Every program that
// draws the scene's triangles begins here. ALONG_RAY hands the world position on, ALONG_AXIS the light distance. RECEIVERS
// hands on what the lookup reads of a receiver: the light's clip coordinates are computed here and interpolated, as
// shadow-map lessons do; the lookup divides by w.
layout(location = 0) in vec3 position;
#if VERTEX_NORMALS
layout(location = 1) in vec3 normal;
#endif

uniform mat4 clip_from_world;

invariant gl_Position;

#if RECEIVERS
uniform mat4 light_clip_from_world;
out vec4 light_clip;
#endif
#if RECEIVERS || ALONG_RAY
out vec3 world_position;
#elif ALONG_AXIS
out float light_distance;
#endif
#if VERTEX_NORMALS
out vec3 world_normal;
#endif

void main()
{
    gl_Position = clip_from_world * vec4(position, 1.0);
#if RECEIVERS
    light_clip = light_clip_from_world * vec4(position, 1.0);
#endif
#if RECEIVERS || ALONG_RAY
    world_position = position;
#elif ALONG_AXIS
    light_distance = gl_Position.w;
#endif
#if VERTEX_NORMALS
    world_normal = normal;
#endif
}
