// SPDX-License-Identifier: BSD-3-Clause
// The map in a report: points embedded in the page, drawn and coloured as in `view`.
"use strict";
((nav) => {
  const LAYOUT = {stride: 8, red: 0, reflectance: 3, sensor: 4, pass: 5, sigma: 6, quality: 7};
  const STEP_MM = 0.5; // of sigma and of the distance between passes

  /** Points from the bytes of a report: x, y, z and time of each in 16 bits of their ranges, then eight values of each. */
  nav.readPackedPoints = (bytes, count, low, high, seconds) => {
    const view = new DataView(bytes.buffer, bytes.byteOffset),
      places = new Float32Array(3 * count),
      times = new Float32Array(count),
      share = (i) => view.getUint16(2 * i, true) / 65535;
    for (let i = 0; i < count; ++i) {
      for (let k = 0; k < 3; ++k) places[3 * i + k] = low[k] + (high[k] - low[k]) * share(4 * i + k);
      times[i] = seconds * share(4 * i + 3);
    }
    return {count, places, times, values: bytes.subarray(8 * count), layout: LAYOUT};
  };

  /** Returns the description of a point; `first`: stamp of the earliest point, s. */
  nav.describePoint = (points, i, first) => {
    const at = (name) => points.values[LAYOUT.stride * i + LAYOUT[name]],
      apart = at("quality");
    return (
      `stamp ${(first + points.times[i]).toFixed(2)} s, pass ${at("pass")}, sensor ${at("sensor")}, ` +
      `sigma ${(STEP_MM * at("sigma")).toFixed(1)} mm` +
      (apart === 255 ? "" : `, passes ${(STEP_MM * apart).toFixed(1)} mm apart`)
    );
  };

  const decode = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

  const waiting = new Map(); // functions that take the text of a tile, by its name
  /** Takes a tile from its script next to the report. */
  nav.takeTile = (name, text) => {
    if (waiting.has(name)) waiting.get(name)(text);
    waiting.delete(name);
  };
  const loadScript = (folder, number, tile) =>
    new Promise((resolve, reject) => {
      waiting.set(`${number}/${tile.name}`, resolve);
      const script = document.createElement("script");
      script.onerror = reject;
      script.onload = () => script.remove();
      script.src = `${folder}/${number}_${tile.name.replace(/[/,]/g, "_")}.js`;
      document.head.append(script);
    });
  const unpack = (text) =>
    new Response(new Blob([decode(text)]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();

  /** The finer levels next to the report, of which an element holds the list: a view of tiles; null without a list. */
  const finerLevels = (element, view, around, missing) => {
    const script = element.querySelector('script[type="application/json"]');
    if (!script || !globalThis.DecompressionStream) return null;
    const {folder, number} = script.dataset,
      tileBytes = (tile) => loadScript(folder, number, tile).then(unpack),
      finer = new nav.TileView(
        view,
        (tile) =>
          tileBytes(tile).catch((error) => {
            missing();
            throw error;
          }),
        around,
      ),
      list = nav.readTileList({sets: [JSON.parse(script.textContent)]}),
      none = list.sets.map(({sessions}) => sessions.map(() => null));
    finer.setList(list);
    finer.place(
      nav.tilePlacement(
        list.sets,
        none,
        list.sets[0].sessions.map((id) => ({id, map: 0})),
        new Map(),
      ),
      [],
    );
    return finer;
  };
  const TILE_MODES = ["pictures", "reflectance", "height", "sensor", "sigma"]; // tiles hold no more

  /** Draws the map of an element that the report holds, and lets other parts of the report add colours to it. */
  nav.showReportMap = (element) => {
    const canvas = element.querySelector("canvas"),
      choice = element.querySelector("select"),
      output = element.querySelector("output"),
      view = new nav.PointView(canvas, {preserveDrawingBuffer: true});
    if (!view.gl) {
      element.style.display = "none";
      return;
    }
    const {dataset} = element,
      list = (text) => text.split(",").map(Number),
      low = list(dataset.low),
      high = list(dataset.high),
      size = low.map((v, k) => high[k] - v);
    const bytes = decode(element.querySelector("script").textContent),
      points = nav.readPackedPoints(bytes, Number(dataset.points), low, high, Number(dataset.seconds)),
      modes = nav.colourModes(points, nav.sessionColours || []);
    const centre = low.map((v, k) => v + size[k] * (k < 2 ? 0.5 : 0.2)),
      camera = new nav.Camera(centre, 0.7 * Math.hypot(size[0], size[1]));
    const matrix = () => camera.matrix(canvas.clientWidth, canvas.clientHeight, Math.hypot(...size)),
      cloud = view.makeCloud(points.count),
      before_tiles = () => (finer && finer.loaded.size > 0) || view.drawCloud(cloud),
      draw = () => {
        if (finer && TILE_MODES.includes(choice.value)) {
          finer.draw({matrix: matrix(), eye: camera.eye(), focal: camera.focal(canvas.clientHeight)});
          return;
        }
        view.begin(matrix());
        view.drawCloud(cloud);
        view.drawLines();
      },
      paint = () => {
        view.fill(cloud.coloured, nav.paintPoints(points.count, modes[choice.value]));
        if (finer && TILE_MODES.includes(choice.value)) finer.colour(choice.value);
        draw();
      };
    let finer = finerLevels(element, view, {before: before_tiles, after: () => view.drawLines()}, () => {
      finer = null; // the folder is not there, or not all of it
      draw();
    });
    view.fill(cloud.placed, points.places);
    view.setLines(JSON.parse(dataset.paths));
    let before = null;
    nav.steer(canvas, camera, draw, (x, y) => {
      const i = nav.pickIndex(points, matrix(), canvas.clientWidth, canvas.clientHeight, x, y);
      if (i < 0) {
        before = null;
        return;
      }
      const place = nav.pointAt(points, i),
        apart = before ? Math.hypot(...place.map((v, k) => v - before[k])) : 0;
      output.textContent =
        nav.describePoint(points, i, Number(dataset.first)) +
        (before ? `, ${apart.toFixed(3)} m from the point before` : "");
      before = before ? null : place;
    });
    choice.addEventListener("change", paint);
    addEventListener("resize", draw);
    element.addLayer = (name, text, colours) => {
      const kinds = decode(text);
      if (kinds.length !== points.count) return;
      modes[name] = (i) => colours[kinds[i]] || [60, 60, 60];
      choice.add(new Option(name, name));
    };
    paint();
  };
})((globalThis.urbanNav ??= {}));
