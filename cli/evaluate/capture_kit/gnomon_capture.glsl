// gnomon_capture.glsl: what `gnomon evaluate` needs of a fragment, for GLSL 3.30, ES 3.00 and later.
//
// Include it after #version and any precision statement, for it has none of its own, in the shader
// that looks up the shadow map, and write what the functions return to
// targets of 32-bit floats (GL_RGBA32F, VK_FORMAT_R32G32B32A32_SFLOAT), cleared to NaN, without
// blending, multisampling or temporal filters:
//
//     layout(location = 0) out highp vec4 gnomon_a;   // P and the mask: level 0 needs no more
//     layout(location = 1) out highp vec4 gnomon_b;   // normal and object
//     layout(location = 2) out highp vec4 gnomon_c;   // the two depths that were compared, and where
//
//     gnomon_a = gnomon_point(world_position, lit);
//     gnomon_b = gnomon_surface(world_position, camera_position, object_number);
//     gnomon_c = gnomon_lookup(receiver_depth, map_depth, uv * resolution);
//
// world_position: the vertex's world position, interpolated (`highp`, not `flat`). Neither relative to
// the camera nor rebuilt from the depth buffer: both lose the digits that the truth is decided by.
// lit: the lookup's result alone, 1 lit, 0 shadowed: before N·L, cascades' blending and fades.

highp vec4 gnomon_point(highp vec3 world_position, highp float lit)
{
    return vec4(world_position, lit);
}

// The flat normal of the triangle, on the side that the camera sees. Call it where all fragments of
// a 2x2 block do: it takes derivatives.
highp vec4 gnomon_surface(highp vec3 world_position, highp vec3 camera_position,
                          highp float object_number)
{
    highp vec3 normal = cross(dFdx(world_position), dFdy(world_position));
    highp float side = dot(normal, camera_position - world_position) < 0.0 ? -1.0 : 1.0;
    highp float size = length(normal);
    return vec4(size > 0.0 ? side / size * normal : vec3(0.0), object_number);
}

// receiver_depth: r, what the lookup compares, in [0, 1], before any bias is added or subtracted.
// map_depth: d, what the map holds at the texel that is looked up (nearest, or the centre tap).
highp vec4 gnomon_depths(highp float receiver_depth, highp float map_depth)
{
    return vec4(receiver_depth, map_depth, 0.0, 0.0);
}

// The same with the place that was looked up: uv × resolution [texels], from the map's lower left. With it,
// the whole camera and the map's settings every cause can be told.
highp vec4 gnomon_lookup(highp float receiver_depth, highp float map_depth, highp vec2 texel)
{
    return vec4(receiver_depth, map_depth, texel);
}
