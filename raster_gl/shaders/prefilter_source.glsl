// The input of a prefilter's snippet: the previous pass, or the drawn depths with SAMPLES per
// texel. SAMPLES_ARE_LAYERS: each sample is a layer.
#if SAMPLES > 1 && SAMPLES_ARE_LAYERS
layout(binding = 0) uniform sampler2DArray source_texels;
#elif SAMPLES > 1
layout(binding = 0) uniform sampler2DMS source_texels;
#else
layout(binding = 0) uniform sampler2D source_texels;
#endif

// Clamps to the nearest texel on the map.
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

// A sample of the texel; beyond the map's edge, of the nearest texel on it.
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

// The texel's value, or its first sample.
vec4 source(ivec2 at)
{
    return source(at, 0);
}
