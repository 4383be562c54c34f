// The shadow test of one pixel. Follows lookup_map.glsl; the bias terms, which define
//
//     vec4 moved_position(Receiver receiver)         the light clip position to look up
//     vec3 offset_of_position(Receiver receiver)     with WRITES_TERMS: how far its point is moved
//     float moved_depth(Receiver receiver, float r)  the receiver's depth to compare
//     float varied_bias(Receiver receiver)           b of the bias curve, scaled by each map's
//                                                    bias_scale, if there is one
//     float added_bias(Receiver receiver)            the bias added to it: the slope term
//     vec2 gradient_of_taps(Receiver receiver)       with TAP_GRADIENT: of taps' reference depths
//
// and the filter's snippet, which defines
//
//     float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)
//
// The program that compiles this defines MAPS, PRIMITIVES, KERNEL_ACROSS, INTERPOLATES, OUTSIDE_CLAMP,
// OUTSIDE_VERDICT, REVERSED, POSITIONAL, CUBE, ALONG_RAY, ALONG_AXIS, SCATTERED, POSITION_OF_PIXEL,
// FINDS_CRITICAL_BIAS, WRITES_TERMS, BLENDS, SCALED_BIAS and HAS_RECEIVER_DEPTH. FINDS_CRITICAL_BIAS finds
// the smallest bias for which the verdict reaches `lit_from`, for methods without a formula; the verdict
// rises with the bias. WRITES_TERMS writes the effect of the terms that the curve does not vary instead of
// the verdict.
#if WRITES_TERMS
layout(location = 0) out vec4 moved_out;    // of the point [m], and of the depth towards the light
layout(location = 1) out vec2 gradient_out; // of taps' reference depths, per texel
#elif FINDS_CRITICAL_BIAS
uniform float lit_from;
layout(location = 0) out float critical_out; // −∞: always lit; +∞: never
#else
layout(location = 0) out vec4 sample_out; // r, d, tan θ, verdict
layout(location = 1) out vec2 texel_out;  // uv · resolution, from the map's lower left
#if MAPS > 1
layout(location = 2) out uint map_out;
#endif
#if BLENDS
layout(location = 3) out vec2 next_texel_out; // in the next map, if it is blended in; else NaN
#endif
#if SCATTERED
layout(location = 4) out vec2 kernel_axis_out; // of the own map's lookup, in texels
#endif
#endif

#if HAS_RECEIVER_DEPTH
layout(binding = 7) uniform sampler2D receiver_depth;
#if BLENDS
layout(binding = 9) uniform sampler2D next_receiver_depth; // in the next map
#endif
#endif
#if SCALED_BIAS
uniform float bias_scale[MAPS];
#endif

// Whether the whole footprint of an interpolating lookup, kernels about 2 × 2 texels, lies beyond
// the map.
bool footprint_is_outside(vec2 texel)
{
#if CUBE
    return false;
#else
    const float reach = float(KERNEL_ACROSS / 2);
    vec2 first = floor(texel - 0.5);
    return any(lessThan(first, vec2(-1.0 - reach))) ||
           any(greaterThanEqual(first, vec2(resolution + reach)));
#endif
}

// A lookup position in a map, and the depths compared there.
struct Place {
    float r;
    vec2 uv;
    vec2 texel;
    bool is_border; // the border mode decides, for any bias
#if TAP_GRADIENT
    vec2 gradient; // of the taps' reference depths
#endif
#if SCATTERED
    vec2 kernel_axis;
#endif
};

// The inputs of a verdict, except the bias that a curve varies.
struct Lookup {
    Place place; // in the map of map_index
    float slope_term;
#if BLENDS
    Place next;  // in the one after it
    float share; // of the next one's verdict
#endif
};

// The verdict in map map_index. d is undefined where the border mode decides.
float verdict_of_map(Place place, float varied, float slope_term, out float d)
{
    d = not_a_depth;
    if (place.is_border) {
        return OUTSIDE_VERDICT;
    }
#if SCALED_BIAS
    precise float scaled = varied * bias_scale[map_index];
    precise float bias = scaled + slope_term;
#else
    precise float bias = varied + slope_term;
#endif
#if TAP_GRADIENT
    tap_gradient = place.gradient;
#endif
#if SCATTERED
    kernel_axis = place.kernel_axis;
#endif
    return visibility(place.r, bias, place.uv, place.texel, d);
}

