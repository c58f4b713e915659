// SPDX-License-Identifier: BSD-3-Clause
// A labelled cloud: encoding, colours of its answers, units, and texts. Independent of the page.
"use strict";
((nav) => {
  const UNSURE = [112, 116, 122], // between the colours of the classes and the ground of the page
    NONE = [60, 60, 60],
    NO_UNIT = 0xffffffff;

  /** Reads the bytes of /api/cloud: places, units, and pixels if there is an image. */
  nav.readCloud = (bytes, count, hasImage) => {
    if (bytes.byteLength !== count * (hasImage ? 24 : 16)) throw new Error("the cloud is incomplete");
    return {
      count,
      places: new Float32Array(bytes, 0, 3 * count),
      units: new Uint32Array(bytes, 12 * count, count),
      pixels: hasImage ? new Float32Array(bytes, 16 * count, 2 * count) : null,
    };
  };

  /** Reads the bytes of /api/answers, three for each point. */
  nav.readAnswers = (bytes, count) => {
    if (bytes.byteLength !== 3 * count) throw new Error("the answers are incomplete");
    const all = new Uint8Array(bytes);
    return {
      label: (i) => all[3 * i],
      probability: (i) => all[3 * i + 1] / 255,
      isUnsure: (i) => (all[3 * i + 2] & 1) !== 0,
      isCorrected: (i) => (all[3 * i + 2] & 2) !== 0,
    };
  };

  nav.hexColour = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));

  /** The ways of colouring a labelled cloud: functions by name, from the index of a point to red, green, blue. */
  nav.labelColours = (cloud, answers, classes, range) => {
    const byNumber = new Map(classes.map((c) => [c.number, nav.hexColour(c.colour)])),
      [floor, roof] = range,
      all = (i) => byNumber.get(answers.label(i)) || NONE;
    return {
      answers: (i) => (answers.isUnsure(i) ? UNSURE : all(i)),
      all,
      probability: (i) => (answers.label(i) === 255 ? NONE : nav.ramp(1 - answers.probability(i))),
      corrections: (i) => (answers.isCorrected(i) ? all(i) : UNSURE),
      height: (i) => nav.ramp(Math.min(1, Math.max(0, (cloud.places[3 * i + 2] - floor) / Math.max(1, roof - floor)))),
    };
  };

  /** Lowest and highest corner of the finite points: {low, high}; null without one. */
  nav.cloudBox = ({count, places}) => {
    const low = [Infinity, Infinity, Infinity],
      high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < count; ++i) {
      if (!(Number.isFinite(places[3 * i]) && Number.isFinite(places[3 * i + 1]) && Number.isFinite(places[3 * i + 2])))
        continue;
      for (let k = 0; k < 3; ++k) {
        const v = places[3 * i + k];
        if (v < low[k]) low[k] = v;
        if (v > high[k]) high[k] = v;
      }
    }
    return low[0] <= high[0] ? {low, high} : null;
  };

  /** Points by unit, and the centres of the units. */
  nav.groupUnits = ({count, places, units}, number) => {
    const first = new Uint32Array(number + 1);
    for (let i = 0; i < count; ++i) if (units[i] !== NO_UNIT) ++first[units[i] + 1];
    for (let u = 0; u < number; ++u) first[u + 1] += first[u];
    const members = new Uint32Array(first[number]),
      next = first.slice(),
      centres = new Float64Array(3 * number);
    for (let i = 0; i < count; ++i) {
      const u = units[i];
      if (u === NO_UNIT) continue;
      members[next[u]++] = i;
      for (let k = 0; k < 3; ++k) centres[3 * u + k] += places[3 * i + k] / (first[u + 1] - first[u]);
    }
    return {first, members, centres, number};
  };

  /** Points that a correction at a point labels: its unit, and those whose centres are within the radius, m. */
  nav.pointsNear = ({places, units}, groups, point, radius) => {
    if (units[point] === NO_UNIT) return [];
    const found = [];
    for (let u = 0; u < groups.number; ++u) {
      let square = 0;
      for (let k = 0; k < 3; ++k) square += (groups.centres[3 * u + k] - places[3 * point + k]) ** 2;
      if (u === units[point] || square < radius * radius)
        for (let m = groups.first[u]; m < groups.first[u + 1]; ++m) found.push(groups.members[m]);
    }
    return found;
  };

  /** The nearest shown point within `reach` px of a pixel of the image; -1 without one. */
  nav.pickPixel = ({count, pixels}, u, v, reach) => {
    let best = -1,
      least = reach;
    for (let i = 0; i < count; ++i) {
      const off = Math.hypot(pixels[2 * i] - u, pixels[2 * i + 1] - v); // NaN if hidden
      if (off < least) {
        least = off;
        best = i;
      }
    }
    return best;
  };

  /** What the answers to some points are: {class name: share}, best first. */
  nav.answersOf = (points, answers, classes) => {
    const counts = new Map();
    for (const i of points) counts.set(answers.label(i), (counts.get(answers.label(i)) || 0) + 1);
    const nameOf = (number) => (classes.find((c) => c.number === number) || {name: "none"}).name;
    return [...counts].sort((a, b) => b[1] - a[1] || a[0] - b[0]).map(([number, n]) => [nameOf(number), n / points.length]);
  };

  nav.percentText = (share) => `${(100 * share).toFixed(share > 0 && share < 0.1 ? 1 : 0)} %`;

  /** A suggestion for a person: "wall 41 %, or vehicle: 312 like it, 410 m²". */
  nav.suggestionText = (s) =>
    `${s.class} ${nav.percentText(s.probability)}${s.second === "none" ? "" : `, or ${s.second}`}: ${s.units} like it, ${s.area_m2.toFixed(s.area_m2 < 10 ? 1 : 0)} m\u00b2`;

  /** A correction for a person: "1  paved, 132 points at 3.2, 4.1, 0.0". */
  nav.correctionText = (c, offset) =>
    `${c.number}  ${c.class === "none" ? "taken back" : c.class}, ${c.points} ${c.points === 1 ? "point" : "points"} at ${c.place.map((v, k) => (v + offset[k]).toFixed(1)).join(", ")}`;

  /** How many answers are sure, for a person. */
  nav.countsText = ({points, answered, unsure, corrected}) =>
    answered === 0
      ? `${points} points without an answer`
      : `${points} points, ${nav.percentText((answered - unsure) / answered)} sure, ${corrected} corrected`;
})((globalThis.urbanNav ??= {}));
