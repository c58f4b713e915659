// SPDX-License-Identifier: BSD-3-Clause
// Draws the tiles of the map: what is needed most at once, the rest in the frames after, as long as nothing moves.
"use strict";
((nav) => {
  const SHOWN_POINTS = 3e6, // at rest
    KEPT_POINTS = 2 * SHOWN_POINTS, // in memory
    FRAME_MS = 120, // for drawing: with the rest of a frame, the view follows at more than 5 frames/s
    AT_ONCE = 4, // requests
    LEAST_GAP = 0.5; // px: two points a pixel, so that surfaces at an angle have no holes

  nav.TileView = class {
    /** `points`: a PointView. `tileBytes` returns the bytes of a tile. `around`: {before, after}, draw what is below and
     * above the tiles. */
    constructor(points, tileBytes, around = {before() {}, after() {}}) {
      Object.assign(this, {points, tileBytes, around, list: null, placement: null, middles: [], mode: "pictures"});
      this.loaded = new Map(); // {points, cloud, used} by tile
      this.failed = new Set();
      this.loading = 0;
      this.rate = new nav.DrawingRate(FRAME_MS);
      this.clock = 0;
      this.frame = null;
    }
    /** Shows other tiles. */
    setList(list) {
      for (const tile of [...this.loaded.keys()]) this.drop(tile);
      this.failed.clear();
      this.list = list;
      this.heights = null;
      this.frame = null;
    }
    /** Moves all points. `trust`: colour of a pose of a session, both by index. */
    place(placement, sessionColours, trust = null) {
      this.placement = placement;
      this.sessionColours = sessionColours;
      this.trust = trust;
      this.middles = this.list.tiles.map((tile) => nav.tileMiddle(tile, placement));
      for (const [tile, {points, cloud}] of this.loaded) {
        nav.placeTile(points, tile, placement);
        this.points.fill(cloud.placed, points.places);
      }
      this.colour(this.mode);
    }
    colour(mode) {
      this.mode = mode;
      for (const {points, cloud} of this.loaded.values()) this.paint(points, cloud);
      this.frame = null;
    }
    paint(points, cloud) {
      this.heights ??= nav.heightRange(points); // in the first, coarsest tile
      this.points.fill(cloud.coloured, nav.colourPoints(points, this.mode, this.sessionColours, this.heights, this.trust));
    }

    /** Draws a view, {matrix, eye, focal}: anew if it differs from the one before, else more of it. */
    draw(view) {
      if (!this.points.gl || !this.list || !this.placement) return;
      const {clientWidth: width, clientHeight: height} = this.points.canvas,
        key = [width, height, this.mode, ...view.matrix].join();
      if (!this.frame || this.frame.key !== key) {
        const given = {planes: nav.viewPlanes(view.matrix), eye: view.eye, focal: view.focal, least: LEAST_GAP},
          wanted = nav.selectTiles(this.list.tiles, this.middles, given, SHOWN_POINTS);
        this.frame = {key, view, wanted, drawn: new Set(), points: 0};
        this.points.begin(view.matrix);
        this.around.before();
        for (const tile of wanted) if (this.loaded.has(tile)) this.loaded.get(tile).used = ++this.clock;
      }
      this.drawSome();
      this.loadSome();
    }
    drawSome() {
      const {frame, loaded} = this,
        begin = performance.now(),
        most = this.rate.points();
      let points = 0;
      for (const tile of frame.wanted) {
        if (frame.drawn.has(tile) || !loaded.has(tile)) continue;
        if (points > 0 && points + tile.points > most) break;
        this.points.drawCloud(loaded.get(tile).cloud);
        frame.drawn.add(tile);
        points += tile.points;
      }
      this.around.after();
      this.points.finish();
      this.rate.measured(points, performance.now() - begin);
      frame.points += points;
      const {dataset} = this.points.canvas;
      dataset.points = frame.points;
      dataset.complete = frame.wanted.every((tile) => frame.drawn.has(tile) || this.failed.has(tile)) ? "1" : "0";
      if (frame.wanted.some((tile) => !frame.drawn.has(tile) && loaded.has(tile))) this.again();
    }
    again() {
      if (this.asked) return;
      this.asked = true;
      requestAnimationFrame(() => {
        this.asked = false;
        if (this.frame) this.draw(this.frame.view);
      });
    }
    loadSome() {
      for (const tile of this.frame ? this.frame.wanted : []) {
        if (this.loading >= AT_ONCE) return;
        if (this.loaded.has(tile) || tile.asked || this.failed.has(tile)) continue;
        this.load(tile);
      }
    }
    async load(tile) {
      const {list} = this;
      tile.asked = true;
      ++this.loading;
      try {
        const points = nav.readTile(await this.tileBytes(tile), tile);
        if (list === this.list) this.keep(tile, points);
      } catch {
        if (list === this.list) this.failed.add(tile);
      } finally {
        tile.asked = false;
        --this.loading;
      }
      if (list === this.list) this.again();
    }
    keep(tile, points) {
      const cloud = this.points.makeCloud(points.count);
      nav.placeTile(points, tile, this.placement);
      this.points.fill(cloud.placed, points.places);
      this.paint(points, cloud);
      this.loaded.set(tile, {points, cloud, used: ++this.clock});
      let kept = 0;
      for (const each of this.loaded.keys()) kept += each.points;
      if (kept <= KEPT_POINTS) return;
      const wanted = new Set(this.frame ? this.frame.wanted : []);
      for (const [each] of [...this.loaded].sort((a, b) => a[1].used - b[1].used)) {
        if (kept <= KEPT_POINTS) return;
        if (wanted.has(each)) continue;
        kept -= each.points;
        this.drop(each);
      }
    }
    drop(tile) {
      this.points.removeCloud(this.loaded.get(tile).cloud);
      this.loaded.delete(tile);
    }

    /** The point nearest to a place of the picture: {points, i}; null without one. */
    pick(matrix, width, height, x, y) {
      let best = null;
      for (const tile of this.frame ? this.frame.drawn : []) {
        const its = this.loaded.get(tile);
        if (!its) continue;
        const found = nav.pickNearest(its.points, matrix, width, height, x, y, best ? best.distance : Infinity);
        if (found) best = {...found, points: its.points};
      }
      return best;
    }
  };
})((globalThis.urbanNav ??= {}));
