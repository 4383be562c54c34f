// What a prefilter's piece reads: the pass before it, or the depths that were drawn, which are SAMPLES of
// each texel. SAMPLES_ARE_LAYERS: a layer holds each sample.
#if SAMPLES > 1 && SAMPLES_ARE_LAYERS
layout(binding = 0) uniform sampler2DArray source_texels;
#elif SAMPLES > 1
layout(binding = 0) uniform sampler2DMS source_texels;
#else
layout(binding = 0) uniform sampler2D source_texels;
#endif

// The nearest texel on the map.
ivec2 on_map(ivec2 at)
{
#if SAMPLES > 1 && SAMPLES_ARE_LAYERS
    ivec2 size = textureSize(source_texels, 0).xy;
#elif SAMPLES > 1
    ivec2 size = textureSize(source_texels);
#else
    ivec2 size = textureSize(source_texels, 0);
#endif
    return clamp(at, ivec2(0), size - 1);
}

// What a sample of the texel holds; beyond the map's edge, what the nearest one on it does.
vec4 source(ivec2 at, int number)
{
#if SAMPLES > 1 && SAMPLES_ARE_LAYERS
    return texelFetch(source_texels, ivec3(on_map(at), number), 0);
#elif SAMPLES > 1
    return texelFetch(source_texels, on_map(at), number);
#else
    return texelFetch(source_texels, on_map(at), 0);
#endif
}

// What the texel, or its first sample, holds.
vec4 source(ivec2 at)
{
    return source(at, 0);
}
