// SPDX-License-Identifier: BSD-3-Clause
// Those scripts of the page that need no browser: node web_test.js
"use strict";
const assert = require("node:assert"),
  test = require("node:test");
for (const name of ["camera", "text", "server", "lists", "explanation", "plan", "points", "tiles", "tile_view", "report_map", "page", "labelled", "marks", "teach"])
  require(`../../web/${name}.js`);
const nav = globalThis.urbanNav;

const close = (a, b, tolerance = 1e-9) =>
  a.forEach((v, k) => assert.ok(Math.abs(v - b[k]) < tolerance, `${a} is not ${b}`));
const SESSIONS = [
  {id: "aaaaaaaaaaaaaaaa", name: "day1", map: 0, begin: "1225719872.123456789", seconds: 12, poses: 3, length_m: 20},
  {id: "bbbbbbbbbbbbbbbb", name: "<b>'\"", map: 1, begin: "1225806272.000000001", seconds: 10, poses: 2, length_m: 18},
];
const CLOSURES = [
  {id: 1, kind: "icp", verdict: "accepted", a: {session: 0, seconds: 1}, b: {session: 1, seconds: 2}},
  {id: 4, kind: "stereo", verdict: "rejected", a: {session: 0, seconds: 0}, b: {session: 0, seconds: 2}},
  {id: 9, kind: "stereo", verdict: "accepted", a: {session: 1, seconds: 0}, b: {session: 1, seconds: 2}},
];

test("a camera projects its centre into the middle, right to the right and up to the top", () => {
  for (const yaw of [-2, 0, 0.7, 3])
    for (const pitch of [-0.3, 0, 0.6, Math.PI / 2]) {
      const camera = new nav.Camera([3, -2, 1], 20, yaw, pitch),
        m = camera.matrix(800, 600, 100),
        [right, up, back] = camera.axes();
      const along = (axis, by) =>
        nav.project(
          m,
          camera.centre.map((c, k) => c + by * axis[k]),
          800,
          600,
        );
      close(along(right, 0), [400, 300, 20], 1e-6);
      const r = along(right, 1),
        u = along(up, 1);
      assert.ok(r[0] > 400 && Math.abs(r[1] - 300) < 1e-6);
      assert.ok(u[1] < 300 && Math.abs(u[0] - 400) < 1e-6);
      close([r[0] - 400], [300 - u[1]], 1e-6); // a metre is a metre in both directions
      close([along(back, 5)[2]], [15], 1e-6);
      assert.strictEqual(along(back, 25), null);
      close(
        [right, up, back].flatMap((a) => [right, up, back].map((b) => a.reduce((s, v, k) => s + v * b[k], 0))),
        [1, 0, 0, 0, 1, 0, 0, 0, 1],
      );
    }
});

test("a camera that moves keeps the point below the pointer there", () => {
  const camera = new nav.Camera([0, 0, 0], 30, 0.4, 0.8),
    point = [...camera.centre];
  camera.move(37, -12, 500);
  close(nav.project(camera.matrix(900, 500, 10), point, 900, 500).slice(0, 2), [450 + 37, 250 - 12], 1e-6);
});

test("a camera that is fitted sees all corners of a box", () => {
  for (const pitch of [0.2, 0.9, Math.PI / 2])
    for (const [width, height] of [
      [900, 300],
      [300, 900],
    ]) {
      const camera = new nav.Camera([0, 0, 0], 1, 1.1, pitch),
        low = [-40, 10, -1],
        high = [80, 31, 4];
      camera.fit(low, high, width / height);
      const m = camera.matrix(width, height, 200);
      for (let corner = 0; corner < 8; ++corner) {
        const at = nav.project(
          m,
          low.map((v, k) => ((corner >> k) & 1 ? high[k] : v)),
          width,
          height,
        );
        assert.ok(at && at[0] > 0 && at[0] < width && at[1] > 0 && at[1] < height, `corner ${corner}: ${at}`);
      }
    }
});

test("a camera neither turns over nor reaches zero distance", () => {
  const camera = new nav.Camera();
  camera.turn(0, 1e6);
  assert.strictEqual(camera.pitch, Math.PI / 2);
  camera.turn(0, -1e6);
  assert.strictEqual(camera.pitch, -0.3);
  camera.zoom(-1e3);
  assert.ok(camera.distance > 0);
  camera.zoom(1e3);
  assert.ok(Number.isFinite(camera.distance));
});

