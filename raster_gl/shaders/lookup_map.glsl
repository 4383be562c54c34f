// The inputs of a lookup, for bias terms and the filter's visibility(): receivers, the map, a depth
// comparison. TAP_GRADIENT, MAPS, CUBE, ALONG_RAY, ALONG_AXIS, OUTSIDE_CLAMP, OUTSIDE_VERDICT,
// REVERSED, POSITIONAL, PRIMITIVES and GRADIENTS are defined by the program that compiles this.
//
// A receiver is lit iff fl(r − fl(b + fl(slope·tan θ))) <= d, in float32 without contraction
// ("precise"), so that r, d and tan θ give the verdict for any bias.
layout(binding = 0) uniform usampler2D receiver_triangle;
layout(binding = 1) uniform sampler2D receiver_light_clip;
layout(binding = 2) uniform sampler2D receiver_world_position;
layout(binding = 5) uniform samplerBuffer normals; // unit normal of each triangle
#ifdef VERTEX_NORMALS
layout(binding = 11) uniform sampler2D receiver_vertex_normal; // not normalised
#endif
// The light's map, or its maps as layers: as the filter samples it, for GL's comparison, and
// prefiltered. Cube faces are bound as a cube map if GL filters them.
#if MAPS > 1
layout(binding = 3) uniform sampler2DArray map;
#if CUBE
layout(binding = 4) uniform samplerCubeShadow map_compare;
layout(binding = 8) uniform samplerCube map_interpolated;
#else
layout(binding = 4) uniform sampler2DArrayShadow map_compare;
#endif
layout(binding = 6) uniform sampler2DArray filtered_map;
layout(binding = 10) uniform usampler2DArray primitive_map; // with PRIMITIVES
int map_index; // the map that the pixel reads
#else
layout(binding = 3) uniform sampler2D map;
layout(binding = 4) uniform sampler2DShadow map_compare;
layout(binding = 6) uniform sampler2D filtered_map;
layout(binding = 10) uniform usampler2D primitive_map; // with PRIMITIVES
const int map_index = 0;
#endif

uniform mat4 light_clip_from_world[MAPS];
uniform vec3 light; // POSITIONAL: its position, else the unit vector towards it
uniform float resolution; // in texels
#if ALONG_RAY
uniform float half_side[2]; // of the map at ζ = 1, along u and v
#endif

#if GRADIENTS
vec2 uv_dx; // change of uv to the next pixel along a row,
vec2 uv_dy; // and along a column
#endif

// Rounds each product and sum, in this order.
vec4 clip_position(mat4 clip_from_world, vec3 position)
{
    precise vec4 clip = clip_from_world[0] * position.x;
    clip = clip + clip_from_world[1] * position.y;
    clip = clip + clip_from_world[2] * position.z;
    clip = clip + clip_from_world[3];
    return clip;
}

#if CUBE
vec3 direction_of(vec3 on_face);
ivec3 texel_across_seams(ivec2 texel);

float depth_of_texel(ivec2 texel)
{
    return texelFetch(map, texel_across_seams(texel), 0).r;
}
float interpolated_depth(vec2 uv)
{
    return textureLod(map_interpolated, direction_of(vec3(uv * 2.0 - 1.0, 1.0)), 0.0).r;
}
float compared_by_gl(vec2 uv, float reference)
{
    // At a cube corner a driver's three weights may sum to more than 1.
    return min(textureGrad(map_compare, vec4(direction_of(vec3(uv * 2.0 - 1.0, 1.0)), reference),
                           vec3(0.0), vec3(0.0)),
               1.0);
}
#elif MAPS > 1
float depth_of_texel(ivec2 texel)
{
    return texelFetch(map, ivec3(texel, map_index), 0).r;
}
float interpolated_depth(vec2 uv)
{
    return textureLod(map, vec3(uv, map_index), 0.0).r;
}
float compared_by_gl(vec2 uv, float reference)
{
    return textureGrad(map_compare, vec4(uv, map_index, reference), vec2(0.0), vec2(0.0));
}
#else
float depth_of_texel(ivec2 texel)
{
    return texelFetch(map, texel, 0).r;
}
float interpolated_depth(vec2 uv)
{
    return textureLod(map, uv, 0.0).r;
}
float compared_by_gl(vec2 uv, float reference)
{
    return textureLod(map_compare, vec3(uv, reference), 0.0);
}
#endif

// Depths of the four texels around a texel corner, in GL's gather order: upper left, upper right,
// lower right, lower left. Beyond the map they are the border values that GL interpolates.
vec4 gathered_depths(vec2 corner)
{
#if CUBE
    ivec2 upper_right = ivec2(corner);
    return vec4(depth_of_texel(upper_right - ivec2(1, 0)), depth_of_texel(upper_right),
                depth_of_texel(upper_right - ivec2(0, 1)), depth_of_texel(upper_right - 1));
#elif MAPS > 1
    return textureGather(map, vec3(corner / resolution, map_index));
#else
    return textureGather(map, corner / resolution);
#endif
}

