#!/usr/bin/env bash
# stages_test.sh WORK: stages.awk sets each stage beside its record, and names those that took a quarter longer.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
rm -rf "$1"
mkdir -p "$1"
cd "$1"
cat >building.md <<'END'
| build asan | 9999 | is another table |

<!-- stages -->
| stage | 2026-01-01 | 2026-01-02 |
|---|---|---|
| format | 4 | 6 |
| build asan | 390 | 410 |
| test asan | 100 | 100 |
<!-- end -->
END
printf 'format\t12\nbuild asan\t501\ntest asan\t60\ntest asan\t65\nbuild dev\t7\n' >stages.tsv
expected='format                12 s, record 5 s
build asan           501 s, record 400 s
test asan            125 s, record 100 s
build dev              7 s, no record
build asan took 501 s, 25 % longer than its record in docs/building.md'
diff <(echo "$expected") <(awk -f "$here/stages.awk" building.md stages.tsv)

printf 'build asan\t500\n' >stages.tsv # a quarter, and no more
diff <(echo 'build asan           500 s, record 400 s') <(awk -f "$here/stages.awk" building.md stages.tsv)
