# shellcheck shell=bash
# What engines/filament needs; read by ./dev engines, whose functions are there to be called, and by the
# tests; the working directory is this folder.
# shellcheck source=/dev/null
source ../common/chromium.sh

install_engine() { install_module filament Filament; }

# missing_of_engine: the first thing that is not there, in one line; nothing where all is.
missing_of_engine() { missing_of_module filament Filament; }
