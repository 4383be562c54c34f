// The verdict with the whole bias, in [0, 1]: the mean of comparisons over the part of the search's
// kernel that the blockers' penumbra covers. If the search ignores the bias, the taps do not depend
// on it, so each comparison and the mean rise with it.
// @param d  the depth of the tap in the middle
uniform float light_radius_m; // of a disc
uniform float light_tangent;  // without POSITIONAL: of the angle of its radius
#if !CUBE
uniform float clip_depth_row[2]; // z of a clip position at ζ: the first · ζ + the second
#endif

// The light distance ζ of a depth in the map.
float light_distance(float depth)
{
#if REVERSED
    precise float ndc = depth;
#else
    precise float ndc = depth * 2.0 - 1.0;
#endif
#if POSITIONAL
    precise float distance_m = clip_depth_row[1] / (ndc - clip_depth_row[0]);
#else
    precise float distance_m = (ndc - clip_depth_row[1]) / clip_depth_row[0];
#endif
    return distance_m;
}

// The penumbra's radius where the light's edge is seen past a blocker [texels].
float penumbra_radius(float receiver_m, float blocker_m)
{
    precise float behind_m = receiver_m - blocker_m;
#if POSITIONAL
    precise float radius_m = light_radius_m * behind_m / blocker_m;
    precise float radius = radius_m / (texel_width_m[map_index] * receiver_m);
#else
    precise float radius = light_tangent * behind_m / texel_width_m[map_index];
#endif
    return radius;
}

// Whether any taps block the receiver, and their mean ζ.
bool find_blockers(float r, float bias, vec2 texel, out float mean_m)
{
    precise float sum_m = 0.0;
    float count = 0.0;
    for (int i = 0; i < TAPS; ++i) {
        float tap;
        if (fetch_depth(tap_texel(texel, i), tap) && !is_lit(r, bias, tap)) {
            sum_m = sum_m + light_distance(tap);
            count += 1.0;
        }
    }
    precise float mean = sum_m / max(count, 1.0);
    mean_m = mean;
    return count > 0.0;
}

float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)
{
    fetch_depth(floor(texel), d);
    vec2 search_axis = kernel_axis;
    float blocker_m;
    bool has_blockers = find_blockers(r, BIASED_SEARCH != 0 ? bias : 0.0, texel, blocker_m);
    float radius = has_blockers ? penumbra_radius(light_distance(r), blocker_m) : 0.0;
    precise float share = clamp(radius / kernel_radius, 0.0, 1.0);
    kernel_axis = share * search_axis;
    float lit_taps = 0.0;
    for (int i = 0; i < TAPS; ++i) {
        float tap;
        bool fetched = fetch_depth(tap_texel(texel, i), tap);
        lit_taps += fetched ? (is_lit(r, bias, tap) ? 1.0 : 0.0) : OUTSIDE_VERDICT;
    }
    kernel_axis = search_axis;
    return lit_taps / float(TAPS);
}
