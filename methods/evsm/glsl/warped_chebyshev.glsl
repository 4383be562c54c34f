// The verdict with the whole bias, in [0, 1]: the lesser of Chebyshev's bounds, from mean and variance
// of the warped depths, on the share that is not nearer to the light than the receiver.
// @param d  the depth of the texel that holds the point
uniform float least_variance[2];  // of each warp, of its own value squared
uniform float bleeding_reduction; // bounds below it count as 0
uniform float stretch;            // 1 / (1 − bleeding_reduction)

// `beyond` is the distance of the receiver's warp beyond the mean, `share` that distance over the
// warp. Both fall when the bias grows, so that the bound rises. Returns the greater bound of both
// variances, because a least variance relative to the warp would fall with the bias.
float bound_of(vec2 moments, float beyond, float share, float least)
{
    if (!(beyond > 0.0)) {
        return 1.0;
    }
    precise float variance = moments.y - moments.x * moments.x;
    precise float bound = variance > 0.0 ? variance / (variance + beyond * beyond) : 0.0;
    precise float with_least = least > 0.0 ? least / (least + share * share) : 0.0;
    return max(bound, with_least);
}

float positive_bound(vec2 moments, float y)
{
    float warp = positive_warp(y);
    precise float beyond = warp - moments.x;
    precise float share = 1.0 - moments.x / warp;
    return bound_of(moments, beyond, share, least_variance[0]);
}

float negative_bound(vec2 moments, float y)
{
    float warp = negative_warp(y);
    precise float beyond = moments.x - warp;
    precise float share = moments.x / warp - 1.0;
    return bound_of(moments, beyond, share, least_variance[1]);
}

float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)
{
    fetch_depth(floor(texel), d);
    vec4 moments = filtered(uv);
#if REVERSED
    precise float reference = r + bias;
#else
    precise float reference = r - bias;
#endif
    float y = centred(reference);
    float bound = positive_bound(moments.rg, y);
#if MOMENTS == 4
    bound = min(bound, negative_bound(moments.ba, y));
#endif
    precise float verdict = (bound - bleeding_reduction) * stretch;
    return clamp(verdict, 0.0, 1.0);
}
