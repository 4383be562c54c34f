// A vertex seen by the light, or by whatever camera the matrix belongs to. ALONG_RAY hands the world
// position on, ALONG_AXIS the light distance.
layout(location = 0) in vec3 position;

uniform mat4 clip_from_world;

invariant gl_Position;

#if ALONG_RAY
out vec3 world_position;
#elif ALONG_AXIS
out float light_distance;
#endif

void main()
{
#if ALONG_RAY
    world_position = position;
#endif
    gl_Position = clip_from_world * vec4(position, 1.0);
#if ALONG_AXIS
    light_distance = gl_Position.w;
#endif
}
