// Names of the values of the layers class, cause and label; docs/aov.md.

const classNames = ["background", "unmatched", "attached", "out_of_light", "indeterminate", "lit", "blocked"];
const causeNames = ["none", "bias", "precision", "resolution", "coverage", "filter"];
const labelNames = ["right", "acne", "peter_panning", "leak", "edge", "overshadow", "bleed"];
const classBackground = 0;
const classUnmatched = 1;
const classLit = 5;
const classBlocked = 6;
const noTriangle = 0xffffffff;
const noObject = 0xffff;
const noMap = 0xff;
const noTexel = 0xffff;

/** Whether a pixel of this class takes part in rates. */
function isScored(pixelClass) {
  return pixelClass === classLit || pixelClass === classBlocked;
}

/** Whether GL draws a surface in a pixel of this class that is looked up in the shadow map. */
function hasReceiver(pixelClass) {
  return pixelClass > classUnmatched;
}

/** A name as people read it: peter_panning as "peter panning". */
function spoken(name) {
  return name.replaceAll("_", " ");
}
