// The verdict with the whole bias, in [0, 1]: the mean of the comparisons with TAPS taps, placed by
// the kernel (scattered_taps.glsl). A tap reads its texel, or with BILINEAR_TAPS the four nearest,
// blended. Weights are multiples of 2^-16, so their sums are exact.
// @param d  the depth of the texel that is looked up
#if WEIGHTED
uniform float tap_weights[TAPS];
#endif

float answer_of_texel(float r, float bias, vec2 texel)
{
    float tap;
    bool fetched = fetch_depth(texel, tap);
    return fetched ? (is_lit(r, bias, tap) ? 1.0 : 0.0) : OUTSIDE_VERDICT;
}

#if BILINEAR_TAPS
// The weighted mean of the four nearest texels' answers, and that of 1. Products and sums of values
// that do not fall with the bias do not fall either.
vec2 answer_at(float r, float bias, vec2 place)
{
    vec2 shifted = place - 0.5;
    vec2 first = floor(shifted);
    vec2 upper = shifted - first;
    precise vec2 lower = 1.0 - upper;
    precise vec2 rows[2];
    for (int y = 0; y < 2; ++y) {
        float left = answer_of_texel(r, bias, first + vec2(0.0, y));
        float right = answer_of_texel(r, bias, first + vec2(1.0, y));
        precise vec2 row = lower.x * vec2(left, 1.0) + upper.x * vec2(right, 1.0);
        rows[y] = row;
    }
    precise vec2 answer = lower.y * rows[0] + upper.y * rows[1];
    return answer;
}
#endif

float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)
{
    fetch_depth(floor(texel), d);
    precise float lit = 0.0;
    precise float all = 0.0;
    for (int i = 0; i < TAPS; ++i) {
#if BILINEAR_TAPS
        vec2 answer = answer_at(r, bias, tap_place(texel, i));
#else
        vec2 answer = vec2(answer_of_texel(r, bias, tap_texel(texel, i)), 1.0);
#endif
#if WEIGHTED
        answer *= tap_weights[i];
#endif
        lit = lit + answer.x;
        all = all + answer.y;
    }
    precise float share = lit / all;
    return share;
}
