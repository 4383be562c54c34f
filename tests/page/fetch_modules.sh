#!/usr/bin/env bash
# fetch_modules.sh DIR: downloads the two modules of the browser tests into DIR/node_modules. Versions and hashes are
# fixed, and neither has dependencies. Ends with 77, a skip, if the registry cannot be reached.
set -euo pipefail
registry=https://registry.npmjs.org
modules=(
    "playwright-core 1.61.1 h7Qlt6m4REp25qvIdvbDtVmD4LqVXfpRxhORv9L0jzETM05p4fuPJ3dKyuSXQxDSbXnmS79HAgi9589lGSpLkg=="
    "axe-core 4.14.1 FHfa+lmNjQZfJz1q8wKqIDwC6DExcHt/pkjNQb09a3NPjCKg2rhu5qb2S4r76ASyFNNtuFooJpZe37OgudVGtQ=="
)
folder=$1/node_modules
mkdir -p "$folder"

for module in "${modules[@]}"; do
    read -r name version sha512 <<<"$module"
    [[ -e "$folder/$name/.complete-$version" ]] && continue
    work=$(mktemp -d "$folder/.fetch.XXXXXX")
    trap 'rm -rf "$work"' EXIT
    curl -fsSL --retry 2 --max-time 120 "$registry/$name/-/$name-$version.tgz" -o "$work/module.tgz" || {
        echo "SKIPPED: $registry cannot be reached for $name $version"
        exit 77
    }
    found=$(openssl dgst -sha512 -binary "$work/module.tgz" | base64 -w0)
    [[ "$found" == "$sha512" ]] || {
        echo "$name $version: sha512 is $found, not $sha512" >&2
        exit 1
    }
    mkdir "$work/module"
    tar -xzf "$work/module.tgz" -C "$work/module" --strip-components=1
    touch "$work/module/.complete-$version"
    rm -rf "${folder:?}/$name"
    mv "$work/module" "$folder/$name"
    rm -rf "$work"
done
