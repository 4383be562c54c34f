"""The engine's own picture agrees with the mask that its adapter writes."""
from unittest.mock import patch

import numpy
import OpenImageIO

from session import Session


def mask_of(answer, frame):
    """The mask of a frame; NaN where it is not valid. By the protocol, valid pixels show a surface."""
    if "shadow" in answer.get("files", {}):
        shadow, valid, position = (numpy.load(frame / answer["files"][name]) if name in answer["files"] else None
                                   for name in ("shadow", "valid", "position"))
        told, is_seen = True if valid is None else valid > 0, numpy.isfinite(position).all(-1)
    else:
        image = OpenImageIO.ImageBuf(str(frame / "frame.exr"))
        channels = {name: image.get_pixels(OpenImageIO.FLOAT)[..., i] for i, name in enumerate(image.spec().channelnames)}
        shadow, valid = channels["shadow.V"], channels.get("valid")
        told, is_seen = True if valid is None else valid > 0, numpy.isfinite(channels.get("P.X", shadow))
    assert valid is None or is_seen[told].all(), "valid is not 0 where no surface is seen"
    return numpy.where(is_seen & told, shadow, numpy.nan)


class OwnPicture:
    """A mixin of DrivenEngine, which must set what is None here."""
    PICTURE = ("--mask=picture",)  # the adapter's option
    PICTURED = None  # settings by scene, whose masks have light and shadow
    UNLIKE = None  # settings of the first scene with another mask
    APART = 1e-4  # of masks: sums of a few weights in float32, and a quotient, have a few roundings of 6e-8
    FEW = 0  # the share of pixels that may differ by more

    def share_apart(self, scene, engine, pictured):
        """The share of the picture's pixels that differ from the adapter's mask."""
        told = numpy.isfinite(pictured)
        own = mask_of(*self.frame(scene, engine))
        self.assertTrue(numpy.isfinite(own[told]).all(), "the picture has pixels that the mask does not have")
        return (abs(own - pictured)[told] > self.APART).sum() / told.sum()

    def test_TheEnginesOwnPictureShowsItsMaskAndNoOther(self):
        with Session([*self.COMMAND, *self.PICTURE]) as session, patch.object(self, "session", session):
            pictures = [mask_of(*self.frame(scene, engine)) for scene, engine in self.PICTURED.items()]
        for (scene, engine), pictured in zip(self.PICTURED.items(), pictures):
            self.assertGreater((pictured > 0.5).sum(), 1000, scene)
            self.assertGreater((pictured < 0.5).sum(), 1000, scene)
            self.assertLessEqual(self.share_apart(scene, engine, pictured), self.FEW, scene)
        self.assertGreater(self.share_apart(next(iter(self.PICTURED)), self.UNLIKE, pictures[0]), 10 * self.FEW + 0.002)
