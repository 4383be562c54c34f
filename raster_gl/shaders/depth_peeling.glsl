// Keeps only casters behind a depth layer. Compares the depths as stored. Precedes scene.frag.
layout(binding = 0) uniform sampler2D front; // with `peels`

uniform uint peels; // 0: draw every caster
uniform uint reversed;

void write_fragment(uint triangle)
{
    float z = gl_FragCoord.z;
    if (peels != 0u) {
        float before = texelFetch(front, ivec2(gl_FragCoord.xy), 0).r;
        if (reversed != 0u ? z >= before : z <= before) {
            discard;
        }
    }
    gl_FragDepth = z;
}
