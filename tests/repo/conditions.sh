#!/usr/bin/env bash
# conditions.sh PROGRAM: prints the conditions of tests/allowed_skips that hold on this machine.
set -uo pipefail
program=$1
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

# GNOMON_SHARED_SCENES does not name a folder with the meshes.
for mesh in bunny nefertiti suzanne; do
    [ -f "${GNOMON_SHARED_SCENES:-/nonexistent}/$mesh.obj" ] || { echo no-shared-scenes && break; }
done

if [ "$(id -u)" -eq 0 ]; then
    echo root
else
    echo not-root
fi

# Other users may not enter a folder above the checkout.
folder=$root
while [ "$folder" != / ]; do
    mode=$(stat -c %a "$folder")
    if (((8#$mode & 1) == 0)); then
        echo private-checkout
        break
    fi
    folder=$(dirname "$folder")
done

# A tmpfs cannot be mounted.
place=$(mktemp -d)
if mount -t tmpfs none "$place" 2>/dev/null; then
    umount "$place"
else
    echo no-mount
fi
rmdir "$place"

# Pseudo-terminals are not available.
if command -v script >/dev/null && ! script -qec true /dev/null >/dev/null 2>&1 </dev/null; then
    echo no-terminal
fi

# node is not installed.
command -v node >/dev/null || echo no-node

# Debian's python3-distributed is not installed.
/usr/bin/python3 -c 'import distributed' 2>/dev/null || echo no-dask

# Debian's slurm-wlm and munge are not installed, or do not start, as in a container without a name.
{ [ -x /usr/bin/sbatch ] && [ -x /usr/sbin/slurmctld ] && [ -x /usr/sbin/slurmd ] && [ -x /usr/sbin/munged ] &&
    /usr/bin/python3 -B "$root/tests/clusters/slurm_cluster.py" >/dev/null 2>&1; } ||
    echo no-slurm

# GNU parallel is not installed.
parallel --version 2>/dev/null | grep -q 'GNU parallel' || echo no-parallel

# An engine is not installed by ./dev engines NAME.
source "$root/engines/common/missing.sh"
for engine in "$root"/engines/*/engine.sh; do
    folder=$(dirname "$engine")
    [ -z "$(missing_of "$folder")" ] || echo "no-$(basename "$folder")"
done

# tests/repo/recorded_results has no hashes for this driver and these libraries.
/usr/bin/python3 -B "$root/tests/repo/recorded_results/recorded_results.py" is-recorded "$program" 2>/dev/null ||
    echo not-recorded

# GL works and is not llvmpipe. A missing GL must not skip tests.
renderer=$("$program" doctor --json 2>/dev/null | sed -n 's/.*"renderer": *"\([^"]*\)".*/\1/p')
case $renderer in
    "" | llvmpipe*) ;;
    *) echo another-driver ;;
esac
