#!/usr/bin/env bash
# document_links.sh CHECKOUT: finds broken references to documents and sources.
#
# It checks docs/NAME.md and docs/NAME.md#anchor in sources, the relative links of Markdown files, and the sources that
# these name as `layer/file`. Anchors are headings as hosting sites spell them.
set -euo pipefail
cd "$1"

broken=0

# anchors FILE: the headings, one a line, in lower case, without punctuation, with hyphens for spaces.
anchors()
{
    sed -n 's/^##* //p' "$1" | tr '[:upper:]' '[:lower:]' | sed 's/[^a-z0-9 _-]//g; s/ /-/g'
}

declare -A headings=() # by file; a newline precedes and follows each

# has_heading FILE ANCHOR
has_heading()
{
    local path=$PWD/$1
    [ -n "${headings[$path]:-}" ] || headings[$path]=$'\n'$(anchors "$1")$'\n'
    [[ ${headings[$path]} == *$'\n'"$2"$'\n'* ]]
}

# check WHERE TARGET: TARGET is FILE, FILE#ANCHOR or #ANCHOR relative to the current folder.
check()
{
    local file=${2%%#*} anchor=""
    [[ $2 != *#* ]] || anchor=${2#*#}
    [ -n "$file" ] || file=${1##*/}
    if [ ! -e "$file" ]; then
        printf '%s: %s does not exist\n' "$1" "$2" >&2
        broken=1
    elif [ -n "$anchor" ] && ! has_heading "$file" "$anchor"; then
        printf '%s: %s has no heading #%s\n' "$1" "$file" "$anchor" >&2
        broken=1
    fi
}

mapfile -t sources < <(find . \( -name build -o -name out -o -name .git -o -name node_modules \) -prune -o -type f \
    \( -name '*.?pp' -o -name '*.cmake' -o -name CMakeLists.txt -o -name '*.frag' -o -name '*.vert' \
    -o -name '*.py' \) -printf '%P\n')
while IFS=: read -r where target; do
    check "$where" "$target"
done < <(grep -oHE 'docs/[a-z_/]+\.md(#[a-z0-9-]+)?' "${sources[@]}")

mapfile -t pages < <(find . \( -name build -o -name out -o -name .git -o -name node_modules \) -prune -o -type f \
    -name '*.md' -printf '%P\n')
while IFS=: read -r where target; do
    target=${target#*](}
    target=${target%)}
    folder=.
    [[ $where != */* ]] || folder=${where%/*}
    [[ $target == http*://* ]] || { pushd "$folder" >/dev/null && check "$where" "$target" && popd >/dev/null; }
done < <(grep -oHE '\]\([^) ]+\)' "${pages[@]}")

# The sources that a page names, with or without their extension.
layers='scene|methods|raster_gl|reference_rt|analysis|store|reports|cli|tests'
while IFS=: read -r where source; do
    if [ ! -e "$source" ] && ! compgen -G "$source.*" >/dev/null; then
        printf '%s: %s does not exist\n' "$where" "$source" >&2
        broken=1
    fi
done < <(grep -oHE "\`($layers)/[A-Za-z0-9_/.]+\`" "${pages[@]}" | tr -d '`')

exit "$broken"
