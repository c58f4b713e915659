// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/map_viewer.hpp"

namespace urban_nav {

// One call draws the last view that stands on the page so far: each view brings the script.
const char* mapViewerScript() {
  return R"js(
"use strict";
((view) => {
  const canvas = view.querySelector("canvas"), choice = view.querySelector("select"), output = view.querySelector("output");
  const gl = canvas.getContext("webgl", {antialias: false, preserveDrawingBuffer: true});
  if (!gl) { view.style.display = "none"; return; }
  const data = view.dataset, n = Number(data.points), list = (text) => text.split(",").map(Number);
  const low = list(data.low), high = list(data.high), size = low.map((v, i) => high[i] - v);
  const raw = atob(view.querySelector("script").textContent), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  const places = new Uint16Array(bytes.buffer, 0, 4 * n), values = bytes.subarray(8 * n), colours = new Uint8Array(4 * n);
  const at = (i) => low.map((v, k) => v + size[k] * places[4 * i + k] / 65535);
  const program = gl.createProgram();
  const shader = (type, text) => { const made = gl.createShader(type); gl.shaderSource(made, text); gl.compileShader(made); gl.attachShader(program, made); };
  shader(gl.VERTEX_SHADER, "attribute vec3 p; attribute vec4 c; uniform mat4 m; uniform vec3 low, size; uniform float px; varying vec4 v;" +
    "void main() { gl_Position = m * vec4(low + size * p, 1.0); gl_PointSize = clamp(px / gl_Position.w, 1.5, 8.0); v = c; }");
  shader(gl.FRAGMENT_SHADER, "precision mediump float; varying vec4 v; void main() { gl_FragColor = vec4(v.rgb, 1.0); }");
  gl.linkProgram(program);
  gl.useProgram(program);
  const uniform = (name) => gl.getUniformLocation(program, name), where = gl.getAttribLocation(program, "p"), tint = gl.getAttribLocation(program, "c");
  const buffer = (content) => { const made = gl.createBuffer(); gl.bindBuffer(gl.ARRAY_BUFFER, made); gl.bufferData(gl.ARRAY_BUFFER, content, gl.STATIC_DRAW); return made; };
  const placed = buffer(places), coloured = buffer(colours);
  const paths = JSON.parse(data.paths).map((path) => ({points: path.length / 3, buffer: buffer(new Float32Array(path))}));
  const ramp = (t) => [255 * Math.min(1, Math.max(0, 1.5 - Math.abs(4 * t - 3))), 255 * Math.min(1, Math.max(0, 1.5 - Math.abs(4 * t - 2))), 255 * Math.min(1, Math.max(0, 1.5 - Math.abs(4 * t - 1)))];
  const kinds = [[214, 96, 77], [67, 147, 195], [90, 174, 97], [153, 112, 171], [225, 170, 60], [80, 80, 80], [200, 120, 160]];
  const heights = Array.from({length: n}, (_, i) => places[4 * i + 2]).sort((a, b) => a - b), floor = heights[n >> 6], roof = heights[n - 1 - (n >> 6)];
  const modes = {
    rgb: (i) => values.subarray(8 * i, 8 * i + 3),
    reflectance: (i) => [values[8 * i + 3], values[8 * i + 3], values[8 * i + 3]],
    height: (i) => ramp(Math.min(1, Math.max(0, (places[4 * i + 2] - floor) / Math.max(1, roof - floor)))),
    pass: (i) => kinds[values[8 * i + 5] % kinds.length],
    laser: (i) => kinds[values[8 * i + 4] % 5],
    sigma: (i) => ramp(Math.sqrt(values[8 * i + 6] / 255)),
    quality: (i) => values[8 * i + 7] === 255 ? [205, 205, 205] : ramp(Math.sqrt(values[8 * i + 7] / 254)),
  };
  let yaw = -0.9, pitch = 0.6, distance = 0.7 * Math.hypot(size[0], size[1]), centre = low.map((v, k) => v + size[k] * (k < 2 ? 0.5 : 0.2)), matrix, first = null;
  const axes = () => {
    const back = [Math.cos(pitch) * Math.cos(yaw), Math.cos(pitch) * Math.sin(yaw), Math.sin(pitch)], right = [-Math.sin(yaw), Math.cos(yaw), 0];
    const up = [back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2], back[0] * right[1] - back[1] * right[0]];
    return [right, up, back];
  };
  const draw = () => {
    const width = Math.max(1, Math.round(canvas.clientWidth * devicePixelRatio)), height = Math.max(1, Math.round(canvas.clientHeight * devicePixelRatio));
    if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; }
    const near = 0.02 * distance, far = 20 * distance + Math.hypot(...size), focal = 1.6, rows = axes();
    const dot = (a) => a[0] * centre[0] + a[1] * centre[1] + a[2] * centre[2];
    const [x, y, z] = rows, tx = -dot(x), ty = -dot(y), tz = -dot(z) - distance, sx = focal * height / width, a = -(far + near) / (far - near), b = -2 * far * near / (far - near);
    matrix = [sx * x[0], focal * y[0], a * z[0], -z[0], sx * x[1], focal * y[1], a * z[1], -z[1], sx * x[2], focal * y[2], a * z[2], -z[2], sx * tx, focal * ty, a * tz + b, -tz];
    gl.viewport(0, 0, width, height);
    gl.clearColor(0.98, 0.98, 0.98, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.uniformMatrix4fv(uniform("m"), false, matrix);
    gl.uniform1f(uniform("px"), 0.06 * focal * height / 2);
    gl.uniform3fv(uniform("low"), low); gl.uniform3fv(uniform("size"), size);
    gl.enableVertexAttribArray(where); gl.enableVertexAttribArray(tint);
    gl.bindBuffer(gl.ARRAY_BUFFER, placed); gl.vertexAttribPointer(where, 3, gl.UNSIGNED_SHORT, true, 8, 0);
    gl.bindBuffer(gl.ARRAY_BUFFER, coloured); gl.vertexAttribPointer(tint, 4, gl.UNSIGNED_BYTE, true, 4, 0);
    gl.drawArrays(gl.POINTS, 0, n);
    gl.uniform3fv(uniform("low"), [0, 0, 0]); gl.uniform3fv(uniform("size"), [1, 1, 1]);
    gl.disableVertexAttribArray(tint); gl.vertexAttrib4f(tint, 0.86, 0.16, 0.16, 1);
    for (const path of paths) { gl.bindBuffer(gl.ARRAY_BUFFER, path.buffer); gl.vertexAttribPointer(where, 3, gl.FLOAT, false, 12, 0); gl.drawArrays(gl.LINE_STRIP, 0, path.points); }
  };
  const paint = () => {
    const mode = modes[choice.value];
    for (let i = 0; i < n; ++i) { const c = mode(i); colours[4 * i] = c[0]; colours[4 * i + 1] = c[1]; colours[4 * i + 2] = c[2]; }
    gl.bindBuffer(gl.ARRAY_BUFFER, coloured); gl.bufferData(gl.ARRAY_BUFFER, colours, gl.STATIC_DRAW);
    draw();
  };
  const pick = (event) => {
    const box = canvas.getBoundingClientRect(), u = 2 * (event.clientX - box.left) / box.width - 1, v = 1 - 2 * (event.clientY - box.top) / box.height, m = matrix;
    let best = -1, least = 1e9;
    for (let i = 0; i < n; ++i) {
      const p = at(i), w = m[3] * p[0] + m[7] * p[1] + m[11] * p[2] + m[15];
      if (w <= 0) continue;
      const du = (m[0] * p[0] + m[4] * p[1] + m[8] * p[2] + m[12]) / w - u, dv = (m[1] * p[0] + m[5] * p[1] + m[9] * p[2] + m[13]) / w - v;
      const off = Math.hypot(du * box.width, dv * box.height) / 2;
      if (off < 6 && w + 0.2 * off < least) { least = w + 0.2 * off; best = i; }
    }
    if (best < 0) { first = null; return; }
    const p = at(best), stamp = Number(data.first) + Number(data.seconds) * places[4 * best + 3] / 65535;
    output.textContent = `stamp ${stamp.toFixed(2)} s, pass ${values[8 * best + 5]}, laser ${values[8 * best + 4]}, sigma ${(0.5 * values[8 * best + 6]).toFixed(1)} mm` +
      (values[8 * best + 7] === 255 ? "" : `, passes ${(0.5 * values[8 * best + 7]).toFixed(1)} mm apart`) +
      (first ? `, ${Math.hypot(p[0] - first[0], p[1] - first[1], p[2] - first[2]).toFixed(3)} m from the point before` : "");
    first = first ? null : p;
  };
  let held = null, moved = 0;
  canvas.addEventListener("pointerdown", (event) => { held = event; moved = 0; canvas.setPointerCapture(event.pointerId); });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return;
    const dx = event.clientX - held.clientX, dy = event.clientY - held.clientY;
    moved += Math.abs(dx) + Math.abs(dy); held = event;
    if (event.shiftKey || event.buttons & 2) {
      const [right, up] = axes(), scale = 1.25 * distance / canvas.clientHeight;
      centre = centre.map((c, k) => c - scale * dx * right[k] + scale * dy * up[k]);
    } else { yaw -= 0.006 * dx; pitch = Math.min(1.57, Math.max(-0.3, pitch + 0.006 * dy)); }
    draw();
  });
  canvas.addEventListener("pointerup", (event) => { held = null; if (moved < 4) pick(event); });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => { event.preventDefault(); distance *= Math.exp(0.001 * event.deltaY); draw(); }, {passive: false});
  choice.addEventListener("change", paint);
  addEventListener("resize", draw);
  view.addLayer = (name, text, colours) => {
    const kindOf = atob(text);
    if (kindOf.length !== n) return;
    modes[name] = (i) => colours[kindOf.charCodeAt(i)] || [60, 60, 60];
    choice.add(new Option(name, name));
  };
  paint();
})([...document.querySelectorAll(".map-view")].pop());
)js";
}

}  // namespace urban_nav
