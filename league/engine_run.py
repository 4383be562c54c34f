"""Measures one engine: its settings on each scene, and the trials of its adapter."""

from dataclasses import dataclass, field

from checks import is_surprising
from measure import Measurement

SETTINGS = ("defaults", "documented", "tuned")


class NotStarted(Exception):
    """An installed engine does not start."""


def half_size(scene):
    """Options for frames of half the width and height. Searches draw many; their result is measured at full size."""
    return tuple(word for key, pixels in scene.image().items() for word in ("--set", f"image.{key}={pixels // 2}"))


@dataclass(frozen=True)
class Device:
    """An engine's version and device, and its keys with their defaults."""

    title: str
    defaults: dict

    @property
    def version(self):
        return self.title.partition(", ")[0]

    @property
    def device(self):
        return self.title.partition(", ")[2]


@dataclass
class SceneResults:
    """The outcomes of an engine on a scene, by setting: also by the second rasterizer (`second`), with masks from pictures
    (`pictured`), and of the trials; `calls` repeat them; `own` is the outcome of Gnomon's GL."""

    scene: object
    rows: dict = field(default_factory=dict)
    calls: dict = field(default_factory=dict)
    second: dict = field(default_factory=dict)
    pictured: dict = field(default_factory=dict)
    tune: dict = None
    own: dict = None
    trials: dict = field(default_factory=dict)


class EngineRun:
    """One engine's part of the league."""

    def __init__(self, bench, engine, budget=None, is_quick=False, settings=SETTINGS):
        self.bench, self.engine, self.is_quick, self.settings = bench, engine, is_quick, settings
        self.budget = budget or engine.budget
        self.devices = {}

    def device(self, variant, scene):
        """The engine's device, found by drawing a frame.

        Raises NotStarted if no frame is drawn.
        """
        if variant not in self.devices:
            outcome = self.bench.run(Measurement("", "compare", self.engine, scene, options=half_size(scene), variant=variant))
            if outcome["status"] != "done":
                raise NotStarted(outcome["message"])
            said = outcome["json"]
            keys = {key.removeprefix("engine."): value for key, value in said["job"].items() if key.startswith("engine.")}
            self.devices[variant] = Device(said["environment"]["gl_renderer"], keys)
        return self.devices[variant]

    def measure(self, scenes):
        """The results by scene, for scenes whose light the engine supports.

        Raises NotStarted if the engine draws no frame.
        """
        lit = [scene for scene in scenes if scene.light in self.engine.lights]
        if not lit:
            return []
        self.device("first", lit[0])
        return [self._scene(scene) for scene in lit]

    def _call(self, scene, kind, settings=None, command="compare", options=(), variant="first"):
        measurement = Measurement(f"{self.engine.name}.{scene.name}.{kind}", command, self.engine, scene, settings or {}, tuple(options),
                                  variant)
        return measurement, self.bench.outcome(measurement, self.device(variant, scene).title)

    def _scene(self, scene):
        results = SceneResults(scene, own=self.bench.outcome(Measurement(f"gnomon.{scene.name}", "compare", None, scene), "GL"))
        documented = self.engine.documented_for(scene.light)
        if "defaults" in self.settings:
            self._row(results, "defaults", {})
        if "documented" in self.settings and documented is not None:
            self._row(results, "documented", documented)
        if "tuned" in self.settings:
            self._tuned(results)
        trials = [("shadows_off", self.engine.shadows_off, ()), ("no_caster", {}, ("--case", "no-caster"))]
        if scene.known_shape and self.engine.known_shape:
            trials.append(("known_shape", self.engine.known_shape, ()))
        for trial, settings, options in trials:
            results.trials[trial] = self._call(scene, trial, settings, options=options)[1]
        if self.engine.second_for(scene.light):
            results.second = self._by("second", results)
        if self.engine.own_picture:
            results.pictured = self._by("picture", results)
        return results

    def _row(self, results, setting, settings):
        call, outcome = self._call(results.scene, setting, settings)
        results.rows[setting], results.calls[setting] = outcome, call

    def _tuned(self, results):
        """Measures the best settings that tune finds, if there are keys to search."""
        defaults = self.device("first", results.scene).defaults
        search = tuple(defaults) if self.engine.search is None else self.engine.search
        if not search:
            return
        fixed = {key: value for key, value in defaults.items() if key not in search or key in self.engine.shadows_off}
        options = (*half_size(results.scene), "--budget", str(self.budget))
        _, results.tune = self._call(results.scene, "tune", fixed, "tune", options)
        if results.tune["status"] != "done":
            results.rows["tuned"] = results.tune
            return
        found = results.tune["json"]["recommended"]["engine"]
        self._row(results, "tuned", {key: value for key, value in found.items() if value != defaults[key]})

    def _by(self, variant, results):
        """The outcomes of another variant by setting, for surprising rows and the defaults."""
        outcomes = {}
        for setting, outcome in results.rows.items():
            if setting not in results.calls:
                continue
            is_wanted = outcome["status"] == "done" and is_surprising(outcome["json"])
            if is_wanted or (setting == "defaults" and not self.is_quick):
                outcomes[setting] = self._try(variant, results.scene, setting, results.calls[setting].settings)
        return outcomes

    def _try(self, variant, scene, setting, settings):
        try:
            return self._call(scene, f"{setting}.{variant}", settings, variant=variant)[1]
        except NotStarted as reason:
            return {"status": "failed", "message": str(reason), "json": None}
