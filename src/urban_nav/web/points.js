// SPDX-License-Identifier: BSD-3-Clause
// Points of the map: encoding, colours, and drawing by WebGL. Without WebGL no points are drawn.
"use strict";
((nav) => {
  const LINE = [0.86, 0.16, 0.16, 1]; // red, green, blue, opacity
  const KINDS = [
    [214, 96, 77],
    [67, 147, 195],
    [90, 174, 97],
    [153, 112, 171],
    [225, 170, 60],
    [80, 80, 80],
    [200, 120, 160],
  ];

  /** From blue over green to red, for 0 to 1. */
  nav.ramp = (t) => [3, 2, 1].map((k) => 255 * Math.min(1, Math.max(0, 1.5 - Math.abs(4 * t - k))));

  /** Heights between which nearly all points lie, m. */
  nav.heightRange = ({count, places}) => {
    const heights = Float32Array.from({length: count}, (_, i) => places[3 * i + 2]).sort();
    return [heights[count >> 6] || 0, heights[count - 1 - (count >> 6)] || 1];
  };

  const TRUST = {failed: [214, 69, 65], corrected: [230, 160, 50], passed: [80, 165, 95], untested: [165, 165, 165]};

  /** Colour of a moment, from the index of its session and s from its first pose, by the consistency tests whose intervals
   * hold it: red where one failed, orange where its cause was corrected, green where all passed, grey without tests. */
  nav.trustColours = (tests) => {
    const bySession = new Map();
    for (const each of tests) bySession.set(each.session, [...(bySession.get(each.session) || []), each]);
    return (session, seconds) => {
      const its = (bySession.get(session) || []).filter(({from, to}) => from <= seconds && seconds <= to);
      return TRUST[["failed", "corrected", "passed"].find((verdict) => its.some((t) => t.verdict === verdict)) || "untested"];
    };
  };

  /** The ways of colouring points: functions by name, from the index of a point to red, green, blue. What the points hold
   * decides which there are; `layout` has the offsets of the values of a point. `range`: of heights, from blue to red. `trust`: colour of a pose of a
   * session, both by index. */
  nav.colourModes = (points, sessionColours, range = nav.heightRange(points), trust = null) => {
    const {places, owner, values, layout} = points,
      at = (i, name) => values[layout.stride * i + layout[name]],
      kind = (value) => KINDS[value % KINDS.length],
      [floor, roof] = range;
    const rgb = sessionColours.map((hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16)));
    const modes = {
      pictures: (i) => [0, 1, 2].map((k) => values[layout.stride * i + layout.red + k]),
      reflectance: (i) => Array(3).fill(at(i, "reflectance")),
      height: (i) => nav.ramp(Math.min(1, Math.max(0, (places[3 * i + 2] - floor) / Math.max(1, roof - floor)))),
      sensor: (i) => kind(at(i, "sensor")),
      sigma: (i) => nav.ramp(Math.sqrt(at(i, "sigma") / 255)),
    };
    if (trust && points.poses) modes.trust = (i) => trust(owner[i], points.poses[i]);
    if (owner) modes.session = (i) => rgb[owner[i] % rgb.length];
    if ("pass" in layout) modes.pass = (i) => kind(at(i, "pass"));
    if ("quality" in layout)
      modes.quality = (i) =>
        at(i, "quality") === 255 ? [205, 205, 205] : nav.ramp(Math.sqrt(at(i, "quality") / 254)); // 255: unknown
    return modes;
  };

  /** Colours of so many points, four bytes each. */
  nav.paintPoints = (count, colourOf) => {
    const colours = new Uint8Array(4 * count);
    for (let i = 0; i < count; ++i) {
      const c = colourOf(i);
      for (let k = 0; k < 3; ++k) colours[4 * i + k] = c[k];
    }
    return colours;
  };
  nav.colourPoints = (points, mode, sessionColours, range, trust) => {
    const {count, values, layout} = points;
    if (mode !== "pictures" && mode !== "reflectance")
      return nav.paintPoints(count, nav.colourModes(points, sessionColours, range, trust)[mode]);
    const colours = new Uint8Array(4 * count), // the same as by colourModes(), without a call for each point
      step = mode === "pictures" ? 1 : 0,
      first = mode === "pictures" ? layout.red : layout.reflectance;
    for (let i = 0; i < count; ++i)
      for (let k = 0; k < 3; ++k) colours[4 * i + k] = values[layout.stride * i + first + step * k];
    return colours;
  };

  /** The nearest point within 6 px of a place in the picture, {i, distance}; null without one nearer than `least`. */
  nav.pickNearest = ({count, places}, m, width, height, x, y, least = Infinity) => {
    let best = -1;
    for (let i = 0; i < count; ++i) {
      const [px, py, pz] = [places[3 * i], places[3 * i + 1], places[3 * i + 2]],
        w = m[3] * px + m[7] * py + m[11] * pz + m[15];
      if (!(w > 0) || w >= least) continue;
      const u = ((1 + (m[0] * px + m[4] * py + m[8] * pz + m[12]) / w) * width) / 2 - x,
        v = ((1 - (m[1] * px + m[5] * py + m[9] * pz + m[13]) / w) * height) / 2 - y,
        off = Math.hypot(u, v);
      if (off < 6 && w + 0.2 * off < least) {
        least = w + 0.2 * off;
        best = i;
      }
    }
    return best < 0 ? null : {i: best, distance: least};
  };
  nav.pickIndex = (...at) => (nav.pickNearest(...at) || {i: -1}).i;
  nav.pointAt = (points, i) => [...points.places.subarray(3 * i, 3 * i + 3)];

  nav.PointView = class {
    constructor(canvas, options = {}) {
      this.canvas = canvas;
      this.lines = [];
      this.gl = canvas.getContext("webgl", {antialias: false, ...options});
      if (!this.gl) return;
      const gl = this.gl,
        program = gl.createProgram();
      const shader = (type, text) => {
        const part = gl.createShader(type);
        gl.shaderSource(part, text);
        gl.compileShader(part);
        gl.attachShader(program, part);
      };
      shader(
        gl.VERTEX_SHADER,
        "attribute vec3 p; attribute vec4 c; uniform mat4 m; uniform float px; varying vec4 v;" +
          "void main() { gl_Position = m * vec4(p, 1.0); gl_PointSize = clamp(px / gl_Position.w, 1.5, 8.0); v = c; }",
      );
      shader(
        gl.FRAGMENT_SHADER,
        "precision mediump float; varying vec4 v; void main() { gl_FragColor = vec4(v.rgb, 1.0); }",
      );
      gl.linkProgram(program);
      gl.useProgram(program);
      const attributes = Object.fromEntries(["p", "c"].map((name) => [name, gl.getAttribLocation(program, name)])),
        uniforms = Object.fromEntries(["m", "px"].map((name) => [name, gl.getUniformLocation(program, name)]));
      this.at = (name) => attributes[name];
      this.uniform = (name) => uniforms[name];
    }
    /** Room for so many points. */
    makeCloud(count) {
      return {count, placed: this.gl.createBuffer(), coloured: this.gl.createBuffer()};
    }
    removeCloud({placed, coloured}) {
      this.gl.deleteBuffer(placed);
      this.gl.deleteBuffer(coloured);
    }
    /** Lines through x, y, z of points, drawn over the points. */
    setLines(lines) {
      if (!this.gl) return;
      this.lines = lines.map((line) => ({count: line.length / 3, buffer: this.gl.createBuffer()}));
      lines.forEach((line, i) => this.fill(this.lines[i].buffer, new Float32Array(line)));
    }
    fill(buffer, content) {
      this.gl.bindBuffer(this.gl.ARRAY_BUFFER, buffer);
      this.gl.bufferData(this.gl.ARRAY_BUFFER, content, this.gl.STATIC_DRAW);
    }
    /** Begins a picture, with a matrix for the size of the canvas on the page. */
    begin(matrix) {
      const {gl, canvas} = this,
        scale = globalThis.devicePixelRatio || 1,
        width = Math.max(1, Math.round(scale * canvas.clientWidth)),
        height = Math.max(1, Math.round(scale * canvas.clientHeight));
      if (canvas.width !== width || canvas.height !== height) {
        canvas.width = width;
        canvas.height = height;
      }
      gl.viewport(0, 0, width, height);
      gl.clearColor(0, 0, 0, 0);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      gl.enable(gl.DEPTH_TEST);
      gl.uniformMatrix4fv(this.uniform("m"), false, matrix);
      gl.uniform1f(this.uniform("px"), 0.05 * height);
    }
    drawCloud({count, placed, coloured}) {
      const {gl} = this;
      for (const [name, buffer, size, type, normalised] of [
        ["p", placed, 3, gl.FLOAT, false],
        ["c", coloured, 4, gl.UNSIGNED_BYTE, true],
      ]) {
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.enableVertexAttribArray(this.at(name));
        gl.vertexAttribPointer(this.at(name), size, type, normalised, 0, 0);
      }
      gl.drawArrays(gl.POINTS, 0, count);
    }
    drawLines() {
      const {gl} = this;
      gl.enableVertexAttribArray(this.at("p"));
      gl.disableVertexAttribArray(this.at("c"));
      gl.vertexAttrib4f(this.at("c"), ...LINE);
      for (const line of this.lines) {
        gl.bindBuffer(gl.ARRAY_BUFFER, line.buffer);
        gl.vertexAttribPointer(this.at("p"), 3, gl.FLOAT, false, 0, 0);
        gl.drawArrays(gl.LINE_STRIP, 0, line.count);
      }
    }
    /** Waits until everything is drawn: reading a pixel does, unlike gl.finish(). */
    finish() {
      this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, new Uint8Array(4));
    }
  };
})((globalThis.urbanNav ??= {}));
