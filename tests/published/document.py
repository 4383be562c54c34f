"""docs/methods/published.md: its blocks are the rows, with the numbers that were measured."""

import re

from row import ROOT
from rows import ROWS

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


def _block(name):
    return re.compile(rf"(<!-- {name}: generated -->\n\n)(.*?)(\n\n<!-- end -->)", re.DOTALL)


def block_of(name):
    """What stands between the markers of a name.

    Raises AssertionError where there are none.
    """
    found = _block(name).search(PATH.read_text())
    assert found, f"docs/methods/published.md has no block <!-- {name}: generated -->"
    return found[2]


def numbers_of(row):
    """The numbers that the document gives of a row, as they stand there; None if it says anything else of it."""
    pattern = re.escape(row_text(row, [NUMBER] * len(row.numbers))).replace(re.escape(NUMBER), r"([-0-9.e]+)")
    found = re.fullmatch(pattern, block_of(row.name))
    return found.groups() if found else None


def write(rows):
    """Puts these rows into the document, and of the others the text with the numbers that it had."""
    text = PATH.read_text()
    blocks = {row.name: row_text(row, [number.printed(number.measure()) for number in row.numbers]) for row in rows}
    blocks["overview"] = overview()
    for name, block in blocks.items():
        text = _block(name).sub(lambda found, block=block: found[1] + block + found[3], text)
    PATH.write_text(text)
