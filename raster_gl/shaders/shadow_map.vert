// A vertex seen by the light, or by whatever camera the matrix belongs to.
layout(location = 0) in vec3 position;

uniform mat4 clip_from_world;

invariant gl_Position;

void main()
{
    gl_Position = clip_from_world * vec4(position, 1.0);
}
