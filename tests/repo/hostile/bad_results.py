"""Damaged cases, runs, baselines and AOVs."""

import subprocess

from bad_files import NOISE
from case import TINY, Case, compare


def exported(gnomon):
    def prepare(d):
        subprocess.run([gnomon, *compare("--export-case", str(d / "case"))], check=True, capture_output=True)
    return prepare


def damaged(gnomon, make, name, change):
    def prepare(d):
        make(gnomon)(d)
        file = d / name
        file.write_bytes(change(file.read_bytes()))
    return prepare


DAMAGES = {"noise": lambda b: NOISE, "empty": lambda b: b"", "half": lambda b: b[: len(b) // 2],
           "end cut": lambda b: b[:-1], "zeros": lambda b: bytes(len(b)),
           "middle": lambda b: b[: len(b) // 3] + NOISE[:64] + b[len(b) // 3 + 64:]}


def run_of(gnomon):
    def prepare(d):
        subprocess.run([gnomon, "sweep", "--builtin", "wall", *TINY, "--axis", "bias.constant=0,0.1", "--out",
                        str(d / "run"), "--quiet"], check=True, capture_output=True)
        subprocess.run([gnomon, "baseline", "save", str(d / "run"), "--baseline", str(d / "b.json")], check=True,
                       capture_output=True)
    return prepare


def aov_of(gnomon):
    def prepare(d):
        subprocess.run([gnomon, *compare("--aov", str(d / "a.exr"))], check=True, capture_output=True)
    return prepare


def bad_results(gnomon):
    """Damaged cases, runs, baselines and tables. If a change leaves a file sound, the command may pass."""
    for what, change in DAMAGES.items():
        quick = what == "half"
        for file in ("aov.exr", "mesh.glb", "case.toml"):
            codes = (0, 2) if what in ("end cut", "middle") else (2,)
            yield Case(f"case: {file}: {what}", ["evaluate", "{d}/case"], codes, "",
                       damaged(gnomon, exported, f"case/{file}", change), is_quick=quick and file == "aov.exr")
        for verb in ("report", "status", "gate"):
            more = ["--baseline", "{d}/b.json"] if verb == "gate" else []
            yield Case(f"{verb}: database: {what}", [verb, "{d}/run", *more], (0, 2, 4, 5), "",
                       damaged(gnomon, run_of, "run/results.sqlite", change), is_quick=quick and verb == "status")
        yield Case(f"merge: one database: {what}", ["merge", "{d}/all", "{d}/run"], (0, 2, 4, 5), "",
                   damaged(gnomon, run_of, "run/results.sqlite", change))
        # A readable AOV may be certified or refuted.
        codes = (0, 1, 2) if what in ("end cut", "middle") else (2,)
        yield Case(f"certify: AOV: {what}", ["certify", "{d}/a.exr", "--builtin", "wall", *TINY], codes, "",
                   damaged(gnomon, aov_of, "a.exr", change), is_quick=quick)
        yield Case(f"gate: baseline: {what}", ["gate", "{d}/run", "--baseline", "{d}/b.json"], (0, 1, 2, 3), "",
                   damaged(gnomon, run_of, "b.json", change))
        yield Case(f"figure: table: {what}", ["figure", "bias-curve", "{d}/run", "-o", "{d}/f.svg"], (0, 2, 4), "",
                   damaged(gnomon, run_of, "run/bias_curves.csv", change))
        yield Case(f"resume: database: {what}", ["sweep", "--builtin", "wall", *TINY, "--axis", "bias.constant=0,0.1",
                                                 "--out", "{d}/run", "--quiet"], (0, 2, 4), "",
                   damaged(gnomon, run_of, "run/results.sqlite", change))