test("events are taken whole, whatever pieces they come in", () => {
  const stream = 'data: {"a": 1}\n\n:\n\ndata: {"b":\ndata: 2}\n\nevent: x\ndata: {"c": 3}\n\n';
  for (let size = 1; size < stream.length + 1; ++size) {
    let left = "";
    const taken = [];
    for (let at = 0; at < stream.length; at += size) {
      const [events, rest] = nav.takeEvents(left + stream.slice(at, at + size));
      taken.push(...events);
      left = rest;
    }
    assert.deepStrictEqual(
      taken.map((e) => JSON.parse(e)),
      [{a: 1}, {b: 2}, {c: 3}],
    );
    assert.strictEqual(left, "");
  }
});

test("filters let pass what fits all of them", () => {
  const ids = (filter) => nav.filterClosures(CLOSURES, filter).map((c) => c.id);
  assert.deepStrictEqual(ids({}), [1, 4, 9]);
  assert.deepStrictEqual(ids({verdict: "accepted", kind: "", session: ""}), [1, 9]);
  assert.deepStrictEqual(ids({verdict: "accepted", kind: "stereo"}), [9]);
  assert.deepStrictEqual(ids({session: "0"}), [1, 4]);
  assert.deepStrictEqual(ids({session: "1", verdict: "rejected"}), []);
});

test("another map is placed as this one is, with gaps where it has no pose", () => {
  const shifts = new Map([
    [0, 0],
    [1, 100],
  ]);
  const values = [1, 2, 3, NaN, NaN, NaN, 4, 5, 6, 7, 8, 9, 10, 11, 12],
    bytes = new ArrayBuffer(4 * values.length),
    view = new DataView(bytes);
  values.forEach((v, i) => view.setFloat32(4 * i, v, true));
  const placed = nav.placeCompared(SESSIONS, bytes, shifts);
  assert.deepStrictEqual([...placed[0]], [1, 2, 3, NaN, NaN, NaN, 4, 5, 6]);
  assert.deepStrictEqual([...placed[1]], [107, 8, 9, 110, 11, 12]);
});

test("a comparison is told in words", () => {
  const compared = {
    store: "b.db",
    absent_here: ["<b>"],
    sessions: [{session: 0, poses: 3, largest_m: 0.5, rms_m: 0.25, seconds: 4}],
  };
  assert.strictEqual(nav.comparedText(undefined, 0), "");
  assert.match(nav.comparedText(compared, 0), /0\.500 m at most .* \+4\.0 s, rms 0\.250 m/);
  assert.match(nav.comparedText(compared, 1), /not in the other store/);
  assert.strictEqual(nav.comparedNotice(compared), "compared with b.db, which also has <b>");
});

test("steps through a list stop at its ends", () => {
  assert.strictEqual(nav.neighbour(CLOSURES, 4, 1), 9);
  assert.strictEqual(nav.neighbour(CLOSURES, 9, 1), 9);
  assert.strictEqual(nav.neighbour(CLOSURES, 9, -1e9), 1);
  assert.strictEqual(nav.neighbour(CLOSURES, null, 1), 1);
  assert.strictEqual(nav.neighbour(CLOSURES, 77, -1), 9);
  assert.strictEqual(nav.neighbour([], 4, 1), null);
});

test("stamps keep all of their nanoseconds", () => {
  assert.strictEqual(nav.addSeconds("1225719872.123456789", 0), "1225719872.123456789");
  assert.strictEqual(nav.addSeconds("1225719872.999999999", 1e-9), "1225719873.000000000");
  assert.strictEqual(nav.addSeconds("1225719872", 0.25), "1225719872.250000000");
});

test("a moment is a stamp, or since the beginning of a session where two have that time", () => {
  assert.strictEqual(nav.momentWord(SESSIONS, 0, 2), "1225719874.123456789");
  const twins = [SESSIONS[0], {...SESSIONS[1], begin: "1225719880.000000000"}];
  assert.strictEqual(nav.momentWord(twins, 0, 9.5), "aaaaaaaaaaaaaaaa+9.500000");
  for (const [sessions, index, seconds] of [
    [SESSIONS, 0, 3.25],
    [SESSIONS, 1, 0],
    [twins, 0, 11],
    [twins, 1, 9.75],
  ]) {
    const found = nav.findMoment(sessions, nav.momentWord(sessions, index, seconds));
    assert.strictEqual(found.session, index);
    close([found.seconds], [seconds], 1e-5);
  }
});

