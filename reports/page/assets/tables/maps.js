// Errors by map, of a light with several: the faces of a cube, or cascades.

/** @param {object[]} maps  "by_map" of `gnomon compare --json` */
const areCascades = (maps) => maps[0]?.begin_m !== undefined;

/** View depths of a cascade's slice, as the tables of `gnomon compare` have them. */
const sliceText = ({ begin_m: begin, end_m: end }) => `${readable(begin)} to ${readable(end)}`;

/** What a map is called beside others: "0: 2 to 7.5 m" of a cascade, "+x" of a face. */
function mapTitle(map) {
  return map.begin_m === undefined ? map.map : `${map.map}: ${sliceText(map)} ${sceneUnit()}`;
}

/** Which colour each map has; by name. */
function mapColoursByName(maps) {
  return Object.fromEntries(maps.map(({ map }, i) => [map, mapColours[i % mapColours.length]]));
}

/** What a cascade's map sees, and the job's constant bias there. */
function cascadeColumns(maps) {
  const metres = (title, valueOf) => ({ title, numeric: true, format: readable, valueOf });
  return [
    {
      title: `view depth [${sceneUnit()}]`,
      numeric: true,
      format: (place) => sliceText(maps[place]),
      valueOf: (map) => maps.indexOf(map),
    },
    metres(`texel [${sceneUnit()}]`, ({ texel_m: texelM }) => texelM),
    metres(`range [${sceneUnit()}]`, ({ near_m: nearM, far_m: farM }) => farM - nearM),
    metres(`bias [${sceneUnit()}]`, ({ bias }) => bias.constant_m),
  ];
}

/** The maps in their own order. */
function mapTable(maps) {
  const name = {
    title: areCascades(maps) ? "cascade" : "map",
    colours: mapColoursByName(maps),
    valueOf: ({ map }) => map,
  };
  return partTable("Errors by map", [name, ...(areCascades(maps) ? cascadeColumns(maps) : [])], maps);
}

/** A chart and a table. */
function mapParts(maps) {
  const host = element("div", { class: "chart-host" });
  mapChart(host, maps);
  return [host, mapTable(maps)];
}
