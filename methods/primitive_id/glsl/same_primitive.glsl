// Lit where the texel that holds the receiver shows the receiver's own triangle. No bias changes that.
// @param d  the texel's depth, which decided what it shows
float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)
{
    vec2 holds_receiver = floor(texel);
    if (!fetch_depth(holds_receiver, d)) {
        return OUTSIDE_VERDICT;
    }
    return shows_receiver(holds_receiver) ? 1.0 : 0.0;
}