test("moments written by hand are found as `edge` finds them", () => {
  assert.deepStrictEqual(nav.findMoment(SESSIONS, " day1+3.5 "), {session: 0, seconds: 3.5});
  assert.deepStrictEqual(nav.findMoment(SESSIONS, "+2"), {session: 0, seconds: 2});
  assert.deepStrictEqual(nav.findMoment(SESSIONS, "bbbb+2"), {session: 1, seconds: 2});
  for (const word of ["", "x", "day9+1", "day1+99", "12", "1e9", "+", "day1+-1"])
    assert.strictEqual(nav.findMoment(SESSIONS, word), null, word);
});

test("an edit has the words of the command", () => {
  const state = {sessions: SESSIONS},
    fields = {t1: "day1+3.5", t2: "day1+9", pose: "1,0,0,0,0,0,1", "pose-sigma": "", at: "1,2,3", "pin-sigma": "0.01"};
  const words = (action, selected = 4, given = fields) => nav.editWords(action, state, selected, given);
  assert.deepStrictEqual(words("reject"), [{action: "reject", arguments: ["4"], options: {}}, ""]);
  assert.deepStrictEqual(words("undo", null), [{action: "undo", arguments: [], options: {}}, ""]);
  assert.deepStrictEqual(words("measure"), [{action: "measure", arguments: ["day1+3.5", "day1+9"], options: {}}, ""]);
  assert.deepStrictEqual(words("assert"), [
    {action: "assert", arguments: ["day1+3.5", "day1+9"], options: {pose: "1,0,0,0,0,0,1"}},
    "",
  ]);
  assert.deepStrictEqual(words("pin"), [
    {action: "pin", arguments: ["day1+3.5"], options: {at: "1,2,3", sigma: "0.01"}},
    "",
  ]);
  assert.deepStrictEqual(words("cut"), [{action: "cut", arguments: ["day1", "day1+3.5"], options: {}}, ""]);
  assert.deepStrictEqual(words("origin"), [{action: "origin", arguments: ["day1+3.5"], options: {}}, ""]);
  for (const [action, selected, given] of [
    ["reject", null, fields],
    ["measure", 4, {...fields, t2: ""}],
    ["origin", 4, {}],
    ["assert", 4, {...fields, pose: ""}],
    ["pin", 4, {...fields, at: ""}],
    ["cut", 4, {t1: "nowhere+1"}],
  ]) {
    const [none, sentence] = words(action, selected, given);
    assert.strictEqual(none, null);
    assert.match(sentence, /\.$/);
  }
});

/** Bytes as the server sends paths: rows of seconds, x, y, z. */
const pathBytes = (rows) => new Float32Array(rows.flat()).buffer;
const ROWS = [
  [0, 0, 0, 0],
  [6, 10, 0, 0],
  [12, 10, 10, 0],
  [0, 100, 3, 1],
  [10, 120, 3, 1],
];

test("maps that nothing joins lie beside each other, sessions of one map where they are", () => {
  const {paths, box} = nav.placePaths(SESSIONS, pathBytes(ROWS));
  close([...paths[0].points], [0, 0, 0, 10, 0, 0, 10, 10, 0]);
  assert.strictEqual(paths[1].points[0], 17, "10 m, a tenth of its own width, and 5 m");
  close([paths[1].points[3] - paths[1].points[0]], [20]);
  close(box.low, [0, 0, 0]);
  close(box.high, [37, 10, 1]);
  const joined = nav.placePaths(
    SESSIONS.map((s) => ({...s, map: 0})),
    pathBytes(ROWS),
  );
  close([...joined.paths[1].points], [100, 3, 1, 120, 3, 1]);
});

test("sessions without poses are no obstacle", () => {
  const none = {...SESSIONS[0], poses: 0},
    {paths, box} = nav.placePaths([none, SESSIONS[1]], pathBytes(ROWS.slice(3)));
  assert.strictEqual(paths[0].points.length, 0);
  assert.strictEqual(nav.placeOf(paths, {session: 0, seconds: 1}), null);
  assert.strictEqual(nav.placeOf(paths, null), null);
  assert.ok(box.low.every(Number.isFinite));
  assert.ok(nav.placePaths([none], new ArrayBuffer(0)).box.low.every(Number.isFinite));
});

