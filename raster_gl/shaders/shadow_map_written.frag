// What GL does not store by itself: with DISTANCE the distance to the light over far, in place of
// depth; with UNORM either as an n-bit unsigned normalised code, code = floor(z·(2^n − 1) + ½),
// exactly: z has 24 significant bits and 2^n − 1 at most 24, so product and sum fit in a double's 53
// bits wherever the floor can depend on them.
#if UNORM
layout(location = 0) out uint code;
layout(location = 1) out float unquantised_z;

uniform uint largest_code; // 2^n − 1
#endif

#if DISTANCE
in vec3 world_position;

uniform vec3 light; // its position
uniform float far;

float stored_value()
{
    vec3 from_light = world_position - light;
    return min(length(from_light) / far, 1.0);
}
#else
float stored_value()
{
    return gl_FragCoord.z;
}
#endif

void main()
{
    float z = stored_value();
#if UNORM
    double steps = double(z) * double(largest_code);
    code = uint(floor(steps + 0.5LF));
    unquantised_z = z;
    gl_FragDepth = float(double(code) / double(largest_code));
#else
    gl_FragDepth = z;
#endif
}
