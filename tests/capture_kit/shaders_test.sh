#!/usr/bin/env bash
# The kit's snippets compile in the shaders that use them: GLSL for desktops, Vulkan and ES, and HLSL.
set -euo pipefail
command -v glslangValidator >/dev/null || {
    echo "SKIPPED: glslangValidator is missing (Debian's glslang-tools)"
    exit 77
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$GNOMON" capture-kit "$folder/kit" >/dev/null
glsl=$folder/kit/gnomon_capture.glsl

# glsl_shader NAME FIRST_LINES PREFIX
glsl_shader()
{
    {
        printf '%s\n' "$2"
        cat "$glsl"
        cat <<END
$3in highp vec3 world_position;
layout(location = 0) out highp vec4 gnomon_a;
layout(location = 1) out highp vec4 gnomon_b;
layout(location = 2) out highp vec4 gnomon_c;
void main()
{
    gnomon_a = gnomon_point(world_position, 1.0);
    gnomon_b = gnomon_surface(world_position, vec3(0.0, 2.0, 6.0), 3.0);
    gnomon_c = gnomon_depths(0.25, 0.5);
    gnomon_c = gnomon_lookup(0.25, 0.5, vec2(3.5, 7.25));
}
END
    } >"$folder/$1.frag"
}
glsl_shader desktop '#version 330' ''
glsl_shader vulkan '#version 450' 'layout(location = 0) '
glsl_shader es $'#version 300 es\nprecision highp float;' ''
glslangValidator "$folder/desktop.frag"
glslangValidator -V "$folder/vulkan.frag" -o "$folder/vulkan.spv"
glslangValidator "$folder/es.frag"

{
    cat "$folder/kit/gnomon_capture.hlsl"
    cat <<'END'
struct Targets
{
    float4 gnomon_a : SV_Target0;
    float4 gnomon_b : SV_Target1;
    float4 gnomon_c : SV_Target2;
};
Targets main(linear float3 world_position : POSITION0)
{
    Targets targets;
    targets.gnomon_a = GnomonPoint(world_position, 1.0);
    targets.gnomon_b = GnomonSurface(world_position, float3(0.0, 2.0, 6.0), 3.0);
    targets.gnomon_c = GnomonDepths(0.25, 0.5);
    targets.gnomon_c = GnomonLookup(0.25, 0.5, float2(3.5, 7.25));
    return targets;
}
END
} >"$folder/pixel.hlsl"
glslangValidator -D -V -S frag -e main "$folder/pixel.hlsl" -o "$folder/pixel.spv"

# The check can fail.
sed 's/gnomon_depths(0.25, 0.5)/gnomon_depths(0.25)/' "$folder/desktop.frag" >"$folder/broken.frag"
if glslangValidator "$folder/broken.frag" >/dev/null; then
    echo "glslangValidator accepts a shader that is wrong" >&2
    exit 1
fi