test("the pose nearest to a time is found", () => {
  const times = new Float32Array([0, 1, 3, 10]);
  for (const [t, at] of [
    [-5, 0],
    [0.4, 0],
    [0.6, 1],
    [2.1, 2],
    [6.4, 2],
    [6.6, 3],
    [99, 3],
  ])
    assert.strictEqual(nav.poseAt(times, t), at, `${t}`);
});

test("a click meets the dot of a closure first, then the nearest pose, else nothing", () => {
  const {paths, box} = nav.placePaths(
      SESSIONS.map((s) => ({...s, map: 0})),
      pathBytes(ROWS),
    ),
    camera = new nav.Camera([0, 0, 0], 10, -Math.PI / 2, Math.PI / 2);
  camera.fit(box.low, box.high, 2);
  const m = camera.matrix(1000, 500, 200),
    at = (p) => nav.project(m, p, 1000, 500),
    pick = (p, dx = 0) => nav.pickInPlan(m, 1000, 500, p[0] + dx, p[1], paths, [CLOSURES[0]]);
  assert.deepStrictEqual(pick(at([10, 10, 0]), 3), {session: 0, seconds: 12});
  assert.deepStrictEqual(pick(at([120, 3, 1])), {session: 1, seconds: 10});
  assert.deepStrictEqual(pick(at([(0 + 100) / 2, 1.5, 0.5])), {closure: 1});
  assert.strictEqual(pick([3, 3]), null);
});

/** Bytes of a tile as the server sends them, by column: rows of [x, y, z (steps), pose, session, red, green, blue,
 * reflectance, sensor, sigma]. */
const tileBytes = (rows) => {
  const widths = [3, 3, 3, 3, 2, 1, 1, 1, 1, 1, 1],
    bytes = [];
  widths.forEach((width, column) => {
    for (let byte = 0; byte < width; ++byte)
      for (const row of rows) bytes.push(((column === 2 ? row[2] + (1 << 23) : row[column]) >> (8 * byte)) & 255);
  });
  return Uint8Array.from(bytes).buffer;
};
const STEP = 0.05 / 256;
const TILE_ROWS = [
  [0, 256, 0, 0, 0, 10, 20, 30, 40, 0, 0],
  [65535, 0, 25600, 1, 1, 50, 60, 70, 80, 1, 255],
  [5120, 5120, -5120, 2, 0, 90, 100, 110, 120, 255, 64],
];
const LIST = {
  sets: [
    {
      digest: "d",
      voxel: 0.05,
      sessions: ["aaaaaaaaaaaaaaaa", "bbbbbbbbbbbbbbbb"],
      tiles: [
        "7/0,0 3 -1 5 0 2",
        "0/0,0 100 -1 5 0 2",
        "0/-1,0 200 -1 5 1 1",
        "0/4,0 400 -1 5 0 0",
      ],
    },
  ],
};
/** Bytes of moves: for each session null, or [quaternion, then, now] of each pose. */
const moveBytes = (sessions) => {
  const numbers = [];
  for (const poses of sessions) {
    numbers.push([poses ? poses.length : 0]);
    for (const pose of poses || []) numbers.push(pose.flat());
  }
  const view = new DataView(new ArrayBuffer(4 * numbers.flat().length));
  let at = 0;
  for (const row of numbers)
    for (const value of row) {
      if (row.length === 1) view.setUint32(at, value, true);
      else view.setFloat32(at, value, true);
      at += 4;
    }
  return view.buffer;
};
const still = (shifts = new Map()) => nav.tilePlacement(LIST.sets, [[null, null]], SESSIONS, shifts);

test("a tile holds the places and values of its points", () => {
  const {tiles} = nav.readTileList(LIST),
    points = nav.readTile(tileBytes(TILE_ROWS), tiles[2]);
  assert.strictEqual(tiles[2].name, "0/-1,0");
  assert.strictEqual(points.count, 3);
  close([...points.places.slice(0, 3)], [-12.8 + 0.5 * STEP, 0.05 + 0.5 * STEP, 0.5 * STEP], 1e-6);
  close([...points.places.slice(3)], [-0.5 * STEP, 0.5 * STEP, 5 + 0.5 * STEP, -11.8, 1, -1], 2e-4);
  assert.deepStrictEqual([...points.poses], [0, 1, 2]);
  const colours = (mode) =>
    [0, 1, 2].map((i) => [...nav.colourPoints(points, mode, nav.sessionColours, [-1, 5]).slice(4 * i, 4 * i + 3)]);
  assert.deepStrictEqual(colours("pictures"), [
    [10, 20, 30],
    [50, 60, 70],
    [90, 100, 110],
  ]);
  assert.deepStrictEqual(colours("reflectance"), [
    [40, 40, 40],
    [80, 80, 80],
    [120, 120, 120],
  ]);
  nav.placeTile(points, tiles[2], still());
  assert.deepStrictEqual(colours("session")[0], [0x1f, 0x6f, 0xeb]);
  for (const mode of ["height", "sensor", "sigma", "session"])
    assert.notDeepStrictEqual(colours(mode)[0], colours(mode)[1], mode);
  const none = nav.readTile(new ArrayBuffer(0), tiles[0]);
  assert.strictEqual(none.count, 0);
  for (const mode of ["height", "pictures"])
    assert.strictEqual(nav.colourPoints(none, mode, nav.sessionColours).length, 0);
});

