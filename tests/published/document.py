"""docs/methods/published.md: its blocks are the rows, with the numbers that were measured."""

import re
import sys

from row import ROOT
from rows import ROWS

sys.path.append(str(ROOT / "docs"))

import blocks  # noqa: E402

PATH = ROOT / "docs" / "methods" / "published.md"
NUMBER = "\0"  # stands where a row has a number


def row_text(row, numbers):
    """A row's block; numbers: printed ones, in their order."""
    lines = [f"- **They say:** {row.claim}", f"- **Source:** {row.source}.", f"- **Here:** {row.ours}.", "",
             "| number | theirs | measured |", "|---|---|---|"]
    for number, printed in zip(row.numbers, numbers):
        unit = f" {number.unit}" if number.unit else ""
        lines.append(f"| {number.name} | {number.published} | {printed}{unit} |")
    lines += ["", f"**{row.verdict.value.capitalize()}.** {row.why}", "", f"**What differs.** {row.differs}", "",
              "```sh", row.run.command, "```"]
    return "\n".join(lines)


def anchor(title):
    """Of a heading."""
    return re.sub(r"[^a-z0-9 -]", "", title.lower()).replace(" ", "-")


def overview():
    lines = ["| published | where | verdict |", "|---|---|---|"]
    lines += [f"| {row.claim} | [{row.title}](#{anchor(row.title)}) | {row.verdict.value} |" for row in ROWS]
    return "\n".join(lines)


def block_of(name):
    """What stands between the markers of a name."""
    return blocks.block_of(PATH, name)


def numbers_of(row):
    """The numbers that the document gives of a row, as they stand there; None if it says anything else of it."""
    pattern = re.escape(row_text(row, [NUMBER] * len(row.numbers))).replace(re.escape(NUMBER), r"([-0-9.e]+)")
    found = re.fullmatch(pattern, block_of(row.name))
    return found.groups() if found else None


def write(rows):
    """Puts these rows into the document, and of the others the text with the numbers that it had."""
    texts = {row.name: row_text(row, [number.printed(number.measure()) for number in row.numbers]) for row in rows}
    blocks.write_blocks(PATH, {**texts, "overview": overview()})
