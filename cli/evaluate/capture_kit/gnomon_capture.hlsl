// gnomon_capture.hlsl: what `gnomon evaluate` needs of a pixel, for shader model 4 and later.
//
// Include it in the pixel shader that looks up the shadow map, and write what the functions return
// to targets of 32-bit floats (DXGI_FORMAT_R32G32B32A32_FLOAT), cleared to NaN, without blending,
// multisampling or temporal filters:
//
//     float4 gnomon_a : SV_Target0;   // P and the mask: level 0 needs no more
//     float4 gnomon_b : SV_Target1;   // normal and object
//     float4 gnomon_c : SV_Target2;   // the two depths that were compared, and where
//
//     gnomon_a = GnomonPoint(world_position, lit);
//     gnomon_b = GnomonSurface(world_position, camera_position, object_number);
//     gnomon_c = GnomonLookup(receiver_depth, map_depth, uv * resolution);
//
// world_position: the vertex's world position, interpolated (`linear`). Neither relative to the camera
// nor rebuilt from the depth buffer: both lose the digits that the truth is decided by.
// lit: the lookup's result alone, 1 lit, 0 shadowed: before N·L, cascades' blending and fades.

float4 GnomonPoint(float3 world_position, float lit)
{
    return float4(world_position, lit);
}

// The flat normal of the triangle, on the side that the camera sees. Call it where all pixels of a
// 2x2 block do: it takes derivatives.
float4 GnomonSurface(float3 world_position, float3 camera_position, float object_number)
{
    float3 normal = cross(ddx(world_position), ddy(world_position));
    float side = dot(normal, camera_position - world_position) < 0.0 ? -1.0 : 1.0;
    float size = length(normal);
    float3 flat_normal = float3(0.0, 0.0, 0.0);
    if (size > 0.0) {
        flat_normal = side / size * normal;
    }
    return float4(flat_normal, object_number);
}

// receiver_depth: r, what the lookup compares, in [0, 1], before any bias is added or subtracted.
// map_depth: d, what the map holds at the texel that is looked up (nearest, or the centre tap).
float4 GnomonDepths(float receiver_depth, float map_depth)
{
    return float4(receiver_depth, map_depth, 0.0, 0.0);
}

// The same with the place that was looked up: uv × resolution [texels], from the map's lower left. With it,
// the whole camera and the map's settings every cause can be told. Where v runs downwards, as in Direct3D,
// that is float2(u, 1 - v) × resolution.
float4 GnomonLookup(float receiver_depth, float map_depth, float2 texel)
{
    return float4(receiver_depth, map_depth, texel);
}
