#!/usr/bin/env bash
# Runs the tests of figures with Debian's python3; ends with 77, which CTest takes for a skip, where
# something is missing that only figures need.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

for module in matplotlib pandas; do
    /usr/bin/python3 -c "import $module" 2>/dev/null || {
        echo "SKIPPED: /usr/bin/python3 has no $module; apt-get install python3-$module"
        exit 77
    }
done
# No bytecode is left in the checkout.
exec /usr/bin/python3 -B -m unittest depth_figures_test make_test axis_figures_test run_figures_test \
    run_settings_test lesson_figures_test cascades_figure_test
