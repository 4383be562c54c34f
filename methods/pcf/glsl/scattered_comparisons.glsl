// The verdict with the whole bias, in [0, 1]: the mean of the comparisons with TAPS texels, which lie
// as the kernel says (scattered_taps.glsl). Weights are whole multiples of 2^-16: their sums are exact.
// @param d  the depth of the tap in the middle
#if WEIGHTED
uniform float tap_weights[TAPS];
#endif

float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)
{
    fetch_depth(floor(texel), d);
    float lit = 0.0;
    for (int i = 0; i < TAPS; ++i) {
        float tap;
        bool fetched = fetch_depth(tap_texel(texel, i), tap);
        float answer = fetched ? (is_lit(r, bias, tap) ? 1.0 : 0.0) : OUTSIDE_VERDICT;
#if WEIGHTED
        lit += tap_weights[i] * answer;
#else
        lit += answer;
#endif
    }
#if WEIGHTED
    return lit;
#else
    return lit / float(TAPS);
#endif
}
