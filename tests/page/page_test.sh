#!/usr/bin/env bash
# page_test.sh CACHE: opens reports of the program that $GNOMON names in Debian's Chromium. CACHE keeps the browser's driver
# and axe-core.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/require_browser.sh"
require_node
require_chromium
. "$here/../support/require_modules.sh"
require_modules pandas=python3-pandas OpenImageIO=python3-openimageio
bash "$here/fetch_modules.sh" "$1"
export GNOMON_PAGE_MODULES=$1
cd "$here"
exec node --test --test-reporter=spec --test-concurrency=1 \
    first_screen_test.mjs inspector_test.mjs slider_test.mjs sweep_test.mjs hostile_test.mjs print_test.mjs accessibility_test.mjs
