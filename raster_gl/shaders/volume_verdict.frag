// The verdict from the number of volumes that contain a receiver. Follows receiver_angle.glsl. The
// program that compiles this defines POSITIONAL.
layout(binding = 0) uniform usampler2D receiver_triangle;
layout(binding = 2) uniform sampler2D receiver_world_position;
layout(binding = 3) uniform usampler2D volumes; // count of volumes, modulo 256
layout(binding = 5) uniform samplerBuffer normals; // unit normal of each triangle

uniform vec3 light; // POSITIONAL: its position, else the unit vector towards it

layout(location = 0) out vec4 sample_out; // r and d (NaN), tan θ, verdict

const float not_a_depth = uintBitsToFloat(0x7FC00000u);

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    sample_out = vec4(0.0);
    uint triangle = texelFetch(receiver_triangle, pixel, 0).r;
    if (triangle == 0xFFFFFFFFu) {
        return;
    }
#if POSITIONAL
    vec3 to_light = normalize(light - texelFetch(receiver_world_position, pixel, 0).xyz);
#else
    vec3 to_light = light;
#endif
    float verdict = texelFetch(volumes, pixel, 0).r == 0u ? 1.0 : 0.0;
    sample_out = vec4(not_a_depth, not_a_depth,
                      tan_of_angle(texelFetch(normals, int(triangle)).xyz, to_light), verdict);
}
