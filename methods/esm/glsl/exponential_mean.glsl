// Averages depths by the mean of their exponentials, along ALONG: 1/c · ln Σ k·e^(c·z). The
// farthest depth is factored out, so that nothing overflows.
uniform float kernel[KERNEL_ACROSS];
uniform float exponent;

// ln x of a positive normal x, with an error of 2^-23 plus a relative 2^-24.
float natural_logarithm(float x)
{
    uint bits = floatBitsToUint(x);
    int power = int(bits >> 23) - 127;
    float mantissa = uintBitsToFloat((bits & 0x007FFFFFu) | 0x3F800000u);
    if (mantissa > 1.41421356) {
        mantissa *= 0.5;
        ++power;
    }
    precise float s = (mantissa - 1.0) / (mantissa + 1.0);
    precise float square = s * s;
    precise float series = 1.0 / 7.0 + square * (1.0 / 9.0);
    series = 0.2 + square * series;
    series = 1.0 / 3.0 + square * series;
    series = 1.0 + square * series;
    precise float logarithm = float(power) * 0.693147181 + 2.0 * s * series;
    return logarithm;
}

// Greater is farther.
float distance_of(ivec2 at, int number)
{
#if REVERSED
    return -source(at, number).r;
#else
    return source(at, number).r;
#endif
}

// Mean over the texel's samples of e^(c·(z − farthest)).
float share_of(ivec2 at, float farthest)
{
    precise float sum = 0.0;
    for (int i = 0; i < SAMPLES; ++i) {
        precise float power = exponent * (distance_of(at, i) - farthest);
        sum += exponential(power);
    }
    precise float mean = sum / float(SAMPLES);
    return mean;
}

vec4 texel(ivec2 at)
{
    const int centre = KERNEL_ACROSS / 2;
    float farthest = distance_of(at, 0);
    for (int tap = -centre; tap <= centre; ++tap) {
        for (int i = 0; i < SAMPLES; ++i) {
            farthest = max(farthest, distance_of(at + tap * ALONG, i));
        }
    }
    precise float sum = kernel[centre] * share_of(at, farthest);
    for (int i = 1; i <= centre; ++i) {
        sum += kernel[centre + i] *
               (share_of(at - i * ALONG, farthest) + share_of(at + i * ALONG, farthest));
    }
    precise float mean = farthest + natural_logarithm(sum) / exponent;
#if REVERSED
    mean = -mean;
#endif
    return vec4(mean, 0.0, 0.0, 1.0);
}
