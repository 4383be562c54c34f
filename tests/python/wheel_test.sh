#!/usr/bin/env bash
# The wheel that `pip wheel .` makes of this build, installed into a fresh virtual environment; exit status 77: skipped.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$(cd "$(dirname "$GNOMON")/.." && pwd)
for module in pip setuptools wheel venv numpy; do
    if ! /usr/bin/python3 -c "import $module" 2>/dev/null; then
        echo "skipped: apt-get install python3-$module"
        exit 77
    fi
done
if [ ! -d "$build/python/gnomon" ]; then
    echo "skipped: the Python package was not built: apt-get install pybind11-dev python3-dev"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# A copy: setuptools writes beside its sources.
git -C "$root" ls-files -coz --exclude-standard -- python README.md LICENSE pyproject.toml setup.py CMakeLists.txt |
    (cd "$root" && xargs -0 cp --parents -t "$work")
cd "$work"
GNOMON_BUILD=$build /usr/bin/python3 -m pip wheel . --quiet --no-deps --no-build-isolation --no-index -w wheels
/usr/bin/python3 -m venv --system-site-packages environment
environment/bin/pip install --quiet --no-deps --no-index wheels/gnomon-*.whl
cd /
"$work/environment/bin/python" - <<'END'
import gnomon

scene = gnomon.Scene([[-1, 1, -1], [-1, 1, 1], [1, 1, 0]], [[0, 1, 2]])
assert gnomon.truth(scene, [[0, 0, 0]], {"direction": [0, -1, 0]}).blocked.all()
assert "environment" in gnomon.__file__, gnomon.__file__
END
"$work/environment/bin/python" -m gnomon --version
"$work/environment/bin/gnomon" --version
if unzip -l "$work"/wheels/*.whl 2>/dev/null | grep -E "libGL|libEGL|dri"; then
    echo "the wheel bundles a driver" >&2
    exit 1
fi
