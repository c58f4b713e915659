// SPDX-License-Identifier: BSD-3-Clause
// Lists of sessions, closures and edits. Independent of the page.
"use strict";
((nav) => {
  /** Closures that pass a filter {verdict, kind, session}; empty members let all pass. */
  nav.filterClosures = (closures, filter) =>
    closures.filter(
      (c) =>
        (!filter.verdict || c.verdict === filter.verdict) &&
        (!filter.kind || c.kind === filter.kind) &&
        (filter.session === "" ||
          filter.session === undefined ||
          c.a.session === Number(filter.session) ||
          c.b.session === Number(filter.session)),
    );

  /** The ID `step` places after a closure in a list; the first or last one if it is not there; null for an empty list. */
  nav.neighbour = (closures, id, step) => {
    if (closures.length === 0) return null;
    const at = closures.findIndex((c) => c.id === id);
    if (at < 0) return closures[step > 0 ? 0 : closures.length - 1].id;
    return closures[Math.min(closures.length - 1, Math.max(0, at + step))].id;
  };

  /** One end of a closure for a person: "day1 +3.5 s". */
  nav.endText = (sessions, end) => {
    const session = end.session === null ? null : sessions[end.session];
    return `${session ? session.name : "?"} +${end.seconds.toFixed(2)} s`;
  };

  /** A length for a person: "0.07 mm", "1.204 m". */
  nav.lengthText = (metres) => (metres < 0.01 ? `${(1e3 * metres).toFixed(2)} mm` : `${metres.toFixed(3)} m`);

  /** Returns the distance of a session from its position in another map; empty without another map. */
  nav.comparedText = (compared, session) => {
    if (!compared) return "";
    const its = compared.sessions.find((s) => s.session === session);
    if (!its) return "; not in the other store";
    if (its.poses === 0) return "; no pose at the same time in the other store";
    return `; ${nav.lengthText(its.largest_m)} at most from the other store, at +${its.seconds.toFixed(1)} s, rms ${nav.lengthText(its.rms_m)}`;
  };

  /** Returns the names of the compared maps, for the head of the page. */
  nav.comparedNotice = (compared) => {
    if (!compared) return "";
    const absent = compared.absent_here.length > 0 ? `, which also has ${compared.absent_here.join(", ")}` : "";
    return `compared with ${compared.store}${absent}`;
  };

  /** Adds nanoseconds exactly: stamps are texts of seconds, which have more digits than a number of JavaScript. */
  nav.addSeconds = (stamp, seconds) => {
    const [whole, fraction = ""] = stamp.split(".");
    const ns =
      BigInt(whole) * 1000000000n + BigInt(fraction.padEnd(9, "0").slice(0, 9)) + BigInt(Math.round(seconds * 1e9));
    return `${ns / 1000000000n}.${String(ns % 1000000000n).padStart(9, "0")}`;
  };

  /** A moment as `edge` takes it: s since 1970, or since the beginning of a session where another session has that time. */
  nav.momentWord = (sessions, index, seconds) => {
    const session = sessions[index],
      stamp = nav.addSeconds(session.begin, seconds),
      value = Number(stamp);
    const shared = sessions.some(
      (other, k) =>
        k !== index &&
        other.poses > 0 &&
        value >= Number(other.begin) - 2 &&
        value <= Number(other.begin) + other.seconds + 2,
    );
    return shared ? `${session.id}+${seconds.toFixed(6)}` : stamp;
  };

  /** Finds what a person wrote as a moment: {session, seconds}, or null. The rules of `edge`, for display only. */
  nav.findMoment = (sessions, word) => {
    const relative = /^(.*)\+(\d+(?:\.\d*)?)$/.exec(word.trim());
    if (relative) {
      const at = sessions.findIndex(
        (s) => s.poses > 0 && (relative[1] === "" || s.name.startsWith(relative[1]) || s.id.startsWith(relative[1])),
      );
      return at < 0 || Number(relative[2]) > sessions[at].seconds + 1
        ? null
        : {session: at, seconds: Number(relative[2])};
    }
    const value = /^\d+(\.\d*)?$/.test(word.trim()) ? Number(word) : NaN;
    const at = sessions.findIndex(
      (s) => s.poses > 0 && value >= Number(s.begin) - 1 && value <= Number(s.begin) + s.seconds + 1,
    );
    return at < 0 ? null : {session: at, seconds: value - Number(sessions[at].begin)};
  };

  /** The word for a session in `cut SESSION T`: its name where no other has it. */
  nav.sessionWord = (sessions, index) =>
    sessions.filter((s) => s.name === sessions[index].name).length === 1 ? sessions[index].name : sessions[index].id;

  /** Words of an edit for the server; null and a sentence if something is missing. `fields`: contents of the inputs by name. */
  nav.editWords = (action, state, selected, fields) => {
    const missing = (sentence) => [null, sentence],
      words = (args, options = {}) => [{action, arguments: args, options}, ""];
    if (action === "undo" || action === "redo") return words([]);
    if (["reject", "accept", "remove"].includes(action))
      return selected === null ? missing("Select a closure first.") : words([String(selected)]);
    if (!fields.t1) return missing("Pick moment 1 on the path, or write it.");
    if (action === "origin") return words([fields.t1]);
    if (action === "cut") {
      const at = nav.findMoment(state.sessions, fields.t1);
      return at
        ? words([nav.sessionWord(state.sessions, at.session), fields.t1])
        : missing("Moment 1 lies in no session.");
    }
    if (action === "pin") {
      if (!fields.at) return missing("Write where moment 1 lies: X,Y,Z in m.");
      return words([fields.t1], {at: fields.at, ...(fields["pin-sigma"] ? {sigma: fields["pin-sigma"]} : {})});
    }
    if (!fields.t2) return missing("Pick moment 2 on the path, or write it.");
    if (action === "measure") return words([fields.t1, fields.t2]);
    if (!fields.pose) return missing("Write the pose: X,Y,Z,QX,QY,QZ,QW.");
    return words([fields.t1, fields.t2], {
      pose: fields.pose,
      ...(fields["pose-sigma"] ? {sigma: fields["pose-sigma"]} : {}),
    });
  };
})((globalThis.urbanNav ??= {}));
