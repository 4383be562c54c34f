#!/usr/bin/env bash
# Runs a sweep in units with GNU parallel, on one machine or several:
#
#   parallel.sh JOB RUN [OPTION…]         OPTIONs are parallel's own, such as --jobs 8
#   parallel.sh JOB RUN --sshloginfile hosts --workdir .
#
# Unit files go to RUN.units, which the machines must share, like the scenes. $UNITS sets the number of units. The same command
# resumes a stopped sweep. Exits with 5 if units are missing, else like `gnomon merge`.
set -euo pipefail
job=$1 run=$2
shift 2
gnomon=$(command -v "${GNOMON:-gnomon}")
units=$(realpath --canonicalize-missing "$run.units")
mkdir -p "$units"
"$gnomon" plan "$job" ${UNITS:+--units "$UNITS"} --out "$units/plan.jsonl"

count=$(($(wc -l <"$units/plan.jsonl") - 1)) # a unit is its number in the plan
seq "$count" | parallel --quote --retries 3 "$@" \
    "$gnomon" run-unit "$units/plan.jsonl" {} --out "$units" --threads 1 --quiet || true # files tell what is there

missing=$((count - $(find "$units" -maxdepth 1 -name '*.unit' | wc -l)))
if ((missing > 0)); then
    echo "parallel.sh: $missing of $count units are missing: the same command goes on" >&2
    exit 5
fi
exec "$gnomon" merge "$run" "$units"
