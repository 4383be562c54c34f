// Averages the rows' means along the column.
uniform float kernel[KERNEL_ACROSS];

vec4 texel(ivec2 at)
{
    const int centre = KERNEL_ACROSS / 2;
    precise CONTENT sum = kernel[centre] * source(at).COMPONENTS;
    for (int i = 1; i <= centre; ++i) {
        sum += kernel[centre + i] *
               (source(at - ivec2(0, i)).COMPONENTS + source(at + ivec2(0, i)).COMPONENTS);
    }
    vec4 averaged = vec4(0.0, 0.0, 0.0, 1.0);
    averaged.COMPONENTS = sum;
    return averaged;
}
