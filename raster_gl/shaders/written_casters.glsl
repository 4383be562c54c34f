// Writes values that GL does not store by itself. ALONG_RAY or ALONG_AXIS: the value of
// stored_measure.glsl instead of depth. Converted formats: codes, from depth_codes.glsl.
// PRIMITIVES: the triangle index. Precedes scene.frag.
//
// UNORM: an n-bit unsigned normalised code, code = floor(z·(2^n − 1) + ½), exactly: z has 24
// significant bits and 2^n − 1 at most 24, so product and sum fit in a double's 53 bits wherever
// the floor can depend on them. RED_FLOAT, RED_HALF and BYTES: a colour, as the float32 value of
// its code. That value may not be monotonic in z, so GL's depth test uses z itself.
#define IS_COLOUR (RED_FLOAT || RED_HALF || BYTES)
#if IS_COLOUR
layout(location = 0) out float colour;
#endif
#if UNORM || IS_COLOUR
layout(location = 1) out uint code;
layout(location = 2) out float unquantised_z;
#endif
#if PRIMITIVES
layout(location = 3) out uint primitive; // the triangle's index in the scene
#endif
#if UNORM
uniform uint largest_code; // 2^n − 1
#endif

#if ALONG_RAY
in vec3 world_position;

uniform vec3 light; // its position

float stored_value()
{
    vec3 from_light = world_position - light;
    return clamp(stored_measure(length(from_light)), 0.0, 1.0);
}
#elif ALONG_AXIS
in float light_distance;

float stored_value()
{
    return clamp(stored_measure(light_distance), 0.0, 1.0);
}
#else
float stored_value()
{
    return gl_FragCoord.z;
}
#endif

void write_fragment(uint triangle)
{
    float z = stored_value();
#if PRIMITIVES
    primitive = triangle;
#endif
#if UNORM
    double steps = double(z) * double(largest_code);
    code = uint(floor(steps + 0.5LF));
    unquantised_z = z;
    gl_FragDepth = float(double(code) / double(largest_code));
#elif ALONG_RAY || ALONG_AXIS
    gl_FragDepth = z;
#endif
#if IS_COLOUR
    unquantised_z = z > 0.0 ? min(z, 1.0) : 0.0; // clamped as in a depth buffer, without −0
#endif
#if RED_FLOAT
    code = floatBitsToUint(unquantised_z);
    colour = unquantised_z;
#elif RED_HALF
    code = half_of_float(unquantised_z);
    colour = float_of_half(code);
#elif BYTES
    code = packed_of_float(unquantised_z);
    colour = float_of_packed(code);
#endif
}
