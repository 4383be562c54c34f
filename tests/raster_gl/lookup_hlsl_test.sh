#!/usr/bin/env bash
# The lookups that `gnomon settings --engine hlsl` writes compile as HLSL.
set -euo pipefail
command -v glslangValidator >/dev/null || {
    echo "SKIPPED: glslangValidator is missing (Debian's glslang-tools)"
    exit 77
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
shader=$folder/lookup.hlsl

# write_lookup LAST_ARGUMENTS SETTING…: a pixel shader that calls the lookup of a job with these settings.
write_lookup()
{
    local last=$1 settings=(--set image.width=64 --set image.height=36 --set bias.slope=0.001 --set bias.normal_texels=1)
    shift
    for setting in "$@"; do
        settings+=(--set "$setting")
    done
    {
        # The code is indented by two spaces.
        "$GNOMON" settings --builtin yard --engine hlsl --own "${settings[@]}" | sed -n 's/^  //p'
        cat <<END
float4 main(float3 position : POSITION0, float3 normal : POSITION1, float3 light : POSITION2) : SV_Target
{
    float lit = visibility(position, normal, light$last);
    return float4(lit, lit, lit, 1.0);
}
END
    } >"$shader"
}

compile() { glslangValidator -D -V -S frag -e main --auto-map-locations "$shader" -o "$folder/lookup.spv"; }

for filter in nearest linear hardware pcf3 bilinear5; do
    write_lookup "" "lookup.filter=$filter" bias.slope_kernels=1
    compile
    write_lookup ", 0" "lookup.filter=$filter" shadow_map.layout=cascades bias.constant_m=0.01
    compile
done
for plane in analytic derivatives; do
    write_lookup "" lookup.filter=pcf3 "bias.receiver_plane=$plane" bias.receiver_plane_clamp=0.01
    compile
done

# The check can fail.
sed -i 's/visibility(position, normal, light)/visibility(position, normal)/' "$shader"
if compile >/dev/null; then
    echo "glslangValidator accepts a lookup without a light" >&2
    exit 1
fi
