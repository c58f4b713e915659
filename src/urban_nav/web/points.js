// SPDX-License-Identifier: BSD-3-Clause
// Points of the map: their bytes, their colours, and WebGL that draws them. Without WebGL nothing is drawn.
"use strict";
((nav) => {
  const BYTES = 24; // of a point: x, y, z, seconds (float32), session (uint16), sensor, sigma, red, green, blue, reflectance
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
    return {count, places, times, owner, values: new Uint8Array(bytes)};
  };

  /** Colours of all points by one of these: pictures, reflectance, height, session, sensor, sigma. */
  nav.colourPoints = (points, mode, sessionColours) => {
    const {count, places, owner, values} = points,
      colours = new Uint8Array(4 * count),
      at = (i, k) => values[BYTES * i + k];
    const heights = Float32Array.from({length: count}, (_, i) => places[3 * i + 2]).sort(),
      floor = heights[count >> 6] || 0,
      roof = heights[count - 1 - (count >> 6)] || 1;
    const rgb = sessionColours.map((hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16)));
    const of = {
      pictures: (i) => [at(i, 20), at(i, 21), at(i, 22)],
      reflectance: (i) => [at(i, 23), at(i, 23), at(i, 23)],
      height: (i) => nav.ramp(Math.min(1, Math.max(0, (places[3 * i + 2] - floor) / Math.max(1, roof - floor)))),
      session: (i) => rgb[owner[i] % rgb.length],
      sensor: (i) => KINDS[at(i, 18) % KINDS.length],
      sigma: (i) => nav.ramp(Math.sqrt(at(i, 19) / 255)),
    }[mode];
    for (let i = 0; i < count; ++i) {
      const c = of(i);
      for (let k = 0; k < 3; ++k) colours[4 * i + k] = c[k];
    }
    return colours;
  };

  /** The nearest point within 6 px of a place in the picture: {session, seconds, place}, or null. */
  nav.pickPoint = (points, m, width, height, x, y) => {
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
    return best < 0
      ? null
      : {
          session: points.owner[best],
          seconds: points.times[best],
          place: [...points.places.subarray(3 * best, 3 * best + 3)],
        };
  };

  nav.PointView = class {
    constructor(canvas) {
      this.canvas = canvas;
      this.count = 0;
      this.gl = canvas.getContext("webgl", {antialias: false});
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
      if (this.count === 0) return;
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
    }
  };
})((globalThis.urbanNav ??= {}));
