#!/usr/bin/env bash
# Runs lessons_test.py with Debian's python3, and the program that $GNOMON names.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ../notebooks/require_modules.sh
require_modules pandas=python3-pandas OpenImageIO=python3-openimageio
# No bytecode is left in the checkout.
exec /usr/bin/python3 -B lessons_test.py
