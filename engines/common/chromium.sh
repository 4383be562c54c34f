# shellcheck shell=bash
# For engines in a headless Chromium. Their engine.sh sources this, in their folder.

# install_module ENGINE TITLE: installs node, npm, Chromium, and the packages of package-lock.json.
install_module()
{
    install_programs node:nodejs npm chromium
    say "Installing $2 into engines/$1/node_modules"
    npm ci --no-audit --no-fund --ignore-scripts ||
        fail "engines $1: npm could not install what engines/$1/package-lock.json names; is its registry within reach?"
}

# missing_of_module MODULE TITLE: prints the first missing requirement, in one line.
missing_of_module()
{
    missing_program node && return
    missing_program chromium && return
    [ -d "node_modules/$1" ] || echo "$2 is not installed"
}
