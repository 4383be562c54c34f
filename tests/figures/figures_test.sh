#!/usr/bin/env bash
# Runs the tests of figures with Debian's python3, and the program that $GNOMON names.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ../support/require_modules.sh
require_modules matplotlib=python3-matplotlib pandas=python3-pandas
# No bytecode is left in the checkout.
exec /usr/bin/python3 -B -m unittest depth_figures_test make_test axis_figures_test run_figures_test \
    run_settings_test lesson_figures_test cascades_figure_test
