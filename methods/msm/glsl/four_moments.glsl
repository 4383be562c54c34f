// The first four powers of a depth that grows away from the light; with 16 bits, after the affine
// map that makes all possible moments fill [0, 1].
vec4 content(float z)
{
#if REVERSED
    precise float depth = 1.0 - z;
#else
    precise float depth = z;
#endif
    precise float square = depth * depth;
    precise vec4 moments = vec4(depth, square, square * depth, square * square);
#if QUANTISED
    precise vec4 stored = vec4(0.035955884801, 0.0, 0.0, 0.0);
    stored += moments.x * vec4(-2.07224649, 13.7948857237, 0.105877704, 9.7924062118);
    stored += moments.y * vec4(32.23703778, -59.4683975703, -1.9077466311, -33.7652110555);
    stored += moments.z * vec4(-68.571074599, 82.0359750338, 9.3496555107, 47.9456096605);
    stored += moments.w * vec4(39.3703274134, -35.364903257, -6.6543490743, -23.9728048165);
    return stored;
#else
    return moments;
#endif
}
