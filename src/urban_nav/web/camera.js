// SPDX-License-Identifier: BSD-3-Clause
// A camera that orbits a point of the map: z is up, angles in rad, lengths in m. Independent of the page.
"use strict";
((nav) => {
  const FOCAL = 1.6; // in units of half the image height

  nav.Camera = class {
    constructor(centre = [0, 0, 0], distance = 10, yaw = -0.9, pitch = 0.6) {
      Object.assign(this, {centre, distance, yaw, pitch});
    }

    /** Axes of the picture in the map: right, up, and back towards the viewer. */
    axes() {
      const {yaw, pitch} = this;
      const back = [Math.cos(pitch) * Math.cos(yaw), Math.cos(pitch) * Math.sin(yaw), Math.sin(pitch)],
        right = [-Math.sin(yaw), Math.cos(yaw), 0];
      const up = [
        back[1] * right[2] - back[2] * right[1],
        back[2] * right[0] - back[0] * right[2],
        back[0] * right[1] - back[1] * right[0],
      ];
      return [right, up, back];
    }

    /** Position of the camera, m. */
    eye() {
      const back = this.axes()[2];
      return this.centre.map((c, k) => c + this.distance * back[k]);
    }

    /** Focal length in px, for an image of this height. */
    focal(height) {
      return (FOCAL * height) / 2;
    }

    /** The matrix by which WebGL projects, column by column. `reach`: diameter of what is to be seen. */
    matrix(width, height, reach) {
      const [x, y, z] = this.axes(),
        {centre, distance} = this,
        near = 0.02 * distance,
        far = 20 * distance + reach;
      const dot = (v) => v[0] * centre[0] + v[1] * centre[1] + v[2] * centre[2];
      const tx = -dot(x),
        ty = -dot(y),
        tz = -dot(z) - distance,
        sx = (FOCAL * height) / width,
        a = -(far + near) / (far - near),
        b = (-2 * far * near) / (far - near);
      return [
        sx * x[0],
        FOCAL * y[0],
        a * z[0],
        -z[0],
        sx * x[1],
        FOCAL * y[1],
        a * z[1],
        -z[1],
        sx * x[2],
        FOCAL * y[2],
        a * z[2],
        -z[2],
        sx * tx,
        FOCAL * ty,
        a * tz + b,
        -tz,
      ];
    }

    turn(dx, dy) {
      this.yaw -= 0.006 * dx;
      this.pitch = Math.min(Math.PI / 2, Math.max(-0.3, this.pitch + 0.006 * dy));
    }

    /** Moves with the pointer, by px in a picture of this height. */
    move(dx, dy, height) {
      const [right, up] = this.axes(),
        scale = (2 * this.distance) / (FOCAL * height);
      this.centre = this.centre.map((c, k) => c - scale * dx * right[k] + scale * dy * up[k]);
    }

    zoom(amount) {
      this.distance = Math.min(1e6, Math.max(0.05, this.distance * Math.exp(amount)));
    }

    /** Shows a box from where the camera looks. */
    fit(low, high, aspect = 1) {
      this.centre = low.map((v, k) => (v + high[k]) / 2);
      const [right, up, back] = this.axes(),
        size = low.map((v, k) => (high[k] - v) / 2);
      const extent = (axis) => size.reduce((sum, s, k) => sum + Math.abs(axis[k]) * s, 0);
      this.distance = Math.max(1, extent(back) + 1.08 * FOCAL * Math.max(extent(up), extent(right) / aspect));
    }
  };

  /** Returns the pixel of a point in an image, from its top left; null if it is not in front of the camera. */
  nav.project = (m, p, width, height) => {
    const w = m[3] * p[0] + m[7] * p[1] + m[11] * p[2] + m[15];
    if (!(w > 0)) return null;
    const u = (m[0] * p[0] + m[4] * p[1] + m[8] * p[2] + m[12]) / w,
      v = (m[1] * p[0] + m[5] * p[1] + m[9] * p[2] + m[13]) / w;
    return [((1 + u) * width) / 2, ((1 - v) * height) / 2, w];
  };

  /** Lets a pointer and keys steer a camera. `changed` draws; `clicked` takes a point of the element, px. */
  nav.steer = (element, camera, changed, clicked) => {
    let held = null,
      moved = 0;
    element.addEventListener("pointerdown", (event) => {
      held = event;
      moved = 0;
      element.setPointerCapture(event.pointerId);
    });
    element.addEventListener("pointermove", (event) => {
      if (!held) return;
      const dx = event.clientX - held.clientX,
        dy = event.clientY - held.clientY;
      moved += Math.abs(dx) + Math.abs(dy);
      held = event;
      if (event.shiftKey || event.buttons & 2) camera.move(dx, dy, element.clientHeight);
      else camera.turn(dx, dy);
      changed();
    });
    element.addEventListener("pointerup", (event) => {
      held = null;
      const box = element.getBoundingClientRect();
      if (moved < 4) clicked(event.clientX - box.left, event.clientY - box.top);
    });
    element.addEventListener("contextmenu", (event) => event.preventDefault());
    element.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        camera.zoom(0.001 * event.deltaY);
        changed();
      },
      {passive: false},
    );
    element.addEventListener("keydown", (event) => {
      const step = {ArrowLeft: [-20, 0], ArrowRight: [20, 0], ArrowUp: [0, 20], ArrowDown: [0, -20]}[event.key];
      if (step && event.shiftKey) camera.move(-step[0], step[1], element.clientHeight);
      else if (step) camera.turn(...step);
      else if (event.key === "+" || event.key === "-") camera.zoom(event.key === "+" ? -0.2 : 0.2);
      else return;
      event.preventDefault();
      event.stopPropagation();
      changed();
    });
  };
})((globalThis.urbanNav ??= {}));