// Samples the prefiltered map.
vec4 filtered(vec2 uv)
{
#if MAPS > 1
    vec3 at = vec3(uv, map_index);
#else
    vec2 at = uv;
#endif
#if GRADIENTS
    return textureGrad(filtered_map, at, uv_dx, uv_dy);
#else
    return textureLod(filtered_map, at, 0.0);
#endif
}

const float not_a_depth = uintBitsToFloat(0x7FC00000u);

// The surface point that a pixel shows.
struct Receiver {
    vec3 position;   // in the world
    vec3 normal;     // geometric, unit
#ifdef VERTEX_NORMALS
    vec3 vertex_normal; // interpolated from the vertices, unit, on the side of normal
#endif
    vec3 to_light;   // unit
    vec4 clip;       // its light clip position
    float cosine;    // of the angle between normal and to_light
    float tan_theta; // of the angle or its supplement: finite, not negative
};

#ifdef VERTEX_NORMALS
// The unit vertex normal of a receiver; the geometric normal if the vertex normals cancel. Rounds
// each product and sum, so that all lookup programs agree.
vec3 vertex_normal_of(ivec2 pixel, vec3 geometric)
{
    vec3 sum = texelFetch(receiver_vertex_normal, pixel, 0).xyz;
    precise float square = sum.x * sum.x + sum.y * sum.y + sum.z * sum.z;
    precise vec3 normal = sum / sqrt(square);
    precise float side =
        sum.x * geometric.x + sum.y * geometric.y + sum.z * geometric.z;
    if (!(square > 0.0)) {
        return geometric;
    }
    return side < 0.0 ? -normal : normal;
}
#endif

#ifdef PLANE_GRADIENT
// The depth gradient of the receiver's plane, per texel along u and v. A plane stays a plane in the
// map.
vec2 plane_gradient(Receiver receiver)
{
    mat4 m = light_clip_from_world[map_index];
    vec3 ndc = receiver.clip.xyz / receiver.clip.w;
    vec3 w = vec3(m[0].w, m[1].w, m[2].w);
    vec3 x = vec3(m[0].x, m[1].x, m[2].x) - ndc.x * w;
    vec3 y = vec3(m[0].y, m[1].y, m[2].y) - ndc.y * w;
    vec3 z = vec3(m[0].z, m[1].z, m[2].z) - ndc.z * w;
    float facing = dot(receiver.normal, cross(x, y));
    vec2 slope = -vec2(dot(receiver.normal, cross(y, z)), dot(receiver.normal, cross(z, x))) / facing;
#if REVERSED
    slope *= 2.0; // r is ndc.z, not half of it
#endif
    return facing == 0.0 ? vec2(0.0) : slope / resolution;
}
#endif

#if TAP_GRADIENT
vec2 tap_gradient; // of the pixel, in its map
#endif

// The reference depth of a tap whose texel centre is this many texels from the lookup position.
float depth_at_tap(float r, vec2 texels)
{
#if TAP_GRADIENT
    precise float depth = r + (tap_gradient.x * texels.x + tap_gradient.y * texels.y);
    return depth;
#else
    return r;
#endif
}

// The reference depth of 2 × 2 taps that GL compares at once.
float depth_of_gather(float r)
{
#if TAP_GRADIENT
    float rise = 2.0 * (abs(tap_gradient.x) + abs(tap_gradient.y));
#if REVERSED
    precise float depth = r + rise;
#else
    precise float depth = r - rise;
#endif
    return depth;
#else
    return r;
#endif
}

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

// Whether a texel with these integer coordinates exists, across a cube's seams as well; border mode
// `clamp` moves to the nearest.
bool is_on_map(inout vec2 texel)
{
#if CUBE
    return true;
#elif OUTSIDE_CLAMP
    texel = clamp(texel, vec2(0.0), vec2(resolution - 1.0));
    return true;
#else
    return is_inside(texel);
#endif
}

// Fetches the depth of `texel`; false if the border mode decides.
bool fetch_depth(vec2 texel, out float d)
{
    if (!is_on_map(texel)) {
        d = not_a_depth;
        return false;
    }
    d = depth_of_texel(ivec2(texel));
    return true;
}

// Fetches the prefiltered value of `texel`; false if the border mode decides.
bool fetch_filtered(vec2 texel, out vec4 kept)
{
    kept = vec4(not_a_depth);
    if (!is_on_map(texel)) {
        return false;
    }
#if CUBE
    kept = texelFetch(filtered_map, texel_across_seams(ivec2(texel)), 0);
#elif MAPS > 1
    kept = texelFetch(filtered_map, ivec3(texel, map_index), 0);
#else
    kept = texelFetch(filtered_map, ivec2(texel), 0);
#endif
    return true;
}

#if PRIMITIVES
uint receiver_primitive; // the triangle that the pixel shows

// Whether the texel shows the receiver's own triangle. Precondition: `fetch_depth` returned true.
bool shows_receiver(vec2 texel)
{
    is_on_map(texel);
#if MAPS > 1
    return texelFetch(primitive_map, ivec3(texel, map_index), 0).r == receiver_primitive;
#else
    return texelFetch(primitive_map, ivec2(texel), 0).r == receiver_primitive;
#endif
}
#endif

