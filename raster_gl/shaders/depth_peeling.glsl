// Casters that lie behind a layer of depths: as depths, of the very numbers that are compared. Before scene.frag.
layout(binding = 0) uniform sampler2D front; // with `peels`

uniform uint peels; // else every caster counts
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
