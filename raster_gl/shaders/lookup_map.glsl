// What a lookup reads, for bias terms and the filter's visibility(): receivers, the map, one
// comparison. OUTSIDE_CLAMP, OUTSIDE_VERDICT, REVERSED, SPOT and GRADIENTS are defined by the program
// that compiles this.
//
// Every bias is in the arithmetic lit iff fl(r − fl(b + fl(slope·tan θ))) <= d, in float32 and
// without contraction ("precise"), so that all biases can be answered from r, d and tan θ alone.
layout(binding = 0) uniform usampler2D receiver_triangle;
layout(binding = 1) uniform sampler2D receiver_light_clip;
layout(binding = 2) uniform sampler2D receiver_world_position;
layout(binding = 3) uniform sampler2D map;              // as the filter samples it
layout(binding = 4) uniform sampler2DShadow map_compare; // for filters that GL compares
layout(binding = 5) uniform samplerBuffer normals;       // unit, by triangle
layout(binding = 6) uniform sampler2D filtered_map;      // what a prefilter made of it

uniform mat4 light_clip_from_world;
uniform vec3 light; // SPOT: its position, else the unit vector towards it
uniform float resolution; // in texels

#if GRADIENTS
vec2 uv_dx; // change of uv to the next pixel along a row,
vec2 uv_dy; // and along a column
#endif

const float not_a_depth = uintBitsToFloat(0x7FC00000u);

// The surface point that a pixel shows.
struct Receiver {
    vec3 position;   // in the world
    vec3 normal;     // geometric, unit
    vec3 to_light;   // unit
    vec4 clip;       // its light clip position
    float cosine;    // of the angle between normal and to_light
    float tan_theta; // of the angle between them, or of its supplement: not negative, finite
};

bool is_lit(float r, float b, float d)
{
#if REVERSED
    precise float biased = r + b;
    return biased >= d;
#else
    precise float biased = r - b;
    return biased <= d;
#endif
}

bool is_inside(vec2 texel)
{
    return all(greaterThanEqual(texel, vec2(0.0))) && all(lessThan(texel, vec2(resolution)));
}

// Depth of the texel whose integer coordinates are `texel`; false where the border mode decides.
bool fetch_depth(vec2 texel, out float d)
{
#if OUTSIDE_CLAMP
    texel = clamp(texel, vec2(0.0), vec2(resolution - 1.0));
#else
    if (!is_inside(texel)) {
        d = not_a_depth;
        return false;
    }
#endif
    d = texelFetch(map, ivec2(texel), 0).r;
    return true;
}

