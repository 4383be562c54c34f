#!/usr/bin/env bash
# slurm_test.sh TEST: a test of sweeps on Slurm, where that is installed and starts.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
for program in /usr/bin/sbatch /usr/sbin/slurmctld /usr/sbin/slurmd /usr/sbin/munged; do
    [ -x "$program" ] || {
        echo "SKIPPED: Slurm is missing: apt-get install slurm-wlm munge"
        exit 77
    }
done
reason=$(/usr/bin/python3 -B "$here/slurm_cluster.py" 2>&1) || {
    echo "SKIPPED: $reason"
    exit 77
}
exec /usr/bin/python3 -B "$here/$1"
