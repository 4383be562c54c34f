// The verdict with the whole bias, in [0, 1]: e^(c·(z − r)), with z the mean that the map holds.
// @param d  the depth of the texel that holds the point
uniform float exponent;

float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)
{
    fetch_depth(floor(texel), d);
    float mean = filtered(uv).r;
    // Each step is monotone in the bias, so that the verdict rises with it.
#if REVERSED
    precise float reference = r + bias;
    precise float before = reference - mean;
#else
    precise float reference = r - bias;
    precise float before = mean - reference;
#endif
    precise float power = exponent * before;
    return min(exponential(power), 1.0);
}