test("points follow their poses, and maps that nothing joins are shown side by side", () => {
  const {sets, tiles} = nav.readTileList(LIST),
    turn = [0, 0, Math.SQRT1_2, Math.SQRT1_2], // a quarter about z
    pose = [turn, [1, 1, 0], [11, 1, 2]],
    moves = nav.readMoves(moveBytes([null, [pose, pose]]), sets);
  assert.strictEqual(moves[0][0], null);
  const points = nav.readTile(tileBytes(TILE_ROWS), tiles[1]),
    rest = [...points.rest];
  nav.placeTile(points, tiles[1], nav.tilePlacement(sets, moves, SESSIONS, new Map([[1, 100]])));
  close([...points.places.slice(0, 3)], rest.slice(0, 3), 1e-6);
  const [x, y, z] = rest.slice(3, 6);
  close([...points.places.slice(3, 6)], [11 - (y - 1) + 100, 1 + (x - 1), z + 2], 1e-4);
  close([...points.rest], rest);
  nav.placeTile(points, tiles[1], still());
  close([...points.places], rest);
  const placement = nav.tilePlacement(sets, moves, [SESSIONS[1], SESSIONS[0]], new Map());
  assert.deepStrictEqual(placement.owners, [[1, 0]], "the page may order sessions in another way");
  const middle = nav.tileMiddle(tiles[2], placement);
  close([...middle], [11 - (6.4 - 1), 1 + (-6.4 - 1), 4], 1e-5);
});

test("the tiles that are seen are chosen, the coarsest and nearest first, within the budget", () => {
  const {tiles} = nav.readTileList(LIST),
    middles = tiles.map((tile) => nav.tileMiddle(tile, still()));
  const choose = (camera, budget, least = 1) => {
    const view = {
      planes: nav.viewPlanes(camera.matrix(800, 600, 100)),
      eye: camera.eye(),
      focal: camera.focal(600),
      least,
    };
    return nav.selectTiles(tiles, middles, view, budget).map((tile) => tile.name);
  };
  const above = (x, distance) => new nav.Camera([x, 6.4, 2], distance, -Math.PI / 2, Math.PI / 2);
  assert.deepStrictEqual(choose(above(6.4, 15), 1e6).slice(0, 2), ["7/0,0", "0/0,0"]);
  assert.ok(!choose(above(6.4, 15), 1e6).includes("0/4,0"), "outside the picture");
  assert.strictEqual(choose(above(28, 40), 1e6).length, 4, "all are seen");
  assert.deepStrictEqual(choose(above(6.4, 15), 3), ["7/0,0"]);
  assert.deepStrictEqual(choose(above(6.4, 15), 0), []);
  assert.deepStrictEqual(choose(above(30, 5000), 1e6), ["7/0,0"], "finer points would share their pixels");
});

test("the planes of a view bound what it projects into its picture", () => {
  const camera = new nav.Camera([3, -2, 1], 20, 0.7, 0.4),
    m = camera.matrix(800, 600, 100),
    planes = nav.viewPlanes(m);
  for (let i = 0; i < 400; ++i) {
    const p = [0, 1, 2].map((k) => camera.centre[k] + 40 * (((i * (k + 2) * 0.618) % 1) - 0.5)),
      at = nav.project(m, p, 800, 600),
      near = 0.02 * camera.distance,
      inside = at !== null && at[0] >= 0 && at[0] <= 800 && at[1] >= 0 && at[1] <= 600 && at[2] >= near;
    assert.strictEqual(
      planes.every(([a, b, c, d]) => a * p[0] + b * p[1] + c * p[2] + d >= 0),
      inside,
      `${p}`,
    );
  }
});

