#!/usr/bin/env bash
# What summary.awk makes of CTest results: summary_test.sh.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

# A GoogleTest program (2 passed, 1 failed, 1 skipped), then one entry of every other outcome.
results()
{
    cat <<'END'
	<testcase name="metrics_test" classname="metrics_test" time="0.1" status="fail">
		<failure message=""/>
		<system-out>Running main() from gtest_main.cc
[==========] Running 4 tests from 1 test suite.
[ RUN      ] Metrics.CountsClasses
[       OK ] Metrics.CountsClasses (0 ms)
[ RUN      ] Metrics.ReadsMeshes
/tests/metrics_test.cpp:5: Skipped
no meshes &lt;here&gt;
[  SKIPPED ] Metrics.ReadsMeshes (0 ms)
[ RUN      ] Sizes/Metrics.AddUp/1
[  FAILED  ] Sizes/Metrics.AddUp/1, where GetParam() = 2 (0 ms)
[ RUN      ] Sizes/Metrics.AddUp/2
[       OK ] Sizes/Metrics.AddUp/2 (0 ms)
[==========] 4 tests from 1 test suite ran. (0 ms total)
[  PASSED  ] 2 tests.
[  SKIPPED ] 1 test, listed below:
[  SKIPPED ] Metrics.ReadsMeshes
[  FAILED  ] 1 test, listed below:
[  FAILED  ] Sizes/Metrics.AddUp/1, where GetParam() = 2
</system-out>
	</testcase>
	<testcase name="empty_shard" classname="empty_shard" time="0.1" status="run">
		<system-out>Note: Google Test filter = None*
[==========] Running 0 tests from 0 test suites.
[==========] 0 tests from 0 test suites ran. (0 ms total)
[  PASSED  ] 0 tests.
</system-out>
	</testcase>
	<testcase name="layer_check" classname="layer_check" time="0.1" status="run">
		<system-out></system-out>
	</testcase>
	<testcase name="readme" classname="readme" time="0.1" status="notrun">
		<skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/>
		<system-out>SKIPPED: no program
</system-out>
	</testcase>
	<testcase name="late" classname="late" time="1.0" status="fail">
		<failure message=""/>
		<system-out></system-out>
	</testcase>
	<testcase name="crash" classname="crash" time="0.1" status="fail">
		<failure message=""/>
		<system-out>[==========] Running 2 tests from 1 test suite.
[ RUN      ] Crash.Never
[       OK ] Crash.Never (0 ms)
[ RUN      ] Crash.Always
</system-out>
	</testcase>
	<testcase name="lost" classname="lost" time="0" status="notrun">
		<skipped message="Unable to find executable"/>
		<system-out>Unable to find executable: lost</system-out>
	</testcase>
END
}

# summary EXIT_CODE CONDITIONS ALLOWED EXPECTED
summary()
{
    local work status=0
    work=$(mktemp -d)
    results >"$work/results.xml"
    printf '%s\n' "$3" >"$work/allowed"
    awk -v conditions="$2" -f summary.awk "$work/allowed" "$work/results.xml" >"$work/actual" || status=$?
    printf '%s\n' "$4" >"$work/expected"
    diff "$work/expected" "$work/actual" >&2 || status=differs
    rm -rf "$work"
    [ "$status" = "$1" ] || {
        echo "summary with the conditions \"$2\": $status in place of $1" >&2
        exit 1
    }
}

list='# TEST CONDITION REASON
Metrics.Reads* no-meshes they are not ours

readme no-program it cannot run
readme never nor now'

nothing='
empty_shard: it ran no test
'
end='
4 passed, 5 failed, 2 skipped'

summary 4 "no-meshes no-program" "$list" "$nothing
Skipped:
  Metrics.ReadsMeshes: no meshes <here>
  readme: no program
$end"

# A condition that does not hold; a list that lacks the test; no list.
summary 4 "no-program" "$list" "$nothing
Skipped:
  readme: no program

Skipped, and tests/allowed_skips does not allow it here:
  Metrics.ReadsMeshes: no meshes <here>
$end"
summary 4 "no-meshes no-program" "${list/readme/read}" "$nothing
Skipped:
  Metrics.ReadsMeshes: no meshes <here>

Skipped, and tests/allowed_skips does not allow it here:
  readme: no program
$end"
summary 4 "no-meshes no-program" "# none" "$nothing
Skipped, and tests/allowed_skips does not allow it here:
  Metrics.ReadsMeshes: no meshes <here>
  readme: no program
$end"

# Without the shard that ran nothing all is well.
results()
{
    cat <<'END'
	<testcase name="readme" classname="readme" time="0.1" status="notrun">
		<skipped message="SKIP_RETURN_CODE=77"/>
		<system-out>SKIPPED: no program
</system-out>
	</testcase>
END
}
summary 0 "no-program" "$list" "
Skipped:
  readme: no program

0 passed, 0 failed, 1 skipped"

# Suites that hide what they skip.
results()
{
    for line in "OK (skipped=2)" "ℹ skipped 1" "# skipped 3" "  YOU HAVE 1 DISABLED TEST" "OK" "ℹ skipped 0"; do
        printf '\t<testcase name="%s" classname="x" time="1" status="run">\n\t\t<system-out>...\n%s\n' \
            "suite" "$line"
        printf '</system-out>\n\t</testcase>\n'
    done
}
summary 3 "" "$list" "
Skipped, and tests/allowed_skips does not allow it here:
  suite: OK (skipped=2)
  suite: ℹ skipped 1
  suite: # skipped 3
  suite:   YOU HAVE 1 DISABLED TEST

6 passed, 0 failed, 0 skipped"
