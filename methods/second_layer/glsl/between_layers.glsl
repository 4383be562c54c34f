// The depth to compare with, and that of the first surface. If nothing lies behind the first
// surface, the second is the far plane.
uniform float largest_offset; // from the first surface, in depth units

vec4 texel(ivec2 at)
{
    float first = source(at, 0).r;
    float second = source(at, 1).r;
#if SECOND_ALONE
    return vec4(second, first, 0.0, 0.0);
#else
    precise float half_gap = 0.5 * (second - first);
    precise float compared = first + clamp(half_gap, -largest_offset, largest_offset);
    return vec4(compared, first, 0.0, 0.0);
#endif
}
