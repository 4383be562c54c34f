"""The tables of docs/lessons.md: the claims of the lessons with their measured numbers."""

import re
import sys
from collections import Counter

from all_lessons import LESSONS, rows
from claim import Verdict
from measured_job import ROOT

sys.path.append(str(ROOT / "docs"))

import blocks  # noqa: E402

PATH = ROOT / "docs" / "lessons.md"
NUMBER = "\0"  # stands for the number of a row


def row_text(lesson, claim, number=NUMBER):
    """A claim's row of its table."""
    unit = {"": "", "%": " %"}.get(claim.unit, f" {claim.unit}")
    job = f"[{claim.job}](../examples/lessons/{lesson.folder}/{claim.job}.toml)"
    return f"| {claim.claim} | {job} | {number}{unit} | {claim.number} | {claim.verdict.value} | {claim.why} |"


def verdicts_text():
    """The number of claims with each verdict, by lesson."""
    counts = {lesson.title: Counter(claim.verdict for claim in lesson.claims) for lesson in LESSONS}
    counts["all"] = Counter(claim.verdict for _, claim in rows())
    lines = [f"| | claims | {' | '.join(verdict.value for verdict in Verdict)} |", "|---|---|---|---|---|"]
    for title, count in counts.items():
        lines.append(f"| {title} | {count.total()} | {' | '.join(str(count[v]) for v in Verdict)} |")
    return "\n".join(lines)


def lesson_text(lesson, numbers):
    """A lesson's table, with printed numbers by claim."""
    lines = ["| it claims | job | number | of | verdict | why |", "|---|---|---|---|---|---|"]
    lines += [row_text(lesson, claim, numbers[claim.job]) for claim in lesson.claims]
    return "\n".join(lines)


def block_of(name):
    """The text between the markers of a name."""
    return blocks.block_of(PATH, name)


def number_of(lesson, claim):
    """A claim's number as the document has it; None if it has no such row."""
    pattern = re.escape(row_text(lesson, claim)).replace(re.escape(NUMBER), r"([-0-9.e]+)")
    found = re.search(f"^{pattern}$", block_of(lesson.folder), re.MULTILINE)
    return found[1] if found else None


def write(numbers):
    """Writes the tables, with printed numbers by the lesson's folder and the claim's job."""
    tables = {lesson.folder: lesson_text(lesson, numbers[lesson.folder]) for lesson in LESSONS}
    blocks.write_blocks(PATH, {**tables, "verdicts": verdicts_text()})
