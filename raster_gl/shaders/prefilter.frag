// One texel of a prefilter's texture, after its piece, which gives
//
//     vec4 texel(ivec2 at)
//
// HALF_FLOATS: the texture holds 16-bit floats.
layout(location = 0) out vec4 texel_out;

#if HALF_FLOATS
// The nearest 16-bit float, of two as near the even one. Drivers may round what they store, or cut
// it: of this number they do neither.
float nearest_half(float x)
{
    const float least_normal = 6.103515625e-05;     // 2^-14
    const float subnormals = 16777216.0;            // to one, 2^24
    float size = abs(x);
    uint bits = floatBitsToUint(size);
    uint kept = (bits + 0xFFFu + ((bits >> 13) & 1u)) & ~0x1FFFu; // ten bits of the fraction
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
