#!/usr/bin/env bash
# bare_system.sh SUITE [COMMAND]: what a newcomer meets. Makes a minimal system of a Debian release in a
# folder (debootstrap), clones this checkout's last commit into it, and runs COMMAND there; without one,
# the README's two commands, which install what they need. Needs root, for chroot.
#
#   GNOMON_BARE_FOLDER   use this folder: kept afterwards, and gone on with where it holds a system
#   GNOMON_DEBIAN_MIRROR take packages from there
#
# Otherwise the system is new each time, and removed when COMMAND has succeeded.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
mirror=${GNOMON_DEBIAN_MIRROR:-} # empty: debootstrap knows its own

fail()
{
    printf 'bare: %s\n' "$*" >&2
    exit 2
}

# The authorities that this machine trusts besides Debian's: an npm registry behind a proxy has one.
copy_certificates()
{
    local own=/usr/local/share/ca-certificates
    [ -d "$own" ] || return 0
    mkdir -p "$1$own"
    cp -L "$own"/*.crt "$1$own" 2>/dev/null || true
}

make_system()
{
    local suite=$1 folder=$2
    [ -e "$folder/.complete-$suite" ] && return 0
    [ -z "$(ls -A "$folder" 2>/dev/null)" ] || fail "$folder holds something else than a whole $suite; empty it"
    printf '== debootstrap %s %s\n' "$suite" "$folder"
    mkdir -p "$folder"
    debootstrap --variant=minbase "$suite" "$folder" ${mirror:+"$mirror"} >"$folder.log" 2>&1 ||
        fail "debootstrap of $suite failed; its last words: $(tail -n 1 "$folder.log")"
    rm -f "$folder.log"
    copy_certificates "$folder"
    touch "$folder/.complete-$suite"
}

clone_checkout()
{
    local folder=$1/src/gnomon
    mkdir -p "$1/src"
    if [ -d "$folder/.git" ]; then
        git -C "$folder" fetch -q "$root" HEAD
        git -C "$folder" checkout -q FETCH_HEAD
    else
        git clone -q --no-hardlinks "$root" "$folder"
    fi
    printf '== %s\n' "$(git -C "$folder" log -1 --format='%h %s')"
}

# run_inside FOLDER COMMAND: with devices and terminals of its own, which end with the command.
run_inside()
{
    cp -L /etc/resolv.conf "$1/etc/resolv.conf"
    FOLDER=$1 COMMAND=$2 unshare --mount --propagation private bash -c '
        set -euo pipefail
        mount -t proc proc "$FOLDER/proc"
        mount --rbind /sys "$FOLDER/sys"
        mount --rbind /dev "$FOLDER/dev"
        mkdir -p "$FOLDER/dev/pts"
        mount -t devpts -o newinstance,ptmxmode=0666,mode=0620 devpts "$FOLDER/dev/pts"
        [ -L "$FOLDER/dev/ptmx" ] || mount --bind "$FOLDER/dev/pts/ptmx" "$FOLDER/dev/ptmx"
        exec chroot "$FOLDER" /usr/bin/env -i HOME=/root LANG=C.UTF-8 CI="${CI:-}" \
            ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
            ${no_proxy:+no_proxy="$no_proxy"} \
            PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
            sh -c "cd /src/gnomon && $COMMAND"'
}

[ $# -ge 1 ] && [ $# -le 2 ] || fail "usage: ./dev bare SUITE [COMMAND], e.g. ./dev bare trixie"
[ "$(id -u)" -eq 0 ] || fail "only root may chroot; sudo ./dev bare $1"
suite=$1
command=${2:-./dev demo && ./dev test}
folder=${GNOMON_BARE_FOLDER:-$(mktemp -d "/var/tmp/gnomon-bare-$suite.XXXXXX")/system}

make_system "$suite" "$folder"
clone_checkout "$folder"
printf '== %s: %s\n' "$suite" "$command"
status=0
run_inside "$folder" "$command" || status=$?
if [ "$status" -ne 0 ]; then
    printf 'bare: it ended with %s; the system is left in %s\n' "$status" "$folder" >&2
elif [ -z "${GNOMON_BARE_FOLDER:-}" ]; then
    rm -rf --one-file-system "${folder%/system}"
fi
exit "$status"
