// The vertex shader of all programs that draw the scene, for the camera or the light. ALONG_RAY
// outputs the world position, ALONG_AXIS the light distance. RECEIVERS outputs the lookup's inputs:
// light clip coordinates are computed per vertex and interpolated, and the lookup divides by w.
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
