// Warps depths before their moments are computed: y in [-1, 1] grows away from the light; the warps
// are e^(c·y) and −e^(−c·y), whose sign is omitted.
uniform float exponents[2]; // of the positive warp, and of the negative one

float centred(float depth)
{
#if REVERSED
    precise float y = 1.0 - 2.0 * depth;
#else
    precise float y = 2.0 * depth - 1.0;
#endif
    return y;
}

float positive_warp(float y)
{
    precise float power = exponents[0] * y;
    return exponential(power);
}

float negative_warp(float y)
{
    precise float power = exponents[1] * -y;
    return exponential(power);
}
