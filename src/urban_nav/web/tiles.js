// SPDX-License-Identifier: BSD-3-Clause
// Levels of detail of the map: which tiles are seen, and what they hold. Independent of the page. Level 0 is the finest;
// each point is in one level, and coarse levels with finer ones make up the map.
"use strict";
((nav) => {
  const TILE_VOXELS = 256,
    VOXEL_STEPS = 256,
    LOWEST_Z = -(1 << 23), // steps
    POINT_BYTES = 20,
    MOVE_FLOATS = 10, // for each pose: rotation x, y, z, w, position when the points were rendered, position now
    LEAST_DISTANCE = 0.1, // m
    LAYOUT = {stride: 6, red: 0, reflectance: 3, sensor: 4, sigma: 5};

  /** Tiles of all maps, from the list of the server: {sets, tiles}. */
  nav.readTileList = (json) => {
    const tiles = json.sets.flatMap(({voxel, tiles: rows}, set) =>
      rows.map((row) => {
        const [name, ...numbers] = row.split(" "),
          [points, lowest, highest, session, pose] = numbers.map(Number),
          [level, x, y] = name.split(/[/,]/).map(Number),
          width = TILE_VOXELS * voxel * 2 ** level;
        return {
          set,
          name,
          points,
          session,
          pose,
          corner: [x * width, y * width],
          step: voxel / VOXEL_STEPS,
          spacing: voxel * 2 ** level,
          middle: [(x + 0.5) * width, (y + 0.5) * width, (lowest + highest) / 2],
          radius: Math.hypot(width, width, highest - lowest) / 2,
        };
      }),
    );
    return {sets: json.sets.map(({digest, sessions}) => ({digest, sessions})), tiles};
  };

  /** Motion of the poses of each session of each set, from the bytes of the server; null where none has moved. */
  nav.readMoves = (bytes, sets) => {
    const view = new DataView(bytes);
    let at = 0;
    return sets.map(({sessions}) =>
      sessions.map(() => {
        const poses = view.getUint32(at, true),
          moves = poses > 0 ? new Float32Array(bytes.slice(at + 4, at + 4 + 4 * MOVE_FLOATS * poses)) : null;
        at += 4 + 4 * MOVE_FLOATS * poses;
        return moves;
      }),
    );
  };

  /** Moves the point at 3 * i of `from` with its pose to 3 * i of `to`. */
  const movePoint = (moves, pose, from, to, i) => {
    const m = MOVE_FLOATS * pose,
      [qx, qy, qz, qw] = [moves[m], moves[m + 1], moves[m + 2], moves[m + 3]],
      x = from[3 * i] - moves[m + 4],
      y = from[3 * i + 1] - moves[m + 5],
      z = from[3 * i + 2] - moves[m + 6],
      // v + 2 qw (q x v) + 2 q x (q x v)
      cx = 2 * (qy * z - qz * y),
      cy = 2 * (qz * x - qx * z),
      cz = 2 * (qx * y - qy * x);
    to[3 * i] = x + qw * cx + qy * cz - qz * cy + moves[m + 7];
    to[3 * i + 1] = y + qw * cy + qz * cx - qx * cz + moves[m + 8];
    to[3 * i + 2] = z + qw * cz + qx * cy - qy * cx + moves[m + 9];
  };

  /** Placement of the map in the picture: motion of the poses, and of each session of each set its index in the state of the page and
   * the shift of its map along x. */
  nav.tilePlacement = (sets, moves, sessions, shifts) => ({
    moves,
    owners: sets.map((set) => set.sessions.map((id) => sessions.findIndex((s) => s.id === id))),
    shifts: sets.map((set) =>
      set.sessions.map((id) => {
        const session = sessions.find((s) => s.id === id);
        return (session && shifts.get(session.map)) || 0;
      }),
    ),
  });

  /** The middle of a tile where it is shown. */
  nav.tileMiddle = (tile, placement) => {
    const {moves, shifts} = placement,
      its = moves[tile.set][tile.session],
      at = Float64Array.from(tile.middle);
    if (its) movePoint(its, tile.pose, tile.middle, at, 0);
    at[0] += shifts[tile.set][tile.session];
    return at;
  };

  /** Points of a tile from the bytes of the server, at the poses of their rendering: `rest`. */
  nav.readTile = (bytes, tile) => {
    const from = new Uint8Array(bytes),
      n = Math.floor(from.length / POINT_BYTES),
      rest = new Float32Array(3 * n),
      poses = new Uint32Array(n),
      local = new Uint16Array(n),
      values = new Uint8Array(LAYOUT.stride * n),
      three = (column, i) => from[column * n + i] | (from[(column + 1) * n + i] << 8) | (from[(column + 2) * n + i] << 16);
    for (let i = 0; i < n; ++i) {
      rest[3 * i] = tile.corner[0] + tile.step * (three(0, i) + 0.5);
      rest[3 * i + 1] = tile.corner[1] + tile.step * (three(3, i) + 0.5);
      rest[3 * i + 2] = tile.step * (three(6, i) + LOWEST_Z + 0.5);
      poses[i] = three(9, i);
      local[i] = from[12 * n + i] | (from[13 * n + i] << 8);
      for (let k = 0; k < LAYOUT.stride; ++k) values[LAYOUT.stride * i + k] = from[(14 + k) * n + i];
    }
    return {count: n, rest, places: rest, poses, local, owner: local, values, layout: LAYOUT};
  };

  /** Moves the points of a tile to where they are shown: sets `places` and `owner`. */
  nav.placeTile = (points, tile, {moves, owners, shifts}) => {
    const owner = owners[tile.set],
      shift = shifts[tile.set],
      its = moves[tile.set],
      stay = its.every((m) => !m) && shift.every((s) => s === 0);
    points.owner = points.local.map((s) => owner[s]);
    points.places = stay ? points.rest : new Float32Array(points.rest);
    if (stay) return;
    for (let i = 0; i < points.count; ++i) {
      const s = points.local[i];
      if (its[s]) movePoint(its[s], points.poses[i], points.rest, points.places, i);
      points.places[3 * i] += shift[s];
    }
  };

  /** Planes that bound what a matrix shows, [a, b, c, d] with unit normals inwards; without the far one. */
  nav.viewPlanes = (m) =>
    [
      [0, 1],
      [0, -1],
      [1, 1],
      [1, -1],
      [2, 1],
    ].map(([row, sign]) => {
      const plane = [0, 1, 2, 3].map((k) => m[4 * k + 3] + sign * m[4 * k + row]),
        length = Math.hypot(plane[0], plane[1], plane[2]);
      return plane.map((v) => v / length);
    });

  /** The tiles that are seen, the most needed ones first: those whose absence would leave the widest gaps between points
   * in the picture, px. `view`: {planes, eye, focal (px), least (gap that needs no filling, px)}; `middles`: by tile.
   * At most `budget` points. */
  nav.selectTiles = (tiles, middles, view, budget) => {
    const seen = [];
    tiles.forEach((tile, i) => {
      const c = middles[i];
      if (view.planes.some(([a, b, e, d]) => a * c[0] + b * c[1] + e * c[2] + d < -tile.radius)) return;
      const distance = Math.hypot(c[0] - view.eye[0], c[1] - view.eye[1], c[2] - view.eye[2]) - tile.radius,
        gap = (2 * tile.spacing * view.focal) / Math.max(LEAST_DISTANCE, distance);
      if (gap > view.least) seen.push({tile, gap});
    });
    seen.sort((a, b) => b.gap - a.gap || b.tile.spacing - a.tile.spacing);
    let points = 0;
    const end = seen.findIndex(({tile}) => (points += tile.points) > budget);
    return (end < 0 ? seen : seen.slice(0, end)).map(({tile}) => tile);
  };

  /** The number of points that may be drawn at once, from the time that drawing took: steady at `target` ms. */
  nav.DrawingRate = class {
    constructor(target, points_per_ms = 500) {
      Object.assign(this, {target, points_per_ms});
    }
    measured(points, ms) {
      if (points < 1000) return; // the time of a call, not of its points
      const rate = points / Math.max(0.1, ms);
      this.points_per_ms += (rate < this.points_per_ms ? 0.7 : 0.3) * (rate - this.points_per_ms);
    }
    points() {
      return Math.max(10_000, this.points_per_ms * this.target);
    }
  };
})((globalThis.urbanNav ??= {}));
