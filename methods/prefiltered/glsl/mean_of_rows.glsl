// Averages the method's function of depth (CONTENT content(float z)) along the row by `kernel`.
// Symmetric, so that a mirrored map gives a mirrored texture.
uniform float kernel[KERNEL_ACROSS];

// The mean over the texel's samples.
CONTENT content_of(ivec2 at)
{
    precise CONTENT sum = CONTENT(0.0);
    for (int i = 0; i < SAMPLES; ++i) {
        sum += content(source(at, i).r);
    }
    precise CONTENT mean = sum / float(SAMPLES);
    return mean;
}

vec4 texel(ivec2 at)
{
    const int centre = KERNEL_ACROSS / 2;
    precise CONTENT sum = kernel[centre] * content_of(at);
    for (int i = 1; i <= centre; ++i) {
        sum += kernel[centre + i] *
               (content_of(at - ivec2(i, 0)) + content_of(at + ivec2(i, 0)));
    }
    vec4 averaged = vec4(0.0, 0.0, 0.0, 1.0);
    averaged.COMPONENTS = sum;
    return averaged;
}
