# shellcheck shell=bash
# What engines in a headless Chromium need; their engine.sh sources it, in their folder.

# install_module ENGINE TITLE: node, npm and Chromium, and what package-lock.json names.
install_module()
{
    install_programs node:nodejs npm chromium
    say "Installing $2 into engines/$1/node_modules"
    npm ci --no-audit --no-fund --ignore-scripts ||
        fail "engines $1: npm could not install what engines/$1/package-lock.json names; is its registry within reach?"
}

# missing_of_module MODULE TITLE: the first thing that is not there, in one line; nothing where all is.
missing_of_module()
{
    missing_program node && return
    missing_program chromium && return
    [ -d "node_modules/$1" ] || echo "$2 is not installed"
}
