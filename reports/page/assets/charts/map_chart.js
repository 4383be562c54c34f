// Errors by map, of a light with several: a bar each for false shadow and false lit.

/** Whether verdicts are fractions, which counts of wrong pixels do not tell. */
function hasFractions(maps) {
  return maps.some((map) => map.shadow_amount !== map.false_shadow || map.light_amount !== map.false_lit);
}

/** The map where a rate is largest, in words. */
function worstMap(maps, member) {
  const worst = maps.reduce((a, b) => ((b[member] ?? -1) > (a[member] ?? -1) ? b : a));
  return `${percent(worst[member] ?? 0)} in ${mapTitle(worst)}`;
}

/**
 * @param {HTMLElement} host
 * @param {object[]} maps  "by_map" of `gnomon compare --json`
 */
function mapChart(host, maps) {
  const isByAmount = hasFractions(maps);
  const [shadow, light] = isByAmount
    ? ["shadow_amount_rate", "light_amount_rate"]
    : ["false_shadow_rate", "false_lit_rate"];
  const bars = (name, colour, member) => ({
    name,
    colour,
    isBar: true,
    points: maps.map((map, place) => [place, map[member]]),
  });
  const title = (place) => (Number.isInteger(place) && maps[place] ? mapTitle(maps[place]) : "");
  return new PageChart(host, {
    title: `${isByAmount ? "Amount of error" : "Errors"} by map, at its own bias`,
    summary:
      `Largest false-shadow rate ${worstMap(maps, shadow)}, ` +
      `largest false-lit rate ${worstMap(maps, light)}.`,
    x: {
      label: areCascades(maps) ? "cascade: view depth" : "map",
      name: "map",
      layout: { ...linearLayout(title), ticks: () => maps.map((_, place) => place) },
      isText: true,
      low: -0.5,
      high: maps.length - 0.5,
    },
    y: {
      label: "share of the map’s lit or blocked pixels",
      layout: rateLayout(),
      low: 0,
      high: 1,
    },
    series: [
      bars("false shadow, of the lit", errorColours.falseShadow, shadow),
      bars("false lit, of the blocked", errorColours.falseLit, light),
    ],
  });
}
