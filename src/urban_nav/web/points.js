// SPDX-License-Identifier: BSD-3-Clause
// Points of the map: encoding, colours, and drawing by WebGL. Without WebGL no points are drawn.
"use strict";
((nav) => {
  const BYTES = 24, // per point: x, y, z, seconds (float32), session (uint16), sensor, sigma, red, green, blue, reflectance
    LAYOUT = {stride: BYTES, sensor: 18, sigma: 19, red: 20, reflectance: 23};
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

  /** Points from the bytes of the server; the maps of their sessions are moved along x as their paths are. */
  nav.readPoints = (bytes, sessions, shifts) => {
    const count = Math.floor(bytes.byteLength / BYTES),
      view = new DataView(bytes),
      places = new Float32Array(3 * count),
      times = new Float32Array(count),
      owner = new Uint16Array(count);
    for (let i = 0; i < count; ++i) {
      const at = BYTES * i;
      for (let k = 0; k < 3; ++k) places[3 * i + k] = view.getFloat32(at + 4 * k, true);
      times[i] = view.getFloat32(at + 12, true);
      owner[i] = view.getUint16(at + 16, true);
      if (sessions[owner[i]]) places[3 * i] += shifts.get(sessions[owner[i]].map) || 0;
    }
    return {count, places, times, owner, values: new Uint8Array(bytes), layout: LAYOUT};
  };

  /** The ways of colouring points: functions by name, from the index of a point to red, green, blue. What the points hold
   * decides which there are; `layout` has the offsets of the values of a point. */
  nav.colourModes = (points, sessionColours) => {
    const {count, places, owner, values, layout} = points,
      at = (i, name) => values[layout.stride * i + layout[name]],
      kind = (value) => KINDS[value % KINDS.length];
    const heights = Float32Array.from({length: count}, (_, i) => places[3 * i + 2]).sort(),
      floor = heights[count >> 6] || 0,
      roof = heights[count - 1 - (count >> 6)] || 1;
    const rgb = sessionColours.map((hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16)));
    const modes = {
      pictures: (i) => [0, 1, 2].map((k) => values[layout.stride * i + layout.red + k]),
      reflectance: (i) => Array(3).fill(at(i, "reflectance")),
      height: (i) => nav.ramp(Math.min(1, Math.max(0, (places[3 * i + 2] - floor) / Math.max(1, roof - floor)))),
      sensor: (i) => kind(at(i, "sensor")),
      sigma: (i) => nav.ramp(Math.sqrt(at(i, "sigma") / 255)),
    };
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
  nav.colourPoints = (points, mode, sessionColours) =>
    nav.paintPoints(points.count, nav.colourModes(points, sessionColours)[mode]);

  /** The index of the nearest point within 6 px of a place in the picture; -1 without one. */
  nav.pickIndex = (points, m, width, height, x, y) => {
    let best = -1,
      least = Infinity;
    for (let i = 0; i < points.count; ++i) {
      const at = nav.project(m, points.places.subarray(3 * i, 3 * i + 3), width, height),
        off = at ? Math.hypot(at[0] - x, at[1] - y) : Infinity;
      if (off < 6 && at[2] + 0.2 * off < least) {
        least = at[2] + 0.2 * off;
        best = i;
      }
    }
    return best;
  };
  nav.pointAt = (points, i) => [...points.places.subarray(3 * i, 3 * i + 3)];

  /** The same as {session, seconds, place}, or null. */
  nav.pickPoint = (points, ...at) => {
    const i = nav.pickIndex(points, ...at);
    return i < 0 ? null : {session: points.owner[i], seconds: points.times[i], place: nav.pointAt(points, i)};
  };

  nav.PointView = class {
    constructor(canvas, options = {}) {
      this.canvas = canvas;
      this.count = 0;
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
      this.at = (name) => gl.getAttribLocation(program, name);
      this.uniform = (name) => gl.getUniformLocation(program, name);
      this.placed = gl.createBuffer();
      this.coloured = gl.createBuffer();
    }
    setPlaces(points) {
      this.count = points.count;
      if (this.gl) this.fill(this.placed, points.places);
    }
    setColours(colours) {
      if (this.gl) this.fill(this.coloured, colours);
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
    /** Draws with a matrix for the size of the canvas on the page. */
    draw(matrix) {
      const {gl, canvas} = this;
      if (!gl) return;
      const scale = globalThis.devicePixelRatio || 1,
        width = Math.max(1, Math.round(scale * canvas.clientWidth)),
        height = Math.max(1, Math.round(scale * canvas.clientHeight));
      if (canvas.width !== width || canvas.height !== height) {
        canvas.width = width;
        canvas.height = height;
      }
      gl.viewport(0, 0, width, height);
      gl.clearColor(0, 0, 0, 0);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      if (this.count === 0 && this.lines.length === 0) return;
      gl.enable(gl.DEPTH_TEST);
      gl.uniformMatrix4fv(this.uniform("m"), false, matrix);
      gl.uniform1f(this.uniform("px"), 0.05 * height);
      for (const [name, buffer, size, type, normalised] of [
        ["p", this.placed, 3, gl.FLOAT, false],
        ["c", this.coloured, 4, gl.UNSIGNED_BYTE, true],
      ]) {
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.enableVertexAttribArray(this.at(name));
        gl.vertexAttribPointer(this.at(name), size, type, normalised, 0, 0);
      }
      gl.drawArrays(gl.POINTS, 0, this.count);
      gl.disableVertexAttribArray(this.at("c"));
      gl.vertexAttrib4f(this.at("c"), ...LINE);
      for (const line of this.lines) {
        gl.bindBuffer(gl.ARRAY_BUFFER, line.buffer);
        gl.vertexAttribPointer(this.at("p"), 3, gl.FLOAT, false, 0, 0);
        gl.drawArrays(gl.LINE_STRIP, 0, line.count);
      }
    }
  };
})((globalThis.urbanNav ??= {}));
