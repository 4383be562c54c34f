#!/usr/bin/env bash
# dask_test.sh TEST: a test of sweeps on Dask, where that is installed.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
/usr/bin/python3 -c 'import distributed' 2>/dev/null || {
    echo "SKIPPED: Dask is missing: apt-get install python3-distributed"
    exit 77
}
exec /usr/bin/python3 -B "$here/$1"
