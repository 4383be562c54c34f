# shellcheck shell=bash
# What engines/three needs; read by ./dev engines, whose functions are there to be called, and by the
# tests; the working directory is this folder.

install_engine()
{
    install_programs node:nodejs npm chromium
    say "Installing three.js into engines/three/node_modules"
    npm ci --no-audit --no-fund --ignore-scripts ||
        fail "engines three: npm could not install what engines/three/package-lock.json names; is its registry within reach?"
}

# missing_of_engine: the first thing that is not there, in one line; nothing where all is.
missing_of_engine()
{
    missing_program node && return
    missing_program chromium && return
    [ -d node_modules/three ] || echo "three.js is not installed"
}
