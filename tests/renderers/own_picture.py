"""The engine's own picture shows what its adapter takes for its mask."""
from unittest.mock import patch

import numpy
import OpenImageIO

from session import Session


def mask_of(answer, frame):
    """The mask of a frame, NaN where nothing is told. What is told must be seen, as the protocol has it."""
    if "shadow" in answer.get("files", {}):
        shadow, valid, position = (numpy.load(frame / answer["files"][name]) if name in answer["files"] else None
                                   for name in ("shadow", "valid", "position"))
        told, is_seen = True if valid is None else valid > 0, numpy.isfinite(position).all(-1)
    else:
        image = OpenImageIO.ImageBuf(str(frame / "frame.exr"))
        channels = {name: image.get_pixels(OpenImageIO.FLOAT)[..., i] for i, name in enumerate(image.spec().channelnames)}
        shadow, valid = channels["shadow.V"], channels.get("valid")
        told, is_seen = True if valid is None else valid > 0, numpy.isfinite(channels.get("P.X", shadow))
    assert valid is None or is_seen[told].all(), "valid is not 0 where nothing is seen"
    return numpy.where(is_seen & told, shadow, numpy.nan)


class OwnPicture:
    """To be mixed into a DrivenEngine, with what is None here."""
    PICTURE = ("--mask=picture",)  # what is said to the adapter beside its command
    PICTURED = None  # by scene, settings whose masks have light and shadow
    UNLIKE = None  # for the first of them, settings with another mask
    APART = 1e-4  # of a mask: both are sums of a few weights in float32, and a quotient adds a rounding of 6e-8 or two
    FEW = 0  # share of pixels that may be further apart

    def share_apart(self, scene, engine, pictured):
        """How much of what the picture tells the adapter's mask tells otherwise."""
        told = numpy.isfinite(pictured)
        own = mask_of(*self.frame(scene, engine))
        self.assertTrue(numpy.isfinite(own[told]).all(), "a picture tells of pixels that the mask does not have")
        return (abs(own - pictured)[told] > self.APART).sum() / told.sum()

    def test_TheEnginesOwnPictureShowsItsMaskAndNoOther(self):
        with Session([*self.COMMAND, *self.PICTURE]) as session, patch.object(self, "session", session):
            pictures = [mask_of(*self.frame(scene, engine)) for scene, engine in self.PICTURED.items()]
        for (scene, engine), pictured in zip(self.PICTURED.items(), pictures):
            self.assertGreater((pictured > 0.5).sum(), 1000, scene)
            self.assertGreater((pictured < 0.5).sum(), 1000, scene)
            self.assertLessEqual(self.share_apart(scene, engine, pictured), self.FEW, scene)
        self.assertGreater(self.share_apart(next(iter(self.PICTURED)), self.UNLIKE, pictures[0]), 10 * self.FEW + 0.002)
