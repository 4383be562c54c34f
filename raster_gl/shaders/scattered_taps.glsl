// Places the taps of scattered kernels. Follows lookup_map.glsl. The program that compiles this
// defines TAPS (the count), RADIUS_IN_METRES, TURNED and ROTATIONS. The CPU places the same taps
// from the kernel axis that the lookup writes.
uniform float tap_places[2 * TAPS]; // x and y in a kernel of radius 1, the one nearest to its middle first
uniform float kernel_radius;        // in texels, or in metres
uniform float texel_width_m[MAPS]; // for POSITIONAL at ζ = 1
#if RADIUS_IN_METRES
uniform float largest_radius; // in texels
#endif
#if TURNED
uniform float rotations[2 * ROTATIONS]; // cosines and sines
#endif

vec2 kernel_axis; // of the lookup: where the kernel's (1, 0) is, in texels

// A hash of the pixel position.
uint hash_of_pixel()
{
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    uint hash = pixel.x * 0x9E3779B1u + pixel.y * 0x85EBCA77u;
    hash = (hash ^ (hash >> 16)) * 0x7FEB352Du;
    hash = (hash ^ (hash >> 15)) * 0x846CA68Bu;
    return hash ^ (hash >> 16);
}

// For a receiver in the map of map_index.
vec2 kernel_axis_at(Receiver receiver)
{
#if RADIUS_IN_METRES
#if POSITIONAL
    precise float width_m = texel_width_m[map_index] * receiver.clip.w;
#else
    precise float width_m = texel_width_m[map_index];
#endif
    precise float radius = clamp(kernel_radius / width_m, 0.0, largest_radius);
#else
    precise float radius = kernel_radius;
#endif
#if TURNED
    int turn = int(hash_of_pixel() % uint(ROTATIONS));
    precise vec2 axis = radius * vec2(rotations[2 * turn], rotations[2 * turn + 1]);
    return axis;
#else
    return vec2(radius, 0.0);
#endif
}

// The position of tap i of a lookup at `texel`; rounds each product and sum.
vec2 tap_place(vec2 texel, int i)
{
    precise vec2 along_x = tap_places[2 * i] * kernel_axis;
    precise vec2 along_y = tap_places[2 * i + 1] * vec2(-kernel_axis.y, kernel_axis.x);
    precise vec2 from_middle = along_x + along_y;
    precise vec2 place = texel + from_middle;
    return place;
}

// Integer coordinates of the texel that tap i reads.
vec2 tap_texel(vec2 texel, int i)
{
    return floor(tap_place(texel, i));
}
