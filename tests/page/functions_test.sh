#!/usr/bin/env bash
# The page's pure functions, without a browser.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/require_browser.sh"
require_node
cd "$here"
exec node --test --test-reporter=spec biases_test.mjs errors_test.mjs data_test.mjs colours_test.mjs