test("the number of points drawn at once follows the time that it takes", () => {
  const rate = new nav.DrawingRate(100);
  for (let i = 0; i < 20; ++i) rate.measured(rate.points(), rate.points() / 40); // 40 points/ms
  assert.ok(Math.abs(rate.points() - 10_000) < 1e-6, "no fewer, so that something is seen");
  for (let i = 0; i < 40; ++i) rate.measured(rate.points(), rate.points() / 2000);
  assert.ok(Math.abs(rate.points() / 200_000 - 1) < 0.01);
  rate.measured(10, 500);
  assert.ok(Math.abs(rate.points() / 200_000 - 1) < 0.01, "a call without points says nothing");
});

test("points of a report are read from the ranges of their numbers", () => {
  const bytes = new Uint8Array(2 * (8 + 8)),
    view = new DataView(bytes.buffer);
  [
    [0, 0, 65535, 0],
    [65535, 32768, 0, 65535],
  ].forEach((point, i) => point.forEach((v, k) => view.setUint16(8 * i + 2 * k, v, true)));
  bytes.set([10, 20, 30, 40, 2, 3, 8, 255, 50, 60, 70, 80, 1, 4, 12, 10], 16);
  const points = nav.readPackedPoints(bytes, 2, [-1, 0, 5], [9, 2, 6], 20);
  close([...points.places], [-1, 0, 6, 9, 1, 5], 1e-4);
  close([...points.times], [0, 20]);
  const modes = nav.colourModes(points, []);
  assert.deepStrictEqual(modes.pictures(1), [50, 60, 70]);
  assert.deepStrictEqual(modes.reflectance(0), [40, 40, 40]);
  assert.deepStrictEqual(modes.quality(0), [205, 205, 205]);
  assert.notDeepStrictEqual(modes.pass(0), modes.pass(1));
  assert.strictEqual(modes.session, undefined);
  for (const name of ["pictures", "reflectance", "height", "sensor", "sigma", "pass", "quality"])
    assert.ok(modes[name](0).every((v) => v >= 0 && v <= 255), name);
  assert.strictEqual(nav.describePoint(points, 0, 100), "stamp 100.00 s, pass 3, sensor 2, sigma 4.0 mm");
  assert.match(nav.describePoint(points, 1, 100), /^stamp 120\.00 s, .*, passes 5\.0 mm apart$/);
  assert.deepStrictEqual([...nav.paintPoints(2, modes.pictures)], [10, 20, 30, 0, 50, 60, 70, 0]);
});

test("the colours of a ramp go from blue over green to red", () => {
  const [low, middle, high] = [0.25, 0.5, 0.75].map(nav.ramp);
  assert.ok(low[2] === 255 && middle[1] === 255 && high[0] === 255);
  for (let t = 0; t <= 1; t += 0.01) assert.ok(nav.ramp(t).every((v) => v >= 0 && v <= 255));
});

test("a click meets the nearest point, the nearer one of two in a line", () => {
  const points = {count: 3, places: Float32Array.from([1, 2, 0, 2, 2, 5, 7, 2, 0])},
    camera = new nav.Camera([2, 2, 2], 10, 0, 0),
    m = camera.matrix(800, 600, 50),
    at = nav.project(m, [2, 2, 5], 800, 600);
  assert.strictEqual(nav.pickNearest(points, m, 800, 600, at[0] + 2, at[1]).i, 1);
  assert.strictEqual(nav.pickNearest(points, m, 800, 600, 5, 5), null);
  assert.strictEqual(nav.pickIndex(points, m, 800, 600, 5, 5), -1);
  const flat = new nav.Camera([2, 2, 0], 10, 0, 0).matrix(800, 600, 50),
    met = nav.pickNearest(points, flat, 800, 600, 400, 300);
  assert.strictEqual(met.i, 2, "x points at the viewer");
  close([met.distance], [5], 1e-4);
  assert.strictEqual(nav.pickNearest(points, flat, 800, 600, 400, 300, 4), null, "another tile has a nearer one");
});

/** A PointView that counts what it is asked to draw. */
const countingView = () => {
  const drawn = [];
  return {
    drawn,
    gl: true,
    canvas: {clientWidth: 800, clientHeight: 600, dataset: {}},
    begin: () => drawn.push("begin"),
    drawCloud: ({count}) => drawn.push(count),
    finish: () => {},
    makeCloud: (count) => ({count}),
    removeCloud: () => drawn.push("removed"),
    fill: () => {},
  };
};
const soon = (so) =>
  new Promise((resolve, reject) => {
    const begin = Date.now();
    const look = () => {
      if (so()) resolve();
      else if (Date.now() - begin > 20_000) reject(new Error("it does not come about"));
      else setTimeout(look, 5);
    };
    look();
  });

