// What depths become before their moments are taken: y in [-1, 1], growing away from the light, and
// of it e^(c·y), and −e^(−c·y), of which the sign is left away.
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
