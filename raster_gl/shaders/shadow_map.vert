// A vertex seen by the light, or by whatever camera the matrix belongs to. DISTANCE hands the world
// position on, LINEAR the light distance.
layout(location = 0) in vec3 position;

uniform mat4 clip_from_world;

invariant gl_Position;

#if DISTANCE
out vec3 world_position;
#elif LINEAR
out float light_distance;
#endif

void main()
{
#if DISTANCE
    world_position = position;
#endif
    gl_Position = clip_from_world * vec4(position, 1.0);
#if LINEAR
    light_distance = gl_Position.w;
#endif
}
