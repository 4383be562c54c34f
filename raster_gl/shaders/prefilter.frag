// One texel of a prefilter's texture, after its piece, which gives
//
//     vec4 texel(ivec2 at)
layout(location = 0) out vec4 texel_out;

void main()
{
    texel_out = texel(ivec2(gl_FragCoord.xy));
}
