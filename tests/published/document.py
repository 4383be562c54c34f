"""The blocks of docs/methods/published.md: the rows with their measured numbers."""

import re
import sys

from row import ROOT
from rows import ROWS

sys.path.append(str(ROOT / "docs"))

import blocks  # noqa: E402

PATH = ROOT / "docs" / "methods" / "published.md"
NUMBER = "\0"  # stands for a number of a row


def row_text(row, numbers):
    """A row's block, with these printed numbers."""
    lines = [f"- **They say:** {row.claim}", f"- **Source:** {row.source}.", f"- **Here:** {row.ours}.", "",
             "| number | theirs | measured |", "|---|---|---|"]
    for number, printed in zip(row.numbers, numbers):
        unit = f" {number.unit}" if number.unit else ""
        lines.append(f"| {number.name} | {number.published} | {printed}{unit} |")
    lines += ["", f"**{row.verdict.value.capitalize()}.** {row.why}", "", f"**What differs.** {row.differs}", "",
              "```sh", row.run.command, "```"]
    return "\n".join(lines)


def anchor(title):
    """The anchor of a heading."""
    return re.sub(r"[^a-z0-9 -]", "", title.lower()).replace(" ", "-")


def overview():
    lines = ["| published | where | verdict |", "|---|---|---|"]
    lines += [f"| {row.claim} | [{row.title}](#{anchor(row.title)}) | {row.verdict.value} |" for row in ROWS]
    return "\n".join(lines)


def numbers_of(row):
    """The numbers of a row as the document has them; None if the row's text differs."""
    pattern = re.escape(row_text(row, [NUMBER] * len(row.numbers))).replace(re.escape(NUMBER), r"([-0-9.e]+)")
    found = re.fullmatch(pattern, blocks.block_of(PATH, row.name))
    return found.groups() if found else None


def write(rows):
    """Writes these rows into the document. The others keep their numbers."""
    texts = {row.name: row_text(row, [number.printed(number.measure()) for number in row.numbers]) for row in rows}
    blocks.write_blocks(PATH, {**texts, "overview": overview()})
