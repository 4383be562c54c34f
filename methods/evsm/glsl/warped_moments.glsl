// The warps of a depth, each with its square.
CONTENT content(float z)
{
    float y = centred(z);
    float positive = positive_warp(y);
#if MOMENTS == 2
    precise vec2 moments = vec2(positive, positive * positive);
#else
    float negative = negative_warp(y);
    precise vec4 moments = vec4(positive, positive * positive, negative, negative * negative);
#endif
    return moments;
}
