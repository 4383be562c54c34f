// The layers that mark wrong pixels: errors, and their causes and names.

/** A wrong pixel of which the page does not know more. */
const unknownColour = "#4A5058";

const growthNote = "larger when zoomed out";

function unknownEntry(image, kind) {
  const name = `wrong at this bias, ${kind} known at the job’s bias only`;
  return image.hasCurve ? [{ name, colour: unknownColour }] : [];
}

/** What the errors' layer shows behind its marks: the faded truth, and pixels that are not scored. */
function errorBase(image, scene) {
  const { class: classes } = image.layers;
  const unscored = classNames.map((name) =>
    ["unmatched", "indeterminate"].includes(name) ? packedColour(channels(errorColours[name])) : 0,
  );
  return scene.faded.map((faded, i) => unscored[classes[i]] || faded);
}

/** False shadow and false lit at the slider's bias, over the truth. */
function errorLayer(image, scene) {
  const { class: classes } = image.layers;
  const falseShadow = packedColour(channels(errorColours.falseShadow));
  const falseLit = packedColour(channels(errorColours.falseLit));
  const base = errorBase(image, scene);
  const marks = new Uint32Array(base.length);
  return {
    id: "errors",
    title: "Errors",
    note: `${image.hasCurve ? "at the slider’s bias" : jobBiasNote}; ${growthNote}`,
    followsBias: true,
    marksErrors: true,
    paint: (packed, bias, growth) => {
      const { litFrom } = image;
      for (let i = 0; i < marks.length; ++i) {
        const isLit = litFrom[i] <= bias;
        const isFalseLit = classes[i] === classBlocked && isLit;
        marks[i] = classes[i] === classLit && !isLit ? falseShadow : isFalseLit ? falseLit : 0;
      }
      paintMarks(packed, image.width, base, marks, growth);
    },
    legend: () =>
      swatchLegend([
        { name: "false shadow", colour: errorColours.falseShadow },
        { name: "false lit", colour: errorColours.falseLit },
        { name: "unmatched", colour: errorColours.unmatched },
        { name: "indeterminate", colour: errorColours.indeterminate },
        { name: "right", colour: legendColours.faded },
      ]),
  };
}

/**
 * Codes of wrong pixels over the faded truth; code 0 has no mark.
 * @param {{id: string, kind: string, title: string, names: string[], colours: object}} spec
 * @param {function(number, number): number} codeAt  of a pixel and a bias
 */
function codeLayer(image, scene, { id, kind, title, names, colours }, codeAt) {
  const palette = names.map((name) => (colours[name] === undefined ? 0 : packedColour(channels(colours[name]))));
  const unknown = packedColour(channels(unknownColour));
  const marks = new Uint32Array(scene.faded.length);
  const entries = names.slice(1).map((name) => ({ name: spoken(name), colour: colours[name] }));
  const rest = { name: "right or not compared", colour: legendColours.faded };
  return {
    id,
    title,
    note: `${image.hasCurve ? "at the slider’s bias" : jobBiasNote}; ${growthNote}`,
    followsBias: true,
    marksErrors: true,
    legend: () => swatchLegend([...entries, ...unknownEntry(image, kind), rest]),
    paint: (packed, bias, growth) => {
      for (let i = 0; i < marks.length; ++i) {
        const code = codeAt(i, bias);
        marks[i] = code === unknownCode ? unknown : palette[code];
      }
      paintMarks(packed, image.width, scene.faded, marks, growth);
    },
  };
}

/** Causes and names of errors; none where the image lacks them. */
function codeLayers(image, scene, causes) {
  const specs = [
    { id: "cause", kind: "cause", title: "Causes of errors", names: causeNames, colours: causeColours },
    { id: "label", kind: "name", title: "Names of errors", names: labelNames, colours: labelColours },
  ];
  const codeAt = { cause: (...at) => causes.causeAt(...at), label: (...at) => causes.labelAt(...at) };
  return specs
    .filter(({ id }) => image.layers[id] !== undefined)
    .map((spec) => codeLayer(image, scene, spec, codeAt[spec.id]));
}
