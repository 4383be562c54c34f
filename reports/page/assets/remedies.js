// Changes that reduce the shown configuration’s error, and the biases that other slopes need.

const measuredBy = { rerun: "GL, run again", curve: "the bias curve", slope_curve: "another slope’s bias curve" };

/** "4 MiB" */
function mebibytes(bytes) {
  return `${readable(bytes / 1024 / 1024)} MiB`;
}

/** A bias in the units that people think in, behind its key; empty where a remedy sets none. */
function biasLength({ bias, bias_m: metres, bias_texels: texels }) {
  return bias > 0 && metres !== null
    ? ` (${readable(Number(metres.toPrecision(3)))} ${sceneUnit()}, ${readable(Number(texels.toPrecision(3)))} texels)`
    : "";
}

/** Whether remedies were tried in several views. */
function hasViews(detail) {
  return (detail?.remedies ?? []).some(({ worst_view: worst }) => worst);
}

/** The ranked remedies, from `gnomon compare --json`: the first cures most for the least. */
function remedyTable({ remedies, pixels, false_shadow: shadow, false_lit: lit, ...now }) {
  const withViews = hasViews({ remedies });
  const scored = pixels.lit + pixels.blocked;
  // Runs of before do not have it.
  const amount = (of) => of.error_amount ?? of.shadow_amount + of.light_amount - (of.softening ?? 0);
  const error = (of) => rate(amount(of), scored);
  const columns = [
    { title: "change", wraps: true },
    { title: "rank", numeric: true, format: grouped },
    { title: "wrong pixels", numeric: true, format: grouped },
    { title: "error by amount", numeric: true, format: percent },
    { title: "map", numeric: true, format: mebibytes },
    { title: "texels read", numeric: true, format: grouped },
    { title: "known from", wraps: true },
    ...(withViews
      ? [{ title: "worst view" }, { title: "error there", numeric: true, format: percent }]
      : []),
  ];
  const worst = ({ worst_view: name, views }) => [
    name ?? null,
    views?.find((view) => view.name === name)?.error_amount_rate ?? null,
  ];
  const row = (remedy, i) => [
    remedy.keys.join(", ") + biasLength(remedy),
    i + 1,
    remedy.false_shadow + remedy.false_lit,
    error(remedy),
    remedy.map_bytes,
    remedy.taps,
    measuredBy[remedy.measured_by],
    ...(withViews ? worst(remedy) : []),
  ];
  const asItIs = ["the job as it is", null, shadow + lit, error(now), null, null, null, ...(withViews ? [null, null] : [])];
  return sortedTable("Changes that reduce the error (amounts leave out borders softened on purpose)", columns, [
    asItIs,
    ...remedies.map(row),
  ]);
}

/** The constant biases that each slope allows. */
function slopeTable(slopes) {
  const columns = [
    { title: "slope", numeric: true, format: readable },
    { title: "fewest errors [px]", numeric: true, format: grouped },
    { title: "with a constant bias from", numeric: true, format: readable },
    { title: "to", numeric: true, format: readable },
    { title: "no acne from", numeric: true, format: readable },
    { title: "no false light up to", numeric: true, format: readable },
  ];
  return sortedTable(
    "Constant biases with other slopes [depth units]",
    columns,
    slopes.map((slope) => [
      slope.slope,
      slope.best_errors,
      slope.best_interval[0],
      slope.best_interval[1],
      slope.acne_free,
      slope.panning_free,
    ]),
  );
}

/** Fills #remedies; its section is hidden where nothing is known. */
class RemedySection {
  /**
   * @param {HTMLElement} section
   * @param {HTMLElement} host  in the section
   * @param {boolean} listsRemedies  whether the first screen may be of another configuration
   */
  constructor(section, host, listsRemedies) {
    Object.assign(this, { section, host, listsRemedies });
    this.hasTable = !section.hidden;
  }

  show(detail, caption) {
    const remedies = this.listsRemedies || hasViews(detail) ? (detail?.remedies ?? []) : [];
    const slopes = detail?.slope_curves ?? [];
    this.section.hidden = !this.hasTable && remedies.length === 0 && slopes.length === 0;
    this.host.replaceChildren(
      element("p", { class: "caption name", text: caption }),
      ...(remedies.length > 0 ? [remedyTable(detail)] : []),
      ...(slopes.length > 0 ? [slopeTable(slopes)] : []),
    );
  }
}
