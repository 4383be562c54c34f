// Writes one texel of a prefiltered map. Follows the method's snippet, which defines
//
//     vec4 texel(ivec2 at)
//
// HALF_FLOATS: the texture holds 16-bit floats.
layout(location = 0) out vec4 texel_out;

#if HALF_FLOATS
// Rounds to the nearest 16-bit float, ties to even. Drivers may round or truncate on store; they
// store this value unchanged.
float nearest_half(float x)
{
    const float least_normal = 6.103515625e-05;     // 2^-14
    const float subnormals = 16777216.0;            // per unit, 2^24
    float size = abs(x);
    uint bits = floatBitsToUint(size);
    uint kept = (bits + 0xFFFu + ((bits >> 13) & 1u)) & ~0x1FFFu; // ten fraction bits
    float nearest = size < least_normal ? roundEven(size * subnormals) / subnormals
                                        : uintBitsToFloat(kept);
    return x < 0.0 ? -nearest : nearest;
}
#endif

void main()
{
    texel_out = texel(ivec2(gl_FragCoord.xy));
#if HALF_FLOATS
    texel_out = vec4(nearest_half(texel_out.r), nearest_half(texel_out.g),
                     nearest_half(texel_out.b), nearest_half(texel_out.a));
#endif
}
