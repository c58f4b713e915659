// SPDX-License-Identifier: BSD-3-Clause
// Marks over a cloud, and a picture with its points, on canvases without WebGL.
"use strict";
((nav) => {
  const RADIUS = 9; // px, of a mark
  const MOST_DOTS = 60000; // in a picture, so that it is drawn in a frame

  /** Prepares a canvas of the page for drawing in its own pixels; returns the context. */
  const prepare = (canvas, width, height) => {
    const scale = globalThis.devicePixelRatio || 1;
    canvas.width = Math.round(scale * width);
    canvas.height = Math.round(scale * height);
    const context = canvas.getContext("2d");
    context.scale(scale, scale);
    return context;
  };

  /** Draws numbered circles at places of the cloud: {at, text, isChosen}. */
  nav.drawMarks = (canvas, matrix, marks, colour) => {
    const {clientWidth: width, clientHeight: height} = canvas,
      context = prepare(canvas, width, height);
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    for (const {at, text, isChosen} of marks) {
      const p = nav.project(matrix, at, width, height);
      if (!p) continue;
      context.beginPath();
      context.arc(p[0], p[1], RADIUS, 0, 2 * Math.PI);
      context.fillStyle = isChosen ? colour : "rgba(255, 255, 255, 0.85)";
      context.fill();
      context.strokeStyle = colour;
      context.lineWidth = 1.5;
      context.stroke();
      context.fillStyle = isChosen ? "#ffffff" : "#1d2430";
      context.fillText(text, p[0], p[1]);
    }
  };

  /** Draws the image of a scene, as wide as its element, with the points it shows in their colours (four bytes each). */
  nav.drawPicture = (canvas, picture, {count, pixels}, colours) => {
    const width = canvas.clientWidth,
      scale = width / picture.width,
      context = prepare(canvas, width, Math.round(scale * picture.height)),
      step = Math.max(1, Math.ceil(count / MOST_DOTS));
    context.drawImage(picture, 0, 0, width, scale * picture.height);
    for (let i = 0; i < count; i += step) {
      if (Number.isNaN(pixels[2 * i])) continue;
      context.fillStyle = `rgb(${colours[4 * i]}, ${colours[4 * i + 1]}, ${colours[4 * i + 2]})`;
      context.fillRect(scale * pixels[2 * i] - 1, scale * pixels[2 * i + 1] - 1, 2, 2);
    }
  };
})((globalThis.urbanNav ??= {}));