test("tiles are fetched and drawn once, a view that moves begins anew, and a tile that is missing is left out", async () => {
  globalThis.requestAnimationFrame = (take) => setTimeout(take, 1);
  const points = countingView(),
    fetched = [],
    view = new nav.TileView(points, async (tile) => {
      fetched.push(tile.name);
      if (tile.name === "0/0,0") throw new Error("not there");
      return tileBytes(TILE_ROWS);
    }),
    {dataset} = points.canvas;
  const shown = (x) => {
    const camera = new nav.Camera([x, 6.4, 2], 40, -Math.PI / 2, Math.PI / 2);
    return {matrix: camera.matrix(800, 600, 100), eye: camera.eye(), focal: camera.focal(600)};
  };
  view.draw(shown(28)); // nothing to draw yet
  view.setList(nav.readTileList(LIST));
  view.place(still(), nav.sessionColours);
  view.draw(shown(28));
  await soon(() => dataset.complete === "1");
  assert.deepStrictEqual([...fetched].sort(), ["0/-1,0", "0/0,0", "0/4,0", "7/0,0"]);
  assert.strictEqual(fetched[0], "7/0,0");
  assert.strictEqual(dataset.points, 3 + 200 + 400, "as the list states them");
  assert.deepStrictEqual(points.drawn, ["begin", 3, 3, 3]);
  view.draw(shown(29));
  await soon(() => dataset.complete === "1" && points.drawn.length === 8);
  assert.strictEqual(fetched.length, 4);
  const at = nav.project(shown(29).matrix, [0, 0.05, 0], 800, 600);
  assert.ok(view.pick(shown(29).matrix, 800, 600, at[0], at[1]));
  assert.strictEqual(view.pick(shown(29).matrix, 800, 600, -500, -500), null);
  view.setList(nav.readTileList(LIST));
  assert.strictEqual(points.drawn.filter((word) => word === "removed").length, 3);
});

test("trust colours a point by the tests of its time", () => {
  const test = (verdict, session, from, to) => ({name: "any", verdict, session, from, to, sentence: ""}),
    colour = nav.trustColours([test("passed", 0, 0, 10), test("failed", 0, 4, 6), test("corrected", 0, 5, 8), test("passed", 1, 2, 3)]),
    [red, green, blue] = [0, 1, 2],
    dominates = (c, k) => c.every((v, other) => other === k || v < c[k]);
  assert.ok(dominates(colour(0, 5), red), "a failure counts more than what passed or was corrected");
  assert.ok(dominates(colour(0, 1), green));
  assert.notDeepStrictEqual(colour(0, 7), colour(0, 5));
  assert.notDeepStrictEqual(colour(0, 7), colour(0, 1));
  const untested = colour(1, 9);
  assert.strictEqual(untested[red], untested[blue], "grey without a test");
  assert.deepStrictEqual(colour(7, 1), untested);
  assert.deepStrictEqual(colour(0, NaN), untested);
  const points = {
    count: 2,
    places: new Float32Array(6),
    values: new Uint8Array(12),
    owner: [0, 0],
    poses: [0, 1],
    layout: {stride: 6, red: 0, reflectance: 3, sensor: 4, sigma: 5},
  };
  const painted = nav.colourPoints(points, "trust", [], [0, 1], (session, pose) => colour(session, pose === 0 ? 1 : 5));
  assert.deepStrictEqual([...painted.slice(0, 3)], colour(0, 1));
  assert.deepStrictEqual([...painted.slice(4, 7)], colour(0, 5));
});

// A labelled cloud of five points: two units of two, and a point without one.
const labelledBytes = (hasImage) => {
  const places = [0, 0, 0, 0.2, 0, 0, 3, 0, 1, 3.2, 0, 1, NaN, 0, 0],
    units = [0, 0, 1, 1, 0xffffffff],
    pixels = [10, 10, NaN, NaN, 50, 20, 52, 20, NaN, NaN],
    bytes = new ArrayBuffer(5 * (hasImage ? 24 : 16));
  new Float32Array(bytes, 0, 15).set(places);
  new Uint32Array(bytes, 60, 5).set(units);
  if (hasImage) new Float32Array(bytes, 80, 10).set(pixels);
  return bytes;
};
const LABEL_CLASSES = [
  {number: 2, name: "paved", colour: "#bebebe"},
  {number: 7, name: "vehicle", colour: "#2864e6"},
];

