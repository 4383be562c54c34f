#!/usr/bin/env bash
# The tests of the Python package that was built beside the program GNOMON; exit status 77: skipped.
set -euo pipefail
folder=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
package=$(dirname "$(dirname "$GNOMON")")/python
if [ ! -d "$package/gnomon" ]; then
    echo "skipped: the Python package was not built: apt-get install pybind11-dev python3-dev"
    exit 77
fi
if ! /usr/bin/python3 -c "import numpy" 2>/dev/null; then
    echo "skipped: apt-get install python3-numpy"
    exit 77
fi
export PYTHONPATH=$package
# gnomon/ is imported from the package, the tests from their own folder.
(cd "$folder" && /usr/bin/python3 -B -m unittest scene_test points_test compare_test tune_test depth_test sun_test \
    sweep_test evaluate_test bad_input_test package_test)

examples=$(cd "$folder/../../examples/python" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
/usr/bin/python3 -B "$examples/bias_of_a_mesh.py" wall
[ -s bias_of_a_mesh.png ]
# A millimetre off is right at a kilometre from the origin: 2^-14 m there is float32's step.
/usr/bin/python3 -B "$examples/ray_offsets.py" 300 1000 | tee table.txt
grep -q "^1e-03 *0.000%" table.txt
if ! /usr/bin/python3 -c "import matplotlib" 2>/dev/null; then
    echo "skipped: sun_hours.py draws a picture: apt-get install python3-matplotlib"
    exit 77
fi
/usr/bin/python3 -B "$examples/sun_hours.py" 52.52 13.40 | tee hours.txt
grep -q "^2026-06-21: .* of 1[67]" hours.txt
[ -s sun_hours.png ]
