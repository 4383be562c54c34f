// Copies the map's depths as a shader reads them, as reading a depth texture back can give other
// bits.
layout(binding = 0) uniform sampler2D map;
uniform uint first_row; // of the band that is drawn
layout(location = 0) out float depth;

void main()
{
    depth = texelFetch(map, ivec2(gl_FragCoord.xy) + ivec2(0, int(first_row)), 0).r;
}
