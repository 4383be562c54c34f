# require_modules MODULE=PACKAGE…: ends with 77, which CTest takes for a skip, where Debian's python3
# lacks a module.
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
