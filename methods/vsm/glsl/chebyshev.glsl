// The verdict with the whole bias, in [0, 1]: Chebyshev's bound on the share of the footprint's
// depths that are not nearer to the light than the receiver, from their mean and variance.
// @param d  the depth of the texel that holds the point
uniform float min_variance;
uniform float bleeding_reduction; // bounds below it count as 0
uniform float stretch;            // 1 / (1 − bleeding_reduction)

float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)
{
    fetch_depth(floor(texel), d);
    vec2 moments = filtered(uv).rg;
    // Each step is monotone in the bias, so that the verdict rises with it.
#if REVERSED
    precise float reference = r + bias;
    precise float beyond = moments.x - reference;
#else
    precise float reference = r - bias;
    precise float beyond = reference - moments.x;
#endif
    if (!(beyond > 0.0)) {
        return 1.0;
    }
    precise float variance = max(moments.y - moments.x * moments.x, min_variance);
    precise float bound = variance > 0.0 ? variance / (variance + beyond * beyond) : 0.0;
    precise float verdict = (bound - bleeding_reduction) * stretch;
    return clamp(verdict, 0.0, 1.0);
}
