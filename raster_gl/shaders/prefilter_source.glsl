// What a prefilter's piece reads: the pass before it, or the depths that were drawn.
layout(binding = 0) uniform sampler2D source_texels;

// What the texel holds; beyond the map's edge, what the nearest one on it does.
vec4 source(ivec2 at)
{
    return texelFetch(source_texels, clamp(at, ivec2(0), textureSize(source_texels, 0) - 1), 0);
}
