#!/usr/bin/env bash
# Executes every notebook in a copy, with the program that $GNOMON names; a cell that fails fails the test.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
. "$root/tests/support/require_modules.sh"
require_modules pandas=python3-pandas matplotlib=python3-matplotlib \
    OpenImageIO=python3-openimageio nbconvert=python3-nbconvert ipykernel=python3-ipykernel

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp -rL "$root/notebooks" "$root/examples" "$work"
cd "$work/notebooks"
export PYTHONDONTWRITEBYTECODE=1 PYDEVD_DISABLE_FILE_VALIDATION=1
export IPYTHONDIR="$work/ipython" JUPYTER_CONFIG_DIR="$work/jupyter"
for notebook in *.ipynb; do
    echo "== $notebook"
    /usr/bin/python3 -m nbconvert --to notebook --execute --log-level ERROR \
        --ExecutePreprocessor.timeout=300 --output "executed_$notebook" "$notebook"
done
