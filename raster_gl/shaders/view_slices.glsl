// Chooses the cascade that a receiver reads: that of its slice of the camera's view. Follows
// lookup_map.glsl. scene/light/map_choice.hpp has the same rule, bit for bit.

uniform vec3 view_eye;
uniform vec3 view_forward;
uniform float slice_ends[MAPS]; // view depths, ascending
#if BLENDS
uniform float mixed_from[MAPS]; // view depth from which on the next cascade is mixed in; the last
                                // one's is its end
#endif

float view_depth(vec3 position)
{
    precise vec3 from_eye = position - view_eye;
    precise float depth = view_forward.x * from_eye.x + view_forward.y * from_eye.y;
    depth = depth + view_forward.z * from_eye.z;
    return depth;
}

int chosen_map(vec3 position)
{
    float depth = view_depth(position);
    for (int i = 0; i < MAPS - 1; ++i) {
        if (depth < slice_ends[i]) {
            return i;
        }
    }
    return MAPS - 1;
}

#if BLENDS
// The next cascade's share in a verdict: 0 up to where blending begins, 1 at the slice's end.
float share_of_next(vec3 position)
{
    int map = chosen_map(position);
    float from = mixed_from[map];
    float depth = view_depth(position);
    if (map == MAPS - 1 || !(depth > from)) {
        return 0.0;
    }
    return min((depth - from) / (slice_ends[map] - from), 1.0);
}
#endif
