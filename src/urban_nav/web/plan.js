// SPDX-License-Identifier: BSD-3-Clause
// Paths and closures, drawn without WebGL over other content.
"use strict";
((nav) => {
  nav.sessionColours = ["#1f6feb", "#d9480f", "#0c8599", "#9c36b5", "#5c940d", "#e67700", "#c2255c", "#495057"];
  const MOST_DRAWN = 20000, // poses of all paths in an image
    MOST_LINES = 600, // from poses to their positions in another map
    LEAST_STEP = 2; // px: browsers take seconds for wide lines with many corners in one pixel

  /** Positions of all sessions from the bytes of the server: maps that nothing joins lie side by side along x. Returns
   * {times, points} of each session in the order of the state, and the box around all. */
  nav.placePaths = (sessions, bytes) => {
    const view = new DataView(bytes),
      paths = [],
      boxes = new Map();
    let at = 0;
    for (const session of sessions) {
      const times = new Float32Array(session.poses),
        points = new Float32Array(3 * session.poses);
      for (let i = 0; i < session.poses; ++i, at += 16) {
        times[i] = view.getFloat32(at, true);
        for (let k = 0; k < 3; ++k) points[3 * i + k] = view.getFloat32(at + 4 + 4 * k, true);
      }
      const box = boxes.get(session.map) || {
        low: [Infinity, Infinity, Infinity],
        high: [-Infinity, -Infinity, -Infinity],
      };
      for (let i = 0; i < points.length; ++i) {
        box.low[i % 3] = Math.min(box.low[i % 3], points[i]);
        box.high[i % 3] = Math.max(box.high[i % 3], points[i]);
      }
      boxes.set(session.map, box);
      paths.push({times, points});
    }
    const shifts = new Map(),
      all = {low: [0, 0, 0], high: [0, 0, 0]};
    let edge = null;
    for (const [map, box] of [...boxes].sort((x, y) => x[0] - y[0])) {
      if (!Number.isFinite(box.low[0])) {
        shifts.set(map, 0);
        continue;
      }
      const gap = 0.1 * (box.high[0] - box.low[0]) + 5,
        shift = edge === null ? 0 : edge + gap - box.low[0];
      shifts.set(map, shift);
      const low = [box.low[0] + shift, box.low[1], box.low[2]],
        high = [box.high[0] + shift, box.high[1], box.high[2]];
      if (edge === null) {
        all.low = low;
        all.high = high;
      }
      all.low = all.low.map((v, k) => Math.min(v, low[k]));
      all.high = all.high.map((v, k) => Math.max(v, high[k]));
      edge = high[0];
    }
    sessions.forEach((session, s) => {
      const shift = shifts.get(session.map);
      if (shift) for (let i = 0; i < paths[s].points.length; i += 3) paths[s].points[i] += shift;
    });
    return {paths, box: all, shifts};
  };

  /** Where another map has the poses of all paths, from the bytes of the server: x, y, z of each pose, moved along x as the
   * maps are; not a number where it has no such pose. */
  nav.placeCompared = (sessions, bytes, shifts) => {
    const view = new DataView(bytes);
    let at = 0;
    return sessions.map((session) => {
      const shift = shifts.get(session.map) || 0;
      return Float32Array.from(
        {length: 3 * session.poses},
        (_, i) => view.getFloat32(4 * at++, true) + (i % 3 === 0 ? shift : 0),
      );
    });
  };

  /** Index of the pose of a path nearest to a time. */
  nav.poseAt = (times, seconds) => {
    let low = 0,
      high = times.length - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (times[middle] < seconds) low = middle + 1;
      else high = middle;
    }
    return low > 0 && seconds - times[low - 1] < times[low] - seconds ? low - 1 : low;
  };

  const pointOf = (path, i) => [path.points[3 * i], path.points[3 * i + 1], path.points[3 * i + 2]];
  /** Returns the position of a moment {session, seconds}; null if it is not on a path. */
  nav.placeOf = (paths, moment) => {
    const path = moment && moment.session !== null ? paths[moment.session] : null;
    return path && path.times.length > 0 ? pointOf(path, nav.poseAt(path.times, moment.seconds)) : null;
  };

  /** Returns the object at a click: {closure: ID} for the dot of a closure, {session, seconds} for a pose, or null. */
  nav.pickInPlan = (matrix, width, height, x, y, paths, closures) => {
    let best = null,
      least = 9;
    for (const c of closures) {
      const a = nav.placeOf(paths, c.a),
        b = nav.placeOf(paths, c.b),
        at =
          a &&
          b &&
          nav.project(
            matrix,
            a.map((v, k) => (v + b[k]) / 2),
            width,
            height,
          );
      const off = at ? Math.hypot(at[0] - x, at[1] - y) : Infinity;
      if (off < least) {
        least = off;
        best = {closure: c.id};
      }
    }
    if (best) return best;
    least = 14;
    paths.forEach((path, session) => {
      for (let i = 0; i < path.times.length; ++i) {
        const at = nav.project(matrix, pointOf(path, i), width, height),
          off = at ? Math.hypot(at[0] - x, at[1] - y) : Infinity;
        if (off < least) {
          least = off;
          best = {session, seconds: path.times[i]};
        }
      }
    });
    return best;
  };

  /** Continues a line to the next point of a path, or begins one after a gap; `p`: null in a gap. Returns where it ends. */
  const lineTo = (draw, before, p) => {
    if (p && before && Math.hypot(p[0] - before[0], p[1] - before[1]) < LEAST_STEP) return before;
    if (p && before) draw.lineTo(p[0], p[1]);
    else if (p) draw.moveTo(p[0], p[1]);
    return p;
  };

  /** Draws where another map has the paths, dashed, and lines from there to some of their poses. */
  const drawCompared = (draw, at, shown, stride) => {
    const most = shown.paths.reduce((sum, path) => sum + path.times.length, 0),
      each = Math.max(stride, Math.ceil(most / MOST_LINES));
    shown.compared.forEach((other, session) => {
      const here = shown.paths[session];
      draw.strokeStyle = nav.sessionColours[session % nav.sessionColours.length];
      const trace = (step, dash, visit) => {
        draw.setLineDash(dash);
        draw.beginPath();
        for (let i = 0; i < here.times.length; i += step) {
          const there = [other[3 * i], other[3 * i + 1], other[3 * i + 2]];
          visit(Number.isFinite(there[0]) ? at(there) : null, i);
        }
        draw.stroke();
      };
      let before = null;
      draw.lineWidth = 1.5;
      trace(stride, [5, 4], (p) => (before = lineTo(draw, before, p)));
      draw.lineWidth = 1;
      trace(each, [], (p, i) => {
        const q = p && at(pointOf(here, i));
        if (!q) return;
        draw.moveTo(p[0], p[1]);
        draw.lineTo(q[0], q[1]);
      });
    });
    draw.setLineDash([]);
  };

  /** Draws all of it. `shown`: {paths, compared, closures, selected, marks: [{at, text, colour}]}; colours by CSS. */
  nav.drawPlan = (canvas, matrix, shown, colours) => {
    const scale = globalThis.devicePixelRatio || 1,
      width = canvas.clientWidth,
      height = canvas.clientHeight,
      draw = canvas.getContext("2d", {willReadFrequently: true}); // without the GPU: lines by software GL take seconds
    if (canvas.width !== Math.round(width * scale) || canvas.height !== Math.round(height * scale)) {
      canvas.width = Math.round(width * scale);
      canvas.height = Math.round(height * scale);
    }
    draw.setTransform(scale, 0, 0, scale, 0, 0);
    draw.clearRect(0, 0, width, height);
    const at = (p) => p && nav.project(matrix, p, width, height),
      poses = shown.paths.reduce((sum, path) => sum + path.times.length, 0),
      stride = Math.max(1, Math.ceil(poses / MOST_DRAWN));
    draw.lineWidth = 2;
    draw.lineJoin = "round";
    shown.paths.forEach((path, session) => {
      draw.strokeStyle = nav.sessionColours[session % nav.sessionColours.length];
      draw.beginPath();
      let before = null;
      for (let i = 0; i < path.times.length; i += stride) before = lineTo(draw, before, at(pointOf(path, i)));
      draw.stroke();
    });
    if (shown.compared) drawCompared(draw, at, shown, stride);
    for (const verdict of ["rejected", "accepted"]) {
      draw.strokeStyle = draw.fillStyle = verdict === "accepted" ? colours.good : colours.bad;
      draw.lineWidth = 1;
      draw.globalAlpha = verdict === "accepted" ? 0.8 : 0.5;
      draw.beginPath();
      const dots = [];
      for (const c of shown.closures) {
        const a = (c.verdict === "accepted") === (verdict === "accepted") && at(nav.placeOf(shown.paths, c.a)),
          b = a && at(nav.placeOf(shown.paths, c.b));
        if (!b) continue;
        draw.moveTo(a[0], a[1]);
        draw.lineTo(b[0], b[1]);
        dots.push([(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]);
      }
      draw.stroke();
      for (const [x, y] of dots) draw.fillRect(x - 2, y - 2, 4, 4);
    }
    draw.globalAlpha = 1;
    const ends = shown.selected
      ? [at(nav.placeOf(shown.paths, shown.selected.a)), at(nav.placeOf(shown.paths, shown.selected.b))]
      : [];
    if (ends[0] && ends[1]) {
      draw.strokeStyle = draw.fillStyle = colours.a;
      draw.lineWidth = 3;
      draw.beginPath();
      draw.moveTo(ends[0][0], ends[0][1]);
      draw.lineTo(ends[1][0], ends[1][1]);
      draw.stroke();
      for (const [x, y] of ends) {
        draw.beginPath();
        draw.arc(x, y, 5, 0, 7);
        draw.fill();
      }
    }
    draw.font = "13px system-ui, sans-serif";
    for (const mark of shown.marks) {
      const p = at(mark.at);
      if (!p) continue;
      draw.strokeStyle = draw.fillStyle = mark.colour;
      draw.lineWidth = 2;
      draw.beginPath();
      draw.arc(p[0], p[1], 7, 0, 7);
      draw.stroke();
      draw.fillText(mark.text, p[0] + 10, p[1] - 8);
    }
  };
})((globalThis.urbanNav ??= {}));
