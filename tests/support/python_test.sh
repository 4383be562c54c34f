#!/usr/bin/env bash
# python_test.sh MODULE=PACKAGE… -- SCRIPT [ARGUMENT…]: runs a test with Debian's python3; skips it if a module is missing.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/require_modules.sh"
while [ "$1" != -- ]; do
    require_modules "$1"
    shift
done
# No bytecode is left in the checkout.
exec /usr/bin/python3 -B "${@:2}"
