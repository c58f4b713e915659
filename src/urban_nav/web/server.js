// SPDX-License-Identifier: BSD-3-Clause
// Requests to the server, each with the token in a header.
"use strict";
((nav) => {
  /** Takes whole events off the front of a text of server-sent events: [their data, what is left]. */
  nav.takeEvents = (text) => {
    const parts = text.split("\n\n"),
      left = parts.pop(),
      events = [];
    for (const part of parts) {
      const data = part
        .split("\n")
        .filter((line) => line.startsWith("data:"))
        .map((line) => line.slice(5).trimStart());
      if (data.length > 0) events.push(data.join("\n"));
    }
    return [events, left];
  };

  nav.Server = class {
    constructor(token) {
      this.token = token;
    }

    async request(path, options = {}) {
      const answer = await fetch(path, {
        ...options,
        headers: {...options.headers, "X-Urban-Nav-Token": this.token},
        credentials: "omit",
        cache: "no-store",
      });
      if (answer.ok) return answer;
      const error = await answer.json().catch(() => null);
      throw new Error((error && error.error) || `the server answers ${answer.status}`);
    }
    async json(path) {
      return (await this.request(path)).json();
    }
    async bytes(path) {
      return (await this.request(path)).arrayBuffer();
    }
    async blob(path) {
      const answer = await this.request(path);
      return answer.status === 204 ? null : answer.blob();
    }
    async post(path, words) {
      return (
        await this.request(path, {
          method: "POST",
          headers: {"Content-Type": "application/json"},
          body: JSON.stringify(words),
        })
      ).json();
    }
    edit(words) {
      return this.post("/api/edit", words);
    }

    /** Calls `take` with each state that the server reports, and `lost` when it cannot be reached; ends with the signal. */
    async follow(take, lost, signal) {
      while (!signal.aborted) {
        try {
          const reader = (await this.request("/api/events", {signal})).body
            .pipeThrough(new TextDecoderStream())
            .getReader();
          for (let text = "", part = await reader.read(); !part.done; part = await reader.read()) {
            const [events, left] = nav.takeEvents(text + part.value);
            text = left;
            for (const event of events) take(JSON.parse(event));
          }
        } catch (error) {
          if (signal.aborted) return;
        }
        lost();
        await new Promise((resolve) => setTimeout(resolve, 2000));
      }
    }
  };

  /** Follows the server as Server.follow() while the page is shown. A hidden page polls rarely, because a browser has few
   * connections to one server. */
  nav.followWhileShown = (server, take, lost) => {
    let following = null;
    const follow = () => {
      if (following) following.abort();
      following = new AbortController();
      const {signal} = following;
      if (!document.hidden) {
        server.follow(take, lost, signal);
        return;
      }
      const timer = setInterval(() => server.json("/api/now").then(take, lost), 1500);
      signal.addEventListener("abort", () => clearInterval(timer));
    };
    document.addEventListener("visibilitychange", follow);
    follow();
  };
})((globalThis.urbanNav ??= {}));