// Blends the verdicts of two maps. Rounds each product and sum, so that the result is monotonic in
// both verdicts, and 1 where both are 1.
float mixed_verdict(Lookup lookup, float varied, out float d)
{
    float own = verdict_of_map(lookup.place, varied, lookup.slope_term, d);
#if BLENDS
    if (lookup.share > 0.0) {
        float next_d;
        ++map_index;
        float next = verdict_of_map(lookup.next, varied, lookup.slope_term, next_d);
        --map_index;
        precise float kept = 1.0 - lookup.share;
        precise float of_own = kept * own;
        precise float of_next = lookup.share * next;
        precise float mixed = of_own + of_next;
        return mixed;
    }
#endif
    return own;
}

#if FINDS_CRITICAL_BIAS
const float infinity = uintBitsToFloat(0x7F800000u);
const int largest_rank = 0x7F000000; // rank of the largest finite float32; infinity is next

// Biases are 0 and the normal float32 of either sign, ranked in ascending order; 0 has rank 0.
float bias_of_rank(int rank)
{
    if (rank == 0) {
        return 0.0;
    }
    uint magnitude = uint(abs(rank)) + 0x007FFFFFu;
    return uintBitsToFloat(rank < 0 ? magnitude | 0x80000000u : magnitude);
}

bool is_lit_with(int rank, Lookup lookup)
{
    float d;
    return mixed_verdict(lookup, bias_of_rank(rank), d) >= lit_from;
}

float critical_bias(Lookup lookup)
{
    if (is_lit_with(-largest_rank, lookup)) {
        return -infinity;
    }
    int shadowed = -largest_rank;
    int lit = largest_rank + 1;
    for (int i = 0; i < 32; ++i) { // there are fewer than 2^32 ranks
        int middle = (shadowed & lit) + ((shadowed ^ lit) >> 1); // their mean, rounded down
        if (is_lit_with(middle, lookup)) {
            lit = middle;
        } else {
            shadowed = middle;
        }
    }
    return bias_of_rank(lit);
}
#endif

void write_nothing()
{
#if WRITES_TERMS
    moved_out = vec4(0.0);
    gradient_out = vec2(0.0);
#elif FINDS_CRITICAL_BIAS
    critical_out = 0.0;
#else
    sample_out = vec4(0.0);
    texel_out = vec2(0.0);
#if MAPS > 1
    map_out = 0u;
#endif
#if BLENDS
    next_texel_out = vec2(not_a_depth);
#endif
#if SCATTERED
    kernel_axis_out = vec2(0.0);
#endif
#endif
}

// The distance that the map stores for a point instead of GL's depth.
#if ALONG_RAY
float measure_of(vec4 clip)
{
    precise vec3 from_light = vec3(clip.x * half_side[0], clip.y * half_side[1], clip.w);
    precise float square = from_light.x * from_light.x + from_light.y * from_light.y;
    square = square + from_light.z * from_light.z;
    return sqrt(square);
}
#elif ALONG_AXIS
float measure_of(vec4 clip)
{
    return clip.w;
}
#endif

// The receiver before any offset.
vec4 light_clip_of(ivec2 pixel)
{
#if POSITION_OF_PIXEL
    vec3 position = texelFetch(receiver_world_position, pixel, 0).xyz;
    return clip_position(light_clip_from_world[map_index], position);
#else
    return texelFetch(receiver_light_clip, pixel, 0);
#endif
}

#if GRADIENTS
bool shows(ivec2 pixel, uint triangle)
{
    return all(greaterThanEqual(pixel, ivec2(0))) &&
           all(lessThan(pixel, textureSize(receiver_triangle, 0))) &&
           texelFetch(receiver_triangle, pixel, 0).r == triangle;
}

vec2 uv_of(ivec2 pixel)
{
    vec4 clip = light_clip_of(pixel);
    return clip.xy / clip.w * 0.5 + 0.5;
}

// The change of uv to the next pixel, or from the previous one, if it shows the same triangle; else
// 0. Hardware derivatives would depend on the position in the 2 × 2 quad.
vec2 uv_change(ivec2 pixel, ivec2 towards, uint triangle)
{
    if (shows(pixel + towards, triangle)) {
        return uv_of(pixel + towards) - uv_of(pixel);
    }
    return shows(pixel - towards, triangle) ? uv_of(pixel) - uv_of(pixel - towards) : vec2(0.0);
}
#endif

