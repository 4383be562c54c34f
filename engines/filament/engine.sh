# shellcheck shell=bash
# The requirements of engines/filament. Sourced by ./dev engines, whose functions it may call, and by the tests,
# in this folder.
# shellcheck source=/dev/null
source ../common/chromium.sh

install_engine() { install_module filament Filament; }

# missing_of_engine: prints the first missing requirement, in one line.
missing_of_engine() { missing_of_module filament Filament; }
