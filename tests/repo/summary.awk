# Summarizes a test run from tests/allowed_skips and CTest's JUnit file, in this order: every skipped test with its reason,
# then a line of totals. Each test case of a GoogleTest program counts, and any other CTest entry counts as one.
# `conditions` are those that hold on this machine. Exits with 3 if a test skipped that may not, and with 4 if an entry
# ran no test.
#
#   awk -v conditions="root no-mount" -f summary.awk tests/allowed_skips build/release/test_results.xml

function attribute(name, value)
{
    value = $0
    if (!sub(".*[ \t]" name "=\"", "", value)) {
        return ""
    }
    sub(/".*/, "", value)
    return value
}

function unescape(text)
{
    gsub(/&lt;/, "<", text)
    gsub(/&gt;/, ">", text)
    gsub(/&quot;/, "\"", text)
    gsub(/&apos;/, "'", text)
    gsub(/&amp;/, "\\&", text)
    return text
}

# Whether the list allows the test to skip under a condition that holds.
function is_allowed(name,    i, pattern)
{
    for (i = 1; i <= allowed_count; i++) {
        pattern = allowed[i]
        if (pattern == name || (sub(/\*$/, "", pattern) && index(name, pattern) == 1)) {
            if (index(" " conditions " ", " " condition_of[i] " ") > 0) {
                return 1
            }
        }
    }
    return 0
}

function skip(name, reason)
{
    if (is_allowed(unescape(name))) {
        skips[++skip_count] = unescape(name ": " reason)
    } else {
        refused[++refused_count] = unescape(name ": " reason)
    }
}

FILENAME == ARGV[1] {
    if ($0 !~ /^#/ && NF > 0) {
        allowed[++allowed_count] = $1
        condition_of[allowed_count] = $2
    }
    next
}

/^\t<testcase / {
    entry = attribute("name")
    status = attribute("status")
    message = said = ""
    entry_passed = entry_failed = entry_skipped = 0
    is_google_test = in_reason = 0
}
/^\t\t<skipped / { message = attribute("message") }
# The line by which our scripts say why they skip.
sub(/^.*SKIPPED: /, "") { said = $0 }

/^\[=+\] Running / { is_google_test = 1 }
/^\[       OK \] / { entry_passed++ }
/^\[  FAILED  \] .* \([0-9]+ ms\)$/ { entry_failed++ }

# GoogleTest prints "FILE:LINE: Skipped", the reason, then the name of the test.
/^\[  SKIPPED \] [^ ]+ \([0-9]+ ms\)$/ {
    skip($4, reason)
    entry_skipped++
    in_reason = 0
}
in_reason && NF > 0 { reason = reason (reason == "" ? "" : " ") $0 }
/: Skipped$/ {
    reason = ""
    in_reason = 1
}

# Python, node and GoogleTest print only the number of skipped or disabled tests.
/^OK \(.*skipped=[1-9]/ || /^(ℹ|#) skipped [1-9]/ || /YOU HAVE [0-9]+ DISABLED TEST/ { skip(entry, $0) }

/^\t<\/testcase>/ {
    if (status == "notrun" && message !~ /^SKIP_/) {
        entry_failed = 1 # the program is missing
    } else if (status == "notrun") {
        skip(entry, said == "" ? message : said)
        entry_skipped = 1
    } else if (status == "fail" && entry_failed == 0) {
        entry_failed = 1 # it crashed or timed out, or it is no GoogleTest program
    } else if (status == "run" && !is_google_test) {
        entry_passed = 1
    } else if (entry_passed + entry_failed + entry_skipped == 0) {
        entry_failed = 1 # a filter left nothing to run
        print "\n" entry ": it ran no test"
        ran_nothing = 1
    }
    passed += entry_passed
    failed += entry_failed
    skipped += entry_skipped
}

END {
    if (skip_count > 0) {
        print "\nSkipped:"
        for (i = 1; i <= skip_count; i++) {
            print "  " skips[i]
        }
    }
    if (refused_count > 0) {
        print "\nSkipped, and tests/allowed_skips does not allow it here:"
        for (i = 1; i <= refused_count; i++) {
            print "  " refused[i]
        }
    }
    printf "\n%d passed, %d failed, %d skipped\n", passed, failed, skipped
    exit ran_nothing ? 4 : refused_count > 0 ? 3 : 0
}
