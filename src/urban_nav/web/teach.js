// SPDX-License-Identifier: BSD-3-Clause
// The page of `urban_nav labels teach`: shows a labelled cloud; each correction is sent at once, and the model answers.
"use strict";
((nav) => {
  if (!globalThis.document || !document.getElementById("class-buttons")) return;
  const NEAR = 9; // m between the camera and a suggestion
  const byId = (id) => document.getElementById(id),
    server = new nav.Server(new URLSearchParams(location.search).get("token") || ""),
    camera = new nav.Camera([0, 0, 0], 50, -Math.PI / 2, 0.9),
    view = new nav.PointView(byId("points"), {preserveDrawingBuffer: true});
  let state = null,
    cloud = null,
    groups = null,
    answers = null,
    box = null,
    range = [0, 1],
    drawn = null,
    picture = null,
    chosen = null, // {point, points}
    suggestion = -1,
    armed = "",
    working = 0,
    running = "",
    wanted = 0;

  const showBusy = () => {
    document.body.dataset.state = answers !== null && working === 0 && running === "" ? "ready" : "busy";
    nav.putText(byId("status"), running || (working > 0 ? "working" : "ready"));
  };
  const tell = (text, wrong = false) => {
    byId("outcome").className = wrong ? "error" : "";
    nav.putText(byId("outcome"), text.trim());
  };
  const work = async (task) => {
    ++working;
    showBusy();
    try {
      return await task();
    } catch (error) {
      tell(error.message, true);
    } finally {
      --working;
      showBusy();
    }
  };

  // Cloud and image

  const canvas = byId("lines");
  const matrix = () =>
    camera.matrix(canvas.clientWidth, canvas.clientHeight, Math.hypot(...box.high.map((v, k) => v - box.low[k])));
  const pickColour = () => getComputedStyle(document.documentElement).getPropertyValue("--pick").trim();
  let asked = false;
  const draw = () => {
    if (asked || !box) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      const m = matrix();
      if (view.gl) {
        view.begin(m);
        view.drawCloud(drawn);
      }
      nav.drawMarks(canvas, m, marks(), pickColour());
    });
  };
  const marks = () =>
    state.suggestions.map((s, k) => ({at: s.place, text: String(k + 1), isChosen: k === suggestion}));
  const paint = () => {
    if (!answers) return;
    const colours = nav.paintPoints(
      cloud.count,
      nav.labelColours(cloud, answers, state.classes, range)[byId("colour").value],
    );
    const pick = nav.hexColour(pickColour());
    for (const i of chosen ? chosen.points : []) for (let k = 0; k < 3; ++k) colours[4 * i + k] = pick[k];
    if (view.gl) view.fill(drawn.coloured, colours);
    if (picture) nav.drawPicture(byId("image"), picture, cloud, colours);
    draw();
  };
  const fit = () => {
    camera.fit(box.low, box.high, canvas.clientWidth / Math.max(1, canvas.clientHeight));
    draw();
  };
  const loadCloud = async () => {
    const bytes = await server.bytes("/api/cloud");
    cloud = nav.readCloud(bytes, state.counts.points, state.image !== null);
    groups = nav.groupUnits(cloud, state.units);
    box = nav.cloudBox(cloud);
    range = nav.heightRange(cloud);
    if (view.gl) {
      drawn = view.makeCloud(cloud.count);
      view.fill(drawn.placed, cloud.places);
    } else nav.putText(byId("notice"), `${state.read_only ? "read only; " : ""}no WebGL: the cloud is not drawn, the list and the image work`);
    if (state.image) {
      picture = await createImageBitmap(await server.blob("/api/image"));
      byId("image").hidden = false;
    }
  };

  // Selection

  const select = (point) => {
    const points = point < 0 ? [] : nav.pointsNear(cloud, groups, point, Number(byId("radius").value));
    chosen = points.length > 0 ? {point, points} : null;
    showSelection();
    paint();
  };
  const showSelection = () => {
    nav.putText(
      byId("selected-title"),
      chosen ? `${chosen.points.length} ${chosen.points.length === 1 ? "point" : "points"} selected` : "Nothing selected",
    );
    nav.putText(
      byId("selection"),
      chosen
        ? `answered ${nav
            .answersOf(chosen.points, answers, state.classes)
            .slice(0, 3)
            .map(([name, share]) => `${name} ${nav.percentText(share)}`)
            .join(", ")}`
        : "",
    );
    byId("selected").dataset.points = chosen ? chosen.points.length : 0;
    for (const button of byId("class-buttons").children) {
      button.disabled = state.read_only;
      nav.put(button, "aria-pressed", String(button.dataset.class === armed));
    }
    nav.putText(
      byId("armed"),
      state.read_only
        ? "Read only: no corrections are taken."
        : armed
          ? `Each click gives ${armed}; Escape ends that.`
          : chosen
            ? "Choose its class."
            : "Select points, then a class; or a class first, which each click then gives.",
    );
  };
  const goTo = (at) => {
    if (state.suggestions.length === 0) return;
    suggestion = Math.min(state.suggestions.length - 1, Math.max(0, at));
    const {point, place} = state.suggestions[suggestion];
    camera.centre = [...place];
    camera.distance = NEAR;
    showSuggestions();
    select(point);
  };

  // Lists

  const showClasses = () =>
    nav.syncRows(
      byId("class-buttons"),
      state.classes.map((c, k) => [c, k]),
      ([c]) => c.name,
      ([c, k]) => {
        const swatch = nav.element("span", {className: "swatch"});
        swatch.style.background = c.colour;
        return nav.element(
          "button",
          {"data-class": c.name, title: `Give the selection the class ${c.name} (${k + 1})`},
          swatch,
          nav.element("span"),
        );
      },
      (button, [c, k]) => nav.putText(button.children[1], `${k + 1} ${c.name} (${state.counts.classes[c.name]})`),
    );
  const showSuggestions = () =>
    nav.syncRows(
      byId("suggestion-rows"),
      state.suggestions.map((s, k) => [s, k]),
      ([, k]) => k,
      ([, k]) =>
        nav.element("div", {role: "option", "data-suggestion": String(k + 1)}, nav.element("span"), nav.element("span")),
      (row, [s, k]) => {
        nav.put(row, "data-point", String(s.point));
        nav.put(row, "aria-selected", String(k === suggestion));
        nav.putText(row.children[0], String(k + 1));
        nav.putText(row.children[1], nav.suggestionText(s));
      },
    );
  const showCorrections = () => {
    nav.putText(byId("file"), state.file);
    nav.syncRows(
      byId("correction-rows"),
      state.corrections,
      (c) => c.number,
      () => nav.element("li"),
      (row, c) => {
        nav.put(row, "data-correction", String(c.number));
        nav.putText(row, nav.correctionText(c, state.offset));
      },
    );
    for (const [action, can] of [
      ["undo", state.can_undo],
      ["redo", state.can_redo],
    ])
      document.querySelector(`[data-action="${action}"]`).disabled = state.read_only || !can;
  };

  const show = () => {
    nav.putText(byId("store"), `${state.scene}, model ${state.model}`);
    if (state.read_only && view.gl) nav.putText(byId("notice"), "read only");
    nav.putText(byId("counts"), nav.countsText(state.counts));
    if (state.fault) tell(state.fault, true);
    showClasses();
    showSuggestions();
    showCorrections();
    showSelection();
  };
  /** Loads what the server has until nothing newer is known of. */
  const load = () =>
    work(async () => {
      do {
        const given = await server.json("/api/state"),
          first = state === null;
        const before = suggestion >= 0 ? state.suggestions[suggestion] : null;
        state = given;
        suggestion = before ? state.suggestions.findIndex((s) => s.point === before.point) : -1;
        if (first) await loadCloud();
        answers = nav.readAnswers(await server.bytes("/api/answers"), cloud.count);
        show();
        if (first) fit();
        paint();
      } while (state.revision < wanted);
    });

  // Corrections

  const send = (words) =>
    work(async () => {
      const outcome = await server.post("/api/correct", words);
      await load();
      tell(outcome.text, !outcome.changed);
    });
  const correct = (name) => {
    if (state.read_only) return;
    if (!chosen) {
      armed = armed === name ? "" : name;
      showSelection();
      return;
    }
    const {point} = chosen;
    chosen = null;
    send({action: "correct", point, radius: Number(byId("radius").value), class: name});
  };
  const take = (action) => {
    if (!document.querySelector(`[data-action="${action}"]`).disabled) send({action});
  };
  const clickAt = (point) => {
    select(point);
    if (chosen && armed && !state.read_only) correct(armed);
  };

  // Events

  nav.steer(canvas, camera, draw, (x, y) => {
    if (box && answers) clickAt(nav.pickIndex(cloud, matrix(), canvas.clientWidth, canvas.clientHeight, x, y));
  });
  byId("image").addEventListener("click", (event) => {
    const {left, top, width} = byId("image").getBoundingClientRect(),
      scale = state.image.width / width;
    clickAt(nav.pickPixel(cloud, scale * (event.clientX - left), scale * (event.clientY - top), 10 * scale));
  });
  const keys = {
    n: () => goTo(suggestion + 1),
    j: () => goTo(suggestion + 1),
    k: () => goTo(suggestion - 1),
    u: () => take("undo"),
    U: () => take("redo"),
    f: () => fit(),
    t: () => byId("above").click(),
    b: () => {
      byId("radius").selectedIndex = (byId("radius").selectedIndex + 1) % byId("radius").options.length;
      byId("radius").dispatchEvent(new Event("change"));
    },
    Escape: () => {
      armed = "";
      select(-1);
    },
  };
  document.addEventListener("keydown", (event) => {
    if (!answers || event.ctrlKey || event.altKey || event.metaKey || /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName))
      return;
    const number = /^[1-9]$/.test(event.key) ? Number(event.key) : 0;
    if (number > 0 && number <= state.classes.length) correct(state.classes[number - 1].name);
    else if (keys[event.key]) keys[event.key]();
    else return;
    event.preventDefault();
  });
  document.addEventListener("click", (event) => {
    const button = event.target.closest("[data-class], [data-action], [data-suggestion]");
    if (!button || !answers) return;
    if (button.dataset.class) correct(button.dataset.class);
    else if (button.dataset.action) take(button.dataset.action);
    else goTo(Number(button.dataset.suggestion) - 1);
  });
  byId("next").addEventListener("click", () => goTo(suggestion + 1));
  byId("fit").addEventListener("click", fit);
  byId("above").addEventListener("click", () => {
    camera.yaw = -Math.PI / 2;
    camera.pitch = Math.PI / 2;
    draw();
  });
  byId("colour").addEventListener("change", paint);
  byId("radius").addEventListener("change", () => chosen && select(chosen.point));
  addEventListener("resize", () => paint());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", paint);

  const report = (told) => {
    running = told.running;
    wanted = told.revision;
    showBusy();
    if (answers && working === 0 && state.revision < wanted) load();
  };
  load().then(() =>
    nav.followWhileShown(server, report, () => nav.putText(byId("status"), "the server cannot be reached")),
  );
})((globalThis.urbanNav ??= {}));
