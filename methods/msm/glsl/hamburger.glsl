// The verdict with the whole bias, in [0, 1]: the greatest share of depths not nearer to the light
// than the receiver, over all distributions with the map's four moments. The extreme distribution
// has three depths, one of them the receiver's.
// @param d  the depth of the texel that holds the point
uniform float moment_bias;
uniform float bleeding_reduction; // bounds below it count as 0
uniform float stretch;            // 1 / (1 − bleeding_reduction)

// Blends the moments with those of equal parts of depths 0 and 1, so that they stay valid despite
// rounding.
vec4 biased_moments(vec4 stored)
{
#if QUANTISED
    precise float first = stored.x - 0.035955884801;
    precise vec4 moments = first * vec4(0.2227744146, 0.1549679261, 0.1451988946, 0.163127443);
    moments += stored.y * vec4(0.0771972861, 0.1394629426, 0.2120202157, 0.2591432266);
    moments += stored.z * vec4(0.7926986636, 0.7963415838, 0.7258694464, 0.6539092497);
    moments += stored.w * vec4(0.0319417555, -0.1722823173, -0.2758014811, -0.3376131734);
#else
    vec4 moments = stored;
#endif
    precise vec4 biased = moments + moment_bias * (vec4(0.5) - moments);
    return biased;
}

// Coefficients of the polynomial whose roots are the two other depths: B⁻¹·(1, z, z²) by Cholesky's
// decomposition of the moments' Hankel matrix B.
vec3 polynomial(vec4 b, float z)
{
    precise float l32_d22 = b.z - b.x * b.y;
    precise float d22 = b.y - b.x * b.x;
    precise float variance_of_squares = b.w - b.y * b.y;
    precise float d33_d22 = variance_of_squares * d22 - l32_d22 * l32_d22;
    precise float l32 = l32_d22 / d22;
    precise vec3 c = vec3(1.0, z - b.x, z * z - b.y);
    c.z -= l32 * c.y;
    c.y /= d22;
    c.z *= d22 / d33_d22;
    c.y -= l32 * c.z;
    c.x -= c.y * b.x + c.z * b.y;
    return c;
}

// The share of the depths that is nearer than z.
float shadow(vec4 b, float z)
{
    precise vec3 c = polynomial(b, z);
    precise float half_p = c.y / c.z * 0.5;
    precise float q = c.x / c.z;
    precise float root = sqrt(max(half_p * half_p - q, 0.0));
    precise float nearer = -half_p - root;
    precise float farther = -half_p + root;
    if (!(nearer < z)) {
        return 0.0;
    }
    bool both_are_nearer = farther < z;
    float first = both_are_nearer ? nearer : z;
    float second = both_are_nearer ? z : nearer;
    precise float above = first * farther - b.x * (first + farther) + b.y;
    precise float share = above / ((farther - second) * (z - nearer));
    if (both_are_nearer) {
        share += 1.0;
    }
    return share >= 0.0 ? min(share, 1.0) : 0.0;
}

float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)
{
    fetch_depth(floor(texel), d);
    vec4 moments = biased_moments(filtered(uv));
#if REVERSED
    precise float reference = 1.0 - (r + bias);
#else
    precise float reference = r - bias;
#endif
    precise float bound = 1.0 - shadow(moments, reference);
    precise float verdict = (bound - bleeding_reduction) * stretch;
    return clamp(verdict, 0.0, 1.0);
}
