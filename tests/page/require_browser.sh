# Each function ends the script with 77, a skip, if its program is missing.
require_node()
{
    local major
    major=$(node -p 'process.versions.node.split(".")[0]' 2>/dev/null) || major=0
    ((major >= 18)) || {
        echo "SKIPPED: there is no node of version 18 or later; apt-get install nodejs"
        exit 77
    }
}
require_chromium()
{
    GNOMON_CHROMIUM=$(command -v chromium) || {
        echo "SKIPPED: there is no chromium; apt-get install chromium"
        exit 77
    }
    export GNOMON_CHROMIUM
}
