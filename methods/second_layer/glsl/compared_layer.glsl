// The verdict with the whole bias, 0 or 1: one comparison with the depth computed from the texel's
// layers.
// @param d  the depth of the first surface
float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)
{
    vec2 holds_receiver = floor(texel);
    vec4 kept;
    if (!fetch_filtered(holds_receiver, kept)) {
        d = not_a_depth;
        return OUTSIDE_VERDICT;
    }
    d = kept.g;
    return is_lit(r, bias, kept.r) ? 1.0 : 0.0;
}
