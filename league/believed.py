"""Which rows are numbers of the engine."""


def is_believed(row):
    """Whether a row counts: measured, and not by an adapter's mistake."""
    return row["status"] == "done" and not row["trust"].startswith("not trusted")
