# awk -f stages.awk docs/building.md build/stages.tsv: prints the seconds of each stage of .ci/run and its record, the mean
# of the runs in the document's table between <!-- stages --> and <!-- end -->. Names stages that took a quarter longer.

BEGIN { quarter_longer = 1.25 }

FNR == 1 { ++file }

file == 1 && /<!-- stages -->/ { is_table = 1 }
file == 1 && /<!-- end -->/ { is_table = 0 }
file == 1 && is_table && split($0, cell, /[ \t]*\|[ \t]*/) > 3 && cell[3] ~ /^[0-9]+$/ {
    runs = sum = 0
    for (i = 3; cell[i] ~ /^[0-9]+$/; i++) {
        sum += cell[i]
        runs++
    }
    record[cell[2]] = sum / runs
}

file == 2 {
    split($0, of, "\t")
    if (!(of[1] in seconds)) {
        order[++count] = of[1]
    }
    seconds[of[1]] += of[2]
}

END {
    for (i = 1; i <= count; i++) {
        name = order[i]
        known = name in record ? sprintf(", record %d s", record[name] + 0.5) : ", no record"
        printf "%-18s %5d s%s\n", name, seconds[name], known
        # A quarter of a short stage is within the rounding to seconds.
        if (name in record && seconds[name] > quarter_longer * record[name] && seconds[name] > record[name] + 10) {
            slower[++slow] = sprintf("%s took %d s, %d %% longer than its record in docs/building.md", name,
                                     seconds[name], 100 * (seconds[name] / record[name] - 1) + 0.5)
        }
    }
    for (i = 1; i <= slow; i++) {
        print slower[i]
    }
}
