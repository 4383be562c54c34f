#!/usr/bin/env bash
# league_test.sh FILE: runs a test of the league with Debian's python3, and the program that $GNOMON names.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ../support/require_modules.sh
require_modules numpy=python3-numpy PIL=python3-pil
# No bytecode is left in the checkout.
exec /usr/bin/python3 -B "$@"