// The lookup position of a receiver in map map_index; for a cube the face may change.
Place place_in_map(Receiver receiver)
{
    Place place;
    vec4 clip = moved_position(receiver);
#if CUBE
    clip = on_its_face(clip);
#endif
    precise vec3 ndc = clip.xyz / clip.w;
    precise vec2 uv = ndc.xy * 0.5 + 0.5;
    precise vec2 texel = uv * resolution;
#if CUBE
    // The seam itself is this face's.
    texel = min(texel, uintBitsToFloat(floatBitsToUint(resolution) - 1u));
#endif
#if ALONG_RAY || ALONG_AXIS
    precise float r = stored_measure(measure_of(clip));
    r = moved_depth(receiver, r);
    bool beyond_far = !(r <= 1.0);
#elif REVERSED
    precise float r = ndc.z;
    r = moved_depth(receiver, r);
    bool beyond_far = !(r >= 0.0);
#else
    precise float r = ndc.z * 0.5 + 0.5;
    r = moved_depth(receiver, r);
    bool beyond_far = !(r <= 1.0);
#endif
    place.uv = uv;
    place.texel = texel;
    place.r = r;
    place.is_border = false;
#if TAP_GRADIENT
    place.gradient = gradient_of_taps(receiver);
#endif
#if SCATTERED
    place.kernel_axis = kernel_axis_at(receiver);
#endif
#if !OUTSIDE_CLAMP
    place.is_border = beyond_far || !(clip.w > 0.0);
#if INTERPOLATES
    place.is_border = place.is_border || footprint_is_outside(texel);
#endif
#endif
    return place;
}

// The depth that border mode `clamp` compares.
float compared_depth(float r)
{
#if OUTSIDE_CLAMP
    return clamp(r, 0.0, 1.0);
#else
    return r;
#endif
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    write_nothing();
    uint triangle = texelFetch(receiver_triangle, pixel, 0).r;
    if (triangle == 0xFFFFFFFFu) {
        return;
    }
#if PRIMITIVES
    receiver_primitive = triangle;
#endif
    Receiver receiver;
    receiver.position = texelFetch(receiver_world_position, pixel, 0).xyz;
#if MAPS > 1
    map_index = chosen_map(receiver.position);
#endif
    vec4 clip = light_clip_of(pixel);
#if GRADIENTS
    uv_dx = uv_change(pixel, ivec2(1, 0), triangle);
    uv_dy = uv_change(pixel, ivec2(0, 1), triangle);
#endif
    receiver.normal = texelFetch(normals, int(triangle)).xyz;
#ifdef VERTEX_NORMALS
    receiver.vertex_normal = vertex_normal_of(pixel, receiver.normal);
#endif
#if POSITIONAL
    receiver.to_light = normalize(light - receiver.position);
#else
    receiver.to_light = light;
#endif
    receiver.clip = clip;
    receiver.cosine = dot(receiver.normal, receiver.to_light);
    float tan_theta = tan_of_angle(receiver.normal, receiver.to_light);
    receiver.tan_theta = tan_theta;

    Lookup lookup;
#if WRITES_TERMS
    moved_out.xyz = offset_of_position(receiver); // before a cube face is chosen again
#endif
    lookup.place = place_in_map(receiver);
#if WRITES_TERMS
    float from_zero = moved_depth(receiver, 0.0);
    moved_out.w = REVERSED != 0 ? from_zero : -from_zero;
#if TAP_GRADIENT
    gradient_out = lookup.place.gradient;
#endif
#else
    lookup.slope_term = added_bias(receiver);
#if HAS_RECEIVER_DEPTH
    lookup.place.r = texelFetch(receiver_depth, pixel, 0).r;
#endif
    lookup.place.r = compared_depth(lookup.place.r);
#if !FINDS_CRITICAL_BIAS
    texel_out = lookup.place.texel;
#if MAPS > 1
    map_out = uint(map_index);
#endif
#if SCATTERED
    kernel_axis_out = lookup.place.kernel_axis;
#endif
#endif
#if BLENDS
    lookup.share = share_of_next(receiver.position);
    if (lookup.share > 0.0) {
        ++map_index;
        receiver.clip = clip_position(light_clip_from_world[map_index], receiver.position);
        lookup.next = place_in_map(receiver);
        --map_index;
#if HAS_RECEIVER_DEPTH
        lookup.next.r = texelFetch(next_receiver_depth, pixel, 0).r;
#endif
        lookup.next.r = compared_depth(lookup.next.r);
#if !FINDS_CRITICAL_BIAS
        next_texel_out = lookup.next.texel;
#endif
    }
#endif

#if FINDS_CRITICAL_BIAS
    critical_out = critical_bias(lookup);
#else
    float d;
    float verdict = mixed_verdict(lookup, varied_bias(receiver), d);
    sample_out = vec4(lookup.place.r, d, tan_theta, verdict);
#endif
#endif
}
