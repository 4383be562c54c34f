#!/usr/bin/env bash
# Hands readme_commands.sh small documents that must pass or fail: readme_commands_test.sh WORK_FOLDER.
set -euo pipefail

work_folder=$1
script=$(dirname "${BASH_SOURCE[0]}")/readme_commands.sh

rm -rf "$work_folder"
mkdir -p "$work_folder/bin"
printf '#!/bin/sh\n[ "$1" = compare ] && echo "compared $2"\n' > "$work_folder/bin/gnomon"
chmod +x "$work_folder/bin/gnomon"

# run_document TEXT: runs the commands of a document with this text, all output to $output.
run_document()
{
    printf '%s\n' "$1" > "$work_folder/document.md"
    output=$(bash "$script" "$work_folder/document.md" "$work_folder/bin" "$work_folder/run" 2>&1)
}

fail()
{
    printf 'readme_commands_test: %s\n%s\n' "$1" "$output" >&2
    exit 1
}

fence='```'
run_document "${fence}sh
./dev build
# a comment
gnomon compare \\
    yard > kept.txt
grep 'compared yard' kept.txt
$fence
${fence}toml
gnomon refuse
$fence" || fail "these commands must pass"
[[ $output == *"compared yard"* ]] || fail "a command's output must be shown"

run_document "${fence}sh
gnomon refuse
gnomon compare yard
$fence" && fail "a failing command must fail the test"
[[ $output == *"failed with 1: gnomon refuse"* ]] || fail "the failing command must be named"

run_document "no commands here" && fail "a document without commands must fail the test"
exit 0
