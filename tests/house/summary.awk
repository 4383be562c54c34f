# Reads CTest's JUnit file and closes a test run: every skipped test with its reason, then one line
# of totals. Test cases of a GoogleTest program count one by one, any other CTest entry as one.

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

function skip(name, reason)
{
    skips[++skip_count] = unescape(name ": " reason)
}

/^\t<testcase / {
    entry = attribute("name")
    status = attribute("status")
    message = said = ""
    entry_passed = entry_failed = entry_skipped = 0
    is_google_test = in_reason = 0
}
/^\t\t<skipped / { message = attribute("message") }
# How a script of this house says why it skips.
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
    printf "\n%d passed, %d failed, %d skipped\n", passed, failed, skipped
}
