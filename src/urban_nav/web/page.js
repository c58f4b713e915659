// SPDX-License-Identifier: BSD-3-Clause
// The page of `urban_nav view`: shows the data of the server; each control sends a command of `edge`.
"use strict";
((nav) => {
  if (!globalThis.document || !document.getElementById("edit-rows")) return;
  const byId = (id) => document.getElementById(id),
    server = new nav.Server(new URLSearchParams(location.search).get("token") || "");
  const field = (name) => document.querySelector(`[data-field="${name}"]`);
  const camera = new nav.Camera([0, 0, 0], 50, -Math.PI / 2, Math.PI / 2);
  let state = null,
    paths = [],
    box = null,
    selected = null,
    working = 0,
    running = "",
    wanted = 0,
    nextPick = "t1",
    now = null,
    shifts = null,
    compared = null,
    places = {};
  const view = new nav.TileView(new nav.PointView(byId("points"), {preserveDrawingBuffer: true}), (tile) =>
    server.bytes(`/api/tile?set=${tile.set}&tile=${tile.name}`),
  );

  // State of the page

  const showBusy = () => {
    document.body.dataset.state = state !== null && working === 0 && running === "" ? "ready" : "busy";
    nav.putText(byId("status"), running ? `running: ${running}` : working > 0 ? "working" : "ready");
  };
  /** Runs something during which the page is busy; what it throws is shown. */
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
  const tell = (text, wrong = false) => {
    byId("outcome").className = wrong ? "error" : "";
    nav.putText(byId("outcome"), text.trim());
  };

  // Map

  const colours = () => {
    const style = getComputedStyle(document.documentElement),
      of = (name) => style.getPropertyValue(name).trim();
    return {good: of("--good"), bad: of("--bad"), a: of("--a"), pick: of("--pick")};
  };
  const drawnClosures = () =>
    state.closures.filter((c) => c.verdict === "accepted" || c.id === selected || byId("show-rejected").checked);
  const matrix = () => {
    const canvas = byId("lines");
    return camera.matrix(
      canvas.clientWidth,
      canvas.clientHeight,
      Math.hypot(...box.high.map((v, k) => v - box.low[k])),
    );
  };
  let asked = false;
  const draw = () => {
    if (asked || !box) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      const palette = colours(),
        marks = [];
      for (const name of ["t1", "t2"]) {
        const place = nav.placeOf(paths, nav.findMoment(state.sessions, field(name).value));
        if (place) marks.push({at: place, text: name.slice(1), colour: palette.pick});
      }
      if (now) marks.push({at: nav.placeOf(paths, now), text: "", colour: palette.a});
      view.draw({matrix: matrix(), eye: camera.eye(), focal: camera.focal(byId("lines").clientHeight)});
      nav.drawPlan(
        byId("lines"),
        matrix(),
        {paths, compared, closures: drawnClosures(), selected: closureOf(selected), marks},
        palette,
      );
    });
  };
  const fit = () => {
    const canvas = byId("lines");
    camera.fit(box.low, box.high, canvas.clientWidth / Math.max(1, canvas.clientHeight));
    draw();
  };
  /** Shows the left image at a picked moment, if the store has it. */
  const showView = async (name, {session, seconds}) => {
    const image = byId(`view-${name}`),
      asked = (image.dataset.asked = `${session} ${seconds}`);
    const blob = await server.blob(`/api/view?session=${session}&seconds=${seconds}`).catch(() => null);
    if (image.dataset.asked !== asked) return;
    URL.revokeObjectURL(image.src);
    image.hidden = !blob;
    image.src = blob ? URL.createObjectURL(blob) : "";
  };
  const pick = (name, moment) => {
    field(name).value = nav.momentWord(state.sessions, moment.session, moment.seconds);
    nextPick = name === "t1" ? "t2" : "t1";
    places[name] = moment.place || nav.placeOf(paths, moment);
    const {t1, t2} = places;
    nav.putText(
      byId("apart"),
      t1 && t2 ? `${Math.hypot(...t1.map((v, k) => v - t2[k])).toFixed(3)} m between both places` : "",
    );
    showView(name, moment);
    draw();
  };
  let loadingPoints = false,
    pointsRevision = 0;
  /** Points come after the lists and paths, and follow the poses: nothing waits for them. */
  const loadPoints = async () => {
    if (loadingPoints || !view.points.gl) return;
    loadingPoints = true;
    try {
      while (pointsRevision !== state.revision) {
        const {revision, sessions, tests = []} = state,
          [json, bytes] = await Promise.all([server.json("/api/tiles"), server.bytes("/api/moves")]);
        if (revision !== state.revision) continue;
        pointsRevision = revision;
        const list = nav.readTileList(json);
        if (!view.list || JSON.stringify(view.list.sets) !== JSON.stringify(list.sets)) view.setList(list);
        const trusted = nav.trustColours(tests),
          trust = (session, pose) => trusted(session, paths[session] ? paths[session].times[pose] : NaN);
        view.place(nav.tilePlacement(list.sets, nav.readMoves(bytes, list.sets), sessions, shifts), nav.sessionColours, trust);
        byId("colour").disabled = list.tiles.length === 0;
        byId("points").dataset.revision = revision;
        draw();
      }
    } catch (error) {
      byId("colour").title = error.message;
    } finally {
      loadingPoints = false;
    }
  };
  /** The moment at which the point of a tile below the pointer was measured; null without one. */
  const pickPoint = (...at) => {
    const found = view.pick(...at);
    if (!found) return null;
    const {points, i} = found,
      session = points.owner[i];
    return {session, seconds: paths[session].times[points.poses[i]], place: nav.pointAt(points, i)};
  };

  // Closures and edits

  const closureOf = (id) => (state && state.closures.find((c) => c.id === id)) || null;
  const filtered = () =>
    nav.filterClosures(state.closures, {
      verdict: byId("verdict-filter").value,
      kind: byId("kind-filter").value,
      session: byId("session-filter").value,
    });
  const fillChoice = (select, entries) => {
    nav.syncRows(
      select,
      [["", select.options[0].text], ...entries],
      ([value]) => `=${value}`,
      ([value]) => nav.element("option", {value}),
      (row, [, text]) => nav.putText(row, text),
    );
  };
  const showClosures = () => {
    const kinds = [...new Set(state.closures.map((c) => c.kind))].sort(),
      verdicts = [...new Set(state.closures.map((c) => c.verdict))].sort();
    fillChoice(
      byId("kind-filter"),
      kinds.map((k) => [k, k]),
    );
    fillChoice(
      byId("verdict-filter"),
      verdicts.map((v) => [v, v]),
    );
    fillChoice(
      byId("session-filter"),
      state.sessions.map((s, k) => [String(k), s.name]),
    );
    const shown = filtered();
    nav.putText(byId("count"), `${shown.length} of ${state.closures.length}`);
    nav.syncRows(
      byId("rows"),
      shown,
      (c) => c.id,
      (c) =>
        nav.element(
          "div",
          {role: "option", id: `closure-${c.id}`, "data-edge": c.id},
          nav.element("span", {}, String(c.id)),
          nav.element("span", {className: "verdict"}),
          nav.element("span"),
          nav.element("span", {className: "reason"}),
        ),
      (row, c) => {
        nav.put(row, "data-verdict", c.verdict);
        nav.put(row, "data-kind", c.kind);
        nav.put(row, "aria-selected", String(c.id === selected));
        nav.putText(row.children[1], c.verdict);
        nav.putText(row.children[2], c.kind);
        nav.putText(
          row.children[3],
          `${nav.endText(state.sessions, c.a)} \u2013 ${nav.endText(state.sessions, c.b)}${c.reason ? `: ${c.reason}` : ""}`,
        );
        row.title = row.children[3].textContent;
      },
    );
  };
  const showSelection = () => {
    const closure = closureOf(selected);
    for (const row of byId("rows").children)
      nav.put(row, "aria-selected", String(row.dataset.key === String(selected)));
    if (closure) byId("rows").setAttribute("aria-activedescendant", `closure-${selected}`);
    else byId("rows").removeAttribute("aria-activedescendant");
    nav.putText(byId("selected-title"), closure ? `Closure ${selected}: ${closure.verdict}` : "No closure selected");
    if (!closure) byId("explanation").replaceChildren();
    for (const button of document.querySelectorAll("[data-action]")) {
      const name = button.dataset.action,
        of_closure = ["reject", "accept", "remove"].includes(name);
      button.disabled =
        state.read_only ||
        (of_closure && !closure) ||
        (name === "remove" && !closure.added) ||
        (name === "undo" && !state.can_undo) ||
        (name === "redo" && !state.can_redo);
    }
    draw();
  };
  const select = (id) =>
    work(async () => {
      selected = id;
      showSelection();
      const row = byId(`closure-${id}`);
      if (row) row.scrollIntoView({block: "nearest"});
      if (id === null) return;
      const page = await server.json(`/api/why?id=${id}`);
      if (selected === id)
        await nav.showExplanation(byId("explanation"), page, (number) =>
          server.blob(`/api/picture?id=${id}&number=${number}`),
        );
    });
  /** Which closures hold the pose at moment 1. */
  const whyHere = () =>
    work(async () => {
      const moment = field("t1").value.trim();
      if (!moment) throw new Error("Pick moment 1 on the path, or write it.");
      const page = await server.json(`/api/moment?t=${encodeURIComponent(moment)}`);
      selected = null;
      showSelection();
      nav.putText(byId("selected-title"), page.title);
      await nav.showExplanation(byId("explanation"), page, () => null);
    });
  /** Measures both moments and shows the matches; the map stays as it is. */
  const tryMeasurement = () =>
    work(async () => {
      const {t1, t2} = fields();
      if (!t1 || !t2) throw new Error("Pick moments 1 and 2 on the path, or write them.");
      const page = await server.json(`/api/try?t1=${encodeURIComponent(t1)}&t2=${encodeURIComponent(t2)}`);
      selected = null;
      showSelection();
      nav.putText(byId("selected-title"), page.accepted ? "Would be accepted; Measure adds it" : "Would not be accepted");
      tell(page.reason, !page.accepted);
      await nav.showExplanation(byId("explanation"), page, (number) =>
        server.blob(`/api/picture?id=0&number=${number}`),
      );
    });
  const showEdits = () =>
    nav.syncRows(
      byId("edit-rows"),
      state.edits,
      (e) => e.number,
      () => nav.element("li"),
      (row, e) => {
        nav.put(row, "data-edit", String(e.number));
        nav.put(row, "data-undone", e.undone ? "1" : "0");
        nav.putText(row, `${e.number}  ${e.command}`);
      },
    );
  const showSessions = () =>
    nav.syncRows(
      byId("sessions"),
      state.sessions.map((s, k) => [s, k]),
      ([s]) => s.id,
      () => nav.element("li", {}, nav.element("span", {className: "swatch"}), nav.element("span")),
      (row, [s, k]) => {
        row.children[0].style.background = nav.sessionColours[k % nav.sessionColours.length];
        nav.putText(
          row.children[1],
          `${s.name}: ${s.poses} poses, ${s.length_m.toFixed(1)} m, ${s.seconds.toFixed(1)} s, map ${s.map + 1}${nav.comparedText(state.compared, k)}`,
        );
      },
    );

  const show = (given, bytes, other) => {
    const first = state === null,
      before = closureOf(selected);
    state = given;
    ({paths, box, shifts} = nav.placePaths(state.sessions, bytes));
    compared = other ? nav.placeCompared(state.sessions, other, shifts) : null;
    nav.putText(byId("store"), state.store);
    nav.putText(byId("compared"), nav.comparedNotice(state.compared));
    nav.putText(
      byId("notice"),
      state.written_by_another
        ? "another program writes this store: it can only be read until that ends"
        : state.read_only
          ? "read only"
          : "",
    );
    if (selected !== null && !closureOf(selected)) selected = null;
    showSessions();
    showClosures();
    showEdits();
    showSelection();
    if (first) fit();
    loadPoints();
    const after = closureOf(selected);
    if (before && after && (before.verdict !== after.verdict || before.reason !== after.reason))
      return select(selected);
    return draw();
  };
  /** Loads what the server has until nothing newer is known of. */
  const load = () =>
    work(async () => {
      do {
        const [given, bytes] = await Promise.all([server.json("/api/state"), server.bytes("/api/paths")]),
          other = given.compared ? await server.bytes("/api/compared") : null,
          poses = given.sessions.reduce((sum, s) => sum + s.poses, 0);
        if (bytes.byteLength !== 16 * poses || (other && other.byteLength !== 12 * poses)) continue; // of another revision
        await show(given, bytes, other);
      } while (state.revision < wanted);
    });

  // Edits

  const fields = () =>
    Object.fromEntries(
      [...document.querySelectorAll("[data-field]")].map((input) => [input.dataset.field, input.value.trim()]),
    );
  const act = (action) => {
    if (working > 0 || running || document.querySelector(`[data-action="${action}"]`).disabled) return;
    const [words, missing] = nav.editWords(action, state, selected, fields());
    if (!words) {
      tell(missing, true);
      return;
    }
    work(async () => {
      tell("");
      const outcome = await server.edit(words);
      await load();
      tell(outcome.text, !outcome.changed);
      if (outcome.edge !== null) await select(outcome.edge);
    });
  };

  // Events

  const step = (by) => {
    const id = nav.neighbour(filtered(), selected, by);
    if (id !== null) select(id);
  };
  const setTime = () => {
    let left = Number(byId("time").value) * state.sessions.reduce((sum, s) => sum + s.seconds, 0);
    const at = state.sessions.findIndex((s) => s.poses > 0 && (left <= s.seconds || ((left -= s.seconds), false)));
    now = at < 0 ? null : {session: at, seconds: Math.max(0, left)};
    nav.putText(byId("moment"), now ? nav.endText(state.sessions, now) : "");
    draw();
  };
  const keys = {
    j: () => step(1),
    k: () => step(-1),
    r: () => act("reject"),
    a: () => act("accept"),
    Delete: () => act("remove"),
    u: () => act("undo"),
    U: () => act("redo"),
    c: () => tryMeasurement(),
    m: () => act("measure"),
    w: () => whyHere(),
    f: () => fit(),
    t: () => byId("above").click(),
    1: () => byId("to-t1").click(),
    2: () => byId("to-t2").click(),
  };
  document.addEventListener("keydown", (event) => {
    if (
      !state ||
      event.ctrlKey ||
      event.altKey ||
      event.metaKey ||
      (/^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName) && event.target.type !== "checkbox")
    )
      return;
    if (keys[event.key]) {
      event.preventDefault();
      keys[event.key]();
    }
  });
  byId("rows").addEventListener("keydown", (event) => {
    const by = {ArrowDown: 1, ArrowUp: -1, PageDown: 10, PageUp: -10, End: 1e9, Home: -1e9}[event.key];
    if (by) {
      event.preventDefault();
      step(by);
    }
  });
  byId("rows").addEventListener("click", (event) => {
    const row = event.target.closest("[data-edge]");
    if (row) select(Number(row.dataset.edge));
  });
  document.addEventListener("click", (event) => {
    const button = event.target.closest("[data-action]");
    if (button) act(button.dataset.action);
  });
  byId("moments").addEventListener("submit", (event) => {
    event.preventDefault();
    act("measure");
  });
  for (const id of ["verdict-filter", "kind-filter", "session-filter"])
    byId(id).addEventListener("change", showClosures);
  for (const name of ["t1", "t2"]) field(name).addEventListener("input", draw);
  byId("show-rejected").addEventListener("change", draw);
  byId("time").addEventListener("input", setTime);
  byId("fit").addEventListener("click", fit);
  byId("above").addEventListener("click", () => {
    camera.yaw = -Math.PI / 2;
    camera.pitch = Math.PI / 2;
    draw();
  });
  for (const name of ["t1", "t2"])
    byId(`to-${name}`).addEventListener("click", () => {
      if (!now) setTime();
      if (now) pick(name, now);
    });
  nav.steer(byId("lines"), camera, draw, (x, y) => {
    if (!box) return;
    const at = [matrix(), byId("lines").clientWidth, byId("lines").clientHeight, x, y];
    const met = nav.pickInPlan(...at, paths, drawnClosures()) || pickPoint(...at);
    if (met && met.closure !== undefined) select(met.closure);
    else if (met) pick(nextPick, met);
  });
  byId("colour").addEventListener("change", () => {
    view.colour(byId("colour").value);
    draw();
  });
  byId("why-here").addEventListener("click", whyHere);
  byId("try").addEventListener("click", tryMeasurement);
  byId("explanation").addEventListener("click", (event) => {
    const link = event.target.closest("[data-closure]");
    if (link && closureOf(Number(link.dataset.closure))) select(Number(link.dataset.closure));
  });
  addEventListener("resize", draw);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);

  /** What the server reports of itself. */
  const take = (report) => {
    const ended = running !== "" && report.running === "";
    running = report.running;
    wanted = report.revision;
    showBusy();
    if (ended && working === 0) tell(report.outcome);
    if (state && working === 0 && state.revision < wanted) load();
  };
  const lost = () => nav.putText(byId("status"), "the server cannot be reached");
  load().then(() => nav.followWhileShown(server, take, lost));
})((globalThis.urbanNav ??= {}));
