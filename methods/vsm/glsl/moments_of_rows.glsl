// Moments (z, z²) of the depths, averaged along the row by `kernel`: symmetric, so that a mirrored
// map gives a mirrored texture.
uniform float kernel[KERNEL_ACROSS];

// The mean over the texel's samples.
vec2 moments(ivec2 at)
{
    precise vec2 sum = vec2(0.0);
    for (int i = 0; i < SAMPLES; ++i) {
        precise float z = source(at, i).r;
        sum += vec2(z, z * z);
    }
    precise vec2 mean = sum / float(SAMPLES);
    return mean;
}

vec4 texel(ivec2 at)
{
    const int centre = KERNEL_ACROSS / 2;
    precise vec2 sum = kernel[centre] * moments(at);
    for (int i = 1; i <= centre; ++i) {
        sum += kernel[centre + i] * (moments(at - ivec2(i, 0)) + moments(at + ivec2(i, 0)));
    }
    return vec4(sum, 0.0, 1.0);
}
