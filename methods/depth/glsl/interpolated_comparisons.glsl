// The verdict with the whole bias, in [0, 1]: comparisons with TAPS_ACROSS × TAPS_ACROSS texels,
// gathered four at a time. Their weights interpolate the kernels around the four nearest centres.
// If all are lit, the verdict is exactly 1.
// @param d  the depth of the texel that holds the point
uniform float kernel[KERNEL_ACROSS]; // whole numbers

// The centres of a gather's four texels, relative to the corner between them.
const vec2 centres_about[4] =
    vec2[4](vec2(-0.5, 0.5), vec2(0.5, 0.5), vec2(0.5, -0.5), vec2(-0.5, -0.5));

// Weights of two neighbours along a line of taps; `upper` is where between the two nearest centres
// the point lies.
vec2 weights_of_taps(int first, float upper)
{
    vec2 weights;
    for (int i = 0; i < 2; ++i) {
        int tap = first + i;
        float of_lower = tap < KERNEL_ACROSS ? kernel[min(tap, KERNEL_ACROSS - 1)] : 0.0;
        float of_upper = tap > 0 ? kernel[max(tap - 1, 0)] : 0.0;
        precise float weight = (1.0 - upper) * of_lower + upper * of_upper;
        weights[i] = weight;
    }
    return weights;
}

// The weighted sum of a gather's four answers.
float weighted_sum(vec4 answers, vec2 columns, vec2 rows)
{
    precise float lower = columns.x * answers.w + columns.y * answers.z;
    precise float upper = columns.x * answers.x + columns.y * answers.y;
    precise float all = rows.x * lower + rows.y * upper;
    return all;
}

float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)
{
    fetch_depth(floor(texel), d);
    vec2 shifted = texel - 0.5;
    vec2 nearest = floor(shifted);
    vec2 upper = shifted - nearest;
    precise float lit = 0.0;
    precise float all = 0.0;
    for (int y = 0; y < TAPS_ACROSS; y += 2) {
        vec2 rows = weights_of_taps(y, upper.y);
        for (int x = 0; x < TAPS_ACROSS; x += 2) {
            vec2 columns = weights_of_taps(x, upper.x);
            vec2 corner = nearest + vec2(x, y) + float(1 - KERNEL_ACROSS / 2);
            vec4 depths = gathered_depths(corner);
            vec4 answers;
            for (int i = 0; i < 4; ++i) {
                float reference = depth_at_tap(r, corner + centres_about[i] - texel);
                answers[i] = is_lit(reference, bias, depths[i]) ? 1.0 : 0.0;
            }
            lit = lit + weighted_sum(answers, columns, rows);
            all = all + weighted_sum(vec4(1.0), columns, rows);
        }
    }
    precise float share = lit / all;
    return share;
}
