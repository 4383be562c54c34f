#!/usr/bin/env bash
# A sweep in units by GNU parallel, on this machine or on several:
#
#   parallel.sh JOB RUN [OPTION…]         OPTIONs are parallel's own, such as --jobs 8
#   parallel.sh JOB RUN --sshloginfile hosts --workdir .
#
# Units' files go to RUN.units, which is to be shared with the other machines, as the scenes are; $UNITS, if it is set, says how
# many. The same command goes on where this was stopped. It ends with 5 if units are missing, else as `gnomon merge` does.
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
