# require_modules MODULE=PACKAGE…: skips the test, with exit status 77, if Debian's python3 lacks a module.
require_modules()
{
    local pair
    for pair in "$@"; do
        /usr/bin/python3 -c "import ${pair%%=*}" 2>/dev/null || {
            echo "SKIPPED: /usr/bin/python3 has no ${pair%%=*}; apt-get install ${pair##*=}"
            exit 77
        }
    done
}
