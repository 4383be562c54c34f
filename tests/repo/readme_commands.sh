#!/usr/bin/env bash
# readme_commands.sh DOCUMENT PROGRAM_FOLDER WORK_FOLDER: runs every command of a document.
#
# A command is a line of a ```sh block; a backslash continues it. Commands run in order in one empty folder, with
# PROGRAM_FOLDER first in PATH. Lines that start with ./dev, git or cd need a checkout, and do not run.
set -euo pipefail

document=$1
program_folder=$(cd "$2" && pwd)
work_folder=$3

[ -x "$program_folder/gnomon" ] || {
    echo "readme_commands: $program_folder/gnomon is missing; build it with ./dev build" >&2
    exit 1
}
rm -rf "$work_folder"
mkdir -p "$work_folder"
export PATH=$program_folder:$PATH

mapfile -t commands < <(awk '
    /^```/ { in_block = ($0 == "```sh"); next }
    !in_block || /^[ \t]*(#|$)/ { next }
    /\\$/ { command = command substr($0, 1, length($0) - 1); next }
    { print command $0; command = "" }' "$document")

count=0
for command in "${commands[@]}"; do
    case $command in
        "./dev"* | "git "* | "cd "*) continue ;;
    esac
    printf '$ %s\n' "$command"
    (cd "$work_folder" && bash -euo pipefail -c "$command") || {
        echo "readme_commands: $document: this command failed with $?: $command" >&2
        exit 1
    }
    count=$((count + 1))
done

[ "$count" -gt 0 ] || {
    echo "readme_commands: $document: no command found in a \`\`\`sh block" >&2
    exit 1
}