test("a labelled cloud is read with its units, and a short one is refused", () => {
  const cloud = nav.readCloud(labelledBytes(false), 5, false);
  assert.strictEqual(cloud.pixels, null);
  close([...cloud.places.subarray(6, 9)], [3, 0, 1], 1e-6);
  assert.deepStrictEqual([...cloud.units], [0, 0, 1, 1, 0xffffffff]);
  assert.throws(() => nav.readCloud(labelledBytes(false), 4, false));
  assert.throws(() => nav.readCloud(labelledBytes(false), 5, true));
  const box = nav.cloudBox(cloud);
  close(box.low, [0, 0, 0], 1e-6);
  close(box.high, [3.2, 0, 1], 1e-6);
  assert.strictEqual(nav.cloudBox({count: 1, places: new Float32Array([NaN, 0, 0])}), null);
});

test("a brush takes whole units", () => {
  const cloud = nav.readCloud(labelledBytes(false), 5, false),
    groups = nav.groupUnits(cloud, 2);
  close([...groups.centres], [0.1, 0, 0, 3.1, 0, 1], 1e-6);
  assert.deepStrictEqual(nav.pointsNear(cloud, groups, 3, 0), [2, 3]);
  assert.deepStrictEqual(nav.pointsNear(cloud, groups, 0, 10), [0, 1, 2, 3]);
  assert.deepStrictEqual(nav.pointsNear(cloud, groups, 4, 10), [], "a point without a unit");
});

test("a click on the image takes the nearest shown point", () => {
  const cloud = nav.readCloud(labelledBytes(true), 5, true);
  assert.strictEqual(nav.pickPixel(cloud, 51.5, 21, 10), 3);
  assert.strictEqual(nav.pickPixel(cloud, 30, 30, 10), -1);
});

test("answers are coloured by their class, unsure ones in one grey", () => {
  const cloud = nav.readCloud(labelledBytes(false), 5, false),
    answers = nav.readAnswers(new Uint8Array([2, 255, 0, 7, 128, 1, 7, 255, 2, 255, 0, 0, 2, 90, 1]).buffer, 5),
    colours = nav.labelColours(cloud, answers, LABEL_CLASSES, [0, 1]);
  assert.throws(() => nav.readAnswers(new ArrayBuffer(14), 5));
  assert.deepStrictEqual(colours.answers(0), [0xbe, 0xbe, 0xbe]);
  assert.deepStrictEqual(colours.answers(1), colours.answers(4), "both unsure");
  assert.notDeepStrictEqual(colours.all(1), colours.all(4));
  assert.deepStrictEqual(colours.corrections(2), [0x28, 0x64, 0xe6]);
  assert.deepStrictEqual(colours.corrections(0), colours.corrections(1), "not corrected");
  assert.deepStrictEqual(nav.answersOf([0, 1, 2, 3], answers, LABEL_CLASSES), [
    ["vehicle", 0.5],
    ["paved", 0.25],
    ["none", 0.25],
  ]);
  close([answers.probability(1)], [128 / 255]);
});

test("suggestions, corrections and counts are told in words", () => {
  assert.strictEqual(
    nav.suggestionText({class: "wall", second: "vehicle", probability: 0.412, units: 312, area_m2: 410.2}),
    "wall 41 %, or vehicle: 312 like it, 410 m\u00b2",
  );
  assert.strictEqual(
    nav.suggestionText({class: "wall", second: "none", probability: 1, units: 1, area_m2: 0.16}),
    "wall 100 %: 1 like it, 0.2 m\u00b2",
  );
  assert.strictEqual(
    nav.correctionText({number: 3, class: "paved", points: 1, place: [1.26, -2, 0]}, [1000, 0, 0]),
    "3  paved, 1 point at 1001.3, -2.0, 0.0",
  );
  assert.strictEqual(nav.countsText({points: 5, answered: 0, unsure: 0, corrected: 0}), "5 points without an answer");
  assert.strictEqual(
    nav.countsText({points: 200, answered: 100, unsure: 25, corrected: 4}),
    "200 points, 75 % sure, 4 corrected",
  );
});
