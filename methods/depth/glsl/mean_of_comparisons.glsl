// The verdict with the whole bias, in [0, 1]: the mean of TAPS_ACROSS × TAPS_ACROSS comparisons.
// @param d  the depth of the tap in the middle
float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)
{
    vec2 centre = floor(texel);
    fetch_depth(centre, d);
    float lit_taps = 0.0;
    for (int y = -TAPS_ACROSS / 2; y <= TAPS_ACROSS / 2; ++y) {
        for (int x = -TAPS_ACROSS / 2; x <= TAPS_ACROSS / 2; ++x) {
            float tap;
            bool fetched = fetch_depth(centre + vec2(x, y), tap);
            float reference = depth_at_tap(r, centre + vec2(x, y) + 0.5 - texel);
            lit_taps += fetched ? (is_lit(reference, bias, tap) ? 1.0 : 0.0) : OUTSIDE_VERDICT;
        }
    }
    return lit_taps / float(TAPS_ACROSS * TAPS_ACROSS);
}
