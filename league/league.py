#!/usr/bin/env python3
"""The league of real shadows: compares each engine's settings on each scene with the truth (docs/league.md)."""

import argparse
import signal
import sys
from pathlib import Path

import document
import engines
import page
import pictures
import rows
import scenes
from measure import Bench, Store
from engine_run import SETTINGS, NotStarted, EngineRun

QUICK_BUDGET = 16  # settings; three engines on two scenes take some ten minutes
INTERRUPTED = 130


def absolute(word):
    """An absolute path."""
    return Path(word).absolute()


def settings_of(text):
    """The settings that `--settings` names, in the order of the table.

    Raises ArgumentTypeError for an unknown one.
    """
    named = text.split(",")
    for name in named:
        if name not in SETTINGS:
            raise argparse.ArgumentTypeError(f"unknown setting {name}; known are {', '.join(SETTINGS)}")
    return tuple(name for name in SETTINGS if name in named)


def arguments(words):
    parser = argparse.ArgumentParser(prog="./dev league", description="Measure the shadows of the engines that are installed.")
    parser.add_argument("engine", nargs="*", help="only these of engines/")
    parser.add_argument("--quick", action="store_true", help=f"three engines, two scenes, {QUICK_BUDGET} settings a search")
    parser.add_argument("--scenes", type=lambda word: word.split(","), help="only these, with commas between")
    parser.add_argument("--settings", type=settings_of, default=SETTINGS, help="only these of defaults, documented and tuned")
    parser.add_argument("--budget", type=int, help=f"settings that a search draws at most, in place of the engine's ({engines.BUDGET})")
    parser.add_argument("--again", action="store_true", help="measure what is there already once more, and say which numbers differ")
    parser.add_argument("--publish", action="store_true", help="write docs/league.csv, docs/league.md and its pictures, too")
    parser.add_argument("--out", type=absolute, default=scenes.ROOT / "out" / "league", help="where results are kept (out/league)")
    parser.add_argument("--engines", type=absolute, default=engines.ENGINES, help="the folder of engines (engines)")
    parser.add_argument("--jobs", type=absolute, default=scenes.JOBS, help="the folder of scenes.toml and its job files (league/jobs)")
    return parser.parse_args(words)


def say(line):
    print(f"league: {line}", file=sys.stderr, flush=True)


def measure_engine(bench, engine, lit_scenes, options):
    """The rows of one engine; a row `absent` if it is not installed or does not start."""
    missing = engine.missing()
    if missing:
        say(f"{engine.name}: not installed: {missing}")
        return [rows.absent(engine, f"not installed: {missing}")]
    engine_run = EngineRun(bench, engine, options.budget or (QUICK_BUDGET if options.quick else None), options.quick, options.settings)
    try:
        results = engine_run.measure(lit_scenes)
    except NotStarted as reason:
        say(f"{engine.name}: does not start: {reason}")
        return [rows.absent(engine, f"does not start: {reason}")]
    return rows.rows_of(engine, engine_run.devices["first"], results) if results else []


def scenes_for(options):
    """The scenes that can be measured here. Reports what the others lack."""
    known, found = scenes.all_scenes(options.jobs), []
    for name in options.scenes or []:
        if name not in known:
            raise engines.DescriptionError(f"unknown scene {name}; known are {', '.join(known)}")
    for scene in known.values():
        if scene.name not in (options.scenes or known) or (options.quick and not scene.quick):
            continue
        missing = scene.missing()
        if missing:
            say(f"{scene.name} is left out: {missing}")
        else:
            found.append(scene)
    return found


def publish(measured):
    """Writes the document, its table and its pictures. Keeps rows that were not measured now."""
    known = rows.read(document.CSV) if document.CSV.exists() else []
    merged = rows.merged(known, measured)
    for engine in dict.fromkeys(row["engine"] for row in measured):
        worst = pictures.worst(measured, engine)
        if worst and not pictures.draw(worst, document.IMAGES / f"{engine}.png"):
            say(f"{engine}: no picture of {worst['scene']}")
    rows.write(document.CSV, merged)
    document.write(rows.read(document.CSV))
    say("wrote docs/league.csv and docs/league.md")


def write_results(options, measured):
    rows.write(options.out / "league.csv", measured)
    read = rows.read(options.out / "league.csv")
    for engine in dict.fromkeys(row["engine"] for row in read):
        worst = pictures.worst(read, engine)
        if worst:
            pictures.draw(worst, options.out / "images" / f"{engine}.png")
    page.write(options.out / "league.html", read, options.out / "images", scenes.all_scenes(options.jobs))
    say(f"wrote {options.out / 'league.csv'} and {options.out / 'league.html'}")
    if options.publish:
        publish(read)


def run(options):
    chosen = engines.chosen(engines.all_engines(options.engines), options.engine, options.quick)
    lit_scenes = scenes_for(options)
    bench = Bench(Store(options.out / "store"), options.again, say)
    measured = []
    try:
        for engine in chosen:
            measured += measure_engine(bench, engine, lit_scenes, options)
    except KeyboardInterrupt:
        say(f"stopped; {bench.measured} results are kept, and the same command resumes")
        return INTERRUPTED
    say(f"{bench.measured} measured, {bench.kept} taken from {options.out / 'store'}")
    write_results(options, measured)
    return 0


def main():
    for ending in (signal.SIGINT, signal.SIGTERM):  # shells start background jobs with SIGINT ignored
        signal.signal(ending, signal.default_int_handler)
    try:
        return run(arguments(sys.argv[1:]))
    except engines.DescriptionError as error:
        say(str(error))
        return 2


if __name__ == "__main__":
    sys.exit(main())
