// Of a depth: itself, and its square.
vec2 content(float z)
{
    precise vec2 moments = vec2(z, z * z);
    return moments;
}
