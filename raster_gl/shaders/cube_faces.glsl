// Chooses the cube face that a receiver reads, and the texels beyond a face's sides. Follows
// lookup_map.glsl and the tables face_forward, face_right and face_up, generated from
// scene/light/cube_faces.hpp. scene/pixels/cube_texels.hpp has the same rules, bit for bit.

uniform float clip_depth_row[2]; // z of a clip position at ζ = w: the first · w + the second

int face_towards(vec3 direction)
{
    float components[6] = float[6](direction.x, -direction.x, direction.y, -direction.y,
                                   direction.z, -direction.z);
    int face = 0;
    for (int i = 1; i < 6; ++i) {
        if (components[i] > components[face]) {
            face = i;
        }
    }
    return face;
}

int chosen_map(vec3 position)
{
    precise vec3 direction = position - light;
    return face_towards(direction);
}

// The vector from the light to these coordinates along right, up and forward of the face. It is
// exact, as each component comes from one of them.
vec3 direction_of(vec3 on_face)
{
    return on_face.x * vec3(face_right[map_index]) + on_face.y * vec3(face_up[map_index]) +
           on_face.z * vec3(face_forward[map_index]);
}

// Moves a clip position that an offset led over a seam onto the face that it lies on.
vec4 on_its_face(vec4 clip)
{
    if (max(abs(clip.x), abs(clip.y)) <= clip.w) {
        return clip;
    }
    vec3 direction = direction_of(clip.xyw);
    map_index = face_towards(direction);
    float w = dot(vec3(face_forward[map_index]), direction);
    return vec4(dot(vec3(face_right[map_index]), direction),
                dot(vec3(face_up[map_index]), direction), clip_depth_row[0] * w + clip_depth_row[1],
                w);
}

int along(ivec3 axis, ivec3 point)
{
    return axis.x * point.x + axis.y * point.y + axis.z * point.z;
}

ivec3 texel_across_seams(ivec2 texel)
{
    int n = int(resolution);
    ivec2 beyond = max(max(-texel, texel - (n - 1)), ivec2(0));
    if (beyond == ivec2(0)) {
        return ivec3(texel, map_index);
    }
    bool is_across_x = beyond.x >= beyond.y;
    int way = (is_across_x ? texel.x : texel.y) < 0 ? -1 : 1;
    ivec3 across = way * (is_across_x ? face_right[map_index] : face_up[map_index]);
    ivec3 beside = is_across_x ? face_up[map_index] : face_right[map_index];
    int row = clamp(is_across_x ? texel.y : texel.x, 0, n - 1);
    int from_seam = min(max(beyond.x, beyond.y), n); // counted from 1
    int next = face_towards(vec3(across));
    ivec3 centre = n * across + (n - (2 * from_seam - 1)) * face_forward[map_index] +
                   (2 * row + 1 - n) * beside;
    return ivec3((along(face_right[next], centre) + n - 1) / 2,
                 (along(face_up[next], centre) + n - 1) / 2, next);
}
