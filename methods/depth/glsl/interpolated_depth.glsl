// The verdict with the whole bias, in [0, 1]: one comparison with the mean of 2 × 2 depths that GL
// interpolates.
// @param d  the interpolated depth
float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)
{
    d = interpolated_depth(uv);
    return is_lit(r, bias, d) ? 1.0 : 0.0;
}
