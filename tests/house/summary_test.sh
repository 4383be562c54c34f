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

expected='
Skipped:
  Metrics.ReadsMeshes: no meshes <here>
  readme: no program

4 passed, 4 failed, 2 skipped'
actual=$(results | awk -f summary.awk; echo x)
[ "${actual%$'\nx'}" = "$expected" ] || {
    printf 'expected:%s\nactual:%s\n' "$expected" "$actual" >&2
    exit 1
}
