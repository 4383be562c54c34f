// Chooses the map that a receiver reads: the first that contains it, else the last. Follows
// lookup_map.glsl. scene/light/map_choice.hpp has the same rule, bit for bit.

bool is_on_map(float x, float w)
{
    precise float from_edge = x + w;
    return from_edge >= 0.0 && from_edge < 2.0 * w;
}

bool map_contains(vec4 clip)
{
#if REVERSED
    float nearest = 0.0;
#else
    float nearest = -clip.w;
#endif
    return clip.w > 0.0 && is_on_map(clip.x, clip.w) && is_on_map(clip.y, clip.w) &&
           clip.z >= nearest && clip.z <= clip.w;
}

int chosen_map(vec3 position)
{
    for (int i = 0; i < MAPS - 1; ++i) {
        if (map_contains(clip_position(light_clip_from_world[i], position))) {
            return i;
        }
    }
    return MAPS - 1;
}
