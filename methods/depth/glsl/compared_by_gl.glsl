// The verdict with the whole bias, in [0, 1]: 2 × 2 comparisons that GL makes and interpolates.
// @param d  the depth of the texel that holds the point
float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)
{
    fetch_depth(floor(texel), d);
#if REVERSED
    precise float reference = depth_of_gather(r) + bias;
#else
    precise float reference = depth_of_gather(r) - bias;
#endif
    return compared_by_gl(uv, reference);
}
