// tan θ of the angle between a receiver's geometric normal and the light, or of its supplement:
// finite, not negative. Both are unit vectors.
float tan_of_angle(vec3 normal, vec3 to_light)
{
    return min(length(cross(normal, to_light)) / abs(dot(normal, to_light)), 3.0e38);
}
