// The moments averaged along the column, too.
uniform float kernel[KERNEL_ACROSS];

vec4 texel(ivec2 at)
{
    const int centre = KERNEL_ACROSS / 2;
    precise vec2 sum = kernel[centre] * source(at).rg;
    for (int i = 1; i <= centre; ++i) {
        sum += kernel[centre + i] * (source(at - ivec2(0, i)).rg + source(at + ivec2(0, i)).rg);
    }
    return vec4(sum, 0.0, 1.0);
}
