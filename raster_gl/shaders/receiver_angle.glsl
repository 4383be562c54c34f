// tan θ between a receiver's geometric normal and the light, or of its supplement: not negative, finite.
// Both are unit vectors.
float tan_of_angle(vec3 normal, vec3 to_light)
{
    return min(length(cross(normal, to_light)) / abs(dot(normal, to_light)), 3.0e38);
}
