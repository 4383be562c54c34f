"""The precision of stored depth: `gnomon depth`."""

import json
from typing import TYPE_CHECKING, Any, Literal

from gnomon import _gnomon
from gnomon.comparison import _device
from gnomon.keys import real_number, whole_number

if TYPE_CHECKING:
    import pandas


class DepthStudy:
    """The error of a depth format in a frustum, by formula and as measured with GL."""

    def __init__(self, found: dict[str, Any]) -> None:
        self._json = found

    @property
    def theory(self) -> dict[str, Any]:
        """dict: steps and errors from the formulas [m] (docs/depth_precision.md)."""
        return self._json["theory"]

    @property
    def measured(self) -> dict[str, Any] | None:
        """dict, or None: the errors of the depths that GL stored [m]."""
        return self._json["measured"]

    def to_dict(self) -> dict[str, Any]:
        """The output of `gnomon depth --json`."""
        return self._json

    def to_pandas(self) -> "pandas.DataFrame":
        """pandas.DataFrame: a row for each sample, by distance `zeta_m` from the camera's plane."""
        import pandas

        return pandas.DataFrame(self._json["samples"])

    def __repr__(self) -> str:
        theory = self.theory
        return (
            f"<gnomon.DepthStudy: {self._json['format']}, steps of {theory['step_at_near_m']:.2g} m at near, "
            f"{theory['step_at_far_m']:.2g} m at far>"
        )


def depth(
    near_m: float = 4,
    far_m: float = 50,
    format: str = "",
    *,
    bits: int | None = None,
    content: Literal["depth", "distance"] = "depth",
    projection: Literal["perspective", "orthographic"] = "perspective",
    reversed: bool = False,
    clip: Literal["zero_to_one", "minus_one_to_one"] | None = None,
    samples: int = 4096,
    tilt_deg: float = 0,
    offset_m: float = 0,
    tolerance_m: float | None = None,
    measure: bool = False,
    device: int | None = None,
) -> DepthStudy:
    """The precision of a depth format in a frustum.

    Parameters
    ----------
    near_m, far_m : float
        The planes [m].
    format : str
        A depth format of a job, "d16", "d24", "d32f", …; empty to use `bits`, or d24 by default.
    bits : int, optional
        Evenly spaced codes of 8 to 32 bits, instead of a format.
    content : str
        "depth", or "distance": the distance to the light over far.
    projection : str
        "perspective" or "orthographic".
    reversed : bool
        Whether depth is 1 at near and 0 at far.
    clip : str, optional
        "zero_to_one" or "minus_one_to_one"; by default the first if reversed, else the second.
    samples : int
        Planes, from near to far.
    tilt_deg : float
        Tilt of the planes, 0 to 80.
    offset_m : float
        The camera's distance from the world origin, on each axis [m].
    tolerance_m : float, optional
        A constant tolerance to compare with the error [m].
    measure : bool
        Whether to draw the planes with GL and read the stored depths. The formulas need no GL.
    device : int, optional
        As for `compare`.

    Returns
    -------
    DepthStudy

    Raises
    ------
    InputError
        If an argument is out of range, or the driver lacks the format.
    EnvironmentError
        If there is no GL driver to measure with.
    """
    request = _gnomon.DepthRequest()
    request.near_m = real_number(near_m, "near_m")
    request.far_m = real_number(far_m, "far_m")
    request.reversed = bool(reversed)
    request.samples = whole_number(samples, "samples", 2, 2**22)
    request.tilt_deg = real_number(tilt_deg, "tilt_deg")
    request.offset_m = real_number(offset_m, "offset_m")
    request.tolerance_m = None if tolerance_m is None else real_number(tolerance_m, "tolerance_m")
    request.set_words(str(content), str(projection), None if clip is None else str(clip))
    if format and bits is not None:
        raise _gnomon.InputError("format and bits are mutually exclusive")
    bits = None if bits is None else whole_number(bits, "bits", 8, 32)
    return DepthStudy(json.loads(_gnomon.depth_json(request, str(format), bits, bool(measure), _device(device))))
